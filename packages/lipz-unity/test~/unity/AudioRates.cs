using System;
using System.Collections.Generic;
using System.Linq;

namespace Lipz.UnityTests
{
    /// <summary>The rate of a recording may differ from that of the output: the mouths are the same.</summary>
    internal static class AudioRates
    {
        private const int RenderedPerSecond = 60;

        internal static string Compare(string fixtures)
        {
            int[] rates = { 12000, 24000, 30000, 44100, 48000, 96000 };
            List<string> expected = null;
            foreach (int rateHz in rates)
            {
                var shown = Play(new Stage(Stage.PathOf(fixtures, "phones")), rateHz);
                expected = expected ?? shown;
                Stage.Equal(string.Join("\n", expected), string.Join("\n", shown));
            }
            int different = expected.Distinct().Count();
            if (different < 20) throw new Exception("only " + different + " different mouths");
            return rates.Length + " rates, " + expected.Count + " rendered frames, " + different + " different mouths";
        }

        private static List<string> Play(Stage stage, int rateHz)
        {
            var shown = new List<string>();
            stage.Play(rateHz);
            while (stage.Player.IsPlaying)
            {
                stage.Tick(shown.Count == 0 ? 0 : Stage.OutputRateHz / RenderedPerSecond);
                shown.Add(stage.Shown());
            }
            return shown;
        }
    }
}
