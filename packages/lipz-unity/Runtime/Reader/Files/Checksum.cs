namespace Lipz
{
    /// <summary>The checksum of the format: XXH64 of the bytes, a byte 1, and zeros up to a multiple of 32.</summary>
    internal static class Checksum
    {
        private const ulong Prime1 = 0x9E3779B185EBCA87;
        private const ulong Prime2 = 0xC2B2AE3D27D4EB4F;
        private const ulong Prime3 = 0x165667B19E3779F9;
        private const ulong Prime4 = 0x85EBCA77C2B2AE63;
        private const int StripeBytes = 32;

        /// <summary>Returns the checksum of the bytes from an offset on.</summary>
        internal static ulong Of(byte[] bytes, int from)
        {
            ulong a = unchecked(Prime1 + Prime2), b = Prime2, c = 0, d = unchecked(0 - Prime1);
            int at = from;
            for (; bytes.Length - at >= StripeBytes; at += StripeBytes) Add(bytes, at, ref a, ref b, ref c, ref d);
            var last = new byte[StripeBytes];
            System.Array.Copy(bytes, at, last, 0, bytes.Length - at);
            last[bytes.Length - at] = 1;
            Add(last, 0, ref a, ref b, ref c, ref d);
            ulong hash = Turned(a, 1) + Turned(b, 7) + Turned(c, 12) + Turned(d, 18);
            hash = Merged(Merged(Merged(Merged(hash, a), b), c), d);
            hash += (ulong)(at - from + StripeBytes);
            hash = (hash ^ hash >> 33) * Prime2;
            hash = (hash ^ hash >> 29) * Prime3;
            return hash ^ hash >> 32;
        }

        private static void Add(byte[] bytes, int at, ref ulong a, ref ulong b, ref ulong c, ref ulong d)
        {
            a = Round(a, LittleEndian.U64(bytes, at));
            b = Round(b, LittleEndian.U64(bytes, at + 8));
            c = Round(c, LittleEndian.U64(bytes, at + 16));
            d = Round(d, LittleEndian.U64(bytes, at + 24));
        }

        private static ulong Round(ulong lane, ulong word)
        {
            return Turned(lane + word * Prime2, 31) * Prime1;
        }

        private static ulong Merged(ulong hash, ulong lane)
        {
            return (hash ^ Round(0, lane)) * Prime1 + Prime4;
        }

        private static ulong Turned(ulong value, int bits)
        {
            return value << bits | value >> (64 - bits);
        }
    }
}
