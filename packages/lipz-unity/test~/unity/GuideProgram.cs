using System.Reflection;
using UnityEngine;

namespace Lipz.UnityTests
{
    /// <summary>Runs the program of docs/guides/unity.md, and compares its output.</summary>
    internal static class GuideProgram
    {
        private const int RateHz = 24000;

        internal static string Run(string fixtures, string expected)
        {
            var stage = new Stage(Stage.PathOf(fixtures, "drama"), false, "jawOpen");
            stage.Player.Speaker = "mara";
            stage.Player.Locale = "de-de";
            Talk program = stage.Player.gameObject.AddComponent<Talk>();
            Set(program, "player", stage.Player);
            Set(program, "recording", AudioClip.Create("line", 4 * RateHz, 1, RateHz, false));
            Debug.Messages.Clear();
            Stage.Message(program, "Start")();
            while (stage.Player.IsPlaying) stage.Tick(800);
            string[] lines = expected.TrimEnd('\n').Split('\n');
            for (int i = 0; i < lines.Length; i++) Stage.Equal(lines[i].TrimEnd(), Debug.Messages[i].TrimEnd());
            Stage.Equal(lines.Length, Debug.Messages.Count);
            return lines.Length + " lines of output";
        }

        /// <summary>Sets a field, as the inspector does.</summary>
        private static void Set(Talk program, string field, object value)
        {
            typeof(Talk).GetField(field, BindingFlags.Instance | BindingFlags.NonPublic).SetValue(program, value);
        }
    }
}
