using System;

namespace Lipz
{
    /// <summary>Blends sounds near a time into an articulation (bank format, "Computing articulation").</summary>
    internal sealed class ArticulationBlend
    {
        private const int LongestRiseUs = 150000;
        private const int LongestReleaseUs = 40000;
        private const int LipsUs = 120000;
        private const int TongueStrength = 10;
        private const int Whole = 1000;
        private const int FullWeight = Whole * 10;
        private const int JawCap = 80;
        private const int TeethCap = 150;

        /// <summary>The rise and the fall of each group in microseconds: jaw, lips, rounding, tongue.</summary>
        private static readonly int[] RiseUs = { 140000, 120000, 150000, 60000 };

        /// <summary>The group of each target.</summary>
        private static readonly int[] Groups = { 0, 1, 2, 1, 3, 3, 3 };

        /// <summary>The least duration and the ramp of each constraint, in the order of the bits of a class.</summary>
        private static readonly int[] ShortestUs = { 60000, 50000, 40000 };
        private static readonly int[] RampUs = { 45000, 50000, 100000 };

        private readonly int[] sums = new int[Groups.Length];
        private readonly int[] weights = new int[RiseUs.Length];
        private readonly int[] added = new int[RiseUs.Length];
        private readonly int[] held = new int[ShortestUs.Length];
        private bool areCertain;

        internal void Clear(bool certain)
        {
            areCertain = certain;
            Array.Clear(sums, 0, sums.Length);
            Array.Clear(weights, 0, weights.Length);
            Array.Clear(held, 0, held.Length);
        }

        /// <summary>Adds a sound that starts and ends this many microseconds after the time of the query.</summary>
        internal void Add(int startUs, int endUs, PhoneTargets targets)
        {
            if (startUs > LongestRiseUs || endUs < -LongestRiseUs) return;
            int holdEndUs = endUs - Math.Min((endUs - startUs) / 4, LongestReleaseUs);
            for (int group = 0; group < added.Length; group++)
            {
                int strength = group < targets.StrengthTenths.Length ? targets.StrengthTenths[group] : TongueStrength;
                added[group] = Share(startUs, holdEndUs, RiseUs[group]) * strength;
                weights[group] += added[group];
            }
            for (int target = 0; target < sums.Length; target++)
            {
                sums[target] += added[Groups[target]] * targets.Percent[target];
            }
            for (int bit = 0; bit < held.Length; bit++)
            {
                if ((targets.Class >> bit & 1) == 0) continue;
                int lasting = areCertain
                    ? Share(startUs, Math.Max(endUs, startUs + ShortestUs[bit]), RampUs[bit])
                    : Share(startUs, holdEndUs, LipsUs) / 2;
                held[bit] = Math.Max(held[bit], lasting);
            }
        }

        /// <summary>Writes the average of all sounds, scaled by the gain, with constraints last.</summary>
        internal void Finish(ArticulationProfile profile, int? levelDb, int[] thousandths)
        {
            PhoneTargets rest = profile.TargetsOf(0);
            for (int target = 0; target < sums.Length; target++)
            {
                int weight = weights[Groups[target]];
                int total = sums[target] + Math.Max(0, FullWeight - weight) * rest.Percent[target];
                sums[target] = total / (Math.Max(weight, FullWeight) / 10);
            }
            int gain = profile.GainAt(levelDb);
            int closedLips = held[0], lipOnTeeth = held[1], narrowJaw = held[2];
            int opening = Capped(Scaled(sums[1], gain), TeethCap, lipOnTeeth);
            thousandths[(int)Articulator.Jaw] = Capped(Scaled(profile.Jaw(sums[0]), gain), JawCap, narrowJaw);
            thousandths[(int)Articulator.Opening] = Capped(opening, 0, closedLips);
            thousandths[(int)Articulator.Closure] = closedLips;
            thousandths[(int)Articulator.Teeth] = lipOnTeeth;
            thousandths[(int)Articulator.Rounding] = sums[2];
            thousandths[(int)Articulator.Spreading] = sums[3];
            thousandths[(int)Articulator.TongueTip] = sums[4];
            thousandths[(int)Articulator.TongueOut] = sums[5];
            thousandths[(int)Articulator.TongueBack] = sums[6];
        }

        private static int Scaled(int value, int gain)
        {
            return (int)Math.Min((long)value * gain / Whole, Whole);
        }

        /// <summary>Moves a value to a cap by the share of a constraint, unless it is below the cap.</summary>
        private static int Capped(int value, int cap, int share)
        {
            return Math.Min(value, (value * (Whole - share) + cap * share) / Whole);
        }

        /// <summary>Returns how far a movement has come, in thousandths, with a rise before and after it.</summary>
        private static int Share(int startUs, int endUs, int riseUs)
        {
            int done = Math.Max(0, Math.Min(Math.Min(riseUs - startUs, endUs + riseUs), riseUs));
            return done * Whole / riseUs;
        }
    }
}
