using System.Globalization;

namespace Lipz
{
    /// <summary>The strengths of gestures, which banks store as names: <c>2</c>, <c>2.5</c>.</summary>
    internal static class Strengths
    {
        private const int Places = 3;

        /// <summary>Reads a decimal number with at most three places, zeros aside, in thousandths.</summary>
        internal static bool TryParse(string text, out int? thousandths)
        {
            thousandths = null;
            if (text == null) return false;
            long value = 0;
            int places = -1;
            bool hasDigit = false;
            foreach (char letter in text)
            {
                if (letter == '.' && places < 0 && hasDigit)
                {
                    places = 0;
                    hasDigit = false;
                    continue;
                }
                if (letter < '0' || letter > '9') return false;
                if (places == Places)
                {
                    if (letter != '0') return false;
                    continue;
                }
                value = value * 10 + (letter - '0');
                if (value > int.MaxValue) return false;
                if (places >= 0) places++;
                hasDigit = true;
            }
            for (int i = places < 0 ? 0 : places; i < Places; i++) value *= 10;
            if (!hasDigit || value > int.MaxValue) return false;
            thousandths = (int)value;
            return true;
        }
    }

    /// <summary>Numbers in thousandths, as text.</summary>
    internal static class Thousandths
    {
        internal static string ToString(int thousandths)
        {
            return ((decimal)thousandths / 1000).ToString("0.###", CultureInfo.InvariantCulture);
        }
    }
}
