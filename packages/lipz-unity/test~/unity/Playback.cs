using System;

namespace Lipz.UnityTests
{
    /// <summary>Subtitles and events of a line, however the audio moves.</summary>
    internal static class Playback
    {
        private const string Line = "act1/mara-good-evening";
        private const string First = "mara feels neutral|\"Guten Abend, Otto.\"";
        private const string Second = "mara sees otto|\"Du bist spät dran,\"";
        private const string Third = "mara points fog|\"und der Nebel ist zu früh.\"";
        private const string End = "\"\"|finished";

        internal static string Check(string fixtures)
        {
            Stage stage = Start(fixtures);
            while (stage.Player.IsPlaying) stage.Tick(800);
            Expect(stage, First, Second, Third, End);

            // One long rendered frame.
            stage = Start(fixtures);
            stage.Tick(3 * Stage.OutputRateHz);
            Expect(stage, "mara feels neutral", "mara sees otto", "mara points fog", "\"und der Nebel ist zu früh.\"");

            // A jump over the second segment, and the end.
            stage = Start(fixtures);
            stage.Tick(0);
            stage.Player.Seek(24000 * 9 / 4);
            stage.Tick(0);
            stage.Player.Stop();
            Expect(stage, First, Third, "\"\"");

            // A loop.
            stage = Start(fixtures);
            stage.Source.loop = true;
            for (int i = 0; i < 9; i++) stage.Tick(Stage.OutputRateHz / 2);
            Expect(stage, First, Second, Third, First);

            // A different language in the middle of a segment, and one that the bank lacks.
            stage = Start(fixtures);
            stage.Tick(0);
            stage.Player.Locale = "fr-fr";
            stage.Player.Locale = "xx";
            Expect(stage, First, "\"Bonsoir, Otto.\"", "\"Good evening, Otto.\"");

            // Events that start the next line.
            stage = Start(fixtures);
            bool hasStarted = false;
            stage.Player.Happened += happened =>
            {
                if (hasStarted || happened.Verb != EventVerb.Sees) return;
                hasStarted = true;
                stage.Play(24000, "act2/otto-eyes");
            };
            while (stage.Player.IsPlaying) stage.Tick(800);
            Expect(stage, First, "mara points fog", "\"\"", "mara sees otto", "\"I was resting my eyes.\"", End);

            Stage.Equal(false, stage.Player.Play("missing"));
            return "whole line, long frame, jump, loop, languages, next line";
        }

        private static Stage Start(string fixtures)
        {
            var stage = new Stage(Stage.PathOf(fixtures, "drama"), "Mouth_A", "Mouth_E", "Mouth_O", "Mouth_U");
            stage.Player.Locale = "de-de";
            stage.Player.Speaker = "mara";
            stage.Play(24000, Line);
            return stage;
        }

        private static void Expect(Stage stage, params string[] happened)
        {
            Stage.Equal(string.Join("|", happened), string.Join("|", stage.Happened.ToArray()));
        }
    }
}
