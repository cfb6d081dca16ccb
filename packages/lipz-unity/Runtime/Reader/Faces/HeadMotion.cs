using System;

namespace Lipz
{
    /// <summary>The head, which moves while the mouth does.</summary>
    internal static class HeadMotion
    {
        private const int WholeShare = 1000;

        /// <summary>Reads pitch, yaw and roll in thousandths of a degree.</summary>
        internal static void Read(
            Clip clip, bool hasHead, Curve poses, FaceProfile profile, ulong seed, long ms, int[] angles)
        {
            Array.Clear(angles, 0, angles.Length);
            long speaking = hasHead ? SpeakingMouth.SpeakingAt(clip, ms) : 0;
            if (speaking == 0) return;
            HeadTurn turn = poses == null || poses.KeyCount == 0
                ? InSlots(clip, profile, seed, ms)
                : AtKeys(clip, profile, poses, ms);
            int most = profile.HeadMotion;
            angles[0] = turn.Angle(seed, ChanceStream.Pitch, most * 2 / 3, speaking);
            angles[1] = turn.Angle(seed, ChanceStream.Yaw, most, speaking);
            angles[2] = turn.Angle(seed, ChanceStream.Roll, most / 2, speaking);
        }

        /// <summary>
        /// Turns from the pose of one key to that of the next, in half of a pose or until the next key.
        /// </summary>
        private static HeadTurn AtKeys(Clip clip, FaceProfile profile, Curve poses, long ms)
        {
            int index = poses.IndexAt(SpeakingMouth.FrameAt(clip, ms * 1000));
            HeadPose before = PoseOf(poses, Math.Max(0, index - 1));
            long start = SpeakingMouth.StartMs(clip, poses.KeyFrame(index));
            long length = profile.PoseMs / 2;
            if (index + 1 < poses.KeyCount)
            {
                long next = SpeakingMouth.StartMs(clip, poses.KeyFrame(index + 1));
                length = Math.Min(length, Math.Max(0, next - start));
            }
            return new HeadTurn(before, before, PoseOf(poses, index), 0, Eased(ms - start, length));
        }

        private static HeadPose PoseOf(Curve poses, int index)
        {
            int share = Math.Max(0, Math.Min(WholeShare, poses.KeyThousandths(index)));
            return new HeadPose(poses.KeyFrame(index), share);
        }

        /// <summary>Divides time into slots. In each slot, the head begins to turn to a new pose.</summary>
        private static HeadTurn InSlots(Clip clip, FaceProfile profile, ulong seed, long ms)
        {
            long slot = profile.PoseMs == 0 ? 0 : ms / profile.PoseMs;
            return new HeadTurn(
                new HeadPose(Math.Max(0, slot - 1), WholeShare),
                new HeadPose(slot, WholeShare),
                new HeadPose(slot + 1, WholeShare),
                slot == 0 ? 0 : InSlot(clip, profile, seed, ms, slot - 1),
                InSlot(clip, profile, seed, ms, slot));
        }

        /// <summary>Returns the progress of a slot's step, which takes half a slot, in 65,536ths.</summary>
        private static long InSlot(Clip clip, FaceProfile profile, ulong seed, long ms, long slot)
        {
            int length = profile.PoseMs;
            long start = SpeakingMouth.ChangeMs(clip, slot * length, length);
            if (start < 0)
            {
                start = slot * length + Chance.Part(length / 2, Chance.Draw(seed, ChanceStream.PoseTime, 0, slot));
            }
            return Eased(ms - start, length / 2);
        }

        /// <summary>Returns the progress of a step, which starts and ends slowly: x² · (3 - 2x).</summary>
        private static long Eased(long passedMs, long lengthMs)
        {
            long part = lengthMs == 0 ? Chance.Whole : Math.Min(Chance.Whole, (Math.Max(0, passedMs) << 16) / lengthMs);
            return (part * part >> 16) * (3 * Chance.Whole - part * 2) >> 16;
        }
    }

    /// <summary>A pose: the number that its angles are drawn with, and its share of the full angles.</summary>
    internal readonly struct HeadPose
    {
        private readonly long number;
        private readonly int shareThousandths;

        internal HeadPose(long number, int shareThousandths)
        {
            this.number = number;
            this.shareThousandths = shareThousandths;
        }

        internal int Angle(ulong seed, ChanceStream stream, int most)
        {
            int own = (int)((long)most * shareThousandths / 1000);
            return Chance.EitherSide(own, Chance.Draw(seed, stream, 0, number));
        }
    }

    /// <summary>Three poses, and the progress between them in 65,536ths.</summary>
    internal readonly struct HeadTurn
    {
        private const long Speaking = 1000;

        private readonly HeadPose first;
        private readonly HeadPose second;
        private readonly HeadPose third;
        private readonly long toSecond;
        private readonly long toThird;

        internal HeadTurn(HeadPose first, HeadPose second, HeadPose third, long toSecond, long toThird)
        {
            this.first = first;
            this.second = second;
            this.third = third;
            this.toSecond = toSecond;
            this.toThird = toThird;
        }

        internal int Angle(ulong seed, ChanceStream stream, int most, long speaking)
        {
            int from = first.Angle(seed, stream, most);
            int middle = second.Angle(seed, stream, most);
            int to = third.Angle(seed, stream, most);
            int angle = from + Chance.Scaled(middle - from, toSecond, Chance.Whole)
                + Chance.Scaled(to - middle, toThird, Chance.Whole);
            return Chance.Scaled(angle, speaking, Speaking);
        }
    }
}
