namespace Lipz
{
    /// <summary>The parts that banks and text banks share: a header, a directory and sections.</summary>
    internal sealed class BankFile
    {
        private const int HeaderBytes = 64;
        private const int EntryBytes = 16;
        private const int MostSections = 64;
        private const int ChecksumAt = 8;
        private const int LengthAt = 16;
        private const int MajorAt = 20;
        private const int SectionCountAt = 40;
        private const ushort SupportedMajor = 1;
        private const int RequiredFlag = 1;

        private static readonly byte[] Magic = { 0x89, (byte)'L', (byte)'P', (byte)'Z', 0x0D, 0x0A, 0x1A, 0x0A };

        /// <summary>The sections of every bank, in their order.</summary>
        private static readonly string[] OfBank =
        {
            "CLIP", "KEYS", "RATE", "PILT", "ORDR", "NAME", "FRAM", "STRT",
            "LOCL", "TXST", "TEXT", "EVRF", "EVNT", "EVTY", "EVNM", "EVST",
        };

        private static readonly int[] BytesOfBank = { 16, 16, 16, 4, 4, 1, 1, 4, 8, 4, 1, 4, 16, 16, 8, 1 };
        private static readonly string[] OfTexts = { "NAME", "LOCL", "TXST", "TEXT" };
        private static readonly int[] BytesOfTexts = { 1, 8, 4, 1 };

        private readonly byte[] bytes;
        private readonly int sectionCount;

        /// <summary>Checks the header and the place of the directory.</summary>
        internal BankFile(byte[] bytes)
        {
            this.bytes = bytes;
            CheckHeader();
            sectionCount = (int)LittleEndian.U32(bytes, SectionCountAt);
            if (HeaderBytes + sectionCount * EntryBytes > bytes.Length)
            {
                throw new BankException(BankErrorKind.DirectoryOutOfBounds, SectionCountAt);
            }
        }

        internal ulong StoredChecksum
        {
            get { return LittleEndian.U64(bytes, ChecksumAt); }
        }

        internal ulong Fingerprint
        {
            get { return LittleEndian.U64(bytes, 24); }
        }

        internal ulong IndexSeed
        {
            get { return LittleEndian.U64(bytes, 32); }
        }

        /// <summary>Whether the file is a text bank.</summary>
        internal bool HasTextsOnly
        {
            get { return sectionCount > 0 && HasTag(0, "NAME"); }
        }

        /// <summary>Compares the checksum with the bytes, in a time proportional to their number.</summary>
        internal void VerifyChecksum()
        {
            if (Checksum.Of(bytes, LengthAt) != StoredChecksum)
            {
                throw new BankException(BankErrorKind.Checksum, ChecksumAt);
            }
        }

        /// <summary>Checks the whole directory against the sections that the file must have.</summary>
        internal void CheckDirectory()
        {
            string[] tags = HasTextsOnly ? OfTexts : OfBank;
            int[] entryBytes = HasTextsOnly ? BytesOfTexts : BytesOfBank;
            int next = 0;
            for (int index = 0; index < sectionCount; index++)
            {
                int entry = HeaderBytes + index * EntryBytes;
                if (!IsInside(entry)) throw new BankException(BankErrorKind.SectionOutOfBounds, entry);
                if (next < tags.Length && HasTag(index, tags[next]))
                {
                    uint length = LittleEndian.U32(bytes, entry + 8);
                    bool isFilled = length % (uint)entryBytes[next] == 0;
                    bool hasShape = LittleEndian.U16(bytes, entry + 12) == entryBytes[next];
                    if (!isFilled || !hasShape) throw new BankException(BankErrorKind.SectionShape, entry);
                    next++;
                }
                else if ((LittleEndian.U16(bytes, entry + 14) & RequiredFlag) != 0)
                {
                    throw new BankException(BankErrorKind.SectionUnknown, entry);
                }
            }
            if (next < tags.Length) throw new BankException(BankErrorKind.SectionMissing, SectionCountAt);
        }

        /// <summary>Returns the entries of a section; none if the file does not have it.</summary>
        internal Table Section(string tag, int entryBytes)
        {
            for (int index = 0; index < sectionCount; index++)
            {
                int entry = HeaderBytes + index * EntryBytes;
                if (!HasTag(index, tag) || !IsInside(entry)) continue;
                int start = (int)LittleEndian.U32(bytes, entry + 4);
                return new Table(bytes, start, (int)LittleEndian.U32(bytes, entry + 8), entryBytes);
            }
            return new Table(bytes, 0, 0, entryBytes);
        }

        private bool HasTag(int index, string tag)
        {
            int at = HeaderBytes + index * EntryBytes;
            return bytes[at] == tag[0] && bytes[at + 1] == tag[1] && bytes[at + 2] == tag[2] && bytes[at + 3] == tag[3];
        }

        private bool IsInside(int entry)
        {
            ulong start = LittleEndian.U32(bytes, entry + 4);
            return start + LittleEndian.U32(bytes, entry + 8) <= (ulong)bytes.Length;
        }

        private void CheckHeader()
        {
            int equal = 0;
            while (equal < Magic.Length && equal < bytes.Length && bytes[equal] == Magic[equal]) equal++;
            bool hasStart = equal >= 4 || equal == bytes.Length;
            if (!hasStart && bytes.Length >= 4) throw new BankException(BankErrorKind.NotABank, 0);
            if (bytes.Length < HeaderBytes) throw new BankException(BankErrorKind.TooShort, bytes.Length);
            if (equal < Magic.Length) throw new BankException(BankErrorKind.TextMode, 0);
            if (LittleEndian.U16(bytes, MajorAt) != SupportedMajor)
            {
                throw new BankException(BankErrorKind.UnsupportedVersion, MajorAt);
            }
            if (LittleEndian.U32(bytes, LengthAt) != (uint)bytes.Length)
            {
                throw new BankException(BankErrorKind.WrongLength, LengthAt);
            }
            if (LittleEndian.U32(bytes, SectionCountAt) > MostSections)
            {
                throw new BankException(BankErrorKind.DirectoryTooLong, SectionCountAt);
            }
        }
    }
}
