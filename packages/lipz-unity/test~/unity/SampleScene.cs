using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using UnityEngine;

namespace Lipz.UnityTests
{
    /// <summary>Plays the sample to its end.</summary>
    internal static class SampleScene
    {
        internal static string Play(string bank)
        {
            GameObject.Everything.Clear();
            var sample = new GameObject("Scene").AddComponent<Conversation>();
            sample.Set(LipzBank.From(File.ReadAllBytes(bank)), "de-de");
            Stage.Message(sample, "Start")();
            Stage.Message(sample, "OnGUI")();
            LipzPlayer[] players = Characters().Select(one => one.GetComponent<LipzPlayer>()).ToArray();
            var subtitles = new List<string>();
            var frowns = new HashSet<float>();
            while (players.Any(player => player.IsPlaying))
            {
                foreach (LipzPlayer player in players)
                {
                    player.AudioSource.Output(800, 48000);
                    Stage.Message(player, "LateUpdate")();
                    frowns.Add(player.gameObject.GetComponent<SkinnedMeshRenderer>().GetBlendShapeWeight(5));
                }
                if (subtitles.LastOrDefault() != sample.Subtitle) subtitles.Add(sample.Subtitle);
            }
            Stage.Equal(
                "Mara: Guten Abend, Otto.|Mara: Du bist spät dran,|Mara: und der Nebel ist zu früh.|"
                    + "Otto: Es ist seit zwanzig Jahren unterwegs.|"
                    + "Otto: Es ist hinter den Briefmarkenschrank gefallen.|"
                    + "Otto: Keiner hat nachgesehen.|Otto: Nicht mal ich.|",
                string.Join("|", subtitles));
            Stage.Equal("mara feels thinking", sample.LastEvent);
            if (frowns.Max() <= 0) throw new Exception("no frown");
            return subtitles.Count - 1 + " subtitles, " + frowns.Count + " different frowns";
        }

        private static IEnumerable<GameObject> Characters()
        {
            return GameObject.Everything.Where(one => one.name != "Scene");
        }
    }
}
