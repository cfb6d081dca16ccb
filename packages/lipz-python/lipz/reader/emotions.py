"""The emotions of a character: the curves that are named after the twelve attributes of emotion."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip

EMOTIONS = (
    *("sadness", "anger", "joy", "fear", "disgust", "surprise"),
    *("shock", "perplexed", "asleep", "pain", "exertion", "shout"),
)
_PLACES = {name: place for place, name in enumerate(EMOTIONS)}


class Who:
    """The character whose curves count: the speaker, the speaker with a name, or another character."""

    __slots__ = ("name", "is_speaker")

    def __init__(self, character: str | None, speaker: str | None) -> None:
        self.name = speaker if character is None else character
        self.is_speaker = character is None

    def purpose(self, curve: str) -> str | None:
        """Returns the name of a curve without the character, or None if it belongs to a different character."""
        if self.name is not None and curve.startswith(self.name + "."):
            return curve[len(self.name) + 1 :]
        return curve if self.is_speaker else None


class Emotions:
    """The values of the attributes at a time, from 0 to 10 each."""

    __slots__ = ("_thousandths",)

    def __init__(self, thousandths: list[int]) -> None:
        self._thousandths = thousandths

    @property
    def values(self) -> dict[str, float]:
        """The value of each attribute."""
        return {name: value / 1000 for name, value in zip(EMOTIONS, self._thousandths)}

    @property
    def strongest(self) -> str | None:
        """The attribute with the highest value, or None on a neutral face."""
        most = max(self._thousandths)
        return EMOTIONS[self._thousandths.index(most)] if most > 0 else None

    @property
    def sum(self) -> float:
        """The sum of all values. Faces are made for at most 10."""
        return sum(self._thousandths) / 1000


def emotions_in(clip: Clip, position: int | None, who: Who) -> list[int]:
    """Returns the attributes in thousandths, at a position in 65,536ths of a frame."""
    found = [0] * len(EMOTIONS)
    if position is None:
        return found
    for curve in clip.curves:
        purpose = who.purpose(curve.name)
        place = None if purpose is None else _PLACES.get(purpose)
        if place is not None:
            found[place] = farther(found[place], curve.thousandths(position), 0)
    return found


def farther(one: int, other: int, neutral: int) -> int:
    """Returns the one of two values that is farther from neutral."""
    return other if abs(other - neutral) > abs(one - neutral) else one
