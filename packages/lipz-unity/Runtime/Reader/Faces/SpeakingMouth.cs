using System;

namespace Lipz
{
    /// <summary>The visemes that move a head, of a clip with a frame rate.</summary>
    internal static class SpeakingMouth
    {
        /// <summary>The microseconds in which a head comes to rest, and starts before the mouth moves.</summary>
        private const long NearUs = 250000;

        /// <summary>The part of a slot that is searched for changes, which limits the work for long poses.</summary>
        private const long LookedAtMs = 1000;

        /// <summary>Returns the start of a frame in milliseconds.</summary>
        internal static long StartMs(Clip clip, long frame)
        {
            return StartUs(clip, frame) / 1000;
        }

        /// <summary>Returns the frame at a time, or the last number of a frame.</summary>
        internal static uint FrameAt(Clip clip, long us)
        {
            return ClipTime.Micros(us).TryFrame(clip.Rate, uint.MaxValue, out uint frame) ? frame : uint.MaxValue;
        }

        /// <summary>
        /// Returns how much the mouth moves, in thousandths: fully in a frame that is not at rest, and less with the
        /// distance to the nearest such frame.
        /// </summary>
        internal static long SpeakingAt(Clip clip, long ms)
        {
            long us = ms * 1000, nearest = NearUs;
            Table codes = clip.FrameCodes;
            long now = FrameAt(clip, us), first = FrameAt(clip, Math.Max(0, us - NearUs));
            for (long frame = Math.Min(now, codes.Count - 1); frame >= first; frame--)
            {
                if (!Moves(codes, frame)) continue;
                nearest = Math.Min(nearest, Math.Max(0, us - StartUs(clip, frame + 1)));
                break;
            }
            long last = FrameAt(clip, us + NearUs);
            for (long frame = now + 1; frame <= last && frame < codes.Count; frame++)
            {
                if (!Moves(codes, frame)) continue;
                nearest = Math.Min(nearest, Math.Max(0, StartUs(clip, frame) - us));
                break;
            }
            return (NearUs - nearest) * 1000 / NearUs;
        }

        /// <summary>
        /// Returns the time of a change in a slot: the start of the last segment that starts in it, or else of the
        /// first pause that begins or ends there; -1 if the mouth continues to move, or to rest.
        /// </summary>
        internal static long ChangeMs(Clip clip, long slotMs, long lengthMs)
        {
            Table codes = clip.FrameCodes;
            long startUs = slotMs * 1000, endUs = startUs + Math.Min(lengthMs, LookedAtMs) * 1000;
            // The frames that start in the slot. The first frame of the clip is never a change.
            long before = FrameAt(clip, Math.Max(0, startUs - 1));
            long last = Math.Min(FrameAt(clip, Math.Max(0, endUs - 1)), codes.Count - 1);
            if (last < 0) return -1;
            int segment = clip.SegmentOfFrame((uint)Math.Max(last, Math.Min(before - 1, uint.MaxValue)));
            if (segment >= 0 && segment < clip.SegmentCount)
            {
                uint start = new Segment(clip, segment).StartFrame;
                if (start > before) return StartMs(clip, start);
            }
            for (long frame = before + 1; frame <= last; frame++)
            {
                if (Moves(codes, frame) != Moves(codes, frame - 1)) return StartMs(clip, frame);
            }
            return -1;
        }

        private static bool Moves(Table codes, long frame)
        {
            return codes.U8(frame) != Clip.Rest;
        }

        private static long StartUs(Clip clip, long frame)
        {
            return (long)Math.Min(long.MaxValue, clip.Rate.StartOfFrameUs((uint)frame));
        }
    }
}
