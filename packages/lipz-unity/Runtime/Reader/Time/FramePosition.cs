namespace Lipz
{
    /// <summary>A position in a clip: a frame, and how much of it has passed.</summary>
    internal readonly struct FramePosition
    {
        internal readonly uint Frame;

        /// <summary>The part of the frame that has passed, in 1/65,536, rounded down.</summary>
        internal readonly ushort SixteenBits;

        /// <summary>The position of times past the end of every clip.</summary>
        internal static readonly FramePosition Last = new FramePosition(uint.MaxValue, ushort.MaxValue);

        internal FramePosition(uint frame, ushort sixteenBits)
        {
            Frame = frame;
            SixteenBits = sixteenBits;
        }

        /// <summary>Takes the part of the frame that has passed as a fraction less than 1.</summary>
        internal FramePosition(uint frame, ulong part, ulong whole)
        {
            uint bits = 0;
            for (int i = 0; i < 16; i++)
            {
                ulong missing = whole - part;
                bits *= 2;
                // Twice the part may overflow.
                if (part >= missing)
                {
                    bits++;
                    part -= missing;
                }
                else
                {
                    part *= 2;
                }
            }
            Frame = frame;
            SixteenBits = (ushort)bits;
        }
    }
}
