using System;

namespace Lipz
{
    /// <summary>A phone of a clip, and when it is spoken.</summary>
    public readonly struct PhoneSpan
    {
        /// <summary>The number of the phone in the bank format. Unknown numbers are silent.</summary>
        public readonly int Number;

        /// <summary>The start in milliseconds from the start of the clip.</summary>
        public readonly uint StartMs;

        /// <summary>The end in milliseconds.</summary>
        public readonly uint EndMs;

        internal PhoneSpan(int number, uint startMs, uint endMs)
        {
            Number = number;
            StartMs = startMs;
            EndMs = endMs;
        }
    }

    /// <summary>The phones of a clip, in the order of their times.</summary>
    public sealed class Phones
    {
        private const int MostNear = 24;
        private const int GlidePercent = 55;
        private const int ShortestGlideUs = 30000;
        private const uint LastMs = 100;
        private const int UnknownLevel = -128;
        private const uint AreCertainFlag = 0x40000000;
        private const uint AreWideFlag = 0x80000000;

        private readonly Table entries;
        private readonly bool areWide;
        private readonly uint clipEndMs;

        /// <summary>Takes the data of a clip; none without phones.</summary>
        internal Phones(Table data, uint flags, Clip clip)
        {
            AreCertain = data.Count == 0 || (flags & AreCertainFlag) != 0;
            areWide = (flags & AreWideFlag) != 0;
            entries = data.Part(Math.Min(1, data.Count), data.Count).As(areWide ? 5 : 3);
            if (data.Count == 0) return;
            int level = (sbyte)data.U8(0);
            LevelDb = level == UnknownLevel ? default(int?) : level;
            clipEndMs = clip.Rate.IsSpecified && clip.FrameCount > 0
                ? (uint)Math.Min(clip.Rate.StartOfFrameUs(clip.FrameCount) / 1000, uint.MaxValue)
                : (Count == 0 ? 0 : StartOf(Count - 1)) + LastMs;
        }

        /// <summary>The number of phones.</summary>
        public int Count
        {
            get { return entries.Count; }
        }

        /// <summary>Whether the phones come from the text of the recording.</summary>
        public bool AreCertain { get; private set; }

        /// <summary>The level of the speech in decibels relative to full scale; null if it is unknown.</summary>
        public int? LevelDb { get; private set; }

        /// <summary>Returns a phone, whose index must be less than the number of phones.</summary>
        public PhoneSpan this[int index]
        {
            get
            {
                if (!entries.Has(index)) throw new ArgumentOutOfRangeException("index");
                uint start = StartOf(index);
                return new PhoneSpan(entries.U8(index), start, EndOf(index, Math.Max(clipEndMs, start)));
            }
        }

        private uint StartOf(int index)
        {
            return areWide ? entries.U32(index, 1) : entries.U16(index, 1);
        }

        private uint EndOf(int index, uint last)
        {
            return index + 1 < Count ? StartOf(index + 1) : last;
        }

        /// <summary>Adds the sounds that matter at a time.</summary>
        internal void AddNear(ClipTime time, ArticulationProfile profile, ArticulationBlend blend)
        {
            var now = new QueryTime(time, profile.LeadMs);
            // The phone before the first one that starts within reach may end within reach.
            int first = Math.Max(0, StartedBy(now.FirstMs) - 1);
            for (int index = first; index < Count && index < first + MostNear; index++)
            {
                uint start = StartOf(index);
                if (start > now.LastMs) return;
                int number = entries.U8(index);
                if (number == 0) continue;
                AddSounds(number, now.Until(start), now.Until(EndOf(index, clipEndMs)), profile, blend);
            }
        }

        /// <summary>Adds a phone, or both sounds of a diphthong.</summary>
        private static void AddSounds(
            int number, int startUs, int endUs, ArticulationProfile profile, ArticulationBlend blend)
        {
            PhoneTargets targets = profile.TargetsOf(number);
            int lengthUs = endUs - startUs;
            if (targets.Second != number && lengthUs > ShortestGlideUs)
            {
                int glideUs = startUs + lengthUs * GlidePercent / 100;
                blend.Add(startUs, glideUs, targets);
                startUs = glideUs;
                targets = profile.TargetsOf(targets.Second);
            }
            blend.Add(startUs, endUs, targets);
        }

        private int StartedBy(uint ms)
        {
            int first = 0, end = Count;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (StartOf(middle) <= ms) first = middle + 1;
                else end = middle;
            }
            return first;
        }
    }

    /// <summary>The sections of phones; empty in a bank without them.</summary>
    internal sealed class PhoneTable
    {
        private const uint OffsetBits = 0x3FFFFFFF;

        private readonly Table clips;
        private readonly Table data;

        internal PhoneTable(BankFile file)
        {
            clips = file.Section("PHNC", 8);
            data = file.Section("PHON", 1);
        }

        internal Phones Of(Clip clip)
        {
            int first = 0, end = clips.Count;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (clips.U32(middle) < clip.Slot) first = middle + 1;
                else end = middle;
            }
            bool isFound = clips.Has(first) && clips.U32(first) == clip.Slot;
            if (!isFound) return new Phones(data.Part(0, 0), 0, clip);
            return new Phones(data.Part(OffsetAt(first), OffsetAt(first + 1)), clips.U32(first, 4), clip);
        }

        private long OffsetAt(int place)
        {
            return clips.Has(place) ? (long)(clips.U32(place, 4) & OffsetBits) : data.Count;
        }
    }
}
