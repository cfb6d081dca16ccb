"""The extension in Blender, as the Python module `bpy`."""

import contextlib
import io
import os
import re
import shutil
import sys
import time
import unittest
import wave

import extension

bpy = extension.bpy
CODES = list("AMOSWEFLU")
ARKIT = ["jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "browInnerUp"]


class InBlender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if bpy is None:
            extension.skip("`bpy`")
        cls.extension = __import__(extension.NAME)
        cls.extension.register()
        cls.animate = extension.module("animate")

    @classmethod
    def tearDownClass(cls):
        cls.extension.unregister()

    def setUp(self):
        bpy.ops.wm.read_homefile(use_empty=True)
        self.scene = bpy.context.scene
        self.scene.render.fps = 24

    def face(self, names, basis="Basis"):
        mesh = bpy.data.meshes.new("face")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        face = bpy.data.objects.new("face", mesh)
        self.scene.collection.objects.link(face)
        for name in [basis, *names]:
            face.shape_key_add(name=name)
        bpy.context.view_layer.objects.active = face
        return face

    def values(self, face, frame):
        self.scene.frame_set(frame)
        return {block.name: block.value for block in face.data.shape_keys.key_blocks[1:]}

    def shown(self, face, frame):
        return "".join(name for name, value in self.values(face, frame).items() if value > 0.5) or "-"

    def curve(self, face, name):
        shape_keys = face.data.shape_keys
        path = shape_keys.key_blocks[name].path_from_id("value")
        return extension.module("keying").curves_of(shape_keys).find(path)

    def reloaded(self):
        """Returns the face after the file was saved and opened again."""
        path = os.path.join(extension.FOLDER, "face.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.scene = bpy.context.scene
        return bpy.data.objects["face"]

    def test_every_frame_of_every_clip_is_right_after_saving(self):
        bank = extension.bank("drama")
        clips = [
            clip
            for clip in bank.clips
            if clip.viseme_type == "blair" and clip.frame_count and str(clip.fps) == "Fps(24, 1)"
        ]
        face = self.face(CODES)
        start, starts, took = 10, [], []
        for clip in clips:
            begun = time.process_time()
            self.animate.animate(face, bank, clip, start, self.scene)
            took.append(time.process_time() - begun)
            starts.append(start)
            start += clip.frame_count + 3
        face = self.reloaded()
        wrong = count = 0
        for clip, start in zip(clips, starts):
            # The frames between two clips are at rest.
            for frame, code in enumerate(clip.frames + "--"):
                wrong += self.shown(face, start + frame) != code
                count += 1
        median = sorted(took)[len(took) // 2] * 1000
        compared = f"{count} frames of {len(clips)} clips, {wrong} wrong"
        print(f"Blender {bpy.app.version_string}: {compared}; {median:.1f} ms a clip")
        self.assertEqual(wrong, 0)
        self.assertGreater(count, 1000)

    def test_weights_of_a_rig_are_right(self):
        bank = extension.bank("phones")
        clip = bank.clip("spoken")
        face = self.face(ARKIT)
        report = self.animate.animate(face, bank, clip, 100, self.scene)
        self.assertIn("shapes of arkit are missing", report)
        face = self.reloaded()
        rig = bank.rigs["arkit"]
        reader = extension.module("reader")
        for frame in range(clip.frame_count + 1):
            us = -(-frame * 1_000_000 // 24)
            weights = dict(zip(rig.weight_names, clip.weights_at(reader.Micros(us), rig)))
            for name, value in self.values(face, 100 + frame).items():
                self.assertAlmostEqual(value, min(max(weights[name], 0), 1), 5, (name, frame))

    def test_a_retake_replaces_only_its_own_keys(self):
        bank = extension.bank("drama")
        clip, other = bank.clip("act1/mara-good-evening"), bank.clip("act1/otto-twenty-years")
        face = self.face([*CODES, "browInnerUp"])
        shape_keys = face.data.shape_keys
        # The animator's keys: a different shape, and one of the clip's, before, in and after it.
        shape_keys.key_blocks["browInnerUp"].value = 0.5
        shape_keys.key_blocks["browInnerUp"].keyframe_insert("value", frame=30)
        for frame, value in ((5, 0.25), (40, 0.75), (900, 0.5)):
            shape_keys.key_blocks["A"].value = value
            shape_keys.key_blocks["A"].keyframe_insert("value", frame=frame)
        self.animate.animate(face, bank, clip, 20, self.scene)
        self.animate.animate(face, bank, other, 200, self.scene)
        first = [tuple(point.co) for point in self.curve(face, "A").keyframe_points]
        self.assertIn((40.0, 0.75), first)
        # The retake begins later and is packed again.
        self.animate.animate(face, bank, clip, 60, self.scene)
        self.assertEqual(self.shown(face, 60 + 2), clip.frames[2])
        points = [(point.co.x, point.type) for point in self.curve(face, "A").keyframe_points]
        self.assertEqual([x for x, kind in points if kind != "GENERATED"], [5.0, 40.0, 900.0])
        generated = [x for x, kind in points if kind == "GENERATED"]
        self.assertTrue(all(60 <= x < 60 + clip.frame_count + 1 or x >= 200 for x in generated), generated)
        self.assertEqual(self.shown(face, 200), other.frames[0])
        self.assertEqual(self.animate.clips_of(shape_keys)[clip.key], (60, 60 + clip.frame_count))
        # To animate again changes nothing.
        before = [(tuple(point.co), point.type) for point in self.curve(face, "E").keyframe_points]
        self.assertEqual(self.animate.update(face, bank, self.scene), [])
        after = [(tuple(point.co), point.type) for point in self.curve(face, "E").keyframe_points]
        self.assertEqual(before, after)
        self.assertAlmostEqual(self.values(face, 30)["browInnerUp"], 0.5)

    def test_a_changed_clip_is_updated_at_its_frame(self):
        face = self.face(CODES)
        old, new = extension.bank("dubbed"), extension.bank("recorded")
        self.animate.animate(face, old, old.clip("aye"), 7, self.scene)
        self.assertEqual([self.shown(face, 7 + at) for at in range(4)], list("MA--"))
        self.animate.animate(face, old, old.clip("no"), 50, self.scene)
        self.assertEqual(self.animate.update(face, new, self.scene), ["no"])
        self.assertEqual([self.shown(face, 7 + at) for at in range(4)], list("AE--"))
        self.assertEqual(self.shown(face, 50), old.clip("no").frames[0])

    def test_the_recording_begins_at_the_same_frame(self):
        bank = extension.bank("drama")
        folder = os.path.join(extension.FOLDER, "recordings", "act1")
        os.makedirs(folder, exist_ok=True)
        for key, seconds in (("mara-good-evening", 3.8), ("otto-twenty-years", 7)):
            with wave.open(os.path.join(folder, f"{key}.wav"), "wb") as sound:
                sound.setparams((1, 2, 24_000, 0, "NONE", ""))
                sound.writeframes(bytes(2 * int(seconds * 24_000)))
        face = self.face(CODES)
        for key, start in (
            ("act1/mara-good-evening", 20),
            ("act1/otto-twenty-years", 140),
            ("act1/mara-good-evening", 33),
        ):
            self.animate.animate(face, bank, bank.clip(key), start, self.scene, None, os.path.dirname(folder))
        self.reloaded()
        strips = {strip["lipz"]: strip for strip in self.scene.sequence_editor.strips}
        starts = {key: (strip.type, strip.frame_final_start) for key, strip in strips.items()}
        self.assertEqual(starts, {"act1/mara-good-evening": ("SOUND", 33), "act1/otto-twenty-years": ("SOUND", 140)})

    def test_the_programs_of_the_pages_run(self):
        pages = [os.path.join(extension.PACKAGE, "README.md")]
        pages.append(os.path.join(extension.PACKAGE, "..", "..", "docs", "guides", "blender.md"))
        folder = os.path.join(extension.FOLDER, "demo")
        os.makedirs(folder, exist_ok=True)
        shutil.copy(os.path.join(extension.BANKS, "drama.lipzbank"), os.path.join(folder, "dialogue.lipzbank"))
        # The name of an installed extension.
        for name in ("", ".animate", ".reader"):
            sys.modules[f"bl_ext.user_default.lipz{name}"] = sys.modules[extension.NAME + name]
        for page in pages:
            with open(page, encoding="utf-8") as file:
                blocks = re.findall(r"^```(python|text)\n(.*?)^```$", file.read(), re.M | re.S)
            (_, program), (_, output) = blocks[:2]
            self.assertLessEqual(len(program.splitlines()), 11)
            self.setUp()
            face = self.face(CODES)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed), contextlib.chdir(folder):
                exec(program, {})
            self.assertEqual(printed.getvalue(), output)
            self.assertNotEqual(self.shown(face, 1), "-")

    def test_operators_animate_and_explain(self):
        face = self.face(CODES)
        settings = self.scene.lipz
        settings.bank = os.path.join(extension.BANKS, "drama.lipzbank")
        settings.clip = "act1/mara-good-evening"
        self.scene.frame_set(12)
        self.assertEqual(bpy.ops.lipz.animate(), {"FINISHED"})
        self.assertEqual(self.shown(face, 12), "S")
        self.assertEqual(bpy.ops.lipz.update(), {"FINISHED"})
        settings.clip = "no/clip"
        with self.assertRaisesRegex(RuntimeError, "no clip 'no/clip'"):
            bpy.ops.lipz.animate()
        settings.bank = os.path.join(extension.BANKS, "small.dump")
        with self.assertRaisesRegex(RuntimeError, "not a lipz bank"):
            bpy.ops.lipz.animate()
        bpy.context.view_layer.objects.active = None
        settings.bank, settings.clip = os.path.join(extension.BANKS, "drama.lipzbank"), "act1/mara-good-evening"
        with self.assertRaisesRegex(RuntimeError, "select the mesh"):
            bpy.ops.lipz.animate()


if __name__ == "__main__":
    unittest.main()
