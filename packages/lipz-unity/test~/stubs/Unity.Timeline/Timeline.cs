// The part of com.unity.timeline that the package uses.
using System;

namespace UnityEngine.Timeline
{
    public abstract class TrackAsset : Playables.PlayableAsset
    {
        public override Playables.Playable CreatePlayable(Playables.PlayableGraph graph, GameObject owner)
        {
            return default(Playables.Playable);
        }
    }

    [Flags]
    public enum ClipCaps
    {
        None = 0,
        ClipIn = 4,
        SpeedMultiplier = 8,
    }

    public interface ITimelineClipAsset
    {
        ClipCaps clipCaps { get; }
    }

    public sealed class TrackColorAttribute : Attribute
    {
        public TrackColorAttribute(float r, float g, float b)
        {
        }
    }

    public sealed class TrackClipTypeAttribute : Attribute
    {
        public TrackClipTypeAttribute(Type clipClass)
        {
        }
    }

    public sealed class TrackBindingTypeAttribute : Attribute
    {
        public TrackBindingTypeAttribute(Type type)
        {
        }
    }
}
