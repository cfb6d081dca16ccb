"""A clip: one spoken line of a bank."""

from __future__ import annotations

from .articulation import Articulation, ArticulationProfile, articulation_of
from .cursor import Cursor
from .curves import Curve
from .emotions import Emotions, Who, emotions_in
from .face import Face, face_of
from .face_profile import AHEAD, FaceProfile, LookAt
from .phones import Phones
from .segment import Segment
from .times import Fps
from .visemes import REST, openness_of
from .voices import Recording, VoicedClip

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .bank import Bank
    from .rig import Rig
    from .times import Time

_VISEME_TYPES = (None, "blair", "toonboom", "rms")
_FLAG_VISEMES = 1


class Clip:
    """One spoken line. `Bank.clip` returns it.

    `frames` is the code of each frame: a character of the viseme type, or `-` for rest. `fps` and `viseme_type` are
    None if the file of the clip does not specify them.
    """

    __slots__ = (
        *("bank", "slot", "key", "id", "fps", "viseme_type", "frames", "frame_count", "has_visemes", "segment_count"),
        *("first_number", "_frames_offset", "_curves"),
    )

    def __init__(self, bank: Bank, slot: int) -> None:
        self.bank = bank
        self.slot = slot
        self.id, self.key, segment_count = bank.key_record(slot)
        offset, count, first, rate, viseme_type, flags = bank.clip_record(slot)
        self.fps: Fps | None = bank.rate(rate)
        self.viseme_type: str | None = _VISEME_TYPES[viseme_type] if viseme_type < len(_VISEME_TYPES) else None
        self.frames: str = str(bank.frame_codes[offset : offset + count], "latin-1")
        self.frame_count: int = count
        self.has_visemes: bool = flags & _FLAG_VISEMES != 0
        self.segment_count: int = min(segment_count, len(bank.starts))
        # The number of the first segment among those of all clips.
        self.first_number: int = first
        self._frames_offset: int = offset
        self._curves: list[Curve] | None = None

    def __repr__(self) -> str:
        return f"<Clip {self.key}>"

    def or_fps(self, numerator: int, denominator: int = 1) -> Clip:
        """Returns the clip with this frame rate, if its file does not specify one."""
        return self._with(self.fps or Fps(numerator, denominator), self.viseme_type)

    def or_viseme_type(self, name: str) -> Clip:
        """Returns the clip with this viseme type, if its file does not specify one."""
        if name not in _VISEME_TYPES:
            raise ValueError(f"{name} is not a viseme type")
        return self._with(self.fps, self.viseme_type or name)

    def _with(self, fps: Fps | None, viseme_type: str | None) -> Clip:
        clip = Clip(self.bank, self.slot)
        clip.fps, clip.viseme_type = fps, viseme_type
        return clip

    @property
    def has_events(self) -> bool:
        """Whether the file of the clip has the element `events`."""
        return self.first_number < len(self.bank.event_references)

    @property
    def duration_us(self) -> int | None:
        """The length in microseconds, or None without a frame rate."""
        return None if self.fps is None else self.fps.start_of_frame_us(self.frame_count)

    def frame_at(self, time: Time) -> int | None:
        """Returns the frame at a time, or None before the start, after the end or without a frame rate."""
        if self.fps is None:
            return None
        frame = self.fps.frame_at(time)
        return frame if 0 <= frame < self.frame_count else None

    def viseme(self, frame: int | None) -> str:
        """Returns the viseme in a frame; rest outside the clip."""
        return self.frames[frame] if frame is not None and 0 <= frame < len(self.frames) else REST

    def viseme_at(self, time: Time) -> str:
        """Returns the viseme at a time; rest outside the clip."""
        return self.viseme(self.frame_at(time))

    def openness_at(self, time: Time) -> float | None:
        """Returns how far the mouth is open at a time, from 0 to 0.99; None without visemes or viseme type."""
        if self.viseme_type is None or self.frame_count == 0:
            return None
        return openness_of(self.viseme_at(time), self.viseme_type) / 10_000

    @property
    def segments(self) -> list[Segment]:
        """All segments in order."""
        return [Segment(self, index) for index in range(self.segment_count)]

    def segment(self, index: int) -> Segment | None:
        """Returns the segment with this index."""
        return Segment(self, index) if 0 <= index < self.segment_count else None

    def segment_at(self, time: Time) -> Segment | None:
        """Returns the segment at a time, or None outside the clip."""
        return self.segment_of_frame(self.frame_at(time))

    def segment_of_frame(self, frame: int | None) -> Segment | None:
        """Returns the segment to which a frame belongs, or None outside the clip."""
        if frame is None or not 0 <= frame < self.frame_count:
            return None
        return self.segment(self.segment_index(frame))

    def segment_index(self, frame: int) -> int:
        """Returns the index of the segment to which a frame of the clip belongs."""
        starts = self.bank.starts
        offset = self._frames_offset + frame
        low, high = self.first_number + 1, min(self.first_number + self.segment_count, len(starts))
        while low < high:
            middle = (low + high) // 2
            if starts[middle] <= offset:
                low = middle + 1
            else:
                high = middle
        return low - self.first_number - 1

    def start_of_segment(self, index: int) -> int:
        """Returns the first frame of a segment, or the end of the clip for the number of segments."""
        number = self.first_number + index
        starts = self.bank.starts
        return max(starts[number] - self._frames_offset, 0) if number < len(starts) else 0

    def cursor(self, speaker: str | None = None, lead_us: int = 0, hold_frames: int = 0) -> Cursor:
        """Returns a cursor before the start of the audio.

        `speaker` is the character of events without a name. `lead_us` is how far visemes are ahead of the audio, in
        microseconds. `hold_frames` is the minimum number of frames for a consonant.

        Raises ValueError for a clip without a frame rate: set one with `or_fps`.
        """
        cursor = Cursor(self)
        cursor.speaker, cursor.lead_us, cursor.hold_frames = speaker, lead_us, hold_frames
        return cursor

    def resume(self, cursor: Cursor) -> Cursor:
        """Returns a cursor at the same time in this clip, which may be from a newer bank. It has no speaker."""
        return cursor.resumed_in(self)

    @property
    def curves(self) -> list[Curve]:
        """All curves, in the order of their names."""
        if self._curves is None:
            self._curves = self.bank.curve_table.of(self.slot, self.fps)
        return self._curves

    def curve(self, name: str) -> Curve | None:
        """Returns the curve with this name, or None if the clip does not have one."""
        return next((curve for curve in self.curves if curve.name == name), None)

    def position_at(self, time: Time) -> int | None:
        """Returns a time in 65,536ths of a frame, or None without a frame rate."""
        return None if self.fps is None else self.fps.position_at(time)

    def emotions_at(self, time: Time, character: str | None = None, speaker: str | None = None) -> Emotions:
        """Returns the emotions at a time: of the speaker, or of another character.

        If you pass the name of the `speaker`, events that name the speaker count as well.
        """
        return Emotions(emotions_in(self, self.position_at(time), Who(character, speaker)))

    def face_at(
        self,
        time: Time,
        character: str | None = None,
        speaker: str | None = None,
        profile: FaceProfile | None = None,
        look_at: LookAt = AHEAD,
    ) -> Face:
        """Returns blink, head and eyes of the speaker or of another character at a time.

        They are generated from `profile`, by default that of the project. Curves of the clip override them.
        """
        return face_of(self, time, Who(character, speaker), profile or self.bank.default_face_profile, look_at)

    @property
    def phones(self) -> Phones:
        """The phones of the clip, which may be empty."""
        return self.bank.phone_table.of(self)

    def articulation_at(self, time: Time, profile: ArticulationProfile | None = None) -> Articulation:
        """Returns how far jaw, lips and tongue are from rest at a time. By default, with the profile of the project."""
        return Articulation(articulation_of(self, time, profile or self.bank.default_articulation))

    def weights_at(
        self,
        time: Time,
        rig: Rig,
        character: str | None = None,
        speaker: str | None = None,
        profile: ArticulationProfile | None = None,
        face_profile: FaceProfile | None = None,
        look_at: LookAt = AHEAD,
    ) -> list[float]:
        """Returns the weights of a rig at a time, in the order of `rig.weight_names`.

        They depend on articulation, emotions and the face of a character of the clip.
        """
        who = Who(character, speaker)
        mouth = articulation_of(self, time, profile or self.bank.default_articulation)
        face = face_of(self, time, who, face_profile or self.bank.default_face_profile, look_at)
        return rig.weights_of(mouth, emotions_in(self, self.position_at(time), who), face.for_rig)

    @property
    def recording(self) -> Recording | None:
        """The length and the hash of the clip's recording, or None if the bank does not contain them."""
        return self.bank.voice_table.recording(self.slot)

    @property
    def voice(self) -> str | None:
        """The voice in which the clip is spoken, such as `de-de`; None in a bank without dubs."""
        return self.bank.voice_table.voice_of(self.slot)

    @property
    def original(self) -> Clip | None:
        """The clip that this clip is a dub of, or None."""
        slot = self.bank.voice_table.original_of(self.slot)
        return None if slot is None else self.bank.clip_in_slot(slot)

    def in_voice(self, voice: str) -> VoicedClip:
        """Returns the clip to play in a voice, and the source of its visemes."""
        slot, spoken = self.bank.voice_table.in_voice(self.slot, voice)
        return VoicedClip(self.bank.clip_in_slot(slot) or self, spoken)
