using System;

namespace Lipz
{
    /// <summary>
    /// The state of a face, except mouth and emotions. Angles are in degrees: pitch upwards, yaw to the left of the
    /// character, roll towards the left shoulder.
    /// </summary>
    public struct Face
    {
        internal int BlinkThousandths;
        internal int HeadPitchThousandths;
        internal int HeadYawThousandths;
        internal int HeadRollThousandths;
        internal int EyePitchThousandths;
        internal int EyeYawThousandths;
        internal int BrowsThousandths;
        internal int ShrugThousandths;
        internal int BreathThousandths;

        /// <summary>How far the lids are closed, from 0 to 1.</summary>
        public float Blink
        {
            get { return BlinkThousandths / 1000f; }
        }

        /// <summary>How far the head is raised.</summary>
        public float HeadPitch
        {
            get { return HeadPitchThousandths / 1000f; }
        }

        /// <summary>How far the head is turned.</summary>
        public float HeadYaw
        {
            get { return HeadYawThousandths / 1000f; }
        }

        /// <summary>How far the head is tilted.</summary>
        public float HeadRoll
        {
            get { return HeadRollThousandths / 1000f; }
        }

        /// <summary>How far the eyes are raised in the head.</summary>
        public float EyePitch
        {
            get { return EyePitchThousandths / 1000f; }
        }

        /// <summary>How far the eyes are turned in the head.</summary>
        public float EyeYaw
        {
            get { return EyeYawThousandths / 1000f; }
        }

        /// <summary>How far the brows are raised, from 0 to 1. Only curves raise them.</summary>
        public float Brows
        {
            get { return BrowsThousandths / 1000f; }
        }

        /// <summary>A shrug of the face, from 0 to 1. Only curves set it.</summary>
        public float Shrug
        {
            get { return ShrugThousandths / 1000f; }
        }

        /// <summary>How hard the character breathes, from 0 to 10. Only curves set it.</summary>
        public float Breath
        {
            get { return BreathThousandths / 1000f; }
        }
    }

    /// <summary>The target of a character's eyes. The default is a person straight ahead.</summary>
    public readonly struct LookAt
    {
        internal readonly int Pitch;
        internal readonly int Yaw;
        internal readonly bool IsPoint;

        private LookAt(int pitch, int yaw, bool isPoint)
        {
            Pitch = pitch;
            Yaw = yaw;
            IsPoint = isPoint;
        }

        private static int Thousandths(float degrees)
        {
            return (int)Math.Round(degrees * 1000.0);
        }

        /// <summary>Returns a person with eyes in this direction, in degrees from the head at rest.</summary>
        public static LookAt Person(float pitch, float yaw)
        {
            return new LookAt(Thousandths(pitch), Thousandths(yaw), false);
        }

        /// <summary>Returns a target in this direction, at which the eyes stay.</summary>
        public static LookAt Point(float pitch, float yaw)
        {
            return new LookAt(Thousandths(pitch), Thousandths(yaw), true);
        }

        /// <summary>Returns a target in thousandths of a degree.</summary>
        internal static LookAt OfThousandths(int pitch, int yaw, bool isPoint)
        {
            return new LookAt(pitch, yaw, isPoint);
        }
    }

    /// <summary>The faces of a clip.</summary>
    public sealed partial class Clip
    {
        private FaceMoment faceMoment;

        /// <summary>
        /// Returns the face of a character at a time: blinks, eyes and head, which move by themselves. Curves of the
        /// clip replace generated values. The same time always has the same face, on every machine.
        /// </summary>
        public Face FaceAt(
            ClipTime time, Who who = default(Who), FaceProfile profile = null, LookAt look = default(LookAt))
        {
            if (faceMoment == null) faceMoment = new FaceMoment(this);
            return faceMoment.FaceAt(time, who, profile ?? Bank.DefaultFaceProfile, look);
        }
    }
}
