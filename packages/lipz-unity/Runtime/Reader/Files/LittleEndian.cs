namespace Lipz
{
    /// <summary>Numbers of files, with the lowest byte first on every machine.</summary>
    internal static class LittleEndian
    {
        internal static ushort U16(byte[] bytes, int at)
        {
            return (ushort)(bytes[at] | bytes[at + 1] << 8);
        }

        internal static uint U32(byte[] bytes, int at)
        {
            return (uint)(bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | bytes[at + 3] << 24);
        }

        internal static ulong U64(byte[] bytes, int at)
        {
            return U32(bytes, at) | (ulong)U32(bytes, at + 4) << 32;
        }
    }
}
