using UnityEngine;
using UnityEngine.Playables;

namespace Lipz
{
    /// <summary>Passes the time of Timeline to a <see cref="LipzPlayer"/>.</summary>
    public sealed class LipzPlayable : PlayableBehaviour
    {
        private LipzPlayer player;
        private double lastTime;

        /// <summary>The clip; null if the bank lacks it.</summary>
        public Clip Clip { get; set; }

        /// <summary>Shows the clip. While Timeline plays, events happen; while you scrub, they do not.</summary>
        public override void ProcessFrame(Playable playable, FrameData info, object playerData)
        {
            player = playerData as LipzPlayer;
            if (player == null || Clip == null) return;
            double time = playable.GetTime();
            bool isNew = player.Cursor == null || player.Cursor.Clip != Clip;
            if (isNew && !player.Begin(Clip)) return;
            bool isScrubbed = info.evaluationType == FrameData.EvaluationType.Evaluate || time < lastTime;
            lastTime = time;
            if (isScrubbed) player.ShowAfterSeek(ClipTime.Seconds(time));
            else player.AdvanceTo(ClipTime.Seconds(time));
        }

        /// <summary>Rests the mouths when the clip ends, and when Timeline pauses.</summary>
        public override void OnBehaviourPause(Playable playable, FrameData info)
        {
            if (player != null) player.Rest();
        }
    }
}
