namespace Lipz
{
    /// <summary>Blinks: single ones, sometimes two in a row.</summary>
    internal sealed class Blinks
    {
        private const long Closed = 1000;

        private readonly FaceMoment moment;

        internal Blinks(FaceMoment moment)
        {
            this.moment = moment;
        }

        /// <summary>
        /// Returns how far the lids are closed, in thousandths. Each interval has its own grid with one blink in each
        /// slot. A blink counts if its interval is that of the strongest emotion when it begins.
        /// </summary>
        internal int ClosedAt(FaceProfile profile, ulong seed, long ms, Who who)
        {
            int[] intervals = profile.BlinkIntervalMs;
            long most = 0;
            for (int place = 0; place < intervals.Length; place++)
            {
                int interval = intervals[place];
                if (interval == 0 || System.Array.IndexOf(intervals, interval) < place) continue;
                // Slots begin before the start of the clip, so that its first blink can come at any time.
                long phase = Chance.Part(interval, Chance.Draw(seed, ChanceStream.BlinkPhase, interval, 0));
                long last = (ms + phase) / interval;
                for (long slot = last - 1; slot <= last; slot++)
                {
                    // In the middle half of the slot.
                    int late = Chance.Part(interval / 2, Chance.Draw(seed, ChanceStream.BlinkTime, interval, slot));
                    long start = slot * interval + interval / 4 + late - phase;
                    if (start < 0 || ms < start) continue;
                    uint draw = Chance.Draw(seed, ChanceStream.DoubleBlink, interval, slot);
                    bool isDouble = Chance.Part(100, draw) < profile.DoubleBlinkPercent;
                    long closed = ClosedAfter(ms - start, profile.BlinkLengthMs, isDouble);
                    if (closed <= most || intervals[moment.StrongestAt(who, start) + 1] != interval) continue;
                    most = closed;
                }
            }
            return (int)most;
        }

        /// <summary>
        /// The lids close in a quarter of a blink, stay closed for a quarter, and open in the rest. The second blink of
        /// a double one begins half a length after the first.
        /// </summary>
        private static long ClosedAfter(long passedMs, long lengthMs, bool isDouble)
        {
            long again = lengthMs + lengthMs / 2;
            long passed = isDouble && passedMs >= again ? passedMs - again : passedMs;
            long closing = lengthMs / 4, openFrom = lengthMs / 2;
            if (passed < closing) return passed * Closed / closing;
            if (passed < openFrom) return Closed;
            if (passed >= lengthMs) return 0;
            return (lengthMs - passed) * Closed / (lengthMs - openFrom);
        }
    }
}
