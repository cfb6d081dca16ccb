namespace Lipz
{
    /// <summary>The kinds of damage that opening a bank can find. The numbers are those of the bank format.</summary>
    public enum BankErrorKind
    {
        /// <summary>The file is shorter than the header.</summary>
        TooShort = 1,

        /// <summary>The file starts with different bytes.</summary>
        NotABank = 2,

        /// <summary>A copy in text mode has converted line endings.</summary>
        TextMode = 3,

        /// <summary>The format version is not 1.</summary>
        UnsupportedVersion = 4,

        /// <summary>The file was cut off, or bytes were appended.</summary>
        WrongLength = 5,

        /// <summary>The directory reaches past the end of the file.</summary>
        DirectoryOutOfBounds = 6,

        /// <summary>A section reaches past the end of the file.</summary>
        SectionOutOfBounds = 7,

        /// <summary>The length of a section or of its entries is wrong.</summary>
        SectionShape = 8,

        /// <summary>A required section is missing.</summary>
        SectionMissing = 9,

        /// <summary>A required section is unknown or out of order.</summary>
        SectionUnknown = 10,

        /// <summary>A byte was changed.</summary>
        Checksum = 12,

        /// <summary>The directory has more than 64 sections.</summary>
        DirectoryTooLong = 26,

        /// <summary>The texts belong to a bank with other clips.</summary>
        OtherClips = 28,

        /// <summary>The file has only texts.</summary>
        TextsOnly = 29,
    }
}
