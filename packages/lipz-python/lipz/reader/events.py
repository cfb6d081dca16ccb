"""Events: the strings of segments, and the typed events in them."""

from __future__ import annotations

import struct

from .file import text_of

NO_NAME = 0xFFFF_FFFF
# The verbs in the order of their numbers, which start at 1.
VERBS = (
    *("feels", "sees", "stares", "stops staring", "points", "stops pointing", "does"),
    *("nods", "shakes", "breathes", "blinks", "looks away"),
)
_WITH_OBJECT = frozenset(("feels", "sees", "stares", "points", "does"))
_WITH_STRENGTH = frozenset(("nods", "shakes", "breathes"))
_MOST_THOUSANDTHS = 0x7FFF_FFFF

_TYPED = struct.Struct("<IIB")
_EVENT = struct.Struct("<IIII")
_NAME = struct.Struct("<II")


class Event:
    """An event in Character Event Syntax, such as `mara sees otto`.

    `character` is None for the speaker. `object` is the emotion, target or action, or None. `strength` is the number of
    a gesture, from 0 to 10, or None.
    """

    __slots__ = ("character", "verb", "object", "strength")

    def __init__(self, character: str | None, verb: str, object: str | None, strength: float | None) -> None:
        self.character = character
        self.verb = verb
        self.object = object
        self.strength = strength

    def __str__(self) -> str:
        strength = None if self.strength is None else number_text(self.strength)
        return " ".join(word for word in (self.character, self.verb, self.object, strength) if word is not None)

    def __repr__(self) -> str:
        return f"<Event {self}>"


class EventTable:
    """The event strings of a bank, their typed events, and the names in them."""

    __slots__ = ("_records", "_typed", "_names", "_strings", "_known")

    def __init__(self, sections: dict[bytes, memoryview]) -> None:
        self._records = sections[b"EVNT"]
        self._typed = sections[b"EVTY"]
        self._names = sections[b"EVNM"]
        self._strings = sections[b"EVST"]
        self._known: dict[int, list[Event]] = {}

    def string(self, number: int) -> str | None:
        """Returns the event string with this number."""
        if (number + 1) * _EVENT.size > len(self._records):
            return None
        start, length, _, _ = _EVENT.unpack_from(self._records, number * _EVENT.size)
        return text_of(self._strings, start, length)

    def typed(self, number: int) -> list[Event]:
        """Returns the typed events of a string, which are shared by all segments with this string."""
        events = self._known.get(number)
        if events is None:
            events = self._known[number] = self._read(number)
        return events

    def name(self, number: int) -> str | None:
        """Returns the name with this number."""
        if (number + 1) * _NAME.size > len(self._names):
            return None
        start, length = _NAME.unpack_from(self._names, number * _NAME.size)
        return text_of(self._strings, start, length)

    def number_of(self, name: str) -> int | None:
        """Returns the number of a name, or None if it does not occur in the bank."""
        wanted = name.encode("utf-8", "surrogatepass")
        low, high = 0, len(self._names) // _NAME.size
        while low < high:
            middle = (low + high) // 2
            start, length = _NAME.unpack_from(self._names, middle * _NAME.size)
            found = bytes(self._strings[start : start + length])
            if found == wanted:
                return middle
            low, high = (middle + 1, high) if found < wanted else (low, middle)
        return None

    def _read(self, number: int) -> list[Event]:
        events: list[Event] = []
        if (number + 1) * _EVENT.size > len(self._records):
            return events
        _, _, first, count = _EVENT.unpack_from(self._records, number * _EVENT.size)
        if (first + count) * _EVENT.size > len(self._typed):
            return events
        for at in range(first, first + count):
            event = self._event(*_TYPED.unpack_from(self._typed, at * _EVENT.size))
            # Only a damaged bank has such a record.
            if event is None:
                break
            events.append(event)
        return events

    def _event(self, character: int, target: int, verb_number: int) -> Event | None:
        if not 0 < verb_number <= len(VERBS):
            return None
        verb = VERBS[verb_number - 1]
        name = None if character == NO_NAME else self.name(character)
        word = None if target == NO_NAME else self.name(target)
        if (name is None) != (character == NO_NAME) or (word is None) != (target == NO_NAME):
            return None
        if verb in _WITH_STRENGTH:
            strength = None if word is None else _strength(word)
            return None if (strength is None) != (word is None) else Event(name, verb, None, strength)
        return None if (verb in _WITH_OBJECT) == (word is None) else Event(name, verb, word, None)


def _strength(word: str) -> float | None:
    """Returns the number of a gesture, which has at most three places."""
    whole, _, places = word.partition(".")
    digits = word.replace(".", "", 1)
    if not whole or word.endswith(".") or not (digits.isascii() and digits.isdigit()) or len(places.rstrip("0")) > 3:
        return None
    thousandths = int(whole + places[:3].ljust(3, "0"))
    return thousandths / 1000 if thousandths <= _MOST_THOUSANDTHS else None


def number_text(value: float) -> str:
    """Returns a number with at most three places, without trailing zeros."""
    return f"{value:.3f}".rstrip("0").rstrip(".")
