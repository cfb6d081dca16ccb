using System.Collections.Generic;
using System.Linq;

namespace Lipz
{
    /// <summary>A kind of shapes that models have, with the weights of the rig that moves them.</summary>
    internal sealed class ShapeKind
    {
        /// <summary>The name of the rig, or of a viseme type.</summary>
        internal readonly string Name;

        /// <summary>The weights of the mouth, by which the kind is recognised.</summary>
        internal readonly string[] Mouth;

        /// <summary>All weights, in the order of the rig.</summary>
        internal readonly string[] WeightNames;

        /// <summary>Further names of a weight.</summary>
        private readonly Dictionary<string, string[]> also;

        private ShapeKind(string name, string[] mouth, string[] rest, Dictionary<string, string[]> also = null)
        {
            Name = name;
            Mouth = mouth;
            WeightNames = mouth.Concat(rest).ToArray();
            this.also = also ?? new Dictionary<string, string[]>();
        }

        internal string[] AlsoOf(string weight)
        {
            return also.TryGetValue(weight, out string[] names) ? names : new string[0];
        }

        internal static ShapeKind Named(string name)
        {
            return All.FirstOrDefault(kind => kind.Name == name);
        }

        private static IEnumerable<string> BothSides(params string[] names)
        {
            return names.SelectMany(name => new[] { name + "Left", name + "Right" });
        }

        private static string[] Split(string names)
        {
            return names.Split(' ');
        }

        private static string[] Letters(string names)
        {
            return names.Select(letter => letter.ToString()).ToArray();
        }

        /// <summary>All kinds. If a model has the shapes of several, the first one is used.</summary>
        internal static readonly ShapeKind[] All =
        {
            // Apple: ARFaceAnchor.BlendShapeLocation.
            new ShapeKind(
                "arkit",
                Split("jawOpen mouthClose mouthFunnel mouthPucker mouthRollLower mouthRollUpper mouthShrugLower")
                    .Concat(BothSides(
                        "mouthPress", "mouthStretch", "mouthSmile", "mouthFrown", "mouthUpperUp", "mouthLowerDown"))
                    .ToArray(),
                new[] { "tongueOut" }
                    .Concat(BothSides("cheekSquint", "noseSneer", "browDown"))
                    .Concat(new[] { "browInnerUp" })
                    .Concat(BothSides("browOuterUp", "eyeWide", "eyeSquint", "eyeBlink"))
                    .ToArray()),

            // OpenXR: XrFaceTrackingVisemeMETA. Oculus Lipsync had single letters for the last three.
            new ShapeKind(
                "ovr",
                Split("sil PP FF TH DD kk CH SS nn RR aa E ih oh ou"),
                new string[0],
                new Dictionary<string, string[]>
                {
                    { "ih", new[] { "I" } },
                    { "oh", new[] { "O" } },
                    { "ou", new[] { "U" } },
                }),

            // VRM 1.0: VRMC_vrm, expressions. The other names are from VRM 0 and VRoid.
            new ShapeKind(
                "vrm",
                Split("aa ih ou ee oh"),
                Split("happy angry sad surprised blink"),
                new Dictionary<string, string[]>
                {
                    { "aa", new[] { "A" } },
                    { "ih", new[] { "I" } },
                    { "ou", new[] { "U" } },
                    { "ee", new[] { "E" } },
                    { "oh", new[] { "O" } },
                    { "happy", new[] { "Fcl_ALL_Joy", "Joy" } },
                    { "angry", new[] { "Fcl_ALL_Angry" } },
                    { "sad", new[] { "Fcl_ALL_Sorrow", "Sorrow" } },
                    { "surprised", new[] { "Fcl_ALL_Surprised" } },
                    { "blink", new[] { "Fcl_EYE_Close" } },
                }),
            new ShapeKind("mmd", Letters("あいうえおん"), Split("まばたき にこり 怒り 困る")),

            // Cubism: "Standard Parameter List". Cubism 2 wrote PARAM_MOUTH_OPEN_Y.
            new ShapeKind("live2d", Split("ParamMouthOpenY ParamMouthForm"), Split("ParamEyeLOpen ParamEyeROpen")),

            // Viseme types: a shape for each code.
            OfVisemes("blair", "AEFLMOSUW", "rest"),
            OfVisemes("toonboom", "ABCDEFG", "rest", "X"),
            OfVisemes("rms", "0123456789", "rest"),
        };

        private static ShapeKind OfVisemes(string name, string codes, params string[] rest)
        {
            var also = new Dictionary<string, string[]> { { "-", rest } };
            return new ShapeKind(name, Letters(codes), new[] { "-" }, also);
        }
    }
}
