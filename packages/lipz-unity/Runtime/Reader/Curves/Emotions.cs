using System;

namespace Lipz
{
    /// <summary>An attribute of emotion. The numbers are those of the bank format.</summary>
    public enum Emotion
    {
        /// <summary>Sadness.</summary>
        Sadness,

        /// <summary>Anger.</summary>
        Anger,

        /// <summary>Joy.</summary>
        Joy,

        /// <summary>Fear.</summary>
        Fear,

        /// <summary>Disgust.</summary>
        Disgust,

        /// <summary>Surprise.</summary>
        Surprise,

        /// <summary>Shock.</summary>
        Shock,

        /// <summary>Being perplexed.</summary>
        Perplexed,

        /// <summary>Being asleep.</summary>
        Asleep,

        /// <summary>Pain.</summary>
        Pain,

        /// <summary>Exertion.</summary>
        Exertion,

        /// <summary>Shouting.</summary>
        Shout,
    }

    /// <summary>The values of all emotions at a time, usually from 0 to 10.</summary>
    public sealed class Emotions
    {
        internal static readonly string[] Names =
        {
            "sadness", "anger", "joy", "fear", "disgust", "surprise", "shock", "perplexed", "asleep", "pain",
            "exertion", "shout",
        };

        internal readonly int[] Thousandths = new int[Names.Length];

        /// <summary>The value of an emotion.</summary>
        public float this[Emotion emotion]
        {
            get { return Thousandths[(int)emotion] / 1000f; }
            set { Thousandths[(int)emotion] = (int)Math.Round(value * 1000); }
        }

        /// <summary>The emotion with the highest value; null if none is above 0.</summary>
        public Emotion? Strongest
        {
            get
            {
                int found = -1, most = 0;
                for (int i = 0; i < Thousandths.Length; i++)
                {
                    if (Thousandths[i] <= most) continue;
                    most = Thousandths[i];
                    found = i;
                }
                return found < 0 ? default(Emotion?) : (Emotion)found;
            }
        }

        /// <summary>The sum of all values. Faces are made for at most 10.</summary>
        public float Sum
        {
            get
            {
                long sum = 0;
                foreach (int value in Thousandths) sum += value;
                return Math.Max(int.MinValue, Math.Min(int.MaxValue, sum)) / 1000f;
            }
        }
    }

    /// <summary>The emotions of a clip.</summary>
    public sealed partial class Clip
    {
        /// <summary>
        /// Returns the emotions of a character at a time. To allocate nothing, pass the object to fill.
        /// </summary>
        public Emotions EmotionsAt(ClipTime time, Who who = default(Who), Emotions into = null)
        {
            Emotions found = into ?? new Emotions();
            Array.Clear(found.Thousandths, 0, found.Thousandths.Length);
            if (!Rate.IsSpecified || OwnCurves.Length == 0) return found;
            FramePosition position = time.PositionIn(Rate);
            foreach (Curve curve in OwnCurves)
            {
                int emotion = curve.Purpose.Emotion;
                if (emotion < 0 || !curve.Purpose.BelongsTo(who)) continue;
                int value = curve.Thousandths(position);
                found.Thousandths[emotion] = Who.Farther(found.Thousandths[emotion], value, 0);
            }
            return found;
        }
    }
}
