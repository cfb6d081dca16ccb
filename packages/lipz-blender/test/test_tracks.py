"""The values of shapes in each frame, without Blender; and the files of the extension."""

import os
import unittest

import extension

tracks = extension.module("tracks")
CODES = list("AMOSWEFLU")


class Tracks(unittest.TestCase):
    def test_a_model_with_a_shape_for_each_viseme_shows_the_clip(self):
        bank = extension.bank("drama")
        clip = bank.clip("act1/mara-good-evening")
        found = tracks.tracks_of(bank, clip, CODES, 24)
        self.assertEqual((found.is_stepped, found.kind, found.frame_count), (True, "blair", clip.frame_count + 1))
        for frame, code in enumerate(clip.frames + "-"):
            shown = [name for name in CODES if found.values[name][frame] == 1]
            self.assertEqual(shown, [code] if code != "-" else [], frame)

    def test_frames_of_the_scene_may_be_different(self):
        bank = extension.bank("drama")
        clip = bank.clip("act1/mara-good-evening")
        found = tracks.tracks_of(bank, clip, CODES, 60, 1.001)
        for frame in range(found.frame_count):
            seconds = frame * 1.001 / 60
            code = clip.viseme_at(seconds)
            self.assertEqual(found.values["A"][frame], 1 if code == "A" else 0, frame)
        self.assertEqual(found.frame_count, round(clip.duration_us * 60 / 1_001_000 + 0.5) + 1)

    def test_keys_are_where_values_change(self):
        found = tracks.Tracks({"a": [0, 0, 0, 1, 1, 0, 0]}, False, "ovr", None)
        self.assertEqual(found.keys("a"), [(0, 0), (2, 0), (3, 1), (4, 1), (5, 0), (6, 0)])
        found = tracks.Tracks({"a": [0, 0, 0, 1, 1, 0, 0]}, True, "blair", None)
        self.assertEqual(found.keys("a"), [(0, 0), (3, 1), (5, 0)])

    def test_a_rig_of_the_bank_fits_the_names(self):
        bank = extension.bank("phones")
        found = tracks.tracks_of(bank, bank.clip("spoken"), ["viseme_PP", "viseme_aa", "viseme_oh"], 24)
        self.assertEqual((found.kind, found.is_stepped), ("ovr", False))
        self.assertIn("12 of 15 shapes of ovr are missing", found.report)
        otto = tracks.tracks_of(bank, bank.clip("spoken"), ["JawDown", "Frown", "viseme_PP"], 24, rig_name="otto")
        self.assertEqual(sorted(otto.values), ["Frown", "JawDown"])

    def test_errors_state_a_fix(self):
        bank = extension.bank("drama")
        clip = bank.clip("act1/mara-good-evening")
        for names, message in [
            (["nose"], "none of the shapes has a known name"),
            (["viseme_PP", "viseme_FF"], "add `ovr = true`"),
            (list("0123456789"), "convert the clip"),
        ]:
            with self.assertRaisesRegex(tracks.ShapeError, message):
                tracks.tracks_of(bank, clip, names, 24)
        silent = extension.bank("small").clip("act2/silent")
        with self.assertRaisesRegex(tracks.ShapeError, "no frame rate"):
            tracks.tracks_of(bank, silent, CODES, 24)

    def test_the_archive_has_the_manifest_the_reader_and_licences(self):
        for name in ("blender_manifest.toml", "__init__.py", "reader/bank.py", "LICENSE-MIT", "LICENSE-APACHE"):
            self.assertIn(name, extension.NAMES)
        with open(os.path.join(extension.PACKAGE, "lipz", "blender_manifest.toml"), encoding="utf-8") as file:
            manifest = file.read()
        for field in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type", "license"):
            self.assertRegex(manifest, rf"(?m)^{field} = ")


if __name__ == "__main__":
    unittest.main()
