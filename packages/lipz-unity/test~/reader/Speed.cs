using System;
using System.Diagnostics;
using System.IO;

namespace Lipz.Tests
{
    /// <summary>
    /// Measures queries, and checks that those of playback allocate nothing. The questions are those of
    /// docs/inside/ports.md.
    /// </summary>
    internal static class Speed
    {
        private const int Warm = 200000;
        private const int Rounds = 20;
        private const int FramesPerSecond = 60;

        internal static string Measure(string fixtures)
        {
            byte[] drama = File.ReadAllBytes(Path.Combine(fixtures, "banks/v1/drama.lipzbank"));
            Bank bank = Bank.Open(drama);
            Clip clip = bank.Clip("act1/mara-good-evening");
            BankLocale german = bank.Locale("de-de");
            ClipCursor cursor = clip.Cursor("mara");
            long sum = 0;
            string measured = Of("open", 2000, i => sum += Bank.Open(drama).ClipCount, mayAllocate: true);
            measured += Of("clip", 200000, i => sum += bank.Clip("act2/otto-eyes").SegmentCount, true);
            measured += Of("viseme", 500000, i => sum += clip.VisemeAt(At(i, 4)));
            measured += Of("tick", 100000, i =>
            {
                ClipTime time = At(i, 4);
                if (i % (4 * FramesPerSecond) == 0) cursor.Seek(time);
                foreach (ClipEvent happened in cursor.AdvanceTo(time).Events) sum += (int)happened.Verb;
                if (cursor.Segment != null) sum += cursor.Segment.Value.Text(german).Value.Text.Length;
                sum += cursor.Viseme;
            });
            Bank phones = Bank.Open(File.ReadAllBytes(Path.Combine(fixtures, "banks/v1/phones.lipzbank")));
            Clip spoken = phones.Clip("spoken");
            Rig rig = phones.Rig("arkit");
            float[] weights = new float[rig.WeightNames.Count];
            measured += Of("weights", 10000, i => sum += spoken.WeightsAt(At(i, 1.4), rig, weights).Length);
            return measured;
        }

        /// <summary>The time of a rendered frame of a clip with this length, which repeats.</summary>
        private static ClipTime At(int frame, double seconds)
        {
            return ClipTime.Micros(frame % (int)Math.Round(seconds * FramesPerSecond) * 1000000L / FramesPerSecond);
        }

        private static string Of(string name, int count, Action<int> query, bool mayAllocate = false)
        {
            for (int i = 0; i < Math.Min(count, Warm); i++) query(i);
            double least = double.MaxValue;
            long most = 0;
            for (int round = 0; round < Rounds; round++)
            {
                Stopwatch watch = new Stopwatch();
                int collections = GC.CollectionCount(0);
                long before = GC.GetAllocatedBytesForCurrentThread();
                watch.Start();
                for (int i = 0; i < count; i++) query(i);
                watch.Stop();
                long allocated = GC.GetAllocatedBytesForCurrentThread() - before;
                bool isClean = allocated == 0 && GC.CollectionCount(0) == collections;
                if (!mayAllocate && !isClean) throw new Exception(allocated + " bytes allocated by " + name);
                least = Math.Min(least, watch.Elapsed.TotalMilliseconds * 1e6 / count);
                most = Math.Max(most, allocated / count);
            }
            return FormattableString.Invariant($"\nbench {name}_ns {least:F1} C#\nbench {name}_bytes {most} C#");
        }
    }
}
