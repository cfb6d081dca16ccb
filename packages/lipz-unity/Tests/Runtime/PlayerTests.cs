using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Lipz.Tests
{
    /// <summary>Tests of the player for the Test Runner of Unity, with a clock of their own.</summary>
    public sealed class PlayerTests
    {
        /// <summary>Subtitles, events and the end, in their order and each once.</summary>
        [Test]
        public void EventsAndSubtitlesHappenOnce()
        {
            var player = new GameObject("Mara").AddComponent<LipzPlayer>();
            var happened = new List<string>();
            player.OnSubtitle.AddListener(happened.Add);
            player.OnEvent.AddListener((who, verb, target) => happened.Add(who + " " + verb + " " + target));
            player.OnFinished.AddListener(() => happened.Add("finished"));
            player.Locale = "en-us";
            player.Begin(Bank.Open(TinyBank.Bytes).Clip("hi"));
            for (int us = 0; us < 200000; us += 10000) player.AdvanceTo(ClipTime.Micros(us));
            Assert.AreEqual(" feels sad|Hi||finished", string.Join("|", happened));
            Assert.IsTrue(!player.IsPlaying);
        }
    }
}
