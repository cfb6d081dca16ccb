"""The whole face at a time: generated motion, and the curves that override it (docs/guides/faces.md)."""

from __future__ import annotations

from . import chance
from .curves import Curve
from .emotions import Who, emotions_in, farther
from .face_profile import AHEAD, FaceProfile, LookAt
from .head import head_motion
from .ids import clip_id
from .times import MILLISECONDS, Micros

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable

    from .clip import Clip
    from .times import Time

_CURVES = frozenset(
    (
        *("blink", "headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw", "lids", "nod", "shake"),
        *("lookPitch", "lookYaw", "brows", "shrug", "breath"),
    )
)
# `nod` and `shake` are neutral at 5, and each unit turns the head by two degrees.
_NEUTRAL = 5000
_DEGREES_PER_UNIT = 2
_SACCADE_MS = 50
# Pitch and yaw of the left eye, the right eye and the mouth of a person one metre away.
_OF_A_FACE = ((0, 1900), (0, -1900), (-4000, 0))
_GLANCE_DOWN, _GLANCE_MORE, _GLANCE_ASIDE = 10_000, 8000, 12_000
_CLOSED = 1000


class Face:
    """The state of a face at a time, except for mouth and emotions.

    `blink`, `brows` and `shrug` are from 0 to 1, and `breath` from 0 to 10. Angles are in degrees: pitch is positive
    upwards, yaw to the left of the character, roll towards the left shoulder.
    """

    __slots__ = ("_thousandths",)

    def __init__(self, thousandths: tuple[int, ...]) -> None:
        self._thousandths = thousandths

    @property
    def values(self) -> dict[str, float]:
        """All values by their names."""
        return {name: value / 1000 for name, value in zip(FACE_VALUES, self._thousandths)}

    @property
    def for_rig(self) -> tuple[int, int, int]:
        """Blink, brows and shrug in thousandths."""
        return self._thousandths[0], self._thousandths[6], self._thousandths[7]


FACE_VALUES = tuple("blink head_pitch head_yaw head_roll eye_pitch eye_yaw brows shrug breath".split())


def face_of(clip: Clip, time: Time, who: Who, profile: FaceProfile, look_at: LookAt) -> Face:
    """Returns the face of a character of a clip at a time."""
    values: dict[str, int] = {}
    poses: tuple[str, Curve] | None = None
    position = clip.position_at(time)
    for curve in clip.curves:
        purpose = who.purpose(curve.name)
        if purpose == "pose":
            # The one with the character's name in front.
            if poses is None or len(curve.name) >= len(poses[0]):
                poses = curve.name, curve
        elif purpose in _CURVES and position is not None:
            value = curve.thousandths(position)
            neutral = _NEUTRAL if purpose in ("nod", "shake") else 0
            values[purpose] = farther(values[purpose], value, neutral) if purpose in values else value
    ms = max(MILLISECONDS.frame_at(time), 0)
    if who.is_speaker:
        seed, head = clip.id, head_motion(clip, profile, clip.id, ms, poses and poses[1])
    else:
        seed, head = clip.id ^ clip_id(who.name or ""), (0, 0, 0)

    def leading(at_ms: int) -> int:
        emotions = emotions_in(clip, clip.position_at(Micros(at_ms * 1000)), who)
        most = max(emotions)
        return emotions.index(most) + 1 if most > 0 else 0

    return _assembled(profile, seed, ms, head, values, look_at, leading)


def idle_face(profile: FaceProfile, time: Time, seed: int, look_at: LookAt = AHEAD) -> Face:
    """Returns the face of a silent character, who blinks and looks. Give each character a different seed."""
    ms = max(MILLISECONDS.frame_at(time), 0)
    return _assembled(profile, seed, ms, (0, 0, 0), {}, look_at, lambda _: 0)


def _assembled(
    profile: FaceProfile,
    seed: int,
    ms: int,
    head: tuple[int, int, int],
    values: dict[str, int],
    look_at: LookAt,
    leading: Callable[[int], int],
) -> Face:
    blink = values["blink"] if "blink" in values else _blink(profile, seed, ms, leading)
    pitch, yaw = _gaze(profile, seed, ms, look_at)
    eye_pitch, pitch = profile.shared(values.get("eyePitch", pitch) + values.get("lookPitch", 0))
    eye_yaw, yaw = profile.shared(values.get("eyeYaw", yaw) + values.get("lookYaw", 0))
    nod, shake = ((values.get(name, _NEUTRAL) - _NEUTRAL) * _DEGREES_PER_UNIT for name in ("nod", "shake"))
    return Face(
        (
            max(blink, values.get("lids", 0)),
            values.get("headPitch", head[0]) + nod + pitch,
            values.get("headYaw", head[1]) + shake + yaw,
            values.get("headRoll", head[2]),
            eye_pitch,
            eye_yaw,
            *(values.get(name, 0) for name in ("brows", "shrug", "breath")),
        )
    )


def _blink(profile: FaceProfile, seed: int, ms: int, leading: Callable[[int], int]) -> int:
    """Returns how far the lids are closed, in thousandths. Each interval has its own grid with one blink in each slot.

    A blink counts if its interval is that of the leading emotion when the blink begins.
    """
    most = 0
    for interval in dict.fromkeys(profile.blink_interval_ms):
        if interval == 0:
            continue
        phase = chance.part(interval, chance.draw(seed, chance.BLINK_PHASE, interval, 0))
        now = ms + phase
        current = now // interval
        for slot in (current - 1, current):
            if slot < 0:
                continue
            late = chance.part(interval // 2, chance.draw(seed, chance.BLINK_TIME, interval, slot))
            start = slot * interval + interval // 4 + late
            if start < phase or now < start:
                continue
            drawn = chance.draw(seed, chance.DOUBLE_BLINK, interval, slot)
            is_double = chance.part(100, drawn) < profile.double_blink_percent
            closed = _closed_after(now - start, profile.blink_length_ms, is_double)
            if closed > most and profile.blink_interval_ms[leading(start - phase)] == interval:
                most = closed
    return most


def _closed_after(passed_ms: int, length_ms: int, is_double: bool) -> int:
    """Returns how far the lids are closed this long after the start of a blink, in thousandths."""
    again = length_ms + length_ms // 2
    if is_double and passed_ms >= again:
        passed_ms -= again
    closing, open_from = length_ms // 4, length_ms // 2
    if passed_ms < closing:
        return passed_ms * _CLOSED // closing
    if passed_ms < open_from or length_ms == open_from:
        return _CLOSED if passed_ms < open_from else 0
    return max(length_ms - passed_ms, 0) * _CLOSED // (length_ms - open_from)


def _gaze(profile: FaceProfile, seed: int, ms: int, look_at: LookAt) -> tuple[int, int]:
    """Returns pitch and yaw of the eyes, in thousandths of a degree."""
    if not look_at.is_person:
        return look_at.pitch, look_at.yaw
    before, now, done = chance.step(seed, ms, chance.FIXATION_TIME, profile.fixation_ms, _SACCADE_MS)
    old, new = _fixation(profile, seed, before), _fixation(profile, seed, now)
    pitch, yaw = (a + chance.scaled(b - a, done, chance.WHOLE) for a, b in zip(old, new))
    return look_at.pitch + pitch, look_at.yaw + yaw


def _fixation(profile: FaceProfile, seed: int, number: int) -> tuple[int, int]:
    """Returns pitch and yaw of a fixation, relative to the eyes of the other person."""
    if chance.part(100, chance.draw(seed, chance.GLANCE, 0, number)) < profile.glance_percent:
        down = _GLANCE_DOWN + chance.part(_GLANCE_MORE, chance.draw(seed, chance.EYE_PITCH, 0, number))
        return -down, chance.either_side(_GLANCE_ASIDE, chance.draw(seed, chance.EYE_YAW, 0, number))
    return _OF_A_FACE[chance.part(len(_OF_A_FACE), chance.draw(seed, chance.TARGET, 0, number))]
