using System;
using System.Runtime.InteropServices;

namespace Lipz
{
    /// <summary>
    /// A floating-point time in seconds, as the bits of its number: mantissa · 2^-shift. It may be too early by two
    /// units in the last place, which every query adds.
    /// </summary>
    internal readonly struct FloatSeconds
    {
        private const ulong Tolerance = 2;

        /// <summary>2⁹⁶ / 1,000,000, rounded up.</summary>
        private static readonly Wide MicroQ96 = new Wide(0x10C6, 0xF7A0B5ED8D36B4C8);

        private enum Kind : byte
        {
            NotANumber,
            Before,
            Finite,
            Infinite,
        }

        private readonly Kind kind;
        private readonly bool isShort;
        private readonly ulong mantissa;
        private readonly int shift;

        private FloatSeconds(Kind kind, bool isShort, ulong mantissa, int shift)
        {
            this.kind = kind;
            this.isShort = isShort;
            this.mantissa = mantissa;
            this.shift = shift;
        }

        internal static FloatSeconds Of(double seconds)
        {
            ulong bits = (ulong)BitConverter.DoubleToInt64Bits(seconds);
            int exponent = (int)(bits >> 52 & 0x7FF);
            ulong fraction = bits & 0xFFFFFFFFFFFFF;
            bool isNormal = exponent != 0;
            return new FloatSeconds(
                KindOf(seconds), false, isNormal ? fraction | 1UL << 52 : fraction, isNormal ? 1075 - exponent : 1074);
        }

        internal static FloatSeconds Of(float seconds)
        {
            uint bits = new FloatBits { Value = seconds }.Bits;
            int exponent = (int)(bits >> 23 & 0xFF);
            ulong fraction = bits & 0x7FFFFF;
            bool isNormal = exponent != 0;
            return new FloatSeconds(
                KindOf(seconds), true, isNormal ? fraction | 1UL << 23 : fraction, isNormal ? 150 - exponent : 149);
        }

        private static Kind KindOf(double seconds)
        {
            if (double.IsNaN(seconds)) return Kind.NotANumber;
            if (seconds < 0) return Kind.Before;
            return double.IsPositiveInfinity(seconds) ? Kind.Infinite : Kind.Finite;
        }

        internal bool HasBegun
        {
            get { return kind == Kind.Finite || kind == Kind.Infinite; }
        }

        /// <summary>Finds the frame, if it is less than a number of frames.</summary>
        internal bool TryFrame(FrameRate rate, uint frameCount, out uint frame)
        {
            frame = 0;
            if (kind != Kind.Finite) return false;
            if (rate.Denominator == 1 && shift >= 1 && shift < 64)
            {
                // A whole rate is at most 1000, so the product fits 64 bits.
                ulong whole = (mantissa + Tolerance) * rate.Numerator >> shift;
                frame = (uint)whole;
                return whole < frameCount;
            }
            var time = new Wide(0, mantissa + Tolerance);
            if (shift <= 0)
            {
                return shift >= -22 && rate.TryFrameAtUnits(time.ShiftedLeft(-shift), 1, frameCount, out frame);
            }
            Wide frames = time.Times(rate.Numerator).ShiftedRight(shift);
            return FrameRate.TryQuotient(frames, rate.Denominator, frameCount, out frame);
        }

        /// <summary>Returns the position in a frame, which is the one at this time.</summary>
        internal FramePosition PositionIn(FrameRate rate, uint frame)
        {
            Wide frames = new Wide(0, mantissa + Tolerance).Times(rate.Numerator);
            int left = 16 - shift;
            Wide shifted = left >= 0 ? frames.ShiftedLeft(left) : frames.ShiftedRight(-left);
            ulong whole = (ulong)rate.Denominator << 16;
            return new FramePosition(frame, shifted.Low - whole * frame, whole);
        }

        /// <summary>Returns a later time, rounded to the bits of the number.</summary>
        internal FloatSeconds Later(uint us)
        {
            bool isFinite = kind == Kind.Finite || kind == Kind.Before;
            if (!isFinite || shift < 0 || us == 0) return this;
            // In units of 2^-64 seconds: fewer than 118 bits.
            Wide time = Units(mantissa), added = MicroQ96.Times(us).ShiftedRight(32);
            if (kind == Kind.Finite) return Rounded(time.Plus(added));
            if (!added.IsLess(time)) return Rounded(added.Minus(time));
            // The start, within the tolerance.
            bool isStart = !Units(Tolerance).IsLess(time.Minus(added));
            return isStart ? new FloatSeconds(Kind.Finite, isShort, 0, isShort ? 149 : 1074) : this;
        }

        private Wide Units(ulong count)
        {
            return new Wide(count, 0).ShiftedRight(shift);
        }

        private FloatSeconds Rounded(Wide sum)
        {
            int excess = sum.BitCount - (isShort ? 24 : 53);
            ulong rounded = excess >= 1
                ? sum.ShiftedRight(excess - 1).Plus(new Wide(0, 1)).ShiftedRight(1).Low
                : sum.ShiftedLeft(-excess).Low;
            return sum.BitCount == 0
                ? new FloatSeconds(Kind.Finite, isShort, 0, isShort ? 149 : 1074)
                : new FloatSeconds(Kind.Finite, isShort, rounded, 64 - excess);
        }

        [StructLayout(LayoutKind.Explicit)]
        private struct FloatBits
        {
            [FieldOffset(0)]
            internal float Value;

            [FieldOffset(0)]
            internal readonly uint Bits;
        }
    }
}
