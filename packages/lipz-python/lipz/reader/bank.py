"""A bank: the clips of one file, used in place."""

from __future__ import annotations

import struct

from .articulation import DEFAULT_ARTICULATION, ArticulationProfile, profiles_in
from .babble import DEFAULT_BABBLE, Babble, babbles_in
from .clip import Clip
from .curves import CurveTable
from .errors import BankError
from .events import EventTable
from .face_profile import DEFAULT_FACE_PROFILE, FaceProfile, face_profiles_in
from .file import REQUIRED, REQUIRED_OF_TEXTS, File, text_of, u32s
from .ids import clip_id, slot_of
from .phones import PhoneTable
from .rig import Rig, rigs_in
from .texts import LocaleTable, Text
from .times import Fps
from .voices import VoiceTable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TypeVar

    from .file import Buffer

    Named = TypeVar("Named", Babble, FaceProfile, ArticulationProfile, Rig)

_CLIP = struct.Struct("<IIIHBB")
_KEY = struct.Struct("<QIHH")
_RATE = struct.Struct("<QII")
_MAX_INTEGER_FPS = 1000
_NO_RATE = 0xFFFF
# The plural categories of Unicode's CLDR, which come first in the key of a variant.
_PLURAL_CATEGORIES = {"zero", "one", "two", "few", "many", "other"}


class Bank:
    """The spoken lines in a bank. It reads from `data`, which must not change while the bank is in use."""

    def __init__(self, data: Buffer) -> None:
        """Opens the bank in these bytes. Checks its header and directory.

        Raises BankError if the bytes are not a bank, are cut off, or have a damaged directory.
        """
        file = File(data)
        if file.has_texts_only:
            raise BankError("TextsOnly", 0)
        sections = file.find(REQUIRED)
        self._file = file
        self._clips, self._keys = sections[b"CLIP"], sections[b"KEYS"]
        self._rates, self._names = sections[b"RATE"], sections[b"NAME"]
        self._pilots, self._key_order = u32s(sections[b"PILT"]), u32s(sections[b"ORDR"])
        self.clip_count: int = len(self._clips) // _CLIP.size
        self.frame_codes: memoryview = sections[b"FRAM"]
        self.starts = u32s(sections[b"STRT"])
        self.event_references = u32s(sections[b"EVRF"])
        self.event_table = EventTable(sections)
        self.curve_table = CurveTable(file, self.event_table)
        self.phone_table = PhoneTable(file)
        self.voice_table = VoiceTable(file, self.clip_count)
        self._texts = [LocaleTable(sections, max(len(self.starts) - 1, 0))]
        # Profiles and rigs by their names.
        self.babbles: dict[str, Babble] = _named(babbles_in(file.section(b"BABL")))
        self.face_profiles: dict[str, FaceProfile] = _named(face_profiles_in(file.section(b"FACE")))
        self.articulations: dict[str, ArticulationProfile] = _named(profiles_in(file.section(b"ARTC")))
        self.rigs: dict[str, Rig] = _named(rigs_in(file.section(b"RIGS")))
        self.default_babble: Babble = self.babbles.get("default", DEFAULT_BABBLE)
        self.default_face_profile: FaceProfile = self.face_profiles.get("default", DEFAULT_FACE_PROFILE)
        self.default_articulation: ArticulationProfile = self.articulations.get("default", DEFAULT_ARTICULATION)

    @property
    def format_version(self) -> tuple[int, int]:
        """The format version of the file, major and minor."""
        return self._file.format_version

    @property
    def fingerprint(self) -> int:
        """A hash of the clips, which is the same for a bank and its text banks."""
        return self._file.fingerprint

    def verify_checksum(self) -> Bank:
        """Compares the checksum with the bytes, and returns the bank.

        Raises BankError if the file was changed or damaged.
        """
        self._file.verify_checksum()
        return self

    def with_texts(self, *files: Buffer, verify_checksums: bool = False) -> Bank:
        """Returns the bank with the texts of these text banks instead of its own texts.

        Checks the header and the directory of each file, and with `verify_checksums` also its checksum. Raises
        BankError if a file is damaged or belongs to different clips.
        """
        bank = Bank(self._file.view)
        bank._texts = [self._texts_in(data, verify_checksums) for data in files]
        return bank

    def _texts_in(self, data: Buffer, verifies_checksum: bool) -> LocaleTable:
        file = File(data)
        sections = file.find(REQUIRED_OF_TEXTS if file.has_texts_only else REQUIRED)
        if file.fingerprint != self.fingerprint:
            raise BankError("OtherClips", 24)
        if verifies_checksum:
            file.verify_checksum()
        return LocaleTable(sections, max(len(self.starts) - 1, 0))

    @property
    def locales(self) -> list[str]:
        """The locales with texts, in ascending order. Tags with `-x-` are variants: leave them out of a menu."""
        return sorted({tag for table in self._texts for tag in table.tags})

    def variant(self, locale: str, key: str) -> str:
        """Returns the locale for texts of a variant.

        For `pl-pl` and the key `few`, these are the texts of `text_pl-pl-x-few` in Lipz files. A key lists all cases
        that apply, the plural category first: `few`, or `few-fem`. The search removes names from the end of the key
        (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip has any of these,
        the result is the locale itself. Look variants up once per locale.
        """
        tags = {tag for table in self._texts for tag in table.tags}
        names = key.split("-")
        behind = names[1:] if names[0] in _PLURAL_CATEGORIES else []
        beginnings = (part[:count] for part in (names, behind) for count in range(len(part), 0, -1))
        found = (f"{locale}-x-{'-'.join(part)}" for part in beginnings)
        return next((tag for tag in found if tag in tags), locale)

    @property
    def default_locale(self) -> str | None:
        """The default locale of the project, or None."""
        return next((table.default for table in self._texts if table.default is not None), None)

    @property
    def voices(self) -> list[str]:
        """The voices, starting with that of the originals; empty without dubs."""
        return list(self.voice_table.tags)

    @property
    def clips(self) -> list[Clip]:
        """All clips, in the order of their keys."""
        found = []
        for slot in self._key_order:
            if slot >= self.clip_count:
                break
            found.append(Clip(self, slot))
        return found

    def clips_under(self, prefix: str) -> list[Clip]:
        """Returns the clips whose keys start with a prefix, such as `act1/`, in the order of their keys."""
        return [clip for clip in self.clips if clip.key.startswith(prefix)]

    def clip(self, key: str) -> Clip | None:
        """Returns the clip with this key, or None."""
        found = self.clip_with_id(clip_id(key))
        return found if found is not None and found.key == key else None

    def clip_with_id(self, own_id: int) -> Clip | None:
        """Returns the clip with this id, or None."""
        if not len(self._pilots):
            return None
        slot = slot_of(own_id, self._file.index_seed, self._pilots, self.clip_count)
        clip = self.clip_in_slot(slot)
        return clip if clip is not None and clip.id == own_id else None

    def clip_in_slot(self, slot: int) -> Clip | None:
        """Returns the clip in a slot. The order of slots has no meaning."""
        return Clip(self, slot) if 0 <= slot < self.clip_count else None

    # For clips and segments.

    def clip_record(self, slot: int) -> tuple[int, int, int, int, int, int]:
        """Returns the fields of a clip record."""
        record: tuple[int, int, int, int, int, int] = _CLIP.unpack_from(self._clips, slot * _CLIP.size)
        return record

    def key_record(self, slot: int) -> tuple[int, str, int]:
        """Returns the id and the key of a clip, and the number of its segments."""
        if (slot + 1) * _KEY.size > len(self._keys):
            return 0, "", 0
        own_id, start, length, segment_count = _KEY.unpack_from(self._keys, slot * _KEY.size)
        return own_id, text_of(self._names, start, length) or "", segment_count

    def rate(self, number: int) -> Fps | None:
        """Returns the frame rate with this number, or None if it is unspecified or not valid."""
        numerator, denominator = number, 1
        if number > _MAX_INTEGER_FPS:
            at = (number - _MAX_INTEGER_FPS - 1) * _RATE.size
            if number == _NO_RATE or at + _RATE.size > len(self._rates):
                return None
            _, numerator, denominator = _RATE.unpack_from(self._rates, at)
        return Fps(numerator, denominator) if 0 < denominator <= numerator <= 1000 * denominator else None

    def text_of(self, locale: str | None, first: int, index: int) -> Text | None:
        """Returns the text of a segment, of a clip whose first segment has the number `first`."""
        for table in self._texts:
            if locale in table.tags:
                return table.text(table.tags.index(locale), first, first + index)
        return None


def _named(items: list[Named]) -> dict[str, Named]:
    """Returns profiles by their names. The first of equal names counts."""
    return {item.name: item for item in reversed(items)}
