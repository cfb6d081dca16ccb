"""One segment of a clip: frames, texts and events."""

from __future__ import annotations

from .events import Event
from .texts import Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip


class Segment:
    """A part of a clip, such as a sentence. The range of its frames excludes `end_frame`."""

    __slots__ = ("clip", "index")

    def __init__(self, clip: Clip, index: int) -> None:
        self.clip = clip
        self.index = index

    def __repr__(self) -> str:
        return f"<Segment {self.index} of {self.clip.key}>"

    @property
    def start_frame(self) -> int:
        return self.clip.start_of_segment(self.index)

    @property
    def end_frame(self) -> int:
        return self.clip.start_of_segment(self.index + 1)

    @property
    def start_us(self) -> int | None:
        """The start in microseconds, or None without a frame rate."""
        return None if self.clip.fps is None else self.clip.fps.start_of_frame_us(self.start_frame)

    @property
    def end_us(self) -> int | None:
        """The end in microseconds, or None without a frame rate."""
        return None if self.clip.fps is None else self.clip.fps.start_of_frame_us(self.end_frame)

    @property
    def frames(self) -> str:
        """The code of each frame."""
        return self.clip.frames[self.start_frame : self.end_frame]

    def text(self, locale: str | None) -> Text | None:
        """Returns the text in a locale, such as `de-de`.

        It is from a different locale if the clip is not translated (`is_fallback`), and None if it is not translated to
        any of the locales that this one falls back to.
        """
        return self.clip.bank.text_of(locale, self.clip.first_number, self.index)

    @property
    def event(self) -> str | None:
        """The event string in any syntax, or None if the file of the clip has no events."""
        number = self._event_number()
        return None if number is None else self.clip.bank.event_table.string(number)

    @property
    def events(self) -> list[Event]:
        """The events, if the string is in Character Event Syntax. Those without a character are the speaker's."""
        number = self._event_number()
        return [] if number is None else self.clip.bank.event_table.typed(number)

    def _event_number(self) -> int | None:
        references = self.clip.bank.event_references
        number = self.clip.first_number + self.index
        return references[number] if number < len(references) else None
