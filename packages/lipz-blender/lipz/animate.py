"""Animates the face of an object with clips of a bank, and replaces the keys of a clip when it has changed."""

from __future__ import annotations

import json

from .keying import add_generated, curves_of, remove_generated
from .sound import place_sound, sound_of
from .tracks import ShapeError, tracks_of

# The property of the shape keys that lists the clips: for each key of a clip, the first and the last frame.
RECORD = "lipz"


def animate(face, bank, clip, start, scene, rig_name=None, sound_folder=None):
    """Keys the shape keys of an object with a clip that begins at frame `start`. Returns a sentence about shapes that
    the model lacks, or None.

    Keys that an earlier call has made for the same clip are replaced. All other keys stay. If `sound_folder` has the
    recording of the clip, it begins at the same frame.

    Raises ShapeError if the object has no shape keys that fit.
    """
    shape_keys = getattr(face.data, "shape_keys", None) if face is not None else None
    if shape_keys is None:
        raise ShapeError("the active object has no shape keys: select the mesh of the face")
    blocks = {block.name: block for block in shape_keys.key_blocks if block != shape_keys.reference_key}
    tracks = tracks_of(bank, clip, list(blocks), scene.render.fps, scene.render.fps_base, rig_name)
    curves = curves_of(shape_keys)
    clips = clips_of(shape_keys)
    end = start + tracks.frame_count - 1
    for first, last in (clips.get(clip.key, (start, end)), (start, end)):
        remove_generated(curves, first, last)
    for name in tracks.values:
        path = blocks[name].path_from_id("value")
        curve = curves.find(path) or curves.new(path)
        add_generated(curve, [(start + at, value) for at, value in tracks.keys(name)], tracks.is_stepped)
    clips[clip.key] = (start, end)
    shape_keys[RECORD] = json.dumps(clips)
    sound = sound_folder and sound_of(sound_folder, clip.key)
    if sound:
        place_sound(scene, sound, clip.key, start)
    return tracks.report


def clips_of(shape_keys):
    """Returns the first and the last frame of each clip that shape keys are animated with."""
    return {key: tuple(frames) for key, frames in json.loads(shape_keys.get(RECORD, "{}")).items()}


def update(face, bank, scene, rig_name=None, sound_folder=None):
    """Animates all clips of a face again, each from its frame, after the bank has changed.

    Returns the keys of clips that the bank lacks. Their keys stay.
    """
    missing = []
    shape_keys = getattr(face.data, "shape_keys", None) if face is not None else None
    for key, (start, _) in clips_of(shape_keys or {}).items():
        clip = bank.clip(key)
        if clip is None:
            missing.append(key)
        else:
            animate(face, bank, clip, start, scene, rig_name, sound_folder)
    return missing
