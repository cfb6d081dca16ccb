using UnityEngine;

namespace Lipz
{
    /// <summary>The state of a recording in an audio source.</summary>
    internal enum RecordingState
    {
        /// <summary>The source no longer has the recording.</summary>
        Gone,

        /// <summary>The recording stands still.</summary>
        Paused,

        /// <summary>The recording plays.</summary>
        Playing,

        /// <summary>The recording was played to its end, or stopped.</summary>
        Ended,
    }

    /// <summary>
    /// The time of a recording, in its own samples. <c>AudioSource.time</c> is less exact, and the clock of the output
    /// runs at a different rate.
    /// </summary>
    internal sealed class RecordingClock
    {
        private readonly AudioSource source;
        private readonly AudioClip recording;
        private int position;

        internal RecordingClock(AudioSource source, AudioClip recording)
        {
            this.source = source;
            this.recording = recording;
        }

        /// <summary>The time at the last reading.</summary>
        internal ClipTime Time
        {
            get { return ClipTime.Samples(position, (uint)recording.frequency); }
        }

        internal void Play()
        {
            source.clip = recording;
            source.timeSamples = 0;
            source.Play();
        }

        /// <summary>Stops the source, if it still has the recording.</summary>
        internal void Stop()
        {
            if (HasRecording) source.Stop();
        }

        internal void Seek(int timeSamples)
        {
            position = timeSamples;
            if (HasRecording) source.timeSamples = timeSamples;
        }

        /// <summary>Reads the state and, if the recording plays, the time.</summary>
        internal RecordingState Read(out bool hasLooped)
        {
            hasLooped = false;
            if (!HasRecording) return RecordingState.Gone;
            if (AudioListener.pause && !source.ignoreListenerPause) return RecordingState.Paused;
            int now = source.timeSamples;
            if (!source.isPlaying)
            {
                // At its end, a source returns to 0. A paused one stays at its position.
                bool hasEnded = now >= recording.samples || now == 0 && position > 0;
                return hasEnded ? RecordingState.Ended : RecordingState.Paused;
            }
            hasLooped = source.loop && now < position - recording.samples / 2;
            position = now;
            return RecordingState.Playing;
        }

        private bool HasRecording
        {
            get { return source != null && recording != null && source.clip == recording; }
        }
    }
}
