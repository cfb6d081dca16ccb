using System;

namespace Lipz
{
    /// <summary>The purpose of a random number: those with different purposes are independent.</summary>
    internal enum ChanceStream
    {
        BlinkPhase = 1,
        BlinkTime = 2,
        DoubleBlink = 3,
        PoseTime = 4,
        Pitch = 5,
        Yaw = 6,
        Roll = 7,
        FixationTime = 8,
        Glance = 9,
        Target = 10,
        EyePitch = 11,
        EyeYaw = 12,
    }

    /// <summary>Random numbers that are the same on every machine, because they are hashes.</summary>
    internal static class Chance
    {
        /// <summary>The progress of a finished step, in 65,536ths.</summary>
        internal const long Whole = 1 << 16;

        /// <summary>Returns a number from 0 to 65,535.</summary>
        internal static uint Draw(ulong seed, ChanceStream stream, long interval, long index)
        {
            ulong mixed = ClipIds.Mix(seed ^ ((ulong)interval << 8 | (ulong)stream), ClipIds.Step);
            return (uint)(ClipIds.Mix(ClipIds.Mix(mixed ^ (ulong)index, ClipIds.Finish), ClipIds.Step) >> 48);
        }

        /// <summary>Maps a draw to a number from 0 up to, but not including, an amount.</summary>
        internal static int Part(int amount, uint draw)
        {
            return (int)((long)amount * draw >> 16);
        }

        /// <summary>Maps a draw to a number from -amount up to, but not including, amount.</summary>
        internal static int EitherSide(int amount, uint draw)
        {
            return Part(amount * 2, draw) - amount;
        }

        /// <summary>Returns value · part / whole, rounded towards 0.</summary>
        internal static int Scaled(long value, long part, long whole)
        {
            return (int)(value * part / whole);
        }

        /// <summary>Limits a number to a range around 0.</summary>
        internal static int Limited(long value, int most)
        {
            return (int)Math.Max(-most, Math.Min(most, value));
        }
    }

    /// <summary>The state of a value that changes once in each period, at a random time of its first half.</summary>
    internal readonly struct ChanceStep
    {
        internal readonly long Before;
        internal readonly long Now;

        /// <summary>How far it has moved from one to the other, in 65,536ths.</summary>
        internal readonly long Part;

        internal ChanceStep(ulong seed, ChanceStream stream, long ms, int periodMs, int stepMs)
        {
            long number = periodMs == 0 ? 0 : ms / periodMs;
            // The state before the first step has the number 0, so each step leads to its own number plus one.
            if (ms < StartOf(seed, stream, number, periodMs)) number--;
            Before = Math.Max(0, number);
            Now = Math.Max(0, number + 1);
            Part = Chance.Whole;
            if (number < 0) return;
            long passed = Math.Max(0, ms - StartOf(seed, stream, number, periodMs));
            if (passed < stepMs) Part = (passed << 16) / stepMs;
        }

        private static long StartOf(ulong seed, ChanceStream stream, long number, int periodMs)
        {
            return number * periodMs + Chance.Part(periodMs / 2, Chance.Draw(seed, stream, 0, number));
        }
    }
}
