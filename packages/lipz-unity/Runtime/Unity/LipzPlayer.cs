using UnityEngine;

namespace Lipz
{
    /// <summary>
    /// Plays a clip along with an <see cref="AudioSource"/>: moves mouths, and reports events and subtitles. It follows
    /// the samples of the recording, so the sample rate of the output does not matter.
    /// </summary>
    [AddComponentMenu("Lipz/Lipz Player")]
    [DisallowMultipleComponent]
    public sealed partial class LipzPlayer : MonoBehaviour
    {
        private ClipCursor cursor;
        private RecordingClock clock;
        private BankLocale textLocale;
        private int shownSegment = -1;
        private bool isAtRest;

        /// <summary>The position in the clip; null if no clip is playing.</summary>
        public ClipCursor Cursor => cursor;

        /// <summary>Whether a clip is playing or paused.</summary>
        public bool IsPlaying => cursor != null;

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
            if (audioSource == null || audioClip == null) return true;
            clock = new RecordingClock(audioSource, audioClip);
            clock.Play();
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
            if (clock != null) clock.Stop();
            CutOff();
        }

        /// <summary>Jumps to a position of the recording, in samples. Events in between do not happen.</summary>
        public void Seek(int timeSamples)
        {
            if (cursor == null || clock == null) return;
            clock.Seek(timeSamples);
            cursor.Seek(clock.Time);
        }

        /// <summary>Shows the clip at a time, for clocks other than an audio source.</summary>
        public void AdvanceTo(ClipTime time)
        {
            if (cursor == null) return;
            if (HandledAt(time, cursor.AdvanceTo(time)) && cursor.IsOver) Finish();
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
            if (cursor == null || clock == null) return;
            switch (clock.Read(out bool hasLooped))
            {
                case RecordingState.Playing:
                    ClipTime time = clock.Time;
                    HandledAt(time, hasLooped ? cursor.LoopTo(time) : cursor.AdvanceTo(time));
                    break;
                case RecordingState.Paused:
                    Rest();
                    break;
                case RecordingState.Ended:
                    Finish();
                    break;
                default:
                    CutOff();
                    break;
            }
        }

        private void OnDisable()
        {
            Rest();
        }

        /// <summary>
        /// Handles due events, and shows the clip. Returns false if an event has stopped it, or started the next one.
        /// </summary>
        private bool HandledAt(ClipTime time, DueSegments due)
        {
            ClipCursor current = cursor;
            Handle(due);
            if (cursor != current) return false;
            ShowAt(time);
            return cursor == current;
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
            ClipCursor current = cursor;
            ShowSubtitle();
            if (cursor != current) return;
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

        /// <summary>Ends the clip. Returns false if one of its last events has started the next one.</summary>
        private bool CutOff()
        {
            ClipCursor ended = cursor;
            Handle(ended.Finish());
            if (cursor != ended) return false;
            cursor = null;
            clock = null;
            Rest();
            bool hasSubtitle = shownSegment >= 0;
            shownSegment = -1;
            if (hasSubtitle) onSubtitle.Invoke("");
            return cursor == null;
        }

        private void Finish()
        {
            if (CutOff()) onFinished.Invoke();
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
