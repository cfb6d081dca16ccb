using System;

namespace Lipz
{
    /// <summary>
    /// A curve of a clip: a named number with keys at frames. Between two keys, the value changes linearly. Before the
    /// first key and after the last one, it is constant.
    /// </summary>
    public sealed class Curve
    {
        /// <summary>The keys to step through before a search. A rendered frame seldom passes more.</summary>
        private const uint Steps = 4;

        private const float Thousand = 1000f;
        private readonly Table keys;
        private readonly bool isWide;
        private readonly FrameRate rate;

        /// <summary>The last key that was read, which only saves a search.</summary>
        private uint lastIndex;

        /// <summary>The purpose of the curve, and the character to whom it belongs.</summary>
        internal readonly CurvePurpose Purpose;

        internal Curve(string name, Table keys, bool isWide, FrameRate rate)
        {
            Name = name;
            this.keys = keys;
            this.isWide = isWide;
            this.rate = rate;
            Purpose = new CurvePurpose(name);
        }

        /// <summary>The name: <c>jawOpen</c>.</summary>
        public string Name { get; private set; }

        /// <summary>The number of keys.</summary>
        public int KeyCount
        {
            get { return keys.Count; }
        }

        /// <summary>Returns the frame of a key, whose index must be less than the number of keys.</summary>
        public uint KeyFrame(int index)
        {
            return isWide ? keys.U32(Checked(index)) : keys.U16(Checked(index));
        }

        /// <summary>Returns the value of a key in thousandths.</summary>
        public int KeyThousandths(int index)
        {
            return isWide ? (int)keys.U32(Checked(index), 4) : (short)keys.U16(Checked(index), 2);
        }

        /// <summary>Returns the value at the start of a frame.</summary>
        public float Value(uint frame)
        {
            return Thousandths(frame) / Thousand;
        }

        /// <summary>Returns the value at a time; null without a frame rate.</summary>
        public float? ValueAt(ClipTime time)
        {
            return ThousandthsAt(time) / Thousand;
        }

        /// <summary>Returns the value at the start of a frame, in thousandths.</summary>
        public int Thousandths(uint frame)
        {
            return Thousandths(new FramePosition(frame, 0));
        }

        /// <summary>Returns the value at a time, in thousandths; null without a frame rate.</summary>
        public int? ThousandthsAt(ClipTime time)
        {
            return rate.IsSpecified ? Thousandths(time.PositionIn(rate)) : default(int?);
        }

        internal int Thousandths(FramePosition position)
        {
            if (keys.Count == 0) return 0;
            int index = lastIndex < keys.Count && HasCome(lastIndex, position.Frame)
                ? IndexFrom(lastIndex, position.Frame)
                : IndexAt(position.Frame);
            lastIndex = (uint)index;
            int value = KeyThousandths(index);
            uint frame = KeyFrame(index);
            if (index + 1 == keys.Count || position.Frame < frame) return value;
            uint next = KeyFrame(index + 1);
            if (next <= position.Frame) return value;
            ulong done = (ulong)(position.Frame - frame) << 16 | position.SixteenBits;
            return Towards(value, KeyThousandths(index + 1), done, (ulong)(next - frame) << 16);
        }

        /// <summary>Returns the index of the last key at or before a frame, or 0.</summary>
        internal int IndexAt(uint frame)
        {
            int first = 0, end = keys.Count;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (HasCome((uint)middle, frame)) first = middle + 1;
                else end = middle;
            }
            return Math.Max(0, first - 1);
        }

        private int IndexFrom(uint index, uint frame)
        {
            for (uint step = 0; step < Steps; step++, index++)
            {
                if (index + 1 >= keys.Count || !HasCome(index + 1, frame)) return (int)index;
            }
            return IndexAt(frame);
        }

        private bool HasCome(uint index, uint frame)
        {
            return KeyFrame((int)index) <= frame;
        }

        private int Checked(int index)
        {
            if (!keys.Has(index)) throw new ArgumentOutOfRangeException("index");
            return index;
        }

        /// <summary>Returns the value after a part of the way, rounded to the nearest number.</summary>
        private static int Towards(int from, int to, ulong done, ulong whole)
        {
            ulong distance = (ulong)Math.Abs((long)to - from);
            Wide twice = Wide.Product(distance, done).ShiftedLeft(1).Plus(new Wide(0, whole));
            long part = FrameRate.Quotient(twice, whole * 2);
            return (int)(to < from ? from - part : from + part);
        }
    }
}
