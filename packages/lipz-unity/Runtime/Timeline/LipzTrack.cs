using UnityEngine.Timeline;

namespace Lipz
{
    /// <summary>A track of Timeline that moves the mouths of a <see cref="LipzPlayer"/>.</summary>
    [TrackColor(0.85f, 0.35f, 0.4f)]
    [TrackClipType(typeof(LipzTimelineClip))]
    [TrackBindingType(typeof(LipzPlayer))]
    public sealed class LipzTrack : TrackAsset
    {
    }
}
