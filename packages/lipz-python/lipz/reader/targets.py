"""The targets of a sound: where it moves jaw, lips and tongue."""

from __future__ import annotations

CLOSED_LIPS = 1
LIP_ON_TEETH = 2


class Targets:
    """The record of a phone or a shape.

    `percent` is the position of jaw, opening, rounding, spreading, and tip, protrusion and back of the tongue.
    `strength_tenths` is how strongly the sound prevails over its neighbours: on jaw, lips and rounding. `second` is the
    number of the second sound of a diphthong.
    """

    __slots__ = ("percent", "strength_tenths", "sound_class", "second")

    def __init__(
        self, percent: tuple[int, ...], strength_tenths: tuple[int, ...], sound_class: int = 0, second: int = 0
    ) -> None:
        self.percent = percent
        self.strength_tenths = strength_tenths
        self.sound_class = sound_class
        self.second = second


# The lips lie on each other without pressure.
REST = Targets((5, 12, 10, 0, 0, 0, 0), (0, 0, 0))
