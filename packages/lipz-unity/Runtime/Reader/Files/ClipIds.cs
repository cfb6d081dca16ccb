namespace Lipz
{
    /// <summary>Hashes of keys, and the index from a hash to a slot.</summary>
    internal static class ClipIds
    {
        internal const ulong Step = 0x9E3779B97F4A7C15;
        internal const ulong Finish = 0x9FB21C651E98DF25;
        private const uint DirectSlot = 0x80000000;

        internal static ulong Mix(ulong value, ulong multiplier)
        {
            ulong product = value * multiplier;
            return product ^ product >> 32;
        }

        /// <summary>Returns the id of a key in UTF-8.</summary>
        internal static ulong IdOf(byte[] key)
        {
            ulong hash = Mix((ulong)key.Length, Step);
            int at = 0;
            for (; key.Length - at >= 8; at += 8) hash = Mix(hash ^ LittleEndian.U64(key, at), Step);
            ulong tail = 0;
            for (int i = key.Length - 1; i >= at; i--) tail = tail << 8 | key[i];
            return Mix(Mix(hash ^ tail, Step), Finish);
        }

        /// <summary>
        /// Returns the slot to which the pilots lead from an id; -1 without pilots. It may not exist.
        /// </summary>
        internal static long SlotOf(ulong id, ulong seed, Table pilots, int clipCount)
        {
            ulong spread = Mix(id ^ seed, Step);
            uint bucket = Scale((uint)(spread >> 32), (uint)pilots.Count);
            if (!pilots.Has(bucket)) return -1;
            uint pilot = pilots.U32(bucket);
            if ((pilot & DirectSlot) != 0) return pilot ^ DirectSlot;
            uint mixed = ((uint)spread ^ pilot * 0x9E3779B9) * 0x85EBCA6B;
            return Scale((mixed ^ mixed >> 15) * 0xC2B2AE35, (uint)clipCount);
        }

        private static uint Scale(uint value, uint count)
        {
            return (uint)((ulong)value * count >> 32);
        }
    }
}
