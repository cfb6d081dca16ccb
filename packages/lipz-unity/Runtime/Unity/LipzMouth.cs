using UnityEngine;

namespace Lipz
{
    /// <summary>A mouth that a <see cref="LipzPlayer"/> moves. Derive from it to move a mouth of your own.</summary>
    public abstract class LipzMouth : MonoBehaviour
    {
        /// <summary>Prepares the mouth for a clip, which is about to play.</summary>
        public abstract void Begin(Clip clip);

        /// <summary>
        /// Shows the mouth at a time of the clip. <paramref name="viseme"/> has the lead and the hold of the player.
        /// </summary>
        public abstract void Show(Clip clip, ClipTime time, char viseme, Who speaker);

        /// <summary>Shows the mouth at rest.</summary>
        public abstract void Rest();
    }
}
