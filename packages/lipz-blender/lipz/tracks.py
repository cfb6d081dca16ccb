"""The values of a model's shapes in each frame of a scene. Needs the reader, but not Blender."""

from __future__ import annotations

from .reader import Micros, shapes_of
from .reader.times import MICROS_PER_SECOND
from .reader.visemes import REST

VISEME_TYPES = ("blair", "toonboom", "rms")


class ShapeError(ValueError):
    """The shapes of a model do not fit the clip or the bank. The message states a fix."""


class Tracks:
    """The values of shapes in each frame: `values[name][frame]`, starting from 0. Stepped values change at once."""

    def __init__(self, values, is_stepped, kind, report):
        self.values = values
        self.is_stepped = is_stepped
        self.kind = kind
        self.report = report

    @property
    def frame_count(self):
        return max(map(len, self.values.values()))

    def keys(self, name):
        """Returns the frames and values to key. Between them, the value is constant or linear."""
        values = self.values[name]
        last = len(values) - 1
        if self.is_stepped:
            return [(at, value) for at, value in enumerate(values) if at == 0 or value != values[at - 1]]
        return [
            (at, value)
            for at, value in enumerate(values)
            if at in (0, last) or value != values[at - 1] or value != values[at + 1]
        ]


def tracks_of(bank, clip, names, fps, fps_base=1.0, rig_name=None):
    """Returns the values of the shapes with these names, for a scene of `fps` / `fps_base` frames per second.

    Uses the rig `rig_name` of the bank, or the one that fits the names. A model with a shape for each viseme needs
    none. Raises ShapeError if neither fits.
    """
    if clip.fps is None:
        raise ShapeError(f"{clip.key} has no frame rate: set `fps` in its Lipz file")
    recognised = shapes_of(names)
    kind = rig_name or recognised.kind
    clock = _Clock(fps, fps_base)
    times = [clock.time(frame) for frame in range(clock.frame_count(clip) + 1)]
    if kind in VISEME_TYPES:
        if clip.viseme_type != kind:
            raise ShapeError(
                f"the shapes are {kind}, but {clip.key} is {clip.viseme_type}: convert the clip or use a rig"
            )
        rows = [dict(recognised.shown(clip.viseme_at(time))) for time in times]
        # A mesh at rest needs no shape.
        report = recognised.report if recognised.missing != [REST] else None
        return Tracks(_columns(rows), True, kind, report)
    if kind is None:
        raise ShapeError(recognised.report)
    rig = bank.rigs.get(kind)
    if rig is None:
        raise ShapeError(f"the bank lacks the rig {kind}: add `{kind} = true` to [rig] in lipz.toml, and pack again")
    shapes = shapes_of(names, rig)
    if not shapes.map:
        raise ShapeError(f"none of the shapes has a name of the rig {kind}")
    rows = [dict(shapes.named(clip.weights_at(time, rig))) for time in times]
    return Tracks(_columns(rows), False, kind, shapes.report)


class _Clock:
    """The frames of a scene, in whole numbers of microseconds."""

    def __init__(self, fps, fps_base):
        self._fps = fps
        # `fps_base` frames take 1 / `fps` seconds.
        self._base_us = round(fps_base * MICROS_PER_SECOND)

    def time(self, frame):
        """Returns the start of a frame of the scene, rounded up, so that it is in that frame of the clip."""
        return Micros(-(-frame * self._base_us // self._fps))

    def frame_count(self, clip):
        """Returns the first frame of the scene at or after the end of the clip."""
        passed = clip.frame_count * clip.fps.denominator * self._fps * MICROS_PER_SECOND
        return max(-(-passed // (clip.fps.numerator * self._base_us)), 1)


def _columns(rows):
    return {name: [row[name] for row in rows] for name in rows[0]}
