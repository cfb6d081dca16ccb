// The clock of a clip: the one of its audio, so that mouth and sound cannot drift apart.
//
// The fixtures have no recordings, so a hum is made up that is as loud as the mouth is open. Where
// audio cannot be played, the clock of the page goes on alone.

const HUM_HZ = 140;
const LOUDEST = 0.12;

export class Clock {
  #audio;
  #source;
  #startedAt = 0;
  #offset = 0;
  #playing = false;

  get playing() {
    return this.#playing;
  }

  /** Whether the time is that of audio. */
  get isAudio() {
    return this.#audio?.state === "running";
  }

  /** Seconds since the audio of the clip began. */
  get time() {
    return this.#playing ? this.#offset + this.#now() - this.#startedAt : this.#offset;
  }

  /** Plays from a time on; `loudness` has a number from 0 to 1 for every frame. */
  async play(time, duration, loudness) {
    this.pause();
    this.#audio ??= newAudio();
    await resumed(this.#audio);
    if (this.isAudio) {
      this.#source = this.#audio.createBufferSource();
      this.#source.buffer = hum(this.#audio, duration, loudness);
      this.#source.connect(this.#audio.destination);
      this.#source.start(0, time);
    }
    this.#offset = time;
    this.#startedAt = this.#now();
    this.#playing = true;
  }

  pause(time = this.time) {
    this.#source?.stop();
    this.#source = undefined;
    this.#offset = time;
    this.#playing = false;
  }

  #now() {
    return this.isAudio ? this.#audio.currentTime : performance.now() / 1000;
  }
}

function newAudio() {
  try {
    return new AudioContext();
  } catch {
    return undefined;
  }
}

/** Waits until audio runs, but not for ever: a browser may forbid it, or have no device. */
function resumed(audio) {
  const soon = new Promise((resolve) => setTimeout(resolve, 500));
  return Promise.race([audio?.resume().catch(() => {}), soon]);
}

function hum(audio, duration, loudness) {
  const rate = audio.sampleRate;
  const buffer = audio.createBuffer(1, Math.max(1, Math.ceil(duration * rate)), rate);
  const samples = buffer.getChannelData(0);
  let volume = 0;
  samples.forEach((_, index) => {
    const frame = Math.floor((index / samples.length) * loudness.length);
    volume += ((loudness[frame] ?? 0) - volume) * 0.002;
    const phase = (2 * Math.PI * HUM_HZ * index) / rate;
    samples[index] = LOUDEST * volume * (Math.sin(phase) + 0.4 * Math.sin(2 * phase) + 0.2 * Math.sin(3 * phase));
  });
  return buffer;
}
