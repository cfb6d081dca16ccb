using System;

namespace Lipz
{
    /// <summary>Holds consonants for a least number of frames, which they take from the vowels next to them.</summary>
    internal static class ConsonantHold
    {
        /// <summary>Returns the frame whose viseme to show in a frame.</summary>
        internal static uint FrameToShow(Clip clip, byte holdFrames, uint frame)
        {
            bool isHeld = holdFrames > 1 && clip.VisemeType != VisemeType.Unspecified;
            return isHeld ? (uint)Shown(clip, holdFrames, frame) : frame;
        }

        private static long Shown(Clip clip, int hold, long at)
        {
            Table codes = clip.FrameCodes;
            if (!codes.Has(at) || !IsOpen(clip, codes, at)) return at;
            // The stretch of vowels and rests around the frame, as far as the hold of a neighbour reaches.
            int openBefore = OpenRun(clip, codes, at - 1, -1, hold);
            int openBehind = OpenRun(clip, codes, at + 1, 1, hold);
            int spare = openBefore + openBehind;

            int missingBefore = openBefore < hold ? Missing(codes, at - 1 - openBefore, -1, hold) : 0;
            int takenBefore = Math.Min(missingBefore, spare);
            if (openBefore < takenBefore) return at - openBefore - 1;

            long next = at + 1 + openBehind;
            int missingBehind = openBehind < hold ? Missing(codes, next, 1, hold) : 0;
            int room = OpenRun(clip, codes, next + hold - missingBehind, 1, hold);
            int early = Math.Max(0, missingBehind - Math.Max(0, room - 1));
            return openBehind < Math.Min(early, spare - takenBefore) ? next : at;
        }

        private static bool IsOpen(Clip clip, Table codes, long at)
        {
            return !Visemes.IsConsonant((char)codes.U8(at), clip.VisemeType);
        }

        /// <summary>Returns the number of vowels and rests from a frame on, up to a limit.</summary>
        private static int OpenRun(Clip clip, Table codes, long from, int step, int most)
        {
            int count = 0;
            for (long at = from; count < most && codes.Has(at) && IsOpen(clip, codes, at); at += step) count++;
            return count;
        }

        /// <summary>Returns how many frames the run of a shape lacks for the whole hold; 0 without a run.</summary>
        private static int Missing(Table codes, long from, int step, int hold)
        {
            if (!codes.Has(from)) return 0;
            int count = 1;
            for (long at = from + step; count < hold && codes.Has(at) && codes.U8(at) == codes.U8(from); at += step)
            {
                count++;
            }
            return hold - count;
        }
    }

    /// <summary>The hold of a clip's consonants.</summary>
    public sealed partial class Clip
    {
        /// <summary>
        /// Returns the number of frames in which viewers can read a consonant or, with the microseconds of a rendered
        /// frame, in which one rendered frame shows it; 0 without a frame rate.
        /// </summary>
        public byte HoldFrames(uint renderedFrameUs = 0)
        {
            if (Rate.Denominator == 0) return 0;
            const ulong MicrosPerSecond = 1000000, ReadablePart = 12;
            ulong parts = ReadablePart * Rate.Denominator, second = MicrosPerSecond * Rate.Denominator;
            ulong frames = renderedFrameUs == 0
                ? (Rate.Numerator + parts / 2) / parts
                : ((ulong)renderedFrameUs * Rate.Numerator + (second - 1)) / second;
            return (byte)Math.Min(frames, byte.MaxValue);
        }
    }
}
