namespace Lipz
{
    /// <summary>The events of a segment, for <c>foreach</c>. Allocates nothing.</summary>
    public readonly struct SegmentEvents
    {
        private readonly EventTable table;
        private readonly long segment;
        private readonly uint speaker;

        internal SegmentEvents(EventTable table, long segment, uint speaker)
        {
            this.table = table;
            this.segment = segment;
            this.speaker = speaker;
        }

        /// <summary>Starts a <c>foreach</c> loop.</summary>
        public Enumerator GetEnumerator()
        {
            return new Enumerator(table, segment, speaker);
        }

        /// <summary>The state of a <c>foreach</c> loop.</summary>
        public struct Enumerator
        {
            private readonly EventTable table;
            private readonly uint speaker;
            private readonly long end;
            private long next;
            private ClipEvent current;

            internal Enumerator(EventTable table, long segment, uint speaker)
            {
                this.table = table;
                this.speaker = speaker;
                current = default(ClipEvent);
                table.TypedOf(segment, out next, out end);
            }

            /// <summary>The event.</summary>
            public ClipEvent Current
            {
                get { return current; }
            }

            /// <summary>Moves to the next event. A damaged event ends the loop.</summary>
            public bool MoveNext()
            {
                return next < end && table.TryTyped(next++, speaker, out current);
            }
        }
    }
}
