"""The targets of shapes, for clips without phones (docs/reference/bank-format.md, "Computing articulation")."""

from __future__ import annotations

from .targets import CLOSED_LIPS, LIP_ON_TEETH, Targets

_SHAPES = (
    ("S", "B", Targets((22, 50, 15, 20, 70, 0, 20), (7, 6, 5))),
    ("M", "A", Targets((25, 0, 5, 0, 0, 0, 0), (7, 10, 5), CLOSED_LIPS)),
    ("F", "G", Targets((20, 15, 0, 0, 0, 0, 0), (7, 10, 5), LIP_ON_TEETH)),
    ("A", "D", Targets((85, 85, 5, 10, 0, 0, 10), (10, 10, 10))),
    ("E", "C", Targets((40, 65, 5, 50, 0, 0, 0), (10, 10, 10))),
    ("O", "E", Targets((60, 55, 50, 0, 0, 0, 40), (10, 10, 15))),
    ("U", "F", Targets((28, 32, 70, 0, 0, 0, 40), (10, 14, 15))),
    ("W", "", Targets((20, 15, 90, 0, 0, 0, 40), (7, 14, 15))),
    ("L", "", Targets((35, 55, 5, 0, 100, 20, 0), (7, 6, 5))),
)
_LEVELS = (0, 11, 22, 33, 44, 55, 66, 77, 88, 100)
_UNKNOWN = _SHAPES[0][2]
_BY_TYPE = {
    "blair": {code: targets for code, _, targets in _SHAPES},
    "toonboom": {code: targets for _, code, targets in _SHAPES if code},
    "rms": {str(digit): Targets((most, most, 0, 0, 0, 0, 0), (10, 10, 10)) for digit, most in enumerate(_LEVELS)},
}


def targets_of_shape(code: str, viseme_type: str) -> Targets:
    """Returns the targets of a viseme."""
    return _BY_TYPE[viseme_type].get(code, _UNKNOWN)
