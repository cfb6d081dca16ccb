"""The names of shapes, with the numbers of matches that the web package has for the same models."""

import unittest

import fixtures
from lipz.reader import Bank, shapes_of
from lipz.reader.shape_names import KINDS, forms_of


def all_names(kind):
    return [*KINDS[kind].mouth, *KINDS[kind].rest]


class Shapes(unittest.TestCase):
    def test_each_kind_is_recognised_by_its_own_names(self):
        for kind in KINDS:
            shapes = shapes_of(all_names(kind))
            self.assertEqual((shapes.kind, shapes.missing, shapes.report), (kind, [], None))

    def test_kinds_have_the_weights_of_the_rigs(self):
        rigs = Bank(fixtures.bank_bytes("rigs.lipzbank")).rigs
        for kind in ("arkit", "ovr", "vrm", "mmd", "live2d"):
            self.assertEqual(sorted(rigs[kind].weight_names), sorted(all_names(kind)), kind)

    def test_names_of_models_are_recognised(self):
        for kind, weight, name in [
            ("arkit", "jawOpen", "blendShape1.jawOpen"),
            ("arkit", "mouthSmileLeft", "mouthSmile_L"),
            ("arkit", "eyeBlinkRight", "eyeBlink.R"),
            ("arkit", "mouthPressLeft", "Mouth_Press_L"),
            ("ovr", "PP", "viseme_PP"),
            ("ovr", "ih", "viseme_I"),
            ("vrm", "aa", "M_F00_000_00_Fcl_MTH_A"),
            ("vrm", "blink", "Fcl_EYE_Close"),
            ("mmd", "あ", "あ"),
            ("live2d", "ParamMouthOpenY", "PARAM_MOUTH_OPEN_Y"),
            ("toonboom", "-", "X"),
        ]:
            others = [own for own in all_names(kind) if own != weight]
            shapes = shapes_of([*others, name, "Basis"])
            self.assertEqual((shapes.kind, shapes.map.get(weight)), (kind, name))

    def test_missing_shapes_are_reported(self):
        shapes = shapes_of(["viseme_sil", "viseme_PP", "viseme_FF", "nose"])
        self.assertEqual(shapes.kind, "ovr")
        self.assertEqual(shapes.report, "12 of 15 shapes of ovr are missing: TH, DD, kk, CH, SS, 7 more")
        self.assertIsNone(shapes_of(["nose", "ears"]).kind)
        self.assertIn("no", shapes_of(["nose"]).report)

    def test_weights_of_a_rig_go_to_the_shapes_of_a_model(self):
        bank = Bank(fixtures.bank_bytes("phones.lipzbank"))
        shapes = shapes_of(["Basis", "viseme_PP", "viseme_aa"], bank.rigs["ovr"])
        weights = bank.clip("spoken").weights_at(0.1, bank.rigs["ovr"])
        self.assertEqual(shapes.named(weights), [("viseme_PP", 1.0), ("viseme_aa", 0.0)])
        with self.assertRaises(ValueError):
            shapes.named([0.0])

    def test_a_shape_for_each_code(self):
        shapes = shapes_of(["A", "B", "C", "D", "E", "F", "G", "X"])
        self.assertEqual(dict(shapes.shown("C"))["C"], 1.0)
        self.assertEqual(sum(dict(shapes.shown("-")).values()), dict(shapes.shown("-"))["X"])

    def test_forms_are_ordered_by_similarity(self):
        self.assertEqual(forms_of("v_aa")[:3], ["vaa", "vaa", "aa"])
        self.assertEqual(forms_of("-"), ["-"] * 5)


if __name__ == "__main__":
    unittest.main()
