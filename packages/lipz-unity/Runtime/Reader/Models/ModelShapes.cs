using System;
using System.Collections.Generic;
using System.Linq;

namespace Lipz
{
    /// <summary>
    /// The shapes of a model that take the weights of a rig, found by their names: blend shapes of ARKit, Oculus, VRM
    /// and MMD, parameters of Live2D, or a shape for each viseme.
    /// </summary>
    public sealed class ModelShapes
    {
        /// <summary>The most names that a report lists.</summary>
        private const int Listed = 5;

        private readonly int[] weightOf;
        private readonly int[] shapeOf;

        /// <summary>
        /// Recognises the shapes of a model by their names, in the order of the model. With a rig of a bank, finds the
        /// shapes for its weights. Call it when the model loads.
        /// </summary>
        public ModelShapes(IReadOnlyList<string> names, Rig rig = null)
        {
            List<Dictionary<string, int>> degrees = FormsIn(names);
            ShapeKind kind = rig == null ? Recognised(degrees) : ShapeKind.Named(rig.Name);
            Kind = rig == null ? kind?.Name : rig.Name;
            WeightNames = rig == null ? kind?.WeightNames ?? new string[0] : rig.WeightNames;
            int[] found = WeightNames.Select(weight => Find(weight, degrees, kind)).ToArray();
            weightOf = Enumerable.Range(0, found.Length).Where(weight => found[weight] >= 0).ToArray();
            shapeOf = weightOf.Select(weight => found[weight]).ToArray();
            var used = new HashSet<int>(shapeOf);
            string[] others = names.Where((name, shape) => !used.Contains(shape)).ToArray();
            Missing = WeightNames.Where((weight, i) => found[i] < 0).ToArray();
            Report = ReportOf(others);
        }

        /// <summary>
        /// The kind, which is also the name of the rig to use: <c>arkit</c>, <c>ovr</c>, <c>vrm</c>, <c>mmd</c>,
        /// <c>live2d</c> or a viseme type. Null if the names are unknown.
        /// </summary>
        public string Kind { get; private set; }

        /// <summary>The names of the weights, in the order of their values.</summary>
        public IReadOnlyList<string> WeightNames { get; private set; }

        /// <summary>The names of the weights without a shape.</summary>
        public IReadOnlyList<string> Missing { get; private set; }

        /// <summary>A sentence about missing shapes, with similar names; null if none is missing.</summary>
        public string Report { get; private set; }

        /// <summary>The number of shapes that take a weight.</summary>
        public int Count
        {
            get { return shapeOf.Length; }
        }

        /// <summary>Returns the index in the model of a shape that takes a weight.</summary>
        public int ShapeIndex(int index)
        {
            return shapeOf[index];
        }

        /// <summary>Returns the index of the weight that this shape takes.</summary>
        public int WeightIndex(int index)
        {
            return weightOf[index];
        }

        /// <summary>Writes each weight to its shape. Allocates nothing.</summary>
        public void Apply(float[] weights, float[] influences)
        {
            for (int i = 0; i < shapeOf.Length; i++) influences[shapeOf[i]] = weights[weightOf[i]];
        }

        /// <summary>
        /// Fills the weights of a viseme for a model with a shape for each viseme: 1 for its shape, 0 for all others.
        /// </summary>
        public void Show(char viseme, float[] weights)
        {
            for (int i = 0; i < weights.Length && i < WeightNames.Count; i++)
            {
                weights[i] = WeightNames[i].Length == 1 && WeightNames[i][0] == viseme ? 1 : 0;
            }
        }

        /// <summary>For each degree of similarity, the shapes by the form of their names in this degree.</summary>
        private static List<Dictionary<string, int>> FormsIn(IReadOnlyList<string> names)
        {
            var degrees = new List<Dictionary<string, int>>();
            for (int shape = 0; shape < names.Count; shape++)
            {
                string[] forms = ShapeNames.FormsOf(names[shape]);
                for (int degree = 0; degree < forms.Length; degree++)
                {
                    if (degree == degrees.Count) degrees.Add(new Dictionary<string, int>(StringComparer.Ordinal));
                    bool isNew = forms[degree] != "" && !degrees[degree].ContainsKey(forms[degree]);
                    if (isNew) degrees[degree].Add(forms[degree], shape);
                }
            }
            return degrees;
        }

        /// <summary>Returns the most similar shape for a weight; -1 without one.</summary>
        private static int Find(string weight, List<Dictionary<string, int>> degrees, ShapeKind kind)
        {
            string[] known = ShapeNames.KnownForms(weight, kind?.AlsoOf(weight) ?? new string[0]).ToArray();
            foreach (Dictionary<string, int> degree in degrees)
            {
                foreach (string form in known)
                {
                    if (degree.TryGetValue(form, out int shape)) return shape;
                }
            }
            return -1;
        }

        /// <summary>Returns the kind of which a model has the most shapes of the mouth; null without any.</summary>
        private static ShapeKind Recognised(List<Dictionary<string, int>> degrees)
        {
            ShapeKind best = null;
            int most = 0;
            foreach (ShapeKind kind in ShapeKind.All)
            {
                int count = kind.Mouth.Count(weight => Find(weight, degrees, kind) >= 0);
                if (count <= most) continue;
                most = count;
                best = kind;
            }
            return best;
        }

        private string ReportOf(string[] others)
        {
            if (Kind != null)
            {
                if (Missing.Count == 0) return null;
                string[] words = Missing.Select(name => WithNearest(name, ShapeNames.Nearest(name, others))).ToArray();
                string count = Missing.Count + " of " + WeightNames.Count;
                return count + " shapes of " + Kind + " are missing: " + List(words);
            }
            string[] near = ShapeKind.All.SelectMany(kind => kind.WeightNames)
                .Select(name => new { name, nearest = ShapeNames.Nearest(name, others) })
                .Where(pair => pair.nearest != null)
                .Select(pair => WithNearest(pair.name, pair.nearest))
                .ToArray();
            string hint = near.Length > 0 ? "expected " + List(near) : "pass the rig that names them, or rename them";
            return "none of " + others.Length + " shapes has a known name (" + List(others) + "); " + hint;
        }

        private static string WithNearest(string name, string nearest)
        {
            return nearest == null ? name : name + " (did you mean " + nearest + "?)";
        }

        private static string List(string[] words)
        {
            string listed = string.Join(", ", words.Take(Listed));
            return words.Length > Listed ? listed + ", " + (words.Length - Listed) + " more" : listed;
        }
    }
}
