using System;

namespace Lipz.Tests
{
    /// <summary>Frames at random times and rates, compared with exact arithmetic.</summary>
    internal static class ExactTimes
    {
        private const int Count = 200000;
        private const decimal MicrosPerSecond = 1000000;

        private static readonly uint[] SampleRates = { 1, 8000, 22050, 44100, 48000, 96000, 192000 };

        internal static string Compare()
        {
            var random = new Random(37);
            for (int i = 0; i < Count; i++)
            {
                FrameRate rate = RateOf(random, i);
                long us = (long)(Math.Pow(2, random.NextDouble() * 41) * random.NextDouble());
                ClipTime.Micros(us).TryFrame(rate, uint.MaxValue, out uint frame);
                Check(rate, frame, us, MicrosPerSecond);

                uint rateHz = SampleRates[random.Next(SampleRates.Length)];
                long position = (long)(us * (rateHz / 1e6));
                ClipTime.Samples(position, rateHz).TryFrame(rate, uint.MaxValue, out uint atSample);
                Check(rate, atSample, position, rateHz);

                Starts(rate, frame);
            }
            return 2 * Count + " times";
        }

        /// <summary>Returns whole rates, those of television, and random ones.</summary>
        private static FrameRate RateOf(Random random, int i)
        {
            if (i % 3 == 0) return new FrameRate((uint)random.Next(1, 1001));
            if (i % 3 == 1) return new FrameRate(1000 * (uint)random.Next(2, 120), 1001);
            uint denominator = (uint)random.Next(2, 1 << 22);
            return new FrameRate(denominator + (uint)(random.NextDouble() * 999 * denominator), denominator);
        }

        /// <summary>Checks frame ≤ time · fps &lt; frame + 1, with products of fewer than 96 bits.</summary>
        private static void Check(FrameRate rate, uint frame, long time, decimal unitsPerSecond)
        {
            decimal frames = (decimal)time * rate.Numerator, whole = rate.Denominator * unitsPerSecond;
            bool isExact = frame * whole <= frames && frames < (frame + 1m) * whole;
            if (!isExact) throw new Exception(rate + ": frame " + frame + " at " + time + " of " + unitsPerSecond);
        }

        /// <summary>Checks that the start of a frame is its first microsecond, in every unit.</summary>
        private static void Starts(FrameRate rate, uint frame)
        {
            long us = (long)rate.StartOfFrameUs(frame);
            Check(rate, frame, us, MicrosPerSecond);
            if (frame > 0) Check(rate, frame - 1, us - 1, MicrosPerSecond);
            bool isFound = ClipTime.Seconds(us / 1e6).TryFrame(rate, uint.MaxValue, out uint found) && found == frame;
            if (!isFound) throw new Exception(rate + ": frame " + found + " at the start of " + frame);
        }
    }
}
