using System.Collections.Generic;

namespace Lipz
{
    /// <summary>
    /// A clip: one spoken line. Look it up when the line starts, and keep it while it plays. Queries allocate nothing
    /// after the first of their kind.
    /// </summary>
    public sealed partial class Clip
    {
        /// <summary>The code of rest, before the start and after the end.</summary>
        public const char Rest = '-';

        private const byte HasVisemesFlag = 1;
        private const ulong NoRecording = ulong.MaxValue;

        /// <summary>The bank.</summary>
        public readonly Bank Bank;

        internal readonly uint Slot;
        internal readonly uint FramesOffset;
        internal readonly long SegmentsFirst;
        internal readonly FrameRate Rate;
        private string key;

        internal Clip(Bank bank, Table records, uint slot)
        {
            Bank = bank;
            Slot = slot;
            FramesOffset = records.U32(slot);
            FrameCount = records.U32(slot, 4);
            SegmentsFirst = records.U32(slot, 8);
            Rate = FrameRate.Stored(records.U16(slot, 12), bank.Rates);
            byte type = records.U8(slot, 14);
            VisemeType = type <= (byte)VisemeType.Rms ? (VisemeType)type : VisemeType.Unspecified;
            HasVisemes = (records.U8(slot, 15) & HasVisemesFlag) != 0;
            if (!bank.KeyRecords.Has(slot)) return;
            Id = bank.KeyRecords.U64(slot);
            SegmentCount = System.Math.Min(bank.KeyRecords.U16(slot, 14), bank.Starts.Count);
        }

        private Clip(Clip clip, FrameRate rate, VisemeType visemeType)
        {
            Bank = clip.Bank;
            Slot = clip.Slot;
            FramesOffset = clip.FramesOffset;
            FrameCount = clip.FrameCount;
            SegmentsFirst = clip.SegmentsFirst;
            SegmentCount = clip.SegmentCount;
            HasVisemes = clip.HasVisemes;
            Id = clip.Id;
            Rate = rate;
            VisemeType = visemeType;
        }

        /// <summary>The id: a hash of the key, which stays the same in all banks.</summary>
        public ulong Id { get; private set; }

        /// <summary>The key: the path of the clip's file without the extension.</summary>
        public string Key
        {
            get { return key ?? (key = Bank.KeyOf(Slot)); }
        }

        /// <summary>The number of frames.</summary>
        public uint FrameCount { get; private set; }

        /// <summary>The number of segments.</summary>
        public int SegmentCount { get; private set; }

        /// <summary>The set of visemes.</summary>
        public VisemeType VisemeType { get; private set; }

        /// <summary>Whether the clip's file has visemes, which may be without frames.</summary>
        public bool HasVisemes { get; private set; }

        /// <summary>Whether the clip's file has events.</summary>
        public bool HasEvents
        {
            get { return Bank.Events.HasReference(SegmentsFirst); }
        }

        /// <summary>The frame rate; null if the file does not specify it.</summary>
        public FrameRate? Fps
        {
            get { return Rate.IsSpecified && Rate.IsValid ? Rate : default(FrameRate?); }
        }

        /// <summary>Returns the clip with this frame rate, if its file does not specify one.</summary>
        public Clip OrFps(FrameRate fps)
        {
            return Rate.IsSpecified ? this : new Clip(this, fps, VisemeType);
        }

        /// <summary>Returns the clip with this number of frames per second, if its file does not specify one.</summary>
        public Clip OrFps(uint numerator, uint denominator = 1)
        {
            return OrFps(new FrameRate(numerator, denominator));
        }

        /// <summary>Returns the clip with this set of visemes, if its file does not specify one.</summary>
        public Clip OrVisemeType(VisemeType type)
        {
            return VisemeType != VisemeType.Unspecified ? this : new Clip(this, Rate, type);
        }

        /// <summary>The length in microseconds; null without a frame rate.</summary>
        public ulong? DurationUs
        {
            get { return StartOfFrameUs(FrameCount); }
        }

        /// <summary>Returns the start of a frame in microseconds; null without a frame rate.</summary>
        public ulong? StartOfFrameUs(uint frame)
        {
            return Rate.IsSpecified ? Rate.StartOfFrameUs(frame) : default(ulong?);
        }

        /// <summary>Returns the frame at a time; null outside the clip, and without a frame rate.</summary>
        public uint? FrameAt(ClipTime time)
        {
            return time.TryFrame(Rate, FrameCount, out uint frame) ? frame : default(uint?);
        }

        /// <summary>Returns the viseme in a frame, or rest outside the clip.</summary>
        public char Viseme(uint frame)
        {
            long offset = (long)FramesOffset + frame;
            return frame < FrameCount && Bank.Frames.Has(offset) ? (char)Bank.Frames.U8(offset) : Rest;
        }

        /// <summary>Returns the viseme at a time, or rest outside the clip.</summary>
        public char VisemeAt(ClipTime time)
        {
            return time.TryFrame(Rate, FrameCount, out uint frame) ? Viseme(frame) : Rest;
        }

        /// <summary>
        /// Returns how far the mouth is open at a time, from 0 to 1; null without frames, or without a viseme type.
        /// </summary>
        public float? OpennessAt(ClipTime time)
        {
            return Visemes.OpennessOf(this, VisemeAt(time));
        }

        /// <summary>The visemes of all frames; none in a damaged bank that lacks some.</summary>
        internal Table FrameCodes
        {
            get { return Bank.Frames.Part(FramesOffset, (long)FramesOffset + FrameCount); }
        }

        /// <summary>Returns a segment; null if the clip has fewer.</summary>
        public Segment? Segment(int index)
        {
            return index >= 0 && index < SegmentCount ? new Segment(this, index) : default(Segment?);
        }

        /// <summary>Returns the segment at a time; null outside the clip, and without a frame rate.</summary>
        public Segment? SegmentAt(ClipTime time)
        {
            return time.TryFrame(Rate, FrameCount, out uint frame) ? Segment(SegmentOfFrame(frame)) : default(Segment?);
        }

        /// <summary>All segments.</summary>
        public IEnumerable<Segment> Segments
        {
            get
            {
                for (int index = 0; index < SegmentCount; index++) yield return new Segment(this, index);
            }
        }

        /// <summary>Returns the index of the segment that contains a frame; -1 in a damaged bank.</summary>
        internal int SegmentOfFrame(uint frame)
        {
            ulong offset = (ulong)FramesOffset + frame;
            // Segment 0 starts at or before every frame.
            if (!Bank.Starts.Has(SegmentsFirst + SegmentCount - 1)) return -1;
            int first = 1, end = SegmentCount;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (Bank.Starts.U32(SegmentsFirst + middle) <= offset) first = middle + 1;
                else end = middle;
            }
            return first - 1;
        }

        /// <summary>The recording that the clip was made for; null if the bank does not record it.</summary>
        public Recording? Recording
        {
            get
            {
                if (!Bank.Recordings.Has(Slot) || Bank.Recordings.U64(Slot) == NoRecording) return null;
                return new Recording(Bank.Recordings.U64(Slot), Bank.Recordings.U64(Slot, 8));
            }
        }
    }

    /// <summary>The length and the hash of a recording when the bank was packed.</summary>
    public readonly struct Recording
    {
        /// <summary>The length in microseconds.</summary>
        public readonly ulong LengthUs;

        /// <summary>XXH3 with 64 bits of all bytes in the file.</summary>
        public readonly ulong ContentHash;

        internal Recording(ulong lengthUs, ulong contentHash)
        {
            LengthUs = lengthUs;
            ContentHash = contentHash;
        }
    }
}
