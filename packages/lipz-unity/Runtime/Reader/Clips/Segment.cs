namespace Lipz
{
    /// <summary>A segment of a clip: a range of frames with a subtitle in each locale, and events.</summary>
    public readonly struct Segment
    {
        /// <summary>The clip.</summary>
        public readonly Clip Clip;

        /// <summary>The index in the clip.</summary>
        public readonly int Index;

        internal Segment(Clip clip, int index)
        {
            Clip = clip;
            Index = index;
        }

        private long Number
        {
            get { return Clip.SegmentsFirst + Index; }
        }

        /// <summary>The first frame.</summary>
        public uint StartFrame
        {
            get { return FrameOf(Number); }
        }

        /// <summary>The frame after the last one.</summary>
        public uint EndFrame
        {
            get { return FrameOf(Number + 1); }
        }

        /// <summary>The start in microseconds; null without a frame rate.</summary>
        public ulong? StartUs
        {
            get { return Clip.StartOfFrameUs(StartFrame); }
        }

        /// <summary>The end in microseconds; null without a frame rate.</summary>
        public ulong? EndUs
        {
            get { return Clip.StartOfFrameUs(EndFrame); }
        }

        /// <summary>
        /// Returns the text in a locale; null without a locale, or if the clip has no text even by fallback.
        /// </summary>
        public SegmentText? Text(BankLocale locale)
        {
            return locale == null ? null : locale.Text(Number);
        }

        /// <summary>The event string as in the file, which may be empty; null if the file has no events.</summary>
        public string Event
        {
            get { return Clip.Bank.Events.StringOf(Number); }
        }

        /// <summary>The events, if they are in Character Event Syntax.</summary>
        public SegmentEvents Events
        {
            get { return new SegmentEvents(Clip.Bank.Events, Number, EventTable.NoName); }
        }

        private uint FrameOf(long number)
        {
            Table starts = Clip.Bank.Starts;
            if (!starts.Has(Number + 1) || starts.U32(number) < Clip.FramesOffset) return 0;
            return starts.U32(number) - Clip.FramesOffset;
        }
    }
}
