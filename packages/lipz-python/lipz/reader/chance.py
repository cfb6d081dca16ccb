"""Random numbers that are the same on every machine (docs/guides/faces.md, "Generated motion")."""

from __future__ import annotations

from .ids import FINISH, STEP, mix

# The purposes of draws, which are independent of each other.
BLINK_PHASE, BLINK_TIME, DOUBLE_BLINK, POSE_TIME, PITCH, YAW, ROLL = range(1, 8)
FIXATION_TIME, GLANCE, TARGET, EYE_PITCH, EYE_YAW = range(8, 13)

# A finished step, in 65,536ths.
WHOLE = 1 << 16


def draw(seed: int, stream: int, interval: int, index: int) -> int:
    """Returns a number from 0 to 65,535."""
    return mix(mix(mix(seed ^ (interval << 8 | stream), STEP) ^ index, FINISH), STEP) >> 48


def part(amount: int, drawn: int) -> int:
    """Maps a draw to a number from 0 up to, but not including, `amount`."""
    return amount * drawn >> 16


def either_side(amount: int, drawn: int) -> int:
    """Maps a draw to a number from -`amount` up to, but not including, `amount`."""
    return part(2 * amount, drawn) - amount


def scaled(value: int, share: int, whole: int) -> int:
    """Returns `value` * `share` / `whole`, rounded towards 0."""
    product = abs(value) * share // whole
    return product if value >= 0 else -product


def step(seed: int, ms: int, stream: int, period_ms: int, step_ms: int) -> tuple[int, int, int]:
    """Returns the states before and after the current step, and the part of it that is done, in 65,536ths.

    There is one step in each period. It starts in the first half of it and takes `step_ms`.
    """
    if period_ms == 0:
        return 0, 0, WHOLE

    def start(number: int) -> int:
        return number * period_ms + part(period_ms // 2, draw(seed, stream, 0, number))

    number = ms // period_ms
    if ms < start(number):
        number -= 1
    if number < 0:
        return 0, 0, WHOLE
    passed = max(ms - start(number), 0)
    return number, number + 1, (passed << 16) // step_ms if passed < step_ms else WHOLE
