"""Keys of shape keys. Keys of lipz have the type `GENERATED`, so that they can be replaced without the others."""

from __future__ import annotations

GENERATED = "GENERATED"
# Two keys are on the same frame if they are closer than this.
_SAME_FRAME = 0.01


def curves_of(shape_keys):
    """Returns the F-curves of the shape keys of a mesh, in their action. Creates the action if it is missing."""
    import bpy

    animation = shape_keys.animation_data_create()
    if animation.action is None:
        animation.action = bpy.data.actions.new(f"{shape_keys.user.name} lips")
    action = animation.action
    if animation.action_slot is None:
        animation.action_slot = action.slots.new(id_type="KEY", name=shape_keys.name)
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(animation.action_slot, ensure=True).fcurves


def remove_generated(curves, start, end):
    """Removes the keys of lipz from `start` to `end`, both included."""
    for curve in curves:
        points = curve.keyframe_points
        frames = _frames_of(points)
        inside = (at for at, frame in enumerate(frames) if start - _SAME_FRAME <= frame <= end + _SAME_FRAME)
        old = [at for at in inside if points[at].type == GENERATED]
        # From the last to the first, because each removal moves the points after it.
        for at in reversed(old):
            points.remove(points[at], fast=True)
        if old:
            curve.update()


def add_generated(curve, keys, is_stepped):
    """Adds keys, each a frame and a value, to a curve. Frames that have a key of the animator keep it."""
    points = curve.keyframe_points
    taken = {round(frame / _SAME_FRAME) for frame in _frames_of(points)}
    keys = [(frame, value) for frame, value in keys if round(frame / _SAME_FRAME) not in taken]
    first, last = len(points), len(keys) - 1
    points.add(len(keys))
    for index, key in enumerate(keys):
        point = points[first + index]
        point.co = key
        # The last value lasts until the next clip begins.
        point.interpolation = "CONSTANT" if is_stepped or index == last else "LINEAR"
        point.type = GENERATED
    curve.update()


def _frames_of(points):
    """Returns the frame of each key."""
    frames = [0.0] * (2 * len(points))
    points.foreach_get("co", frames)
    return frames[::2]
