using UnityEngine;
using UnityEngine.Playables;

namespace Lipz.UnityTests
{
    /// <summary>A track of Timeline plays and scrubs a clip.</summary>
    internal static class TimelineTracks
    {
        internal static string Check(string fixtures)
        {
            var stage = new Stage(Stage.PathOf(fixtures, "phones"));
            var asset = ScriptableObject.CreateInstance<LipzTimelineClip>();
            asset.Set(stage.Bank, Stage.Key);
            Stage.Equal(stage.Bank.Bank.Clip(Stage.Key).DurationUs.Value / 1e6, asset.duration);
            asset.CreatePlayable(default(PlayableGraph), null);
            LipzPlayable playable = ScriptPlayable<LipzPlayable>.Last;
            Show(playable, stage, 0.25, FrameData.EvaluationType.Evaluate);
            string scrubbed = stage.Shown();
            Stage.Equal(false, stage.IsAtRest);
            Show(playable, stage, 0.7, FrameData.EvaluationType.Playback);
            Show(playable, stage, 0.25, FrameData.EvaluationType.Playback);
            Stage.Equal(scrubbed, stage.Shown());
            playable.OnBehaviourPause(default(Playable), default(FrameData));
            Stage.Equal(true, stage.IsAtRest);
            Events(fixtures);
            return "plays, scrubs, rests, and reports events once";
        }

        private static void Events(string fixtures)
        {
            var stage = new Stage(Stage.PathOf(fixtures, "drama"), "Mouth_A");
            var playable = new LipzPlayable { Clip = stage.Bank.Bank.Clip("act1/mara-good-evening") };
            // Played from its start, and longer than the clip.
            for (int i = 1; i < 500; i++) Show(playable, stage, i / 60.0, FrameData.EvaluationType.Playback);
            Happened(stage, "feels neutral", "sees otto", "points fog", "finished");
            // Scrubbed to the middle, and played from there.
            Show(playable, stage, 2, FrameData.EvaluationType.Evaluate);
            Happened(stage);
            for (int i = 120; i < 500; i++) Show(playable, stage, i / 60.0, FrameData.EvaluationType.Playback);
            Happened(stage, "points fog", "finished");
            // A new playable that starts in the middle.
            playable = new LipzPlayable { Clip = playable.Clip };
            for (int i = 120; i < 500; i++) Show(playable, stage, i / 60.0, FrameData.EvaluationType.Playback);
            Happened(stage, "points fog", "finished");
        }

        private static void Happened(Stage stage, params string[] expected)
        {
            stage.Happened.RemoveAll(each => each.StartsWith("\""));
            Stage.Equal(string.Join("|", expected), string.Join("|", stage.Happened.ToArray()));
            stage.Happened.Clear();
        }

        private static void Show(LipzPlayable playable, Stage stage, double time, FrameData.EvaluationType type)
        {
            playable.ProcessFrame(Playable.At(time), new FrameData { evaluationType = type }, stage.Player);
        }
    }
}
