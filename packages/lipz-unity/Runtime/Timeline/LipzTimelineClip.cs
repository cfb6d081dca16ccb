using UnityEngine;
using UnityEngine.Playables;
using UnityEngine.Timeline;

namespace Lipz
{
    /// <summary>A clip of a bank on a <see cref="LipzTrack"/>. Put it at the start of its recording.</summary>
    public sealed class LipzTimelineClip : PlayableAsset, ITimelineClipAsset
    {
        private const double MicrosPerSecond = 1e6;

        [SerializeField]
        private LipzBank bank;

        [SerializeField, Tooltip("The key of the clip: act1/mara-good-evening.")]
        private string key = "";

        /// <summary>Sets the bank and the key of the clip.</summary>
        public void Set(LipzBank clipBank, string clipKey)
        {
            bank = clipBank;
            key = clipKey;
        }

        /// <summary>The clip can start late, be cut off, and be played at a different speed.</summary>
        public ClipCaps clipCaps
        {
            get { return ClipCaps.ClipIn | ClipCaps.SpeedMultiplier; }
        }

        /// <summary>The length of the clip in seconds.</summary>
        public override double duration
        {
            get
            {
                Clip clip = Find();
                ulong us = clip == null ? 0 : clip.DurationUs.GetValueOrDefault();
                return us == 0 ? base.duration : us / MicrosPerSecond;
            }
        }

        /// <summary>Makes the playable of the clip.</summary>
        public override Playable CreatePlayable(PlayableGraph graph, GameObject owner)
        {
            ScriptPlayable<LipzPlayable> playable = ScriptPlayable<LipzPlayable>.Create(graph);
            playable.GetBehaviour().Clip = Find();
            return playable;
        }

        private Clip Find()
        {
            return bank == null ? null : bank.Bank.Clip(key);
        }
    }
}
