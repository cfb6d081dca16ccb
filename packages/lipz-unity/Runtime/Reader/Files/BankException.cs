using System;

namespace Lipz
{
    /// <summary>The only exception of unusable files.</summary>
    public sealed class BankException : Exception
    {
        /// <summary>The kind of damage.</summary>
        public readonly BankErrorKind Kind;

        /// <summary>The position of the damage, in bytes from the start of the file.</summary>
        public readonly long OffsetBytes;

        internal BankException(BankErrorKind kind, long offsetBytes)
            : base(ProblemOf(kind) + " (" + kind + " at byte " + offsetBytes + "); " + RemedyFor(kind))
        {
            Kind = kind;
            OffsetBytes = offsetBytes;
        }

        /// <summary>Returns what is wrong with the file, in the words of the bank format.</summary>
        public static string ProblemOf(BankErrorKind kind)
        {
            switch (kind)
            {
                case BankErrorKind.TooShort: return "the file is shorter than the header of a bank";
                case BankErrorKind.NotABank: return "the file is not a lipz bank";
                case BankErrorKind.TextMode:
                    return "the bank was damaged by a copy in text mode (line endings were converted)";
                case BankErrorKind.UnsupportedVersion:
                    return "the bank has a format version that this reader does not support";
                case BankErrorKind.WrongLength:
                    return "the file does not have the length in its header (cut off, or with bytes appended)";
                case BankErrorKind.DirectoryOutOfBounds: return "the directory reaches past the end of the file";
                case BankErrorKind.SectionOutOfBounds: return "a section reaches past the end of the file";
                case BankErrorKind.SectionShape: return "the entry size or the length of a section is wrong";
                case BankErrorKind.SectionMissing: return "a section that every bank has is missing";
                case BankErrorKind.SectionUnknown:
                    return "the bank needs a newer reader (a required section is unknown or out of order)";
                case BankErrorKind.Checksum: return "the checksum does not match: the file was changed or damaged";
                case BankErrorKind.DirectoryTooLong: return "the directory has more than 64 sections";
                case BankErrorKind.OtherClips: return "the texts belong to a bank with other clips";
                default: return "the file contains only texts, for the clips of another bank";
            }
        }

        private static string RemedyFor(BankErrorKind kind)
        {
            switch (kind)
            {
                case BankErrorKind.NotABank: return "name a file that lipz has packed";
                case BankErrorKind.UnsupportedVersion:
                case BankErrorKind.SectionUnknown: return "update lipz, or pack the file again";
                case BankErrorKind.OtherClips: return "pack the bank and its texts again, and replace both";
                case BankErrorKind.TextsOnly: return "open the bank first, and pass it these texts";
                default: return "copy the file again, or pack it again";
            }
        }
    }
}
