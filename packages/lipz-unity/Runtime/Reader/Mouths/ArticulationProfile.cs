using System;
using System.Collections.Generic;

namespace Lipz
{
    /// <summary>How a project or a character articulates: targets of phones, gain, jaw and lead.</summary>
    public sealed class ArticulationProfile : INamed
    {
        private const int RecordBytes = 16;
        private const int TargetBytes = 12;

        /// <summary>Gain per decibel, in thousandths.</summary>
        private const int GainPerDb = 35;

        private static readonly PhoneTargets RestTargets =
            new PhoneTargets(new byte[] { 5, 12, 10, 0, 0, 0, 0 }, new byte[] { 0, 0, 0 }, 0, 0);

        /// <summary>The profile of projects without their own.</summary>
        public static readonly ArticulationProfile BuiltIn =
            new ArticulationProfile("default", new PhoneTargets[0], 100, 100, 10, -20);

        private readonly PhoneTargets[] targets;
        private readonly int gainPercent;
        private readonly int jawPercent;
        private readonly int levelDb;

        internal readonly int LeadMs;

        private ArticulationProfile(
            string name, PhoneTargets[] targets, int gainPercent, int jawPercent, int leadMs, int levelDb)
        {
            Name = name;
            this.targets = targets;
            this.gainPercent = gainPercent;
            this.jawPercent = jawPercent;
            LeadMs = leadMs;
            this.levelDb = levelDb;
        }

        /// <summary>The name of the profile.</summary>
        public string Name { get; private set; }

        string INamed.LookUpName
        {
            get { return Name; }
        }

        /// <summary>Reads the profiles of a section. A damaged profile ends them.</summary>
        internal static IReadOnlyList<ArticulationProfile> AllOf(Table section)
        {
            var all = new List<ArticulationProfile>();
            for (long at = 0; at + RecordBytes <= section.Count;)
            {
                int nameLength = section.U16(at), count = section.U16(at, 2);
                long end = at + RecordBytes + nameLength + count * TargetBytes;
                if (end > section.Count) break;
                string name = new StringPool(section).At(at + RecordBytes, nameLength) ?? "";
                var targets = new PhoneTargets[count];
                for (int i = 0; i < count; i++)
                {
                    targets[i] = new PhoneTargets(section, at + RecordBytes + nameLength + i * TargetBytes);
                }
                int gain = section.U16(at, 4), jaw = section.U16(at, 6);
                int lead = (short)section.U16(at, 8), level = (short)section.U16(at, 10);
                all.Add(new ArticulationProfile(name, targets, gain, jaw, lead, level));
                at = end;
            }
            return all;
        }

        internal PhoneTargets TargetsOf(int phone)
        {
            return phone < targets.Length ? targets[phone] : RestTargets;
        }

        /// <summary>Returns the gain of a clip with a level, in thousandths.</summary>
        internal int GainAt(int? clipLevelDb)
        {
            int louderDb = clipLevelDb == null ? 0 : clipLevelDb.Value - levelDb;
            return Math.Max(700, Math.Min(1300, louderDb * GainPerDb + 1000)) * gainPercent / 100;
        }

        internal int Jaw(int value)
        {
            return (int)((long)value * jawPercent / 100);
        }
    }

    /// <summary>The targets of a phone or of a shape.</summary>
    internal sealed class PhoneTargets
    {
        /// <summary>Jaw, opening, rounding, spreading, tongue tip, tongue out, tongue back, in percent.</summary>
        internal readonly byte[] Percent;

        /// <summary>How strongly the phone prevails on jaw, lips and rounding, in tenths.</summary>
        internal readonly byte[] StrengthTenths;

        /// <summary>Bits for closed lips, a lip on the teeth, and a narrow jaw.</summary>
        internal readonly byte Class;

        /// <summary>The second sound of a diphthong, or the phone itself.</summary>
        internal readonly byte Second;

        internal PhoneTargets(byte[] percent, byte[] strengthTenths, byte classBits, byte second)
        {
            Percent = percent;
            StrengthTenths = strengthTenths;
            Class = classBits;
            Second = second;
        }

        internal PhoneTargets(Table section, long at)
        {
            Percent = new byte[7];
            for (int i = 0; i < Percent.Length; i++) Percent[i] = section.U8(at, i);
            StrengthTenths = new[] { section.U8(at, 7), section.U8(at, 8), section.U8(at, 9) };
            Class = section.U8(at, 10);
            Second = section.U8(at, 11);
        }
    }
}
