// Playables of UnityEngine.
namespace UnityEngine.Playables
{
    public struct PlayableGraph
    {
    }

    public interface IPlayable
    {
    }

    public struct Playable : IPlayable
    {
        internal double Time;

        /// <summary>Makes a playable at a time, for tests.</summary>
        public static Playable At(double seconds)
        {
            return new Playable { Time = seconds };
        }
    }

    public static class PlayableExtensions
    {
        public static double GetTime(this Playable playable)
        {
            return playable.Time;
        }
    }

    public struct FrameData
    {
        public enum EvaluationType
        {
            Evaluate,
            Playback,
        }

        public EvaluationType evaluationType { get; set; }
    }

    public abstract class PlayableBehaviour
    {
        public virtual void ProcessFrame(Playable playable, FrameData info, object playerData)
        {
        }

        public virtual void OnBehaviourPause(Playable playable, FrameData info)
        {
        }
    }

    public struct ScriptPlayable<T> : IPlayable
        where T : PlayableBehaviour, new()
    {
        private T behaviour;

        /// <summary>The last one made, for tests.</summary>
        public static T Last { get; private set; }

        public static ScriptPlayable<T> Create(PlayableGraph graph, int inputCount = 0)
        {
            Last = new T();
            return new ScriptPlayable<T> { behaviour = Last };
        }

        public T GetBehaviour()
        {
            return behaviour;
        }

        public static implicit operator Playable(ScriptPlayable<T> playable)
        {
            return default(Playable);
        }
    }

    public abstract class PlayableAsset : ScriptableObject
    {
        public virtual double duration
        {
            get { return 5; }
        }

        public abstract Playable CreatePlayable(PlayableGraph graph, GameObject owner);
    }
}
