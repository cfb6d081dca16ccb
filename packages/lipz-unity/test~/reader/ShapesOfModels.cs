using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;

namespace Lipz.Tests
{
    /// <summary>Shapes of models by their names, as in packages/lipz-web/test/shapes.test.js.</summary>
    internal static class ShapesOfModels
    {
        private const string Ovr = "sil PP FF TH DD kk CH SS nn RR aa E I O U";
        private const string Vroid = "ALL_Neutral ALL_Angry ALL_Joy ALL_Sorrow ALL_Surprised BRW_Joy EYE_Close EYE_Joy "
            + "MTH_Close MTH_Joy MTH_A MTH_I MTH_U MTH_E MTH_O";

        internal static string Recognise(string fixtures)
        {
            Bank bank = Bank.Open(File.ReadAllBytes(Path.Combine(fixtures, "banks/v1/rigs.lipzbank")));
            var packed = ShapeKind.All.Where(kind => bank.Rig(kind.Name) != null).ToArray();
            Equal("arkit ovr vrm mmd live2d", string.Join(" ", packed.Select(kind => kind.Name)));
            foreach (ShapeKind kind in packed)
            {
                Equal(string.Join(" ", bank.Rig(kind.Name).WeightNames), string.Join(" ", kind.WeightNames));
            }
            int models = 0;
            foreach (KeyValuePair<string, IEnumerable<string>> model in Models())
            {
                string[] names = model.Value.ToArray();
                var shapes = new ModelShapes(names);
                Equal(model.Key + " ", shapes.Kind + " " + shapes.Report);
                int different = Enumerable.Range(0, shapes.Count).Select(shapes.ShapeIndex).Distinct().Count();
                Equal(shapes.WeightNames.Count, different);
                models++;
            }
            Reports();
            Apply(bank);
            return packed.Length + " rigs, " + models + " models";
        }

        private static IEnumerable<KeyValuePair<string, IEnumerable<string>>> Models()
        {
            string[] arkit = ShapeKind.Named("arkit").WeightNames;
            yield return Model("arkit", arkit);
            yield return Model("arkit", arkit.Select(name => "blendShape1." + name));
            yield return Model("arkit", arkit.Select(name => char.ToUpper(name[0]) + name.Substring(1)));
            yield return Model("arkit", arkit.Select(name => name.Replace("Left", "_L").Replace("Right", "_R")));
            yield return Model("arkit", arkit.Select(name => name.Replace("Left", "L").Replace("Right", "R")));
            yield return Model("arkit", Split(Ovr).Select(name => "viseme_" + name).Concat(arkit));
            foreach (string prefix in new[] { "", "viseme_", "vrc.v_", "Wolf3D_Head.viseme_" })
            {
                yield return Model("ovr", Split(Ovr).Select(name => prefix + name));
            }
            yield return Model("vrm", Split("aa ih ou ee oh happy angry sad relaxed surprised blink"));
            yield return Model("vrm", Split("Neutral A I U E O Blink Joy Angry Sorrow Fun Surprised"));
            yield return Model("vrm", Split(Vroid).Select(name => "Face.M_F00_000_00_Fcl_" + name));
            yield return Model("mmd", Split("真面目 困る にこり 怒り まばたき 笑い あ い う え お ん"));
            yield return Model("live2d", Split("ParamEyeLOpen ParamEyeROpen ParamMouthForm ParamMouthOpenY"));
            yield return Model(
                "live2d", Split("PARAM_MOUTH_FORM PARAM_MOUTH_OPEN_Y PARAM_EYE_L_OPEN PARAM_EYE_R_OPEN"));
            yield return Model("blair", "AEFLMOSUW".Select(code => "Mouth_" + code).Concat(new[] { "rest" }));
            yield return Model("toonboom", "ABCDEFGHX".Select(code => "mouth-" + code));
            yield return Model("rms", "0123456789".Select(code => "Mouth " + code).Concat(new[] { "rest" }));
        }

        private static KeyValuePair<string, IEnumerable<string>> Model(string kind, IEnumerable<string> names)
        {
            return new KeyValuePair<string, IEnumerable<string>>(kind, names);
        }

        private static string[] Split(string names)
        {
            return names.Split(' ');
        }

        private static void Reports()
        {
            string report = new ModelShapes(Split("jawOpen mouthFunel mouthPuckerr smile")).Report;
            Equal(
                "34 of 35 shapes of arkit are missing: mouthClose, mouthFunnel (did you mean mouthFunel?), "
                    + "mouthPucker (did you mean mouthPuckerr?), mouthRollLower, mouthRollUpper, 29 more",
                report);
            Equal(
                "none of 2 shapes has a known name (jawOpne, Smile); expected jawOpen (did you mean jawOpne?)",
                new ModelShapes(Split("jawOpne Smile")).Report);
            Equal(3, new ModelShapes(Split("head|Open jawOpen jawOpen mouthClose")).ShapeIndex(1));
        }

        private static void Apply(Bank bank)
        {
            Rig rig = bank.Rig("vrm");
            var shapes = new ModelShapes(new[] { "Basis" }.Concat(rig.WeightNames).ToArray(), rig);
            float[] weights = Enumerable.Range(1, rig.WeightNames.Count).Select(i => (float)i).ToArray();
            float[] influences = new float[weights.Length + 1];
            shapes.Apply(weights, influences);
            Equal("0 1 2 3 4 5 6 7 8 9 10", string.Join(" ", influences));
            var facefx = new ModelShapes(Split("head|Open head|w head|sh_ch wide"), bank.Rig("facefx"));
            Equal("5 4", facefx.Missing.Count + " " + facefx.Count);
            var visemes = new ModelShapes("AEFLMOSUW".Select(code => "Mouth_" + code).ToArray());
            float[] shown = new float[visemes.WeightNames.Count];
            visemes.Show('L', shown);
            Equal("0 0 0 1 0 0 0 0 0 0", string.Join(" ", shown));
        }

        private static void Equal(object expected, object found)
        {
            if (!expected.Equals(found)) throw new Exception("found    " + found + "\n    expected " + expected);
        }
    }
}
