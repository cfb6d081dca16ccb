namespace Lipz
{
    /// <summary>
    /// A time from the start of a clip, in the unit of your clock. All units find the same frame. Times below 0 are
    /// before the start.
    /// </summary>
    public readonly struct ClipTime
    {
        /// <summary>Later times are past the end of every clip.</summary>
        private const ulong LatestUs = 1UL << 54;
        private const uint MicrosPerSecond = 1000000;

        private enum Unit : byte
        {
            Micros,
            Samples,
            Float,
        }

        private readonly Unit unit;
        private readonly long value;
        private readonly uint rateHz;
        private readonly FloatSeconds seconds;

        private ClipTime(Unit unit, long value, uint rateHz, FloatSeconds seconds)
        {
            this.unit = unit;
            this.value = value;
            this.rateHz = rateHz;
            this.seconds = seconds;
        }

        /// <summary>Returns a time in microseconds.</summary>
        public static ClipTime Micros(long us)
        {
            return new ClipTime(Unit.Micros, us, 0, default(FloatSeconds));
        }

        /// <summary>
        /// Returns a position in a recording, in samples per channel: <c>AudioSource.timeSamples</c>, with the rate of
        /// the audio clip. With a rate of 0 Hz, no clip has started.
        /// </summary>
        public static ClipTime Samples(long position, uint rateHz)
        {
            return new ClipTime(Unit.Samples, position, rateHz, default(FloatSeconds));
        }

        /// <summary>Returns a time in seconds. If it is not a number, no clip has started.</summary>
        public static ClipTime Seconds(double seconds)
        {
            return new ClipTime(Unit.Float, 0, 0, FloatSeconds.Of(seconds));
        }

        /// <summary>Returns a time in seconds with 32 bits, whose rounding it allows for.</summary>
        public static ClipTime Seconds(float seconds)
        {
            return new ClipTime(Unit.Float, 0, 0, FloatSeconds.Of(seconds));
        }

        /// <summary>Whether the time is at or after the start.</summary>
        internal bool HasBegun
        {
            get
            {
                switch (unit)
                {
                    case Unit.Micros: return value >= 0;
                    case Unit.Samples: return value >= 0 && rateHz > 0;
                    default: return seconds.HasBegun;
                }
            }
        }

        /// <summary>Finds the frame, if it is less than a number of frames.</summary>
        internal bool TryFrame(FrameRate rate, uint frameCount, out uint frame)
        {
            frame = 0;
            if (!rate.IsSpecified) return false;
            switch (unit)
            {
                case Unit.Micros:
                    // Times before the start become very large.
                    if ((ulong)value >= LatestUs) return false;
                    ulong found = rate.FrameAtMicros((ulong)value);
                    frame = (uint)found;
                    return found < frameCount;
                case Unit.Samples:
                    if (value < 0 || rateHz == 0) return false;
                    return rate.TryFrameAtUnits(new Wide(0, (ulong)value), rateHz, frameCount, out frame);
                default:
                    return seconds.TryFrame(rate, frameCount, out frame);
            }
        }

        /// <summary>Returns a later time.</summary>
        internal ClipTime Later(uint us)
        {
            switch (unit)
            {
                case Unit.Micros: return Micros(SaturatingSum(value, us));
                case Unit.Samples:
                    ulong millionths = (ulong)us * rateHz;
                    ulong samples = millionths / MicrosPerSecond + (millionths % MicrosPerSecond == 0 ? 0UL : 1);
                    return Samples(SaturatingSum(value, (long)samples), rateHz);
                default: return new ClipTime(Unit.Float, 0, 0, seconds.Later(us));
            }
        }

        /// <summary>Returns the position in frames, in units of 1/65,536.</summary>
        internal FramePosition PositionIn(FrameRate rate)
        {
            if (!TryFrame(rate, uint.MaxValue, out uint frame))
            {
                return HasBegun ? FramePosition.Last : default(FramePosition);
            }
            if (unit == Unit.Float) return seconds.PositionIn(rate, frame);
            uint unitsPerSecond = unit == Unit.Micros ? MicrosPerSecond : rateHz;
            ulong whole = (ulong)unitsPerSecond * rate.Denominator;
            return new FramePosition(frame, (ulong)value * rate.Numerator - whole * frame, whole);
        }

        /// <summary>Returns whole milliseconds since the start; 0 before it. Saturates after 49 days.</summary>
        internal uint Milliseconds
        {
            get
            {
                if (TryFrame(new FrameRate(1000, 1, 0), uint.MaxValue, out uint ms)) return ms;
                return HasBegun ? uint.MaxValue : 0;
            }
        }

        private static long SaturatingSum(long time, long more)
        {
            return time > long.MaxValue - more ? long.MaxValue : time + more;
        }
    }
}
