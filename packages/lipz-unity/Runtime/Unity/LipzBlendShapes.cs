using System.Collections.Generic;
using UnityEngine;

namespace Lipz
{
    /// <summary>Moves the blend shapes of a mesh. Their names decide which rig of the bank they take.</summary>
    [AddComponentMenu("Lipz/Lipz Blend Shapes")]
    public sealed class LipzBlendShapes : LipzMouth
    {
        [SerializeField, Tooltip("The mesh with the blend shapes.")]
        private SkinnedMeshRenderer face;

        [SerializeField, Tooltip("The rig of the bank. Empty: the rig for the names of the blend shapes.")]
        private string rigName = "";

        [SerializeField, Tooltip("The weight of a fully moved blend shape.")]
        private float fullWeight = 100f;

        private ModelShapes shapes;
        private Mesh shapesOf;
        private Bank bank;
        private Rig rig;
        private float[] weights = new float[0];

        /// <summary>The mesh with the blend shapes.</summary>
        public SkinnedMeshRenderer Face
        {
            get { return face; }
            set { face = value; }
        }

        /// <summary>The rig of the bank. If it is empty, the rig for the names of the blend shapes.</summary>
        public string RigName
        {
            get { return rigName; }
            set
            {
                rigName = value;
                bank = null;
            }
        }

        /// <summary>The shapes that were recognised in the mesh; null before the first clip.</summary>
        public ModelShapes Shapes
        {
            get { return shapes; }
        }

        /// <inheritdoc/>
        public override void Begin(Clip clip)
        {
            if (face == null || face.sharedMesh == null) return;
            if (bank == clip.Bank && shapesOf == face.sharedMesh) return;
            bank = clip.Bank;
            shapesOf = face.sharedMesh;
            List<string> names = NamesOf(shapesOf);
            shapes = new ModelShapes(names);
            rig = string.IsNullOrEmpty(rigName) ? RigFor(shapes.Kind) : bank.Rig(rigName);
            if (rig != null) shapes = new ModelShapes(names, rig);
            weights = new float[shapes.WeightNames.Count];
            string problem = rig == null ? ProblemWithoutRig() : shapes.Report;
            if (problem != null) Debug.LogWarning(name + ": " + problem, this);
        }

        /// <inheritdoc/>
        public override void Show(Clip clip, ClipTime time, char viseme, Who speaker)
        {
            if (shapes == null || face == null) return;
            if (rig == null) shapes.Show(viseme, weights);
            else clip.WeightsAt(time, rig, weights, speaker);
            for (int i = 0; i < shapes.Count; i++)
            {
                face.SetBlendShapeWeight(shapes.ShapeIndex(i), weights[shapes.WeightIndex(i)] * fullWeight);
            }
        }

        /// <inheritdoc/>
        public override void Rest()
        {
            if (shapes == null || face == null) return;
            for (int i = 0; i < shapes.Count; i++) face.SetBlendShapeWeight(shapes.ShapeIndex(i), 0f);
        }

        private static List<string> NamesOf(Mesh mesh)
        {
            var names = new List<string>(mesh.blendShapeCount);
            for (int i = 0; i < mesh.blendShapeCount; i++) names.Add(mesh.GetBlendShapeName(i));
            return names;
        }

        private Rig RigFor(string kind)
        {
            return kind == null ? null : bank.Rig(kind);
        }

        private string ProblemWithoutRig()
        {
            if (!string.IsNullOrEmpty(rigName))
            {
                return "the bank has no rig \"" + rigName + "\": add it to [rig] in lipz.toml";
            }
            bool hasVisemes = shapes.Kind == "blair" || shapes.Kind == "toonboom" || shapes.Kind == "rms";
            if (shapes.Kind == null || hasVisemes) return shapes.Report;
            return "the bank has no rig for these shapes: add " + shapes.Kind + " = true to [rig] in lipz.toml";
        }
    }
}
