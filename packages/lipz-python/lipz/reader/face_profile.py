"""Face profiles: the frequency of blinks, and the range of head and eyes. Also the targets of the eyes."""

from __future__ import annotations

import struct

_RECORD = struct.Struct("<13HHBBHHHHH")
_INTERVALS = 13
# The greatest turn of the head, in thousandths of a degree.
_HEAD_MOST = 60_000


class FaceProfile:
    """The parameters of generated motion: `[face]` in `lipz.toml`, or `DEFAULT_FACE_PROFILE`.

    `blink_interval_ms` lists the interval of a calm face, then that of each leading emotion; 0 stands for no blinks.
    `head_motion` and `head_follows` are in thousandths of a degree.
    """

    __slots__ = (
        *("name", "blink_interval_ms", "blink_length_ms", "double_blink_percent", "glance_percent", "head_motion"),
        *("head_follows", "pose_ms", "fixation_ms"),
    )

    def __init__(self, name: str, numbers: tuple[int, ...]) -> None:
        self.name = name
        self.blink_interval_ms = numbers[:_INTERVALS]
        self.blink_length_ms, self.double_blink_percent, self.glance_percent = numbers[_INTERVALS : _INTERVALS + 3]
        self.head_motion, self.head_follows, self.pose_ms, self.fixation_ms = numbers[_INTERVALS + 3 :]

    def shared(self, angle: int) -> tuple[int, int]:
        """Divides an angle: the eyes turn as far as the profile allows, and the head turns the rest."""
        eyes = min(max(angle, -self.head_follows), self.head_follows)
        return eyes, min(max(angle - eyes, -_HEAD_MOST), _HEAD_MOST)


DEFAULT_FACE_PROFILE = FaceProfile(
    "default",
    (
        *(4000, 4000, 6000, 4000, 2000, 4000, 4000, 4000, 2000, 4000, 4000, 4000, 4000),
        *(240, 10, 20, 3000, 20_000, 400, 1000),
    ),
)


def face_profiles_in(data: memoryview) -> list[FaceProfile]:
    """Returns the profiles of a section. A damaged profile ends the list."""
    profiles = []
    at = 0
    while at + _RECORD.size <= len(data):
        *numbers, name_length = _RECORD.unpack_from(data, at)
        start = at + _RECORD.size
        at = start + name_length
        if at > len(data):
            break
        profiles.append(FaceProfile(str(data[start:at], "utf-8", "replace"), tuple(numbers)))
    return profiles


class LookAt:
    """The target of a character's eyes, in degrees from the head at rest: up and to the left are positive.

    The eyes move over a person's face, and stay at any other point.
    """

    __slots__ = ("pitch", "yaw", "is_person")

    def __init__(self, pitch: float, yaw: float, is_person: bool = False) -> None:
        # In thousandths.
        self.pitch = round(pitch * 1000)
        self.yaw = round(yaw * 1000)
        self.is_person = is_person


# A person straight ahead.
AHEAD = LookAt(0.0, 0.0, True)
