using System;
using UnityEngine;
using UnityEngine.Events;

namespace Lipz
{
    /// <summary>
    /// Plays a clip along with an <see cref="AudioSource"/>: moves mouths, and reports events and subtitles. It follows
    /// the samples of the recording, so the sample rate of the output does not matter.
    /// </summary>
    [AddComponentMenu("Lipz/Lipz Player")]
    [DisallowMultipleComponent]
    public sealed class LipzPlayer : MonoBehaviour
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

        [SerializeField, Tooltip("Called after the last event of the clip.")]
        private UnityEvent onFinished = new UnityEvent();

        private ClipCursor cursor;
        private AudioClip recording;
        private bool followsAudio;
        private int position;
        private BankLocale textLocale;
        private int shownSegment = -1;
        private bool isAtRest;

        /// <summary>Like <see cref="OnEvent"/>, but with the whole event.</summary>
        public event Action<ClipEvent> Happened;

        /// <summary>The bank with the clips.</summary>
        public LipzBank BankAsset
        {
            get { return bank; }
            set { bank = value; }
        }

        /// <summary>The source that plays recordings.</summary>
        public AudioSource AudioSource
        {
            get { return audioSource; }
            set { audioSource = value; }
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
            get { return voice; }
            set { voice = value; }
        }

        /// <summary>The speaker of the next clip.</summary>
        public string Speaker
        {
            get { return speaker; }
            set { speaker = value; }
        }

        /// <summary>Called with each new subtitle, and with an empty string at the end.</summary>
        public SubtitleEvent OnSubtitle
        {
            get { return onSubtitle; }
        }

        /// <summary>Called with each event, exactly once, however long a rendered frame takes.</summary>
        public LipzClipEvent OnEvent
        {
            get { return onEvent; }
        }

        /// <summary>Called after the last event of the clip.</summary>
        public UnityEvent OnFinished
        {
            get { return onFinished; }
        }

        /// <summary>The position in the clip; null if no clip is playing.</summary>
        public ClipCursor Cursor
        {
            get { return cursor; }
        }

        /// <summary>Whether a clip is playing or paused.</summary>
        public bool IsPlaying
        {
            get { return cursor != null; }
        }

        /// <summary>
        /// Starts a clip, and its recording if there is an audio source. Returns false if the bank lacks the clip, or
        /// if the clip has no frame rate.
        /// </summary>
        public bool Play(string key, AudioClip audioClip = null)
        {
            Stop();
            Clip clip = bank == null ? null : bank.Bank.Clip(key);
            if (clip == null) return Failed("the bank has no clip \"" + key + "\"");
            BankVoice dub = string.IsNullOrEmpty(voice) ? null : clip.Bank.Voice(voice);
            if (dub != null) clip = clip.InVoice(dub, out VoiceSource _);
            if (!Begin(clip)) return Failed("the clip \"" + key + "\" has no frame rate");
            recording = audioClip;
            followsAudio = audioSource != null && audioClip != null;
            if (!followsAudio) return true;
            audioSource.clip = audioClip;
            audioSource.timeSamples = 0;
            audioSource.Play();
            return true;
        }

        /// <summary>
        /// Starts a clip for a clock of your own: call <see cref="AdvanceTo"/> in each rendered frame.
        /// </summary>
        public bool Begin(Clip clip)
        {
            Stop();
            ClipCursor started = clip.Cursor(string.IsNullOrEmpty(speaker) ? null : speaker);
            if (started == null) return false;
            cursor = started;
            cursor.LeadUs = (uint)clip.StartOfFrameUs(leadFrames).GetValueOrDefault();
            cursor.HoldFrames = holdConsonants ? clip.HoldFrames() : (byte)0;
            position = 0;
            shownSegment = -1;
            isAtRest = false;
            FindLocale();
            if (mouths.Length == 0) mouths = GetComponentsInChildren<LipzMouth>();
            foreach (LipzMouth mouth in mouths) mouth.Begin(clip);
            return true;
        }

        /// <summary>Cuts the clip off. The remaining events happen, so that lasting emotions take effect.</summary>
        public void Stop()
        {
            if (cursor == null) return;
            if (HasItsRecording()) audioSource.Stop();
            Finish();
        }

        /// <summary>Jumps to a position of the recording, in samples. Events in between do not happen.</summary>
        public void Seek(int timeSamples)
        {
            if (cursor == null || !HasItsRecording()) return;
            audioSource.timeSamples = timeSamples;
            position = timeSamples;
            cursor.Seek(ClipTime.Samples(timeSamples, (uint)recording.frequency));
        }

        /// <summary>Shows the clip at a time, for clocks other than an audio source.</summary>
        public void AdvanceTo(ClipTime time)
        {
            if (cursor == null) return;
            ClipCursor current = cursor;
            Handle(cursor.AdvanceTo(time));
            // An event may have stopped the clip, or started the next one.
            if (cursor != current) return;
            ShowAt(time);
            if (cursor.IsOver) Finish();
        }

        /// <summary>Shows the clip at a time without events, as when an editor scrubs.</summary>
        public void ShowAfterSeek(ClipTime time)
        {
            if (cursor == null) return;
            cursor.Seek(time);
            ShowAt(time);
        }

        /// <summary>Shows all mouths at rest, until the next time.</summary>
        public void Rest()
        {
            if (isAtRest) return;
            isAtRest = true;
            foreach (LipzMouth mouth in mouths)
            {
                if (mouth != null) mouth.Rest();
            }
        }

        // After animators, which would overwrite the blend shapes.
        private void LateUpdate()
        {
            if (cursor == null || !followsAudio) return;
            // Without its recording, or with a different one, the line is cut off.
            if (!HasItsRecording()) Finish();
            else if (IsListenerPaused()) Rest();
            else if (audioSource.isPlaying) Follow();
            else if (HasEnded()) Finish();
            else Rest();
        }

        private void OnDisable()
        {
            Rest();
        }

        /// <summary>Follows the audio, which may have looped.</summary>
        private void Follow()
        {
            int before = position;
            position = audioSource.timeSamples;
            ClipTime time = ClipTime.Samples(position, (uint)recording.frequency);
            bool hasLooped = audioSource.loop && position < before - recording.samples / 2;
            ClipCursor current = cursor;
            Handle(hasLooped ? cursor.LoopTo(time) : cursor.AdvanceTo(time));
            if (cursor == current) ShowAt(time);
        }

        private bool HasItsRecording()
        {
            return followsAudio && audioSource != null && recording != null && audioSource.clip == recording;
        }

        /// <summary>Whether a source that does not play is at its end. A paused one stays at its position.</summary>
        private bool HasEnded()
        {
            int now = audioSource.timeSamples;
            return now >= recording.samples || now == 0 && position > 0;
        }

        private bool IsListenerPaused()
        {
            return AudioListener.pause && !audioSource.ignoreListenerPause;
        }

        private void Handle(DueSegments due)
        {
            foreach (ClipEvent happened in due.Events)
            {
                if (Happened != null) Happened(happened);
                onEvent.Invoke(happened.Character ?? "", happened.VerbName, happened.Object ?? "");
            }
        }

        private void ShowAt(ClipTime time)
        {
            ShowSubtitle();
            if (cursor.IsOver)
            {
                Rest();
                return;
            }
            isAtRest = false;
            char viseme = cursor.Viseme;
            Who who = string.IsNullOrEmpty(speaker) ? default(Who) : Who.Speaker(speaker);
            foreach (LipzMouth mouth in mouths)
            {
                if (mouth != null) mouth.Show(cursor.Clip, time, viseme, who);
            }
        }

        private void ShowSubtitle()
        {
            Segment? segment = cursor.Segment;
            int index = segment == null ? -1 : segment.Value.Index;
            if (index == shownSegment) return;
            shownSegment = index;
            SegmentText? text = segment == null ? default(SegmentText?) : segment.Value.Text(textLocale);
            onSubtitle.Invoke(text == null ? "" : text.Value.Text);
        }

        private void Finish()
        {
            ClipCursor ended = cursor;
            Handle(ended.Finish());
            // An event may have started the next clip.
            if (cursor != ended) return;
            cursor = null;
            recording = null;
            followsAudio = false;
            Rest();
            if (shownSegment >= 0) onSubtitle.Invoke("");
            shownSegment = -1;
            onFinished.Invoke();
        }

        private void FindLocale()
        {
            Bank from = cursor.Clip.Bank;
            textLocale = (string.IsNullOrEmpty(locale) ? null : from.Locale(locale)) ?? from.DefaultLocale;
        }

        private bool Failed(string problem)
        {
            Debug.LogWarning(name + ": " + problem, this);
            return false;
        }
    }
}
