using System;

namespace Lipz
{
    /// <summary>The articulation of clips without phones, from their visemes.</summary>
    internal static class VisemeShapes
    {
        private const uint MostUs = QueryTime.MostMs * 1000;
        private const ulong LongestFrameUs = 1000000;
        private const byte ClosedLips = 1;
        private const byte LipOnTeeth = 2;

        /// <summary>The codes of the shapes, and those of the nearest shapes of Toon Boom.</summary>
        private const string Blair = "SMFAEOUWL";
        private const string ToonBoom = "BAGDCEF";

        private static readonly PhoneTargets[] Shapes =
        {
            Shape(new byte[] { 22, 50, 15, 20, 70, 0, 20 }, 7, 6, 5, 0),
            Shape(new byte[] { 25, 0, 5, 0, 0, 0, 0 }, 7, 10, 5, ClosedLips),
            Shape(new byte[] { 20, 15, 0, 0, 0, 0, 0 }, 7, 10, 5, LipOnTeeth),
            Shape(new byte[] { 85, 85, 5, 10, 0, 0, 10 }, 10, 10, 10, 0),
            Shape(new byte[] { 40, 65, 5, 50, 0, 0, 0 }, 10, 10, 10, 0),
            Shape(new byte[] { 60, 55, 50, 0, 0, 0, 40 }, 10, 10, 15, 0),
            Shape(new byte[] { 28, 32, 70, 0, 0, 0, 40 }, 10, 14, 15, 0),
            Shape(new byte[] { 20, 15, 90, 0, 0, 0, 40 }, 7, 14, 15, 0),
            Shape(new byte[] { 35, 55, 5, 0, 100, 20, 0 }, 7, 6, 5, 0),
        };

        private static readonly PhoneTargets[] Levels =
        {
            Level(0), Level(11), Level(22), Level(33), Level(44),
            Level(55), Level(66), Level(77), Level(88), Level(100),
        };

        /// <summary>Adds the shapes that matter at a time.</summary>
        internal static void AddNear(Clip clip, ClipTime time, ArticulationBlend blend)
        {
            if (!clip.Rate.IsSpecified || clip.VisemeType == VisemeType.Unspecified || !time.HasBegun) return;
            FramePosition position = time.PositionIn(clip.Rate);
            uint frameUs = (uint)Math.Max(1, Math.Min(LongestFrameUs, clip.Rate.StartOfFrameUs(1)));
            long reach = MostUs / frameUs + 1;
            long first = Math.Max(0, position.Frame - reach);
            Table codes = clip.FrameCodes;
            codes = codes.Part(Math.Min(first, codes.Count), Math.Min(position.Frame + reach, codes.Count));
            long passedUs = (long)frameUs * (position.SixteenBits >> 4) >> 12;
            long startUs = -((position.Frame - first) * frameUs + passedUs);
            for (int at = 0; at < codes.Count;)
            {
                byte code = codes.U8(at);
                int length = 1;
                while (at + length < codes.Count && codes.U8(at + length) == code) length++;
                long endUs = startUs + (long)length * frameUs;
                if (code != Clip.Rest) blend.Add((int)startUs, (int)endUs, TargetsOf((char)code, clip.VisemeType));
                startUs = endUs;
                at += length;
            }
        }

        private static PhoneTargets TargetsOf(char code, VisemeType type)
        {
            string codes = type == VisemeType.Blair ? Blair : ToonBoom;
            int place = type == VisemeType.Rms ? code - '0' : codes.IndexOf(code);
            PhoneTargets[] shapes = type == VisemeType.Rms ? Levels : Shapes;
            return place >= 0 && place < shapes.Length ? shapes[place] : Shapes[0];
        }

        private static PhoneTargets Shape(byte[] percent, byte jaw, byte lips, byte rounding, byte classBits)
        {
            return new PhoneTargets(percent, new[] { jaw, lips, rounding }, classBits, 0);
        }

        private static PhoneTargets Level(byte percent)
        {
            return Shape(new byte[] { percent, percent, 0, 0, 0, 0, 0 }, 10, 10, 10, 0);
        }
    }
}
