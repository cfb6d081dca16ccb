"""The head: it moves a little while the mouth does."""

from __future__ import annotations

from . import chance
from .curves import Curve
from .face_profile import FaceProfile
from .times import Fps, Micros
from .visemes import REST

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .clip import Clip

# The microseconds in which a head comes to rest after the mouth stops, and starts before the mouth moves.
_NEAR_US = 250_000
_SPEAKING = 1000
# The part of a slot of poses that is searched for changes, in milliseconds.
_LOOKED_AT_MS = 1000


def head_motion(clip: Clip, profile: FaceProfile, seed: int, ms: int, poses: Curve | None) -> tuple[int, int, int]:
    """Returns pitch, yaw and roll in thousandths of a degree.

    There is one pose for each key of the curve `pose`. Without the curve, there is one for each segment, each pause
    and, between those, each word of average length.
    """
    fps = clip.fps
    speaking = 0 if fps is None else _speaking(clip, fps, ms)
    if fps is None or speaking == 0:
        return 0, 0, 0
    turn = None if poses is None else _at_keys(fps, profile, ms, poses)
    targets, parts = turn or _in_slots(clip, fps, profile, seed, ms)
    most = profile.head_motion
    pitch, yaw, roll = (
        _angle(seed, stream, amount, targets, parts, speaking)
        for stream, amount in ((chance.PITCH, most * 2 // 3), (chance.YAW, most), (chance.ROLL, most // 2))
    )
    return pitch, yaw, roll


def _angle(
    seed: int, stream: int, most: int, targets: list[tuple[int, int]], parts: tuple[int, int], speaking: int
) -> int:
    first, second, third = (
        chance.either_side(most * share // 1000, chance.draw(seed, stream, 0, number)) for number, share in targets
    )
    angle = first + chance.scaled(second - first, parts[0], chance.WHOLE)
    angle += chance.scaled(third - second, parts[1], chance.WHOLE)
    return chance.scaled(angle, speaking, _SPEAKING)


def _frame_at(fps: Fps, us: int) -> int:
    return fps.frame_at(Micros(us))


def _speaking(clip: Clip, fps: Fps, ms: int) -> int:
    """Returns how much the mouth moves, in thousandths: less far from the nearest frame that is not rest."""
    now_us = ms * 1000
    now = _frame_at(fps, now_us)
    first = _frame_at(fps, max(now_us - _NEAR_US, 0))
    nearest = _NEAR_US
    for frame in range(min(now, clip.frame_count - 1), first - 1, -1):
        if clip.viseme(frame) != REST:
            nearest = min(nearest, max(now_us - fps.start_of_frame_us(frame + 1), 0))
            break
    for frame in range(now + 1, min(_frame_at(fps, now_us + _NEAR_US), clip.frame_count - 1) + 1):
        if clip.viseme(frame) != REST:
            nearest = min(nearest, max(fps.start_of_frame_us(frame) - now_us, 0))
            break
    return (_NEAR_US - nearest) * _SPEAKING // _NEAR_US


def _at_keys(
    fps: Fps, profile: FaceProfile, ms: int, poses: Curve
) -> tuple[list[tuple[int, int]], tuple[int, int]] | None:
    """Turns from the pose of one key to that of the next, in half of `pose_ms` or until the key after that."""
    index = poses.index_at(_frame_at(fps, ms * 1000))
    key = poses.key(index)
    if key is None:
        return None
    before, behind = poses.key(max(index - 1, 0)) or key, poses.key(index + 1)
    start = fps.start_of_frame_us(key[0]) // 1000
    length = profile.pose_ms // 2
    if behind is not None:
        length = min(max(fps.start_of_frame_us(behind[0]) // 1000 - start, 0), length)
    from_pose, to_pose = ((frame, min(max(share, 0), 1000)) for frame, share in (before, key))
    return [from_pose, from_pose, to_pose], (0, _eased(max(ms - start, 0), length))


def _in_slots(
    clip: Clip, fps: Fps, profile: FaceProfile, seed: int, ms: int
) -> tuple[list[tuple[int, int]], tuple[int, int]]:
    """Divides time into slots. In each slot, the head begins to turn to a new pose. Overlapping steps are added."""
    length = max(profile.pose_ms, 1)
    slot = ms // length
    targets = [(number, 1000) for number in (max(slot - 1, 0), slot, slot + 1)]
    first = _in_slot(clip, fps, profile, seed, ms, slot - 1) if slot > 0 else 0
    return targets, (first, _in_slot(clip, fps, profile, seed, ms, slot))


def _in_slot(clip: Clip, fps: Fps, profile: FaceProfile, seed: int, ms: int, slot: int) -> int:
    """Returns the progress of the step of a slot, which takes half a slot."""
    length = profile.pose_ms
    start = _change_ms(clip, fps, slot * length, length)
    if start is None:
        start = slot * length + chance.part(length // 2, chance.draw(seed, chance.POSE_TIME, 0, slot))
    return _eased(max(ms - start, 0), length // 2)


def _change_ms(clip: Clip, fps: Fps, slot_ms: int, length_ms: int) -> int | None:
    """Returns the time of a change in a slot: the last start of a segment, or else the first edge of a pause."""
    start_us = slot_ms * 1000
    end_us = start_us + min(length_ms, _LOOKED_AT_MS) * 1000
    # The frames that start in the slot. The first frame of the clip is never a change.
    before = min(_frame_at(fps, max(start_us - 1, 0)), clip.frame_count)
    end = min(_frame_at(fps, max(end_us - 1, 0)) + 1, clip.frame_count)
    if end == 0:
        return None
    segment = clip.segment_of_frame(end - 1)
    if segment is not None and segment.start_frame > before:
        return fps.start_of_frame_us(segment.start_frame) // 1000
    for frame in range(before + 1, end):
        if (clip.viseme(frame) == REST) != (clip.viseme(frame - 1) == REST):
            return fps.start_of_frame_us(frame) // 1000
    return None


def _eased(passed_ms: int, length_ms: int) -> int:
    """Returns the progress of a step in 65,536ths. It starts and ends slowly: x² (3 - 2x)."""
    whole = chance.WHOLE
    done = min((passed_ms << 16) // length_ms, whole) if length_ms else whole
    return (done * done >> 16) * (3 * whole - 2 * done) >> 16
