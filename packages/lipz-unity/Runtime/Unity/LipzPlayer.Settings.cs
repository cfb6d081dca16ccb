using System;
using UnityEngine;
using UnityEngine.Events;

namespace Lipz
{
    /// <summary>The settings of a player, which the inspector shows.</summary>
    public sealed partial class LipzPlayer
    {
        [SerializeField]
        private LipzBank bank;

        [SerializeField, Tooltip("The source that plays the recording. Empty: call AdvanceTo with your own clock.")]
        private AudioSource audioSource;

        [SerializeField, Tooltip("The mouths to move. Empty: those of this object and its children.")]
        private LipzMouth[] mouths = new LipzMouth[0];

        [SerializeField, Tooltip("The language of subtitles: de-de. Empty: the default locale of the bank.")]
        private string locale = "";

        [SerializeField, Tooltip("The language of dubs. Empty: the clip itself.")]
        private string voice = "";

        [SerializeField, Tooltip("The speaker, to whom events without a character belong.")]
        private string speaker = "";

        [SerializeField, Tooltip("The frames of the clip by which visemes are ahead of the audio.")]
        private uint leadFrames;

        [SerializeField, Tooltip("Shows consonants long enough to be read.")]
        private bool holdConsonants = true;

        [SerializeField]
        private SubtitleEvent onSubtitle = new SubtitleEvent();

        [SerializeField]
        private LipzClipEvent onEvent = new LipzClipEvent();

        [SerializeField, Tooltip("Called after a clip was played to its end.")]
        private UnityEvent onFinished = new UnityEvent();

        /// <summary>Like <see cref="OnEvent"/>, but with the whole event.</summary>
        public event Action<ClipEvent> Happened;

        /// <summary>The bank with the clips.</summary>
        public LipzBank BankAsset
        {
            get => bank;
            set => bank = value;
        }

        /// <summary>The source that plays recordings.</summary>
        public AudioSource AudioSource
        {
            get => audioSource;
            set => audioSource = value;
        }

        /// <summary>The language of subtitles. A change applies at once.</summary>
        public string Locale
        {
            get { return locale; }
            set
            {
                locale = value;
                if (cursor == null) return;
                FindLocale();
                shownSegment = -1;
                ShowSubtitle();
            }
        }

        /// <summary>The language of dubs, for the next clip.</summary>
        public string Voice
        {
            get => voice;
            set => voice = value;
        }

        /// <summary>The speaker of the next clip.</summary>
        public string Speaker
        {
            get => speaker;
            set => speaker = value;
        }

        /// <summary>Called with each new subtitle, and with an empty string at the end.</summary>
        public SubtitleEvent OnSubtitle => onSubtitle;

        /// <summary>Called with each event, exactly once, however long a rendered frame takes.</summary>
        public LipzClipEvent OnEvent => onEvent;

        /// <summary>Called after a clip was played to its end, but not after <see cref="Stop"/>.</summary>
        public UnityEvent OnFinished => onFinished;
    }
}
