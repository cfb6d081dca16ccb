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
            return "plays, scrubs and rests";
        }

        private static void Show(LipzPlayable playable, Stage stage, double time, FrameData.EvaluationType type)
        {
            playable.ProcessFrame(Playable.At(time), new FrameData { evaluationType = type }, stage.Player);
        }
    }
}
