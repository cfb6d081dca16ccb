using System;
using System.Diagnostics;
using System.IO;

namespace Lipz.Tests
{
    /// <summary>Measures queries, and checks that those of playback allocate nothing.</summary>
    internal static class Speed
    {
        private const int Warm = 200000;

        internal static string Measure(string fixtures)
        {
            byte[] drama = File.ReadAllBytes(Path.Combine(fixtures, "banks/v1/drama.lipzbank"));
            Bank bank = Bank.Open(drama);
            Clip clip = bank.Clip("act1/mara-good-evening");
            BankLocale german = bank.Locale("de-de");
            ClipCursor cursor = clip.Cursor("mara");
            long sum = 0;
            string measured = "\n    open " + Of(2000, i => sum += Bank.Open(drama).ClipCount, mayAllocate: true);
            measured += "\n    clip by key " + Of(200000, i => sum += bank.Clip("act2/otto-eyes").SegmentCount, true);
            measured += "\n    viseme at a time " + Of(10000000, i =>
            {
                sum += clip.VisemeAt(ClipTime.Micros(i % 4000000));
            });
            measured += "\n    tick of a cursor, with events and a subtitle " + Of(1000000, i =>
            {
                ClipTime time = ClipTime.Samples(i % 160000, 48000);
                if (i % 160000 == 0) cursor.Seek(time);
                foreach (ClipEvent happened in cursor.AdvanceTo(time).Events) sum += (int)happened.Verb;
                if (cursor.Segment != null) sum += cursor.Segment.Value.Text(german).Value.Text.Length;
                sum += cursor.Viseme;
            });
            Bank phones = Bank.Open(File.ReadAllBytes(Path.Combine(fixtures, "banks/v1/phones.lipzbank")));
            Clip spoken = phones.Clip("spoken");
            Rig rig = phones.Rig("arkit");
            float[] weights = new float[rig.WeightNames.Count];
            measured += "\n    " + weights.Length + " weights of a rig " + Of(200000, i =>
            {
                sum += spoken.WeightsAt(ClipTime.Micros(i * 10 % 1500000), rig, weights).Length;
            });
            return measured;
        }

        private static string Of(int count, Action<int> query, bool mayAllocate = false)
        {
            for (int i = 0; i < Math.Min(count, Warm); i++) query(i);
            Stopwatch watch = new Stopwatch();
            int collections = GC.CollectionCount(0);
            long before = GC.GetAllocatedBytesForCurrentThread();
            watch.Start();
            for (int i = 0; i < count; i++) query(i);
            watch.Stop();
            long allocated = GC.GetAllocatedBytesForCurrentThread() - before;
            double nanoseconds = watch.Elapsed.TotalMilliseconds * 1e6 / count;
            bool isClean = allocated == 0 && GC.CollectionCount(0) == collections;
            if (!mayAllocate && !isClean) throw new Exception(allocated + " bytes allocated by " + count + " queries");
            return nanoseconds.ToString("F0") + " ns, " + allocated / count + " bytes";
        }
    }
}
