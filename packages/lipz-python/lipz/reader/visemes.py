"""Visemes: the openness of each code, and the consonants to hold."""

from __future__ import annotations

REST = "-"

# Openness in steps of 0.11, and the codes of consonants, for each viseme type.
_STEPS = {
    "blair": {"A": 9, "E": 6, "O": 6, "L": 4, "S": 3, "U": 2, "W": 2, "F": 1},
    "toonboom": {"D": 9, "C": 6, "E": 6, "B": 3, "F": 2, "G": 1},
    "rms": {str(digit): digit for digit in range(10)},
}
_CONSONANTS = {"blair": frozenset("MSWFL"), "toonboom": frozenset("ABFG"), "rms": frozenset()}
_TEN_THOUSANDTHS_PER_STEP = 1100


def openness_of(code: str, viseme_type: str) -> int:
    """Returns how far the mouth is open in ten-thousandths, from 0 to 9,900."""
    return _STEPS[viseme_type].get(code, 0) * _TEN_THOUSANDTHS_PER_STEP


def held_frame(frames: str, viseme_type: str | None, hold: int, at: int) -> int:
    """Returns the frame whose shape is shown at a frame if each consonant lasts at least `hold` frames.

    A consonant that is too short extends into the vowels and rests after it, or else begins early. At least one frame
    of vowels or rests remains between two consonants.
    """
    consonants = _CONSONANTS.get(viseme_type or "", _CONSONANTS["rms"])
    if hold < 2 or not consonants or at >= len(frames) or frames[at] in consonants:
        return at
    # The stretch of vowels and rests around the frame, as far as the hold of a neighbour reaches.
    open_before = _open_count(frames, consonants, range(at - 1, max(at - 1 - hold, -1), -1))
    open_behind = _open_count(frames, consonants, range(at + 1, min(at + 1 + hold, len(frames))))
    spare = open_before + open_behind

    missing = _missing(frames, hold, at - 1 - open_before, -1) if open_before < hold else 0
    taken_before = min(missing, spare)
    if open_before < taken_before:
        return at - open_before - 1

    next_consonant = at + 1 + open_behind
    missing = _missing(frames, hold, next_consonant, 1) if open_behind < hold else 0
    first_behind = next_consonant + hold - missing
    room = _open_count(frames, consonants, range(first_behind, min(first_behind + hold, len(frames))))
    early = max(missing - max(room - 1, 0), 0)
    return next_consonant if open_behind < min(early, spare - taken_before) else at


def _open_count(frames: str, consonants: frozenset[str], places: range) -> int:
    """Returns the number of frames at the start of a range that are not consonants."""
    for count, place in enumerate(places):
        if frames[place] in consonants:
            return count
    return len(places)


def _missing(frames: str, hold: int, start: int, step: int) -> int:
    """Returns how many frames the run of equal codes at `start` lacks for the whole hold; 0 outside the clip."""
    if not 0 <= start < len(frames):
        return 0
    length = 1
    while length < hold and 0 <= start + length * step < len(frames) and frames[start + length * step] == frames[start]:
        length += 1
    return max(hold - length, 0)
