using System;
using System.Diagnostics;

namespace Lipz.UnityTests
{
    /// <summary>A rendered frame allocates nothing, with events, subtitles, loops and 35 blend shapes.</summary>
    internal static class Ticks
    {
        private const int Rounds = 20;
        private const int Count = 50000;

        internal static string Measure(string fixtures)
        {
            string measured = Of("weights", new Stage(Stage.PathOf(fixtures, "phones"), false), Stage.Key);
            string[] shapes = { "Mouth_A", "Mouth_E", "Mouth_O", "Mouth_U", "Mouth_M", "Mouth_F" };
            var drama = new Stage(Stage.PathOf(fixtures, "drama"), false, shapes);
            drama.Player.Speaker = "otto";
            return measured + Of("tick", drama, "act1/otto-twenty-years");
        }

        private static string Of(string name, Stage stage, string key)
        {
            long happened = 0;
            stage.Player.Happened += each => happened++;
            stage.Play(24000, key);
            stage.Source.loop = true;
            // The first loop decodes each string.
            for (int i = 0; i < 2000; i++) stage.Tick(800);
            double least = double.MaxValue;
            var watch = new Stopwatch();
            int collections = GC.CollectionCount(0);
            long before = GC.GetAllocatedBytesForCurrentThread();
            for (int round = 0; round < Rounds; round++)
            {
                watch.Restart();
                for (int i = 0; i < Count; i++) stage.Tick(800);
                least = Math.Min(least, watch.Elapsed.TotalMilliseconds * 1e6 / Count);
            }
            long allocated = GC.GetAllocatedBytesForCurrentThread() - before;
            if (allocated != 0 || GC.CollectionCount(0) != collections) throw new Exception(allocated + " bytes");
            string times = FormattableString.Invariant($"\nbench {name}_ns {least:F1} Unity player");
            return times + "\nbench " + name + "_bytes 0 Unity player\n    " + happened + " events";
        }
    }
}
