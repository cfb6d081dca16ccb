using System.Collections.Generic;

namespace Lipz
{
    /// <summary>A locale of a bank, from <see cref="Bank.Locale"/>.</summary>
    public sealed class BankLocale : INamed
    {
        private const uint NoText = 0xFFFFFFFF;
        private const uint Fallback = 0x80000000;
        private const uint HasLength = 0x40000000;
        private const uint Offset = 0x3FFFFFFF;
        private const int CountBytes = 3;

        private readonly Table starts;
        private readonly StringPool texts;

        /// <summary>The place in <c>starts</c> of the text of the first segment.</summary>
        private readonly long first;

        /// <summary>The tag: <c>en-us</c>.</summary>
        public readonly string Tag;

        /// <summary>Whether this is the default locale of the project.</summary>
        public readonly bool IsDefault;

        internal BankLocale(string tag, bool isDefault, Table starts, StringPool texts, long first)
        {
            Tag = tag;
            IsDefault = isDefault;
            this.starts = starts;
            this.texts = texts;
            this.first = first;
        }

        string INamed.LookUpName
        {
            get { return Tag; }
        }

        /// <summary>Returns the text of the segment with a number; none if the clip has no text.</summary>
        internal SegmentText? Text(long number)
        {
            long place = first + number;
            if (!starts.Has(place) || !starts.Has(place + 1)) return null;
            uint entry = starts.U32(place);
            if (entry == NoText) return null;
            long start = entry & Offset, end = starts.U32(place + 1) & Offset;
            if ((entry & HasLength) != 0)
            {
                if (!texts.Has(start, CountBytes)) return null;
                long length = LengthDigit(start) << 12 | LengthDigit(start + 1) << 6 | LengthDigit(start + 2);
                start += CountBytes;
                end = start + length;
            }
            string text = texts.At(start, end - start);
            return text == null ? default(SegmentText?) : new SegmentText(text, (entry & Fallback) != 0);
        }

        private long LengthDigit(long at)
        {
            return texts.Bytes.U8(at) & 0x3F;
        }
    }

    /// <summary>The text of a segment in a locale.</summary>
    public readonly struct SegmentText
    {
        /// <summary>The text to show. May be empty.</summary>
        public readonly string Text;

        /// <summary>Whether the text comes from a fallback of the locale.</summary>
        public readonly bool IsFallback;

        internal SegmentText(string text, bool isFallback)
        {
            Text = text;
            IsFallback = isFallback;
        }

        /// <summary>Returns the text.</summary>
        public override string ToString()
        {
            return Text;
        }
    }

    /// <summary>The locales of a bank and of its text banks, in the order of their tags.</summary>
    internal sealed class BankLocales
    {
        private const ushort DefaultFlag = 1;

        private readonly List<BankLocale> all = new List<BankLocale>();

        internal BankLocales(BankFile file, StringPool names, int segmentCount)
        {
            Add(file, names, segmentCount);
        }

        internal IReadOnlyList<BankLocale> All
        {
            get { return all; }
        }

        internal BankLocale Default
        {
            get { return all.Find(locale => locale.IsDefault); }
        }

        /// <summary>Adds the locales of a text bank, which replace those with the same tags.</summary>
        internal void Add(BankFile file, int segmentCount)
        {
            Add(file, new StringPool(file.Section("NAME", 1)), segmentCount);
        }

        private void Add(BankFile file, StringPool names, int segmentCount)
        {
            Table records = file.Section("LOCL", 8);
            Table starts = file.Section("TXST", 4);
            var texts = new StringPool(file.Section("TEXT", 1));
            for (int i = 0; i < records.Count; i++)
            {
                string tag = names.At(records.U32(i), records.U16(i, 4)) ?? "";
                bool isDefault = (records.U16(i, 6) & DefaultFlag) != 0;
                all.RemoveAll(locale => locale.Tag == tag);
                all.Add(new BankLocale(tag, isDefault, starts, texts, (long)i * segmentCount));
            }
            all.Sort((one, other) => string.CompareOrdinal(one.Tag, other.Tag));
        }
    }
}
