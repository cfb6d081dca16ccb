using System;
using System.Collections.Generic;

namespace Lipz
{
    /// <summary>
    /// A dialogue bank: clips with their visemes, subtitles and events. Queries of a damaged bank return nothing, rest
    /// or wrong answers, but never throw. A bank and its clips are for one thread at a time.
    /// </summary>
    public sealed class Bank
    {
        private readonly BankFile file;
        private readonly Table clipRecords;
        private readonly Table pilots;
        private readonly Table keyOrder;
        private readonly StringPool names;
        private readonly BankLocales locales;

        internal readonly Table KeyRecords;
        internal readonly Table Rates;
        internal readonly Table Frames;
        internal readonly Table Starts;
        internal readonly EventTable Events;
        internal readonly CurveTable Curves;
        internal readonly PhoneTable Phones;
        internal readonly DubTable Dubs;

        private Bank(BankFile file)
        {
            this.file = file;
            clipRecords = file.Section("CLIP", 16);
            KeyRecords = file.Section("KEYS", 16);
            Rates = file.Section("RATE", 16);
            pilots = file.Section("PILT", 4);
            keyOrder = file.Section("ORDR", 4);
            names = new StringPool(file.Section("NAME", 1));
            Frames = file.Section("FRAM", 1);
            Starts = file.Section("STRT", 4);
            locales = new BankLocales(file, names, Starts.Count - 1);
            Events = new EventTable(file);
            Curves = new CurveTable(file);
            Phones = new PhoneTable(file);
            Dubs = new DubTable(file, clipRecords.Count);
            Recordings = file.Section("RCRD", 16);
            ArticulationProfiles = Lipz.ArticulationProfile.AllOf(file.Section("ARTC", 1));
            Rigs = Lipz.Rig.AllOf(file.Section("RIGS", 1));
            FaceProfiles = Lipz.FaceProfile.AllOf(file.Section("FACE", 1));
            BabbleProfiles = Lipz.BabbleProfile.AllOf(file.Section("BABL", 1));
        }

        internal Table Recordings { get; private set; }

        /// <summary>
        /// Opens a bank. Checks the header and the directory; the time does not depend on the length of the file. The
        /// bank reads from <paramref name="bytes"/>, so do not change them.
        /// </summary>
        /// <exception cref="BankException">The bytes are not a bank, or it is damaged.</exception>
        public static Bank Open(byte[] bytes)
        {
            var file = new BankFile(bytes);
            if (file.HasTextsOnly) throw new BankException(BankErrorKind.TextsOnly, 0);
            file.CheckDirectory();
            return new Bank(file);
        }

        /// <summary>Compares the checksum with all bytes, which detects damage, but not forgery.</summary>
        /// <exception cref="BankException">The bytes have changed.</exception>
        public void VerifyChecksum()
        {
            file.VerifyChecksum();
        }

        /// <summary>
        /// Checks the header and the directory of a text bank (<c>.lipztexts</c>), and compares its checksum with all
        /// bytes.
        /// </summary>
        /// <exception cref="BankException">The bytes are not a file of lipz, or they are damaged.</exception>
        public static void VerifyTexts(byte[] bytes)
        {
            var texts = new BankFile(bytes);
            texts.CheckDirectory();
            texts.VerifyChecksum();
        }

        /// <summary>
        /// Adds the locales of a text bank (<c>.lipztexts</c>) that was packed with this bank. Checks its header and
        /// its directory; for files that were downloaded, call <see cref="VerifyTexts"/> first.
        /// </summary>
        /// <exception cref="BankException">The bytes are not its texts, or they are damaged.</exception>
        public void OpenTexts(byte[] bytes)
        {
            var texts = new BankFile(bytes);
            texts.CheckDirectory();
            if (texts.Fingerprint != file.Fingerprint) throw new BankException(BankErrorKind.OtherClips, 24);
            locales.Add(texts, Starts.Count - 1);
        }

        /// <summary>The number of clips.</summary>
        public int ClipCount
        {
            get { return clipRecords.Count; }
        }

        /// <summary>All clips, in the order of their keys.</summary>
        public IEnumerable<Clip> Clips
        {
            get { return ClipsFrom(0, new byte[0]); }
        }

        /// <summary>Returns the clips whose keys start with a prefix, in the order of their keys.</summary>
        public IEnumerable<Clip> ClipsUnder(string prefix)
        {
            byte[] wanted = StringPool.BytesOf(prefix);
            int first = 0, end = keyOrder.Count;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (CompareKey(keyOrder.U32(middle), wanted, wanted.Length) < 0) first = middle + 1;
                else end = middle;
            }
            return ClipsFrom(first, wanted);
        }

        /// <summary>Returns the clip with a key: the path of its file without the extension; null without it.</summary>
        public Clip Clip(string key)
        {
            byte[] wanted = StringPool.BytesOf(key);
            Clip clip = Clip(ClipIds.IdOf(wanted));
            return clip != null && CompareKey(clip.Slot, wanted, int.MaxValue) == 0 ? clip : null;
        }

        /// <summary>Returns the clip with an id, which is the hash of its key; null without it.</summary>
        public Clip Clip(ulong id)
        {
            long slot = ClipIds.SlotOf(id, file.IndexSeed, pilots, clipRecords.Count);
            return KeyRecords.Has(slot) && KeyRecords.U64(slot) == id ? ClipAt((uint)slot) : null;
        }

        /// <summary>Returns the clip in a slot; null without it.</summary>
        internal Clip ClipAt(uint slot)
        {
            return clipRecords.Has(slot) ? new Clip(this, clipRecords, slot) : null;
        }

        /// <summary>Returns the key of a slot; an empty string in a damaged bank.</summary>
        internal string KeyOf(uint slot)
        {
            if (!KeyRecords.Has(slot)) return "";
            return names.At(KeyRecords.U32(slot, 8), KeyRecords.U16(slot, 12)) ?? "";
        }

        /// <summary>
        /// All locales, in the order of their tags. Tags with <c>-x-</c> are variants of texts: leave them out of a
        /// menu of languages.
        /// </summary>
        public IReadOnlyList<BankLocale> Locales
        {
            get { return locales.All; }
        }

        /// <summary>Returns the locale with a tag such as <c>de-de</c>; null without it.</summary>
        public BankLocale Locale(string tag)
        {
            return ByName.Find(locales.All, tag);
        }

        /// <summary>
        /// Returns the locale for texts of a variant: for <c>pl-pl</c> and the key <c>few</c>, the texts of
        /// <c>text_pl-pl-x-few</c> in Lipz files. A key lists all cases that apply, the plural category first:
        /// <c>few</c>, or <c>few-fem</c>. The search removes names from the end of the key (<c>few-fem</c>,
        /// <c>few</c>), and then does the same without the plural category (<c>fem</c>). If no clip has any of these,
        /// the result is the locale itself. Look variants up once per locale.
        /// </summary>
        public BankLocale Variant(BankLocale locale, string key)
        {
            int hyphen = key.IndexOf('-');
            bool hasCategory = hyphen >= 0 && Array.IndexOf(PluralCategories, key.Substring(0, hyphen)) >= 0;
            BankLocale variant = VariantWithBeginning(locale, key);
            if (variant == null && hasCategory) variant = VariantWithBeginning(locale, key.Substring(hyphen + 1));
            return variant ?? locale;
        }

        /// <summary>The plural categories of Unicode's CLDR, which come first in a key.</summary>
        private static readonly string[] PluralCategories = { "zero", "one", "two", "few", "many", "other" };

        /// <summary>Returns the variant with this key, or with the longest beginning of it; null without any.</summary>
        private BankLocale VariantWithBeginning(BankLocale locale, string key)
        {
            for (int length = key.Length; length > 0; length = key.LastIndexOf('-', length - 1))
            {
                BankLocale variant = Locale(locale.Tag + "-x-" + key.Substring(0, length));
                if (variant != null) return variant;
            }
            return null;
        }

        /// <summary>The default locale of the project; null without one.</summary>
        public BankLocale DefaultLocale
        {
            get { return locales.Default; }
        }

        /// <summary>All voices: first that of the originals, then those of the dubs. Empty without dubs.</summary>
        public IReadOnlyList<BankVoice> Voices
        {
            get { return Dubs.Voices; }
        }

        /// <summary>Returns the voice with a tag; null without it.</summary>
        public BankVoice Voice(string tag)
        {
            return ByName.Find(Dubs.Voices, tag);
        }

        /// <summary>All rigs, in the order of their names.</summary>
        public IReadOnlyList<Rig> Rigs { get; private set; }

        /// <summary>Returns the rig with a name such as <c>arkit</c>; null without it.</summary>
        public Rig Rig(string name)
        {
            return ByName.Find(Rigs, name);
        }

        /// <summary>All articulation profiles, in the order of their names.</summary>
        public IReadOnlyList<ArticulationProfile> ArticulationProfiles { get; private set; }

        /// <summary>Returns the articulation profile with a name; null without it.</summary>
        public ArticulationProfile ArticulationProfile(string name)
        {
            return ByName.Find(ArticulationProfiles, name);
        }

        /// <summary>The articulation profile of the project, or the built-in one.</summary>
        public ArticulationProfile DefaultArticulationProfile
        {
            get { return ArticulationProfile("default") ?? Lipz.ArticulationProfile.BuiltIn; }
        }

        /// <summary>All face profiles, in the order of their names.</summary>
        public IReadOnlyList<FaceProfile> FaceProfiles { get; private set; }

        /// <summary>Returns the face profile with a name; null without it.</summary>
        public FaceProfile FaceProfile(string name)
        {
            return ByName.Find(FaceProfiles, name);
        }

        /// <summary>The face profile of the project, or the built-in one.</summary>
        public FaceProfile DefaultFaceProfile
        {
            get { return FaceProfile("default") ?? Lipz.FaceProfile.BuiltIn; }
        }

        /// <summary>All babble profiles, in the order of their names.</summary>
        public IReadOnlyList<BabbleProfile> BabbleProfiles { get; private set; }

        /// <summary>Returns the babble profile with a name; null without it.</summary>
        public BabbleProfile BabbleProfile(string name)
        {
            return ByName.Find(BabbleProfiles, name);
        }

        /// <summary>The babble profile of the project, or the built-in one.</summary>
        public BabbleProfile DefaultBabbleProfile
        {
            get { return BabbleProfile("default") ?? Lipz.BabbleProfile.BuiltIn; }
        }

        private IEnumerable<Clip> ClipsFrom(int first, byte[] prefix)
        {
            for (int i = first; i < keyOrder.Count; i++)
            {
                uint slot = keyOrder.U32(i);
                // A damaged order ends the clips.
                if (!clipRecords.Has(slot) || CompareKey(slot, prefix, prefix.Length) != 0) yield break;
                yield return ClipAt(slot);
            }
        }

        /// <summary>Compares the first bytes of the key in a slot with others. A missing key is less.</summary>
        private int CompareKey(uint slot, byte[] other, int mostBytes)
        {
            if (!KeyRecords.Has(slot)) return -1;
            uint offset = KeyRecords.U32(slot, 8);
            int length = KeyRecords.U16(slot, 12);
            return names.Has(offset, length)
                ? names.Bytes.Compare(offset, length < mostBytes ? length : mostBytes, other)
                : -1;
        }
    }
}
