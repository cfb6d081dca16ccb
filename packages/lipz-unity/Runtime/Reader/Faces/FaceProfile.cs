using System.Collections.Generic;

namespace Lipz
{
    /// <summary>How faces move by themselves: <c>[face]</c> in <c>lipz.toml</c>.</summary>
    public sealed class FaceProfile : INamed
    {
        private const int RecordBytes = 40;
        private const int HeadMost = 60000;

        /// <summary>The profile of projects without their own.</summary>
        public static readonly FaceProfile BuiltIn = new FaceProfile();

        /// <summary>
        /// Milliseconds between blinks: on a calm face, then while each emotion is the strongest. 0 for no blinks.
        /// </summary>
        internal readonly int[] BlinkIntervalMs =
        {
            4000, 4000, 6000, 4000, 2000, 4000, 4000, 4000, 2000, 4000, 4000, 4000, 4000,
        };

        internal readonly int BlinkLengthMs = 240;
        internal readonly int DoubleBlinkPercent = 10;
        internal readonly int GlancePercent = 20;

        /// <summary>In thousandths of a degree.</summary>
        internal readonly int HeadMotion = 3000;

        /// <summary>In thousandths of a degree.</summary>
        internal readonly int HeadFollows = 20000;
        internal readonly int PoseMs = 400;
        internal readonly int FixationMs = 1000;

        private FaceProfile()
        {
            Name = "default";
        }

        private FaceProfile(Table section, long at, string name)
        {
            Name = name;
            for (int i = 0; i < BlinkIntervalMs.Length; i++) BlinkIntervalMs[i] = section.U16(at, 2 * i);
            BlinkLengthMs = section.U16(at, 26);
            DoubleBlinkPercent = section.U8(at, 28);
            GlancePercent = section.U8(at, 29);
            HeadMotion = section.U16(at, 30);
            HeadFollows = section.U16(at, 32);
            PoseMs = section.U16(at, 34);
            FixationMs = section.U16(at, 36);
        }

        /// <summary>The name of the profile.</summary>
        public string Name { get; private set; }

        string INamed.LookUpName
        {
            get { return Name; }
        }

        /// <summary>Reads the profiles of a section. A damaged profile ends them.</summary>
        internal static IReadOnlyList<FaceProfile> AllOf(Table section)
        {
            var all = new List<FaceProfile>();
            var pool = new StringPool(section);
            for (long at = 0; at + RecordBytes <= section.Count;)
            {
                int length = section.U16(at, 38);
                if (!pool.Has(at + RecordBytes, length)) break;
                all.Add(new FaceProfile(section, at, pool.At(at + RecordBytes, length) ?? ""));
                at += RecordBytes + length;
            }
            return all;
        }

        /// <summary>
        /// Returns the face of a silent character, who blinks and looks. Give each character a different seed.
        /// </summary>
        public Face IdleAt(ClipTime time, ulong seed, LookAt look = default(LookAt))
        {
            return new FaceMoment(null).IdleAt(time, seed, this, look);
        }

        /// <summary>
        /// Divides an angle: the eyes turn as far as the profile allows, and the head turns the rest.
        /// </summary>
        internal int Shared(long angle, out int head)
        {
            int eyes = Chance.Limited(angle, HeadFollows);
            head = Chance.Limited(angle - eyes, HeadMost);
            return eyes;
        }
    }
}
