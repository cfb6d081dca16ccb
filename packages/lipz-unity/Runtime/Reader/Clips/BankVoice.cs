using System.Collections.Generic;

namespace Lipz
{
    /// <summary>A voice of a bank: the language in which lines are spoken. From <see cref="Bank.Voice"/>.</summary>
    public sealed class BankVoice : INamed
    {
        internal const uint NoDub = 0xFFFFFFFF;
        private readonly Table entries;

        /// <summary>The tag: <c>de-de</c>.</summary>
        public readonly string Tag;

        /// <summary>Whether this is the voice of the originals.</summary>
        public readonly bool IsOriginal;

        internal BankVoice(string tag, bool isOriginal, Table entries)
        {
            Tag = tag;
            IsOriginal = isOriginal;
            this.entries = entries;
        }

        string INamed.LookUpName
        {
            get { return Tag; }
        }

        internal uint Entry(uint slot)
        {
            return entries.Has(slot) ? entries.U32(slot) : NoDub;
        }
    }

    /// <summary>The source of a clip in a voice.</summary>
    public enum VoiceSource
    {
        /// <summary>The line is not dubbed.</summary>
        Original,

        /// <summary>The line is dubbed in this voice.</summary>
        Dub,

        /// <summary>The line is dubbed in a fallback of this voice.</summary>
        OtherDub,
    }

    /// <summary>The sections of voices and dubs.</summary>
    internal sealed class DubTable
    {
        private const uint DubOf = 0x80000000;
        private const uint OtherDub = 0x40000000;

        private readonly List<BankVoice> voices = new List<BankVoice>();

        internal DubTable(BankFile file, int clipCount)
        {
            var tags = new StringPool(file.Section("VOIC", 1));
            Table entries = file.Section("DUBS", 4);
            int start = 0;
            for (int at = 0; at < tags.Bytes.Count; at++)
            {
                if (tags.Bytes.U8(at) != 0) continue;
                long first = (voices.Count - 1L) * clipCount;
                if (first >= 0 && first + clipCount > entries.Count) break;
                Table own = first < 0 ? entries.Part(0, 0) : entries.Part(first, first + clipCount);
                voices.Add(new BankVoice(tags.At(start, at - start) ?? "", first < 0, own));
                start = at + 1;
            }
        }

        internal IReadOnlyList<BankVoice> Voices
        {
            get { return voices; }
        }

        /// <summary>Finds the original of a dub, and the voice of the dub.</summary>
        internal bool TryOriginal(uint slot, out uint original, out BankVoice voice)
        {
            for (int i = 0; i < voices.Count; i++)
            {
                uint entry = voices[i].Entry(slot);
                if (entry == BankVoice.NoDub || (entry & DubOf) == 0) continue;
                original = entry & ~DubOf;
                voice = voices[i];
                return true;
            }
            original = slot;
            voice = voices.Count > 0 ? voices[0] : null;
            return false;
        }

        /// <summary>Returns the slot of the clip to play in a voice, and its source.</summary>
        internal static uint InVoice(uint original, BankVoice voice, out VoiceSource source)
        {
            uint entry = voice.Entry(original);
            source = (entry & OtherDub) == 0 ? VoiceSource.Dub : VoiceSource.OtherDub;
            return entry & ~OtherDub;
        }
    }

    /// <summary>The dubs of a clip.</summary>
    public sealed partial class Clip
    {
        /// <summary>The voice in which the clip is spoken; null in a bank without dubs.</summary>
        public BankVoice Voice
        {
            get
            {
                Bank.Dubs.TryOriginal(Slot, out uint _, out BankVoice voice);
                return voice;
            }
        }

        /// <summary>The clip of which this one is a dub; null if it is not a dub.</summary>
        public Clip Original
        {
            get { return Bank.Dubs.TryOriginal(Slot, out uint slot, out BankVoice _) ? Bank.ClipAt(slot) : null; }
        }

        /// <summary>Returns the clip to play in a voice, which may be this one, and where it comes from.</summary>
        public Clip InVoice(BankVoice voice, out VoiceSource source)
        {
            Clip original = Original ?? this;
            uint slot = DubTable.InVoice(original.Slot, voice, out source);
            Clip dub = Bank.ClipAt(slot);
            if (dub == null) source = VoiceSource.Original;
            return dub ?? original;
        }
    }
}
