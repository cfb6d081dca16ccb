"""lipz for Blender: the tab `lipz` in the sidebar of the 3D viewport."""

import os

import bpy

from .animate import animate, clips_of, update
from .reader import BankError, open_bank
from .tracks import ShapeError


def _bank(settings):
    """Opens the bank of the settings. Raises ShapeError with a message for the animator if that fails."""
    path = bpy.path.abspath(settings.bank)
    if not os.path.isfile(path):
        raise ShapeError(f"there is no bank at {path!r}")
    try:
        return open_bank(path)
    except (BankError, OSError) as error:
        raise ShapeError(f"{path}: {error}") from error


def _keys_of_clips(settings, _context, text):
    """Returns the keys that contain the text of the search field."""
    try:
        return [clip.key for clip in _bank(settings).clips if text in clip.key]
    except ShapeError:
        return []


class LipzSettings(bpy.types.PropertyGroup):
    """The settings of a scene."""

    bank: bpy.props.StringProperty(name="Bank", description="Bank with the clips", subtype="FILE_PATH")
    clip: bpy.props.StringProperty(name="Clip", description="Key of the clip", search=_keys_of_clips)
    rig: bpy.props.StringProperty(name="Rig", description="Rig of the bank; empty to choose it by the shape keys")
    recordings: bpy.props.StringProperty(
        name="Recordings", description="Folder of the recordings; empty for no sound", subtype="DIR_PATH"
    )


class _FaceOperator:
    """Runs with the bank of the settings, and shows errors to the animator."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        settings = context.scene.lipz
        try:
            return self.run(context, settings, _bank(settings))
        except ShapeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}


def _options(settings):
    folder = bpy.path.abspath(settings.recordings) if settings.recordings else None
    return settings.rig or None, folder


class LIPZ_OT_animate(_FaceOperator, bpy.types.Operator):
    """Key the shape keys of the active object with a clip, from the current frame"""

    bl_idname = "lipz.animate"
    bl_label = "Animate"

    def run(self, context, settings, bank):
        clip = bank.clip(settings.clip)
        if clip is None:
            raise ShapeError(f"the bank has no clip {settings.clip!r}")
        scene = context.scene
        missing = animate(context.object, bank, clip, scene.frame_current, scene, *_options(settings))
        if missing:
            self.report({"WARNING"}, missing)
        return {"FINISHED"}


class LIPZ_OT_update(_FaceOperator, bpy.types.Operator):
    """Replace the keys of all clips of the active object, after the bank was packed again"""

    bl_idname = "lipz.update"
    bl_label = "Update all clips"

    def run(self, context, settings, bank):
        missing = update(context.object, bank, context.scene, *_options(settings))
        if missing:
            self.report({"WARNING"}, f"the bank lacks {', '.join(missing)}")
        return {"FINISHED"}


class LIPZ_PT_panel(bpy.types.Panel):
    bl_label = "lipz"
    bl_category = "lipz"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"

    def draw(self, context):
        layout, settings = self.layout, context.scene.lipz
        for name in ("bank", "clip", "recordings", "rig"):
            layout.prop(settings, name)
        layout.operator(LIPZ_OT_animate.bl_idname)
        shape_keys = getattr(getattr(context.object, "data", None), "shape_keys", None)
        for key, (start, end) in (clips_of(shape_keys) if shape_keys else {}).items():
            layout.label(text=f"{key}: {start} to {end}")
        layout.operator(LIPZ_OT_update.bl_idname)


_CLASSES = (LipzSettings, LIPZ_OT_animate, LIPZ_OT_update, LIPZ_PT_panel)


def register():
    for own_class in _CLASSES:
        bpy.utils.register_class(own_class)
    bpy.types.Scene.lipz = bpy.props.PointerProperty(type=LipzSettings)


def unregister():
    del bpy.types.Scene.lipz
    for own_class in reversed(_CLASSES):
        bpy.utils.unregister_class(own_class)
