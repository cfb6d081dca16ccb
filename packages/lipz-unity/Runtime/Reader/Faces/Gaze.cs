namespace Lipz
{
    /// <summary>The eyes: they move between the eyes and the mouth of a person, and sometimes glance below.</summary>
    internal static class Gaze
    {
        private const int SaccadeMs = 50;
        private const int GlanceDown = 10000;
        private const int GlanceMore = 8000;
        private const int GlanceAside = 12000;

        /// <summary>Pitch and yaw of the left eye, the right eye and the mouth of a person one metre away.</summary>
        private static readonly int[] Pitches = { 0, 0, -4000 };
        private static readonly int[] Yaws = { 1900, -1900, 0 };

        /// <summary>Reads the direction of the eyes, in thousandths of a degree from the head at rest.</summary>
        internal static void Read(FaceProfile profile, ulong seed, long ms, LookAt look, out int pitch, out int yaw)
        {
            pitch = look.Pitch;
            yaw = look.Yaw;
            if (look.IsPoint) return;
            var step = new ChanceStep(seed, ChanceStream.FixationTime, ms, profile.FixationMs, SaccadeMs);
            Fixation(profile, seed, step.Before, out int pitchBefore, out int yawBefore);
            Fixation(profile, seed, step.Now, out int pitchNow, out int yawNow);
            pitch = Sum(pitch, pitchBefore, pitchNow, step.Part);
            yaw = Sum(yaw, yawBefore, yawNow, step.Part);
        }

        private static int Sum(long target, int before, int now, long part)
        {
            return Chance.Limited(target + before + Chance.Scaled(now - before, part, Chance.Whole), int.MaxValue);
        }

        private static void Fixation(FaceProfile profile, ulong seed, long number, out int pitch, out int yaw)
        {
            bool isGlance = Chance.Part(100, Chance.Draw(seed, ChanceStream.Glance, 0, number)) < profile.GlancePercent;
            if (isGlance)
            {
                pitch = -GlanceDown - Chance.Part(GlanceMore, Chance.Draw(seed, ChanceStream.EyePitch, 0, number));
                yaw = Chance.EitherSide(GlanceAside, Chance.Draw(seed, ChanceStream.EyeYaw, 0, number));
                return;
            }
            int place = Chance.Part(Pitches.Length, Chance.Draw(seed, ChanceStream.Target, 0, number));
            pitch = Pitches[place];
            yaw = Yaws[place];
        }
    }
}
