using UnityEngine;

namespace Lipz.UnityTests
{
    /// <summary>
    /// Mouths rest when a recording is paused, taken away or at its end, and when the player is disabled.
    /// </summary>
    internal static class RestingMouths
    {
        private const int ToOpenMouth = 12000;

        internal static string Check(string fixtures)
        {
            Stage stage = Speaking(fixtures);
            stage.Source.Pause();
            Rests(stage, 0);
            stage.Source.UnPause();
            Moves(stage);
            Stage.Equal(true, stage.Player.IsPlaying);

            AudioListener.pause = true;
            Rests(stage, 0);
            AudioListener.pause = false;
            Moves(stage);

            stage.Message("OnDisable")();
            Stage.Equal(true, stage.IsAtRest);
            Moves(stage);

            stage.Source.clip = null;
            Rests(stage, 0);
            Stage.Equal(false, stage.Player.IsPlaying);

            stage = Speaking(fixtures);
            stage.Source.clip = AudioClip.Create("other", 48000, 1, 48000, false);
            Rests(stage, 0);
            Stage.Equal(false, stage.Player.IsPlaying);

            stage = Speaking(fixtures);
            stage.Source.Stop();
            Rests(stage, 0);
            Stage.Equal(false, stage.Player.IsPlaying);

            stage = Speaking(fixtures);
            stage.Player.Stop();
            Stage.Equal(true, stage.IsAtRest);
            Stage.Equal(false, stage.Source.isPlaying);

            stage = Speaking(fixtures);
            Rests(stage, 10 * Stage.OutputRateHz);
            Stage.Equal(false, stage.Player.IsPlaying);
            return "pause, listener, disabled, no clip, other clip, stop, end";
        }

        private static Stage Speaking(string fixtures)
        {
            var stage = new Stage(Stage.PathOf(fixtures, "phones"));
            stage.Play(24000);
            stage.Tick(ToOpenMouth);
            Stage.Equal(false, stage.IsAtRest);
            return stage;
        }

        private static void Moves(Stage stage)
        {
            stage.Tick(0);
            Stage.Equal(false, stage.IsAtRest);
        }

        private static void Rests(Stage stage, int outputSamples)
        {
            stage.Tick(outputSamples);
            Stage.Equal(true, stage.IsAtRest);
        }
    }
}
