using System;

namespace Lipz
{
    /// <summary>A movement of the mouth. The numbers are those of the bank format.</summary>
    public enum Articulator
    {
        /// <summary>How far the jaw is lowered.</summary>
        Jaw,

        /// <summary>How far the lips are apart.</summary>
        Opening,

        /// <summary>How firmly the lips are closed, as in p, b and m.</summary>
        Closure,

        /// <summary>How far the lower lip is under the upper teeth, as in f and v.</summary>
        Teeth,

        /// <summary>How far the lips are rounded, as in "too".</summary>
        Rounding,

        /// <summary>How far the corners of the lips are pulled apart, as in "see".</summary>
        Spreading,

        /// <summary>How far the tip of the tongue is raised, as in t and l.</summary>
        TongueTip,

        /// <summary>How far the tongue is between the teeth, as in "thin".</summary>
        TongueOut,

        /// <summary>How far the back of the tongue is raised, as in "key".</summary>
        TongueBack,
    }

    /// <summary>How far jaw, lips and tongue are from rest at a time, each from 0 to 1.</summary>
    public sealed class Articulation
    {
        internal static readonly string[] Names =
        {
            "jaw", "opening", "closure", "teeth", "rounding", "spreading", "tongue_tip", "tongue_out", "tongue_back",
        };

        internal readonly int[] Thousandths = new int[Names.Length];

        /// <summary>The value of an articulator.</summary>
        public float this[Articulator articulator]
        {
            get { return Thousandths[(int)articulator] / 1000f; }
            set { Thousandths[(int)articulator] = (int)Math.Round(Math.Max(0, Math.Min(1, value)) * 1000); }
        }
    }

    /// <summary>The articulation of a clip.</summary>
    public sealed partial class Clip
    {
        private Phones phones;
        private ArticulationBlend blend;

        /// <summary>The phones of the clip; none if it has only visemes.</summary>
        public Phones Phones
        {
            get { return phones ?? (phones = Bank.Phones.Of(this)); }
        }

        /// <summary>
        /// Returns the articulation at a time, from the phones of the clip, or from its visemes. Curves that are named
        /// like an articulator replace its values. Outside the clip, the mouth is at rest. To allocate nothing, pass
        /// the object to fill.
        /// </summary>
        public Articulation ArticulationAt(
            ClipTime time, ArticulationProfile profile = null, Articulation into = null)
        {
            Articulation found = into ?? new Articulation();
            ArticulationProfile used = profile ?? Bank.DefaultArticulationProfile;
            if (blend == null) blend = new ArticulationBlend();
            blend.Clear(Phones.AreCertain);
            if (Phones.Count == 0) VisemeShapes.AddNear(this, time, blend);
            else Phones.AddNear(time, used, blend);
            blend.Finish(used, Phones.LevelDb, found.Thousandths);
            if (!Rate.IsSpecified || OwnCurves.Length == 0) return found;
            FramePosition position = time.PositionIn(Rate);
            foreach (Curve curve in OwnCurves)
            {
                int articulator = curve.Purpose.Articulator;
                if (articulator < 0) continue;
                found.Thousandths[articulator] = Math.Max(0, Math.Min(1000, curve.Thousandths(position)));
            }
            return found;
        }
    }
}
