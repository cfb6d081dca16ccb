namespace Lipz
{
    /// <summary>
    /// The segments that a move of a cursor has made due, in order. A <c>foreach</c> loop allocates nothing.
    /// </summary>
    public readonly struct DueSegments
    {
        private readonly Clip clip;
        private readonly uint speaker;
        private readonly int first;
        private readonly int end;
        private readonly int aroundTo;

        /// <summary>
        /// Takes the segments of a range, then those before <paramref name="aroundTo"/>. Numbers outside the clip are
        /// skipped: they may be those of another clip.
        /// </summary>
        internal DueSegments(Clip clip, uint speaker, int first, int end, int aroundTo)
        {
            this.clip = clip;
            this.speaker = speaker;
            this.first = first;
            this.end = System.Math.Min(end, clip.SegmentCount);
            this.aroundTo = System.Math.Min(aroundTo, clip.SegmentCount);
        }

        /// <summary>The events of all segments, if they are in Character Event Syntax.</summary>
        public DueEvents Events
        {
            get { return new DueEvents(this); }
        }

        internal SegmentEvents EventsOf(Segment segment)
        {
            return new SegmentEvents(clip.Bank.Events, clip.SegmentsFirst + segment.Index, speaker);
        }

        /// <summary>Starts a <c>foreach</c> loop.</summary>
        public Enumerator GetEnumerator()
        {
            return new Enumerator(clip, first, end, aroundTo);
        }

        /// <summary>The state of a <c>foreach</c> loop.</summary>
        public struct Enumerator
        {
            private readonly Clip clip;
            private int index;
            private int end;
            private int aroundTo;

            internal Enumerator(Clip clip, int first, int end, int aroundTo)
            {
                this.clip = clip;
                index = first - 1;
                this.end = end;
                this.aroundTo = aroundTo;
            }

            /// <summary>The segment.</summary>
            public Segment Current
            {
                get { return new Segment(clip, index); }
            }

            /// <summary>Moves to the next segment.</summary>
            public bool MoveNext()
            {
                index++;
                if (index < end) return true;
                index = 0;
                end = aroundTo;
                aroundTo = 0;
                return index < end;
            }
        }
    }

    /// <summary>The events of due segments, for <c>foreach</c>. Allocates nothing.</summary>
    public readonly struct DueEvents
    {
        private readonly DueSegments segments;

        internal DueEvents(DueSegments segments)
        {
            this.segments = segments;
        }

        /// <summary>Starts a <c>foreach</c> loop.</summary>
        public Enumerator GetEnumerator()
        {
            return new Enumerator(segments);
        }

        /// <summary>The state of a <c>foreach</c> loop.</summary>
        public struct Enumerator
        {
            private readonly DueSegments all;
            private DueSegments.Enumerator segments;
            private SegmentEvents.Enumerator events;

            internal Enumerator(DueSegments all)
            {
                this.all = all;
                segments = all.GetEnumerator();
                events = default(SegmentEvents.Enumerator);
            }

            /// <summary>The event.</summary>
            public ClipEvent Current
            {
                get { return events.Current; }
            }

            /// <summary>Moves to the next event.</summary>
            public bool MoveNext()
            {
                while (!events.MoveNext())
                {
                    if (!segments.MoveNext()) return false;
                    events = all.EventsOf(segments.Current).GetEnumerator();
                }
                return true;
            }
        }
    }
}
