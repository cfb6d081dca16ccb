namespace Lipz
{
    /// <summary>Entries of equal length in a file. Callers check an index with <see cref="Has"/> first.</summary>
    internal readonly struct Table
    {
        private readonly byte[] bytes;
        private readonly int start;
        private readonly int entryBytes;

        /// <summary>The number of whole entries.</summary>
        internal readonly int Count;

        /// <summary>Takes entries from a range that is inside the bytes.</summary>
        internal Table(byte[] bytes, int start, int lengthBytes, int entryBytes)
        {
            this.bytes = bytes;
            this.start = start;
            this.entryBytes = entryBytes;
            Count = lengthBytes / entryBytes;
        }

        /// <summary>Returns the same bytes as entries of a different length.</summary>
        internal Table As(int newEntryBytes)
        {
            return new Table(bytes, start, Count * entryBytes, newEntryBytes);
        }

        /// <summary>Returns a part of the entries; none if the part is not inside.</summary>
        internal Table Part(long first, long end)
        {
            bool isInside = first >= 0 && first <= end && end <= Count;
            return isInside
                ? new Table(bytes, start + (int)first * entryBytes, (int)(end - first) * entryBytes, entryBytes)
                : new Table(bytes, start, 0, entryBytes);
        }

        internal bool Has(long index)
        {
            return (ulong)index < (ulong)Count;
        }

        internal byte U8(long index, int field = 0)
        {
            return bytes[At(index, field)];
        }

        internal ushort U16(long index, int field = 0)
        {
            return LittleEndian.U16(bytes, At(index, field));
        }

        internal uint U32(long index, int field = 0)
        {
            return LittleEndian.U32(bytes, At(index, field));
        }

        internal ulong U64(long index, int field = 0)
        {
            return LittleEndian.U64(bytes, At(index, field));
        }

        /// <summary>Returns the place of a field among all bytes of the file.</summary>
        private int At(long index, int field)
        {
            return start + (int)index * entryBytes + field;
        }

        /// <summary>Compares the bytes of a range with others, like numbers from the first byte on.</summary>
        internal int Compare(long first, int length, byte[] other)
        {
            int at = start + (int)first;
            for (int i = 0; i < length && i < other.Length; i++)
            {
                int difference = bytes[at + i] - other[i];
                if (difference != 0) return difference;
            }
            return length - other.Length;
        }

        /// <summary>Decodes a range.</summary>
        internal string Decode(System.Text.Encoding encoding, long first, int length)
        {
            return encoding.GetString(bytes, start + (int)first, length);
        }
    }
}
