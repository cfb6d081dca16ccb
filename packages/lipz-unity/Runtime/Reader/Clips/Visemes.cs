namespace Lipz
{
    /// <summary>A set of visemes. The numbers are those of the bank format.</summary>
    public enum VisemeType : byte
    {
        /// <summary>The clip's file does not specify it.</summary>
        Unspecified = 0,

        /// <summary>The shapes of Preston Blair: <c>-AMOSWEFLU</c>.</summary>
        Blair = 1,

        /// <summary>The shapes of Toon Boom: <c>-ABCDEFG</c>.</summary>
        ToonBoom = 2,

        /// <summary>Loudness: <c>-0123456789</c>.</summary>
        Rms = 3,
    }

    /// <summary>Properties of visemes.</summary>
    public static class Visemes
    {
        private const float PerDigit = 0.11f;

        /// <summary>Returns the codes of a type: rest, and then the shapes.</summary>
        public static string CodesOf(VisemeType type)
        {
            switch (type)
            {
                case VisemeType.Blair: return "-AMOSWEFLU";
                case VisemeType.ToonBoom: return "-ABCDEFG";
                case VisemeType.Rms: return "-0123456789";
                default: return "-";
            }
        }

        /// <summary>Returns how far a viseme opens the mouth, from 0 to 0.99.</summary>
        public static float Openness(char viseme, VisemeType type)
        {
            return DigitOf(viseme, type) * PerDigit;
        }

        /// <summary>Returns the openness of a clip's viseme; null without frames, or without a viseme type.</summary>
        internal static float? OpennessOf(Clip clip, char viseme)
        {
            bool isKnown = clip.VisemeType != VisemeType.Unspecified && clip.FrameCount > 0;
            return isKnown ? Openness(viseme, clip.VisemeType) : default(float?);
        }

        /// <summary>Whether a shape is that of a consonant (Lipz specification, "Visemes").</summary>
        internal static bool IsConsonant(char viseme, VisemeType type)
        {
            switch (type)
            {
                case VisemeType.Blair: return "MSWFL".IndexOf(viseme) >= 0;
                case VisemeType.ToonBoom: return "ABFG".IndexOf(viseme) >= 0;
                default: return false;
            }
        }

        private static int DigitOf(char viseme, VisemeType type)
        {
            int place;
            switch (type)
            {
                case VisemeType.Rms: return viseme >= '0' && viseme <= '9' ? viseme - '0' : 0;
                case VisemeType.Blair:
                    place = "AEOLSUWF".IndexOf(viseme);
                    return place < 0 ? 0 : "96643221"[place] - '0';
                case VisemeType.ToonBoom:
                    place = "DCEBFG".IndexOf(viseme);
                    return place < 0 ? 0 : "966321"[place] - '0';
                default: return 0;
            }
        }
    }
}
