"""The cursor: the position in a clip while it plays. It returns each event exactly once."""

from __future__ import annotations

from .events import Event
from .segment import Segment
from .times import MICROS_PER_SECOND, WAITING, Fps, later
from .visemes import REST, held_frame, openness_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip
    from .times import Time

# The frame from the end of the clip on.
_OVER = 0xFFFF_FFFF
_MOST_HOLD = 255
# The most events that a query of a state evaluates. No clip has so many, but a forged bank may.
_MOST_EVENTS = 1 << 20


class CharacterState:
    """The lasting effects of events on a character. `name` is None for a speaker without a name."""

    __slots__ = ("name", "feels", "stares_at", "points_at")

    def __init__(self, name: str | None) -> None:
        self.name = name
        self.feels: str | None = None
        self.stares_at: str | None = None
        self.points_at: str | None = None

    def apply(self, event: Event) -> None:
        """Changes the state by an event of the character."""
        if event.verb == "feels":
            self.feels = event.object
        elif event.verb in ("stares", "stops staring"):
            self.stares_at = event.object
        elif event.verb in ("points", "stops pointing"):
            self.points_at = event.object


class Due:
    """The segments that have begun since the last call, in order, and the events in them."""

    __slots__ = ("segments", "_speaker")

    def __init__(self, segments: list[Segment], speaker: str | None) -> None:
        self.segments = segments
        self._speaker = speaker

    @property
    def events(self) -> list[Event]:
        """The events, in order. Events without a character belong to the speaker."""
        if not self.segments:
            return []
        return [_spoken(event, self._speaker) for segment in self.segments for event in segment.events]


_NOTHING = Due([], None)


class Cursor:
    """The position in a clip. Call `advance_to` once per rendered frame, with the position of the audio."""

    __slots__ = (
        *("clip", "lead_us", "_hold_frames", "_fps", "_viseme_type", "_speaker", "_frame", "_mouth_frame"),
        *("_next_segment", "_is_fired", "_has_looped"),
    )

    def __init__(self, clip: Clip) -> None:
        if clip.fps is None:
            raise ValueError(f"the clip {clip.key} has no frame rate: set one with `or_fps`")
        self.clip = clip
        # How far visemes are ahead of the audio, in microseconds.
        self.lead_us = 0
        self._hold_frames = 0
        self._fps: Fps = clip.fps
        self._viseme_type = clip.viseme_type
        self._speaker: str | None = None
        self._frame = WAITING
        self._mouth_frame = WAITING
        self._next_segment = 0
        self._is_fired = False
        self._has_looped = False

    def resumed_in(self, clip: Clip) -> Cursor:
        """Returns the cursor at the same time in another clip."""
        cursor = Cursor(clip.or_fps(self._fps.numerator, self._fps.denominator))
        cursor._viseme_type = clip.viseme_type or self._viseme_type
        cursor.lead_us, cursor._hold_frames = self.lead_us, self._hold_frames
        cursor._frame, cursor._mouth_frame = self._frame, self._mouth_frame
        cursor._next_segment, cursor._is_fired = self._next_segment, self._is_fired
        cursor._has_looped = self._has_looped
        return cursor

    @property
    def speaker(self) -> str | None:
        """The character of events without a name. A name that occurs in no event of the bank is ignored."""
        return self._speaker

    @speaker.setter
    def speaker(self, name: str | None) -> None:
        is_known = name is not None and self.clip.bank.event_table.number_of(name) is not None
        self._speaker = name if is_known else None

    @property
    def hold_frames(self) -> int:
        """The minimum number of frames for a consonant."""
        return self._hold_frames

    @hold_frames.setter
    def hold_frames(self, count: int) -> None:
        self._hold_frames = min(count, _MOST_HOLD)

    def set_lead_frames(self, count: int) -> None:
        """Sets the lead of visemes to one or two frames."""
        self.lead_us = self._fps.start_of_frame_us(count)

    def set_hold(self, rendered_frame_us: int | None = None) -> None:
        """Holds consonants as long as viewers need to read them (two frames at 24 fps).

        If you pass the microseconds of a rendered frame, holds them so long that one rendered frame shows them.
        """
        numerator, denominator = self._fps.numerator, self._fps.denominator
        if rendered_frame_us is None:
            self.hold_frames = (numerator + 6 * denominator) // (12 * denominator)
        else:
            self.hold_frames = -(-rendered_frame_us * numerator // (denominator * MICROS_PER_SECOND))

    def advance_to(self, time: Time) -> Due:
        """Moves the cursor to the position of the audio. Returns the segments that have begun since the last call.

        Each segment is returned once, however long ago the last call was. A time before the last one returns none.
        """
        before, first = self._frame, self._next_segment
        self._show(time)
        if self._frame == before and self._is_fired:
            return _NOTHING
        self._next_segment = max(first, self._segments_begun())
        self._is_fired = True
        return self._due(range(first, self._next_segment))

    def loop_to(self, time: Time) -> Due:
        """Moves the cursor after the audio has jumped from its end to its start. Returns the rest and the new start."""
        self._show(time)
        first, self._next_segment = self._next_segment, self._segments_begun()
        self._is_fired = self._has_looped = True
        return self._due([*range(first, self.clip.segment_count), *range(self._next_segment)])

    def seek(self, time: Time) -> None:
        """Jumps to a time. The next `advance_to` starts with the segments that begin in that frame."""
        self._show(time)
        before = min(self._frame, self.clip.frame_count) - 1
        self._next_segment = self._begun_by(before) if before >= 0 else 0
        self._is_fired = self._has_looped = False

    def finish(self) -> Due:
        """Ends the clip before its audio ends. Returns the remaining segments."""
        self._frame = self._mouth_frame = _OVER
        first, self._next_segment = self._next_segment, self.clip.segment_count
        self._is_fired = True
        return self._due(range(first, self._next_segment))

    @property
    def viseme(self) -> str:
        """The viseme to draw, with lead and hold; rest outside the clip."""
        if self._mouth_frame < 0:
            return REST
        clip, frame = self.clip, self._mouth_frame
        if self._hold_frames > 1:
            frame = held_frame(clip.frames, self._viseme_type, self._hold_frames, frame)
        return clip.viseme(frame)

    @property
    def openness(self) -> float | None:
        """How far the mouth to draw is open, from 0 to 0.99; None without visemes or viseme type."""
        if self._viseme_type is None or self.clip.frame_count == 0:
            return None
        return openness_of(self.viseme, self._viseme_type) / 10_000

    @property
    def segment(self) -> Segment | None:
        """The segment of the subtitle to show, or None outside the clip."""
        return self.clip.segment_of_frame(self._frame)

    @property
    def frame(self) -> int | None:
        """The frame at the position of the audio, or None outside the clip."""
        return None if self._frame in (WAITING, _OVER) else self._frame

    @property
    def is_over(self) -> bool:
        """Whether the audio is past the last frame."""
        return self._frame == _OVER

    def state(self, character: str | None = None) -> CharacterState:
        """Returns the state of a character, by default the speaker, after the events so far."""
        wanted = self._speaker if character is None else character
        state = CharacterState(character)
        for event in self._events(self._past()):
            if event.character == wanted:
                state.apply(event)
        return state

    def characters(self) -> list[CharacterState]:
        """Returns the states of all characters in the events of the clip, in the order of their names."""
        names = {event.character for event in self._events(range(self.clip.segment_count))}
        states = {name: CharacterState(name) for name in sorted(names, key=_bytes_of)}
        for event in self._events(self._past()):
            states[event.character].apply(event)
        return list(states.values())

    def _past(self) -> list[int]:
        """Returns the segments whose events have been returned or jumped over."""
        last_round = range(self.clip.segment_count if self._has_looped else 0)
        return [*last_round, *range(min(self._next_segment, self.clip.segment_count))]

    def _events(self, segments: range | list[int]) -> list[Event]:
        found: list[Event] = []
        for index in segments:
            found.extend(_spoken(event, self._speaker) for event in Segment(self.clip, index).events)
            if len(found) > _MOST_EVENTS:
                break
        return found

    def _due(self, segments: range | list[int]) -> Due:
        if not segments:
            return _NOTHING
        count = self.clip.segment_count
        return Due([Segment(self.clip, index) for index in segments if index < count], self._speaker)

    def _show(self, time: Time) -> None:
        self._frame = self._frame_at(time)
        self._mouth_frame = self._frame_at(later(time, self.lead_us)) if self.lead_us else self._frame

    def _frame_at(self, time: Time) -> int:
        frame = (self.clip.fps or self._fps).frame_at(time)
        return frame if frame < self.clip.frame_count else _OVER

    def _segments_begun(self) -> int:
        if self._frame == WAITING:
            return 0
        return self.clip.segment_count if self._frame == _OVER else self._begun_by(self._frame)

    def _begun_by(self, frame: int) -> int:
        return min(self.clip.segment_index(frame) + 1, self.clip.segment_count)


def _spoken(event: Event, speaker: str | None) -> Event:
    if event.character is not None or speaker is None:
        return event
    return Event(speaker, event.verb, event.object, event.strength)


def _bytes_of(name: str | None) -> bytes:
    return b"" if name is None else name.encode()
