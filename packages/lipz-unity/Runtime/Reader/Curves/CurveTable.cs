using System.Collections.Generic;

namespace Lipz
{
    /// <summary>The sections of curves; empty in a bank without them.</summary>
    internal sealed class CurveTable
    {
        private const uint WideFlag = 0x80000000;

        private readonly Table clips;
        private readonly Table curves;
        private readonly Table units;

        internal CurveTable(BankFile file)
        {
            clips = file.Section("CRVC", 8);
            curves = file.Section("CURV", 8);
            units = file.Section("CRVK", 4);
        }

        /// <summary>Returns the curves of a clip, in the order of their names. A damaged curve ends them.</summary>
        internal Curve[] Of(Clip clip)
        {
            int place = PlaceOf(clip.Slot);
            if (place < 0) return new Curve[0];
            long first = clips.U32(place, 4);
            long end = place + 1 < clips.Count ? (long)clips.U32(place + 1, 4) : curves.Count;
            var found = new List<Curve>();
            for (long index = first; index < end && curves.Has(index); index++)
            {
                Curve curve = CurveAt(index, clip);
                if (curve == null) break;
                found.Add(curve);
            }
            return found.ToArray();
        }

        private Curve CurveAt(long index, Clip clip)
        {
            uint nameAndWidth = curves.U32(index, 4);
            long start = curves.U32(index);
            long end = index + 1 < curves.Count ? (long)curves.U32(index + 1) : units.Count;
            string name = clip.Bank.Events.NameOf(nameAndWidth & ~WideFlag);
            if (name == null || start > end || end > units.Count) return null;
            bool isWide = (nameAndWidth & WideFlag) != 0;
            Table keys = units.Part(start, end);
            return new Curve(name, isWide ? keys.As(8) : keys, isWide, clip.Rate);
        }

        private int PlaceOf(uint slot)
        {
            int first = 0, end = clips.Count;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (clips.U32(middle) < slot) first = middle + 1;
                else end = middle;
            }
            return clips.Has(first) && clips.U32(first) == slot ? first : -1;
        }
    }

    /// <summary>The curves of a clip.</summary>
    public sealed partial class Clip
    {
        private Curve[] curves;

        /// <summary>All curves, in the order of their names.</summary>
        public IReadOnlyList<Curve> Curves
        {
            get { return OwnCurves; }
        }

        /// <summary>Returns the curve with a name; null without it.</summary>
        public Curve Curve(string name)
        {
            foreach (Curve curve in OwnCurves)
            {
                if (curve.Name == name) return curve;
            }
            return null;
        }

        /// <summary>The curves, which are found once.</summary>
        internal Curve[] OwnCurves
        {
            get { return curves ?? (curves = Bank.Curves.Of(this)); }
        }
    }
}
