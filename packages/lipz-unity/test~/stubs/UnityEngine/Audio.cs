// Audio of UnityEngine. The source plays at the rate of the output, and counts samples of its clip.
using System;

namespace UnityEngine
{
    public sealed class AudioClip : Object
    {
        public int samples { get; private set; }

        public int frequency { get; private set; }

        public static AudioClip Create(string name, int lengthSamples, int channels, int frequency, bool stream)
        {
            return new AudioClip { name = name, samples = lengthSamples, frequency = frequency };
        }
    }

    public static class AudioListener
    {
        public static bool pause { get; set; }
    }

    public sealed class AudioSource : Behaviour
    {
        private double position;
        private AudioClip ownClip;

        /// <summary>Like the engine, stops when the clip changes.</summary>
        public AudioClip clip
        {
            get
            {
                return ownClip;
            }
            set
            {
                if (ownClip != value) Stop();
                ownClip = value;
            }
        }

        public bool isPlaying { get; private set; }

        public bool loop { get; set; }

        public bool ignoreListenerPause { get; set; }

        public int timeSamples
        {
            get { return (int)Math.Floor(position + 1e-6); }
            set { position = value; }
        }

        public void Play()
        {
            isPlaying = clip != null;
        }

        public void Pause()
        {
            isPlaying = false;
        }

        public void UnPause()
        {
            isPlaying = clip != null;
        }

        public void Stop()
        {
            isPlaying = false;
            position = 0;
        }

        /// <summary>Plays this many samples of the output, for tests.</summary>
        public void Output(int outputSamples, int outputRateHz)
        {
            if (!isPlaying || AudioListener.pause && !ignoreListenerPause) return;
            position += (double)outputSamples * clip.frequency / outputRateHz;
            if (position < clip.samples) return;
            if (loop) position -= clip.samples;
            else Stop();
        }
    }
}
