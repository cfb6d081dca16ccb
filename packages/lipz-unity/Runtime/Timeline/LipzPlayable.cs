using UnityEngine;
using UnityEngine.Playables;

namespace Lipz
{
    /// <summary>Passes the time of Timeline to a <see cref="LipzPlayer"/>.</summary>
    public sealed class LipzPlayable : PlayableBehaviour
    {
        /// <summary>A clip that is first shown later than this has not been played from its start.</summary>
        private const double LatestStartSeconds = 0.25;

        private LipzPlayer player;
        private double lastTime;
        private bool isOver;

        /// <summary>The clip; null if the bank lacks it.</summary>
        public Clip Clip { get; set; }

        /// <summary>Shows the clip. While Timeline plays, events happen; while you scrub, they do not.</summary>
        public override void ProcessFrame(Playable playable, FrameData info, object playerData)
        {
            player = playerData as LipzPlayer;
            if (player == null || Clip == null) return;
            double seconds = playable.GetTime();
            bool isJump = info.evaluationType == FrameData.EvaluationType.Evaluate || seconds < lastTime;
            lastTime = seconds;
            if (isJump) isOver = false;
            if (isOver) return;
            ClipTime time = ClipTime.Seconds(seconds);
            if (player.Cursor == null || player.Cursor.Clip != Clip)
            {
                if (!player.Begin(Clip)) return;
                isJump |= seconds > LatestStartSeconds;
            }
            if (isJump) player.ShowAfterSeek(time);
            if (info.evaluationType == FrameData.EvaluationType.Evaluate) return;
            player.AdvanceTo(time);
            isOver = player.Cursor == null;
        }

        /// <summary>Rests the mouths when the clip ends, and when Timeline pauses.</summary>
        public override void OnBehaviourPause(Playable playable, FrameData info)
        {
            if (player != null) player.Rest();
        }
    }
}
