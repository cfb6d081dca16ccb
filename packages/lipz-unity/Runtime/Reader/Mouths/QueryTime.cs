using System;

namespace Lipz
{
    /// <summary>The time of a query: whole milliseconds, and the microseconds after them.</summary>
    internal readonly struct QueryTime
    {
        private const int ReachMs = 150;
        internal const int MostMs = 400;

        private readonly int ms;
        private readonly int us;

        /// <summary>Times before the start of the clip are out of reach.</summary>
        internal QueryTime(ClipTime time, int leadMs)
        {
            us = 0;
            ms = -MostMs;
            if (!time.HasBegun) return;
            FramePosition position = time.PositionIn(new FrameRate(1000, 1, 0));
            long ahead = Math.Min(position.Frame, int.MaxValue) + (long)leadMs;
            ms = (int)Math.Min(int.MaxValue, ahead);
            us = position.SixteenBits * 1000 >> 16;
        }

        /// <summary>The first millisecond in reach.</summary>
        internal uint FirstMs
        {
            get { return (uint)Math.Max(0, (long)ms - ReachMs); }
        }

        /// <summary>The last millisecond in reach.</summary>
        internal uint LastMs
        {
            get { return (uint)Math.Max(0, Math.Min(int.MaxValue, (long)ms + ReachMs)); }
        }

        /// <summary>Returns the microseconds until a time in milliseconds, at most 0.4 s in both directions.</summary>
        internal int Until(uint at)
        {
            long left = Math.Min(at, int.MaxValue) - (long)ms;
            return (int)Math.Max(-MostMs, Math.Min(MostMs, left)) * 1000 - us;
        }
    }
}
