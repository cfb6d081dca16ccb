using System;

namespace Lipz
{
    /// <summary>The curves that move a face, in the order of the bank format.</summary>
    internal enum FaceCurve
    {
        Blink,
        HeadPitch,
        HeadYaw,
        HeadRoll,
        EyePitch,
        EyeYaw,
        Lids,
        Nod,
        Shake,
        LookPitch,
        LookYaw,
        Brows,
        Shrug,
        Breath,
        Pose,
    }

    /// <summary>The purpose of a curve by its name: <c>fear</c>, or <c>mara.fear</c> of another character.</summary>
    internal readonly struct CurvePurpose
    {
        private static readonly string[] FaceNames =
        {
            "blink", "headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw", "lids", "nod", "shake", "lookPitch",
            "lookYaw", "brows", "shrug", "breath", "pose",
        };

        /// <summary>The character before the last full stop; null without one.</summary>
        private readonly string character;

        /// <summary>The number of the emotion; -1 if it is none.</summary>
        internal readonly int Emotion;

        /// <summary>The number of the curve of a face; -1 if it is none.</summary>
        internal readonly int Face;

        /// <summary>The number of the articulator; -1 if it is none. It always belongs to the speaker.</summary>
        internal readonly int Articulator;

        internal CurvePurpose(string name)
        {
            int stop = name.LastIndexOf('.');
            character = stop < 0 ? null : name.Substring(0, stop);
            string own = name.Substring(stop + 1);
            Emotion = Array.IndexOf(Emotions.Names, own);
            Face = Array.IndexOf(FaceNames, own);
            Articulator = Array.IndexOf(Articulation.Names, name);
        }

        internal bool HasCharacter
        {
            get { return character != null; }
        }

        /// <summary>Whether the curve belongs to a character.</summary>
        internal bool BelongsTo(Who who)
        {
            return character == null ? who.IsSpeaker : character == who.Name;
        }
    }

    /// <summary>The character whose face and emotions are queried. The default is the speaker.</summary>
    public readonly struct Who
    {
        private readonly bool isOther;

        /// <summary>The name; null for a speaker without one.</summary>
        internal readonly string Name;

        private Who(string name, bool isOther)
        {
            Name = name;
            this.isOther = isOther;
        }

        /// <summary>Returns the speaker with a name, so that events with this name count, too.</summary>
        public static Who Speaker(string name)
        {
            return new Who(name, false);
        }

        /// <summary>Returns another character, who listens.</summary>
        public static Who Other(string name)
        {
            return new Who(name, true);
        }

        internal bool IsSpeaker
        {
            get { return !isOther; }
        }

        /// <summary>Returns the one of two values that is farther from neutral.</summary>
        internal static int Farther(int one, int other, int neutral)
        {
            return Math.Abs((long)other - neutral) > Math.Abs((long)one - neutral) ? other : one;
        }
    }
}
