using System;

namespace Lipz
{
    /// <summary>A frame rate: frames per second, as a ratio. The frame at a time is computed exactly.</summary>
    public readonly struct FrameRate : IEquatable<FrameRate>
    {
        private const ulong MicrosPerSecond = 1000000;
        private const uint MostPerSecond = 1000;

        /// <summary>
        /// The number of frames in <see cref="Denominator"/> seconds. 0 stands for an unspecified rate.
        /// </summary>
        public readonly uint Numerator;

        /// <summary>The number of seconds in which that many frames pass.</summary>
        public readonly uint Denominator;

        /// <summary>2⁶⁴ times the number of frames per microsecond, rounded up.</summary>
        private readonly ulong framesPerMicro;

        /// <summary>Takes the parts of a rate of a bank, which may be damaged.</summary>
        internal FrameRate(uint numerator, uint denominator, ulong framesPerMicro)
        {
            Numerator = numerator;
            Denominator = denominator;
            this.framesPerMicro = framesPerMicro;
        }

        /// <summary>Makes a rate from 1 to 1000 frames per second, such as 24 or 30000/1001.</summary>
        /// <exception cref="ArgumentOutOfRangeException">The rate is outside this range.</exception>
        public FrameRate(uint numerator, uint denominator = 1)
        {
            if (denominator == 0 || numerator < denominator || numerator > (ulong)MostPerSecond * denominator)
            {
                throw new ArgumentOutOfRangeException("numerator", "a frame rate must be from 1 to 1000");
            }
            uint divisor = GreatestCommonDivisor(numerator, denominator);
            Numerator = numerator / divisor;
            Denominator = denominator / divisor;
            framesPerMicro = Reciprocal(Numerator, Denominator * MicrosPerSecond);
        }

        /// <summary>Whether a bank or a program specifies the rate.</summary>
        internal bool IsSpecified
        {
            get { return Numerator != 0; }
        }

        /// <summary>Whether the parts fit together. False only in a damaged bank.</summary>
        internal bool IsValid
        {
            get
            {
                if (Denominator == 0 || Numerator < Denominator) return false;
                if (Numerator > (ulong)MostPerSecond * Denominator) return false;
                if (GreatestCommonDivisor(Numerator, Denominator) != 1) return false;
                if (Denominator == 1) return true;
                ulong micros = Denominator * MicrosPerSecond;
                Wide rest = Wide.Product(framesPerMicro, micros).Minus(new Wide(Numerator, 0));
                return rest.IsLess(new Wide(0, micros));
            }
        }

        /// <summary>Returns the frame at a time in microseconds.</summary>
        internal ulong FrameAtMicros(ulong us)
        {
            if (Denominator == 1) return us * Numerator / MicrosPerSecond;
            ulong estimate = Wide.Product(us, framesPerMicro).High;
            ulong behind = us * Numerator - estimate * (Denominator * MicrosPerSecond);
            return estimate - (behind >> 63);
        }

        /// <summary>Finds the frame at a time in units, if it is less than a number of frames.</summary>
        internal bool TryFrameAtUnits(Wide time, uint unitsPerSecond, uint frameCount, out uint frame)
        {
            return TryQuotient(time.Times(Numerator), (ulong)Denominator * unitsPerSecond, frameCount, out frame);
        }

        /// <summary>Divides, if the quotient is less than a limit.</summary>
        internal static bool TryQuotient(Wide rest, ulong divisor, uint limit, out uint quotient)
        {
            quotient = 0;
            if (rest.High == 0)
            {
                ulong whole = divisor == 0 ? ulong.MaxValue : rest.Low / divisor;
                quotient = (uint)whole;
                return whole < limit;
            }
            if (!rest.IsLess(Wide.Product(divisor, limit))) return false;
            quotient = Quotient(rest, divisor);
            return true;
        }

        /// <summary>Returns a quotient that is less than 2³².</summary>
        internal static uint Quotient(Wide rest, ulong divisor)
        {
            if (rest.High == 0) return (uint)(rest.Low / divisor);
            uint quotient = 0;
            for (int bit = 31; bit >= 0; bit--)
            {
                Wide part = new Wide(0, divisor).ShiftedLeft(bit);
                if (rest.IsLess(part)) continue;
                rest = rest.Minus(part);
                quotient |= 1U << bit;
            }
            return quotient;
        }

        /// <summary>Returns the first microsecond of a frame, rounded up.</summary>
        public ulong StartOfFrameUs(uint frame)
        {
            if (Numerator == 0) return 0;
            ulong parts = (ulong)frame * Denominator;
            ulong seconds = parts / Numerator, rest = parts % Numerator;
            ulong micros = (rest * MicrosPerSecond + (Numerator - 1)) / Numerator;
            bool isTooLate = seconds > (ulong.MaxValue - micros) / MicrosPerSecond;
            return isTooLate ? ulong.MaxValue : seconds * MicrosPerSecond + micros;
        }

        /// <summary>Whether both rates are the same.</summary>
        public bool Equals(FrameRate other)
        {
            return Numerator == other.Numerator && Denominator == other.Denominator;
        }

        /// <summary>Whether the other object is the same rate.</summary>
        public override bool Equals(object other)
        {
            return other is FrameRate rate && Equals(rate);
        }

        /// <summary>Returns a hash of the ratio.</summary>
        public override int GetHashCode()
        {
            return (int)(Numerator * 31 + Denominator);
        }

        /// <summary>Returns the ratio: <c>24/1</c>.</summary>
        public override string ToString()
        {
            return Numerator + "/" + Denominator;
        }

        /// <summary>Returns the rate of a clip record, from its number; unspecified if it has none.</summary>
        internal static FrameRate Stored(uint rate, Table rates)
        {
            const uint NoRate = 0xFFFF;
            if (rate <= MostPerSecond) return new FrameRate(rate, 1, 0);
            long index = rate - MostPerSecond - 1;
            if (rate == NoRate || !rates.Has(index)) return default(FrameRate);
            return new FrameRate(rates.U32(index, 8), rates.U32(index, 12), rates.U64(index));
        }

        private static uint GreatestCommonDivisor(uint a, uint b)
        {
            while (b != 0)
            {
                uint rest = a % b;
                a = b;
                b = rest;
            }
            return a;
        }

        private static ulong Reciprocal(uint frames, ulong micros)
        {
            ulong reciprocal = 0, rest = frames;
            for (int bit = 0; bit < 64; bit++)
            {
                rest *= 2;
                reciprocal <<= 1;
                if (rest < micros) continue;
                rest -= micros;
                reciprocal |= 1;
            }
            return rest == 0 ? reciprocal : reciprocal + 1;
        }
    }
}
