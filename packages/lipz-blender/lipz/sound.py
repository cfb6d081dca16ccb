"""Recordings: sound strips in the sequencer, each from the frame at which its clip begins."""

from __future__ import annotations

import os

# The property of a strip that has the key of its clip.
CLIP = "lipz"
EXTENSIONS = (".wav", ".flac", ".ogg", ".opus", ".mp3")


def sound_of(folder, key):
    """Returns the path of the recording of a clip in a folder, or None."""
    paths = (os.path.join(folder, *key.split("/")) + extension for extension in EXTENSIONS)
    return next((path for path in paths if os.path.isfile(path)), None)


def place_sound(scene, path, key, start):
    """Adds a sound strip that begins at a frame, and removes the earlier strip of the same clip."""
    strips = scene.sequence_editor_create().strips
    channel = None
    for strip in list(strips):
        if strip.get(CLIP) == key:
            channel = strip.channel
            strips.remove(strip)
    new = strips.new_sound(name=key, filepath=path, channel=channel or _free_channel(strips), frame_start=start)
    new[CLIP] = key
    return new


def _free_channel(strips):
    """Returns the lowest channel without strips, except those of other clips."""
    used = {strip.channel for strip in strips if CLIP not in strip.keys()}
    return next(channel for channel in range(1, 129) if channel not in used)
