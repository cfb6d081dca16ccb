using System.Collections.Generic;
using System.Text;

namespace Lipz
{
    /// <summary>Strings of a section. Each is decoded once, so that playback allocates nothing.</summary>
    internal sealed class StringPool
    {
        /// <summary>Longer strings are decoded again, so that a forged bank cannot fill the memory.</summary>
        private const int LongestKeptBytes = 4096;

        private static readonly UTF8Encoding Strict = new UTF8Encoding(false, true);

        internal readonly Table Bytes;
        private readonly Dictionary<ulong, string> decoded = new Dictionary<ulong, string>();

        internal StringPool(Table bytes)
        {
            Bytes = bytes;
        }

        /// <summary>Whether a range is inside the section.</summary>
        internal bool Has(long start, long length)
        {
            return start >= 0 && length >= 0 && start + length <= Bytes.Count;
        }

        /// <summary>Returns the string in a range; null outside the section, or if it is not valid UTF-8.</summary>
        internal string At(long start, long length)
        {
            if (!Has(start, length)) return null;
            if (length == 0) return "";
            ulong range = (ulong)start << 32 | (uint)length;
            if (decoded.TryGetValue(range, out string text)) return text;
            try
            {
                text = Bytes.Decode(Strict, start, (int)length);
            }
            catch (DecoderFallbackException)
            {
                text = null;
            }
            if (length <= LongestKeptBytes) decoded[range] = text;
            return text;
        }

        /// <summary>Returns the bytes of a name that a program passes.</summary>
        internal static byte[] BytesOf(string name)
        {
            return Encoding.UTF8.GetBytes(name);
        }
    }
}
