"""Articulation: how far jaw, lips and tongue are from rest (docs/guides/articulation.md)."""

from __future__ import annotations

import struct

from .blend import Blend
from .phones import SILENCE, Phones
from .shape_targets import targets_of_shape
from .targets import REST, Targets
from .times import MILLISECONDS, Fps
from .visemes import REST as REST_CODE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip
    from .times import Time

ARTICULATORS = (
    *("jaw", "opening", "closure", "teeth", "rounding", "spreading"),
    *("tongue_tip", "tongue_out", "tongue_back"),
)
_PLACES = {name: place for place, name in enumerate(ARTICULATORS)}
_RECORD = struct.Struct("<HHHHhhI")
_TARGETS = struct.Struct("<7B3BBB")

# How many milliseconds before its start and after its end a sound can matter.
_REACH_MS = 150
# The most milliseconds from a query to a start or an end. Farther ones have no effect.
_MOST_MS = 400
# The most phones that are blended.
_MOST_NEAR = 24
# From this length on, a diphthong has two sounds. The second one begins after this part, in hundredths.
_SHORTEST_GLIDE_US = 30_000
_GLIDE_PERCENT = 55
_LONGEST_FRAME_US = 1_000_000


class Articulation:
    """How far each articulator is from rest at a time, from 0 to 1."""

    __slots__ = ("_thousandths",)

    def __init__(self, thousandths: list[int]) -> None:
        self._thousandths = thousandths

    @property
    def values(self) -> dict[str, float]:
        """The value of each articulator."""
        return {name: value / 1000 for name, value in zip(ARTICULATORS, self._thousandths)}


class ArticulationProfile:
    """How a character articulates: `[articulation]` in `lipz.toml`, or `DEFAULT_ARTICULATION`."""

    __slots__ = ("name", "targets", "gain_percent", "jaw_percent", "lead_ms", "level_db")

    def __init__(self, name: str, targets: list[Targets], numbers: tuple[int, int, int, int]) -> None:
        self.name = name
        self.targets = targets
        self.gain_percent, self.jaw_percent, self.lead_ms, self.level_db = numbers

    def targets_of(self, phone: int) -> Targets:
        """Returns the targets of a phone; those of rest for a phone that the profile does not list."""
        return self.targets[phone] if phone < len(self.targets) else REST

    def gain_at(self, level_db: int | None) -> int:
        """Returns how wide the mouth opens in a line with this level, in thousandths."""
        louder_db = 0 if level_db is None else level_db - self.level_db
        return min(max(louder_db * 35 + 1000, 700), 1300) * self.gain_percent // 100


DEFAULT_ARTICULATION = ArticulationProfile("default", [], (100, 100, 10, -20))


def profiles_in(data: memoryview) -> list[ArticulationProfile]:
    """Returns the profiles of a section. A damaged profile ends the list."""
    profiles = []
    at = 0
    while at + _RECORD.size <= len(data):
        name_length, count, *numbers, _ = _RECORD.unpack_from(data, at)
        start = at + _RECORD.size + name_length
        at = start + count * _TARGETS.size
        if at > len(data):
            break
        name = str(data[start - name_length : start], "utf-8", "replace")
        targets = [
            Targets(found[:7], found[7:10], found[10], found[11]) for found in _TARGETS.iter_unpack(data[start:at])
        ]
        profiles.append(ArticulationProfile(name, targets, (numbers[0], numbers[1], numbers[2], numbers[3])))
    return profiles


def articulation_of(clip: Clip, time: Time, profile: ArticulationProfile) -> list[int]:
    """Returns the value of each articulator at a time, in thousandths."""
    phones = clip.phones
    blend = Blend(phones.are_certain)
    if len(phones):
        _add_phones(blend, phones, time, profile)
    elif clip.fps is not None and clip.viseme_type is not None:
        _add_shapes(blend, clip, clip.fps, clip.viseme_type, time)
    rest = profile.targets_of(SILENCE)
    values = blend.finished(rest, profile.jaw_percent, profile.gain_at(phones.level_db))
    position = clip.position_at(time)
    if position is not None:
        for curve in clip.curves:
            place = _PLACES.get(curve.name)
            if place is not None:
                values[place] = min(max(curve.thousandths(position), 0), 1000)
    return values


def _add_phones(blend: Blend, phones: Phones, time: Time, profile: ArticulationProfile) -> None:
    now_ms, now_us = -_MOST_MS, 0
    if MILLISECONDS.frame_at(time) >= 0:
        position = MILLISECONDS.position_at(time)
        now_ms = (position >> 16) + profile.lead_ms
        now_us = (position & 0xFFFF) * 1000 >> 16
    numbers, starts_ms = phones.numbers, phones.starts_ms
    # The phone before the first one that starts within reach may end within reach.
    first = max(_started_by(starts_ms, max(now_ms - _REACH_MS, 0)) - 1, 0)
    last_ms = max(now_ms + _REACH_MS, 0)
    for index in range(first, min(first + _MOST_NEAR, len(numbers))):
        if starts_ms[index] > last_ms:
            break
        if numbers[index] == SILENCE:
            continue
        end_ms = starts_ms[index + 1] if index + 1 < len(starts_ms) else phones.end_ms
        start_us, end_us = (
            min(max(ms - now_ms, -_MOST_MS), _MOST_MS) * 1000 - now_us for ms in (starts_ms[index], end_ms)
        )
        targets = profile.targets_of(numbers[index])
        if targets.second != numbers[index] and end_us - start_us > _SHORTEST_GLIDE_US:
            glide_us = start_us + (end_us - start_us) * _GLIDE_PERCENT // 100
            blend.add(start_us, glide_us, targets)
            start_us, targets = glide_us, profile.targets_of(targets.second)
        blend.add(start_us, end_us, targets)


def _started_by(starts_ms: list[int], ms: int) -> int:
    """Returns the number of phones that start at or before a time."""
    low, high = 0, len(starts_ms)
    while low < high:
        middle = (low + high) // 2
        if starts_ms[middle] <= ms:
            low = middle + 1
        else:
            high = middle
    return low


def _add_shapes(blend: Blend, clip: Clip, fps: Fps, viseme_type: str, time: Time) -> None:
    """Adds the runs of equal shapes near a time, each as one sound."""
    if fps.frame_at(time) < 0:
        return
    position = fps.position_at(time)
    frame = position >> 16
    frame_us = min(max(fps.start_of_frame_us(1), 1), _LONGEST_FRAME_US)
    reach = _MOST_MS * 1000 // frame_us + 1
    start = max(frame - reach, 0)
    end_of_reach = min(frame + reach, len(clip.frames))
    passed_us = frame_us * ((position & 0xFFFF) >> 4) >> 12
    while start < end_of_reach:
        code = clip.frames[start]
        end = start + 1
        while end < end_of_reach and clip.frames[end] == code:
            end += 1
        if code != REST_CODE:
            start_us, end_us = ((edge - frame) * frame_us - passed_us for edge in (start, end))
            blend.add(start_us, end_us, targets_of_shape(code, viseme_type))
        start = end
