namespace Lipz
{
    /// <summary>An unsigned number of 128 bits. Overflow wraps around.</summary>
    internal readonly struct Wide
    {
        internal readonly ulong High;
        internal readonly ulong Low;

        internal Wide(ulong high, ulong low)
        {
            High = high;
            Low = low;
        }

        /// <summary>Returns the whole product of two numbers.</summary>
        internal static Wide Product(ulong a, ulong b)
        {
            ulong aLow = (uint)a, aHigh = a >> 32, bLow = (uint)b, bHigh = b >> 32;
            ulong low = aLow * bLow;
            ulong middle = aHigh * bLow + (low >> 32);
            ulong other = aLow * bHigh + (uint)middle;
            return new Wide(aHigh * bHigh + (middle >> 32) + (other >> 32), other << 32 | (uint)low);
        }

        internal Wide Times(ulong factor)
        {
            Wide product = Product(Low, factor);
            return new Wide(product.High + High * factor, product.Low);
        }

        internal Wide Plus(Wide other)
        {
            ulong low = Low + other.Low;
            return new Wide(High + other.High + (low < Low ? 1UL : 0), low);
        }

        internal Wide Minus(Wide other)
        {
            return new Wide(High - other.High - (Low < other.Low ? 1UL : 0), Low - other.Low);
        }

        /// <summary>Whether the number is less than the other one.</summary>
        internal bool IsLess(Wide other)
        {
            return High < other.High || High == other.High && Low < other.Low;
        }

        internal Wide ShiftedLeft(int bits)
        {
            if (bits == 0) return this;
            if (bits >= 128) return default(Wide);
            if (bits >= 64) return new Wide(Low << (bits - 64), 0);
            return new Wide(High << bits | Low >> (64 - bits), Low << bits);
        }

        internal Wide ShiftedRight(int bits)
        {
            if (bits == 0) return this;
            if (bits >= 128) return default(Wide);
            if (bits >= 64) return new Wide(0, High >> (bits - 64));
            return new Wide(High >> bits, Low >> bits | High << (64 - bits));
        }

        /// <summary>The number of bits without leading zeros.</summary>
        internal int BitCount
        {
            get
            {
                int count = 0;
                for (Wide rest = this; rest.High != 0 || rest.Low != 0; rest = rest.ShiftedRight(1)) count++;
                return count;
            }
        }
    }
}
