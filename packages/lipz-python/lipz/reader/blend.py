"""Coarticulation: sounds that overlap are blended, and then closed lips are closed.

Each sound is a trapezoid: it rises before its start, holds until shortly before its end, and falls. The mouth is the
average of all sounds, weighted by their trapezoids and strengths, and of rest where they are weak.
"""

from __future__ import annotations

from .targets import Targets

# The rise and the fall of each group in microseconds: jaw, lips, rounding, tongue.
_RISE_US = (140_000, 120_000, 150_000, 60_000)
_LONGEST_RISE_US = 150_000
# The group of each target.
_GROUPS = (0, 1, 2, 1, 3, 3, 3)
_TONGUE_STRENGTH = 10
_LONGEST_RELEASE_US = 40_000
# The shortest length and the ramp of each constraint: closed lips, lip on the teeth, narrow jaw.
_WINDOWS_US = ((60_000, 45_000), (50_000, 50_000), (40_000, 100_000))
_LIPS_US = 120_000
# The widest jaw in a sibilant and the widest opening with a lip on the teeth, in thousandths.
_JAW_CAP = 80
_TEETH_CAP = 150
# The weight from which sounds leave no room for rest.
_FULL_WEIGHT = 10_000


class Blend:
    """The sounds that were added so far. Constraints are enforced only for certain sounds."""

    __slots__ = ("_are_certain", "_sums", "_weights", "_held")

    def __init__(self, are_certain: bool) -> None:
        self._are_certain = are_certain
        self._sums = [0] * len(_GROUPS)
        self._weights = [0] * len(_RISE_US)
        self._held = [0] * len(_WINDOWS_US)

    def add(self, start_us: int, end_us: int, targets: Targets) -> None:
        """Adds a sound that starts and ends this many microseconds after the time of the query."""
        if start_us > _LONGEST_RISE_US or end_us < -_LONGEST_RISE_US:
            return
        # Rounded towards zero, because a damaged bank may have a negative length.
        hold_end_us = end_us - min(int((end_us - start_us) / 4), _LONGEST_RELEASE_US)
        jaw, lips, rounding = targets.strength_tenths
        strengths = (jaw, lips, rounding, _TONGUE_STRENGTH)
        added = [_share(start_us, hold_end_us, rise_us) * strength for rise_us, strength in zip(_RISE_US, strengths)]
        for group, weight in enumerate(added):
            self._weights[group] += weight
        for place, (group, percent) in enumerate(zip(_GROUPS, targets.percent)):
            self._sums[place] += added[group] * percent
        if not targets.sound_class:
            return
        for bit, (shortest_us, ramp_us) in enumerate(_WINDOWS_US):
            if targets.sound_class >> bit & 1:
                if self._are_certain:
                    lasting = _share(start_us, max(end_us, start_us + shortest_us), ramp_us)
                else:
                    lasting = _share(start_us, hold_end_us, _LIPS_US) // 2
                self._held[bit] = max(self._held[bit], lasting)

    def finished(self, rest: Targets, jaw_percent: int, gain: int) -> list[int]:
        """Returns the articulation in thousandths: the average, scaled by the gain, with constraints last."""
        values = []
        for total, group, percent in zip(self._sums, _GROUPS, rest.percent):
            weight = self._weights[group]
            total += max(_FULL_WEIGHT - weight, 0) * percent
            values.append(total // (max(weight, _FULL_WEIGHT) // 10))
        jaw, opening, rounding, spreading, tip, out, back = values
        closed_lips, lip_on_teeth, narrow_jaw = self._held
        jaw = _capped(min(jaw * jaw_percent // 100 * gain // 1000, 1000), _JAW_CAP, narrow_jaw)
        opening = _capped(min(opening * gain // 1000, 1000), _TEETH_CAP, lip_on_teeth)
        opening = _capped(opening, 0, closed_lips)
        return [jaw, opening, closed_lips, lip_on_teeth, rounding, spreading, tip, out, back]


def _capped(value: int, cap: int, share: int) -> int:
    return min((value * (1000 - share) + cap * share) // 1000, value)


def _share(start_us: int, end_us: int, rise_us: int) -> int:
    """Returns how far a movement has come at the time of the query, in thousandths."""
    done = min(rise_us - start_us, end_us + rise_us, rise_us)
    return done * 1000 // rise_us if done > 0 else 0
