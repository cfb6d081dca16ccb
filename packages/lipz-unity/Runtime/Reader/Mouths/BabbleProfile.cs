using System;
using System.Collections.Generic;

namespace Lipz
{
    /// <summary>How far the two movements of babble have come, each from 0 to 1.</summary>
    public readonly struct BabbleWeights
    {
        /// <summary>How far the lips are pursed.</summary>
        public readonly float Ooh;

        /// <summary>How far the jaw is open.</summary>
        public readonly float Aah;

        internal BabbleWeights(float ooh, float aah)
        {
            Ooh = ooh;
            Aah = aah;
        }
    }

    /// <summary>Generated mouth movement for a voice without visemes: loops of digits for lips and jaw.</summary>
    public sealed class BabbleProfile : INamed
    {
        private const int RecordBytes = 32;
        private const int Strings = 5;
        private const float PerProduct = 0.0121f;

        /// <summary>The profile of projects without their own, which is that of Second Life's viewer.</summary>
        public static readonly BabbleProfile BuiltIn = new BabbleProfile(
            new[]
            {
                "default", "1247898743223344444443200000", "257998776531013446642343", "0012345566778899",
                "0000123456789",
            },
            new FrameRate(24));

        private readonly string[] strings;
        private readonly FrameRate rate;

        private BabbleProfile(string[] strings, FrameRate rate)
        {
            this.strings = strings;
            this.rate = rate;
        }

        /// <summary>The name of the profile.</summary>
        public string Name
        {
            get { return strings[0]; }
        }

        string INamed.LookUpName
        {
            get { return Name; }
        }

        /// <summary>Reads the profiles of a section. A damaged profile ends them.</summary>
        internal static IReadOnlyList<BabbleProfile> AllOf(Table section)
        {
            var all = new List<BabbleProfile>();
            var pool = new StringPool(section);
            for (long at = 0; at + RecordBytes <= section.Count;)
            {
                var rate = new FrameRate(section.U32(at, 8), section.U32(at, 12), section.U64(at));
                var strings = new string[Strings];
                long end = at + RecordBytes;
                for (int i = 0; i < Strings; i++)
                {
                    int length = section.U16(at, 16 + 2 * i);
                    if (!pool.Has(end, length)) return all;
                    strings[i] = pool.At(end, length) ?? "";
                    end += length;
                }
                if (!rate.IsSpecified || !rate.IsValid) return all;
                all.Add(new BabbleProfile(strings, rate));
                at = end;
            }
            return all;
        }

        /// <summary>
        /// Returns how far lips and jaw have moved after the start of speech, at a power of the voice from 0 to 1. For
        /// a voice that is not measured, pass 0.75.
        /// </summary>
        public BabbleWeights At(ClipTime elapsed, float power)
        {
            if (!elapsed.TryFrame(rate, uint.MaxValue, out uint index)) return default(BabbleWeights);
            return new BabbleWeights(
                Product(strings[1], index, strings[3], power), Product(strings[2], index, strings[4], power));
        }

        private static float Product(string loop, uint index, string transfer, float power)
        {
            if (loop.Length == 0 || transfer.Length == 0) return 0;
            // The arithmetic of the viewer. Values below 0 and NaN are silent.
            float scaled = (float)(transfer.Length * power);
            int at = scaled > 0 ? (int)Math.Min(scaled, transfer.Length - 1) : 0;
            return DigitOf(loop[(int)(index % (uint)loop.Length)]) * DigitOf(transfer[at]) * PerProduct;
        }

        private static int DigitOf(char letter)
        {
            return letter >= '0' && letter <= '9' ? letter - '0' : 0;
        }
    }
}
