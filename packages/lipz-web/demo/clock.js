// The clock of a clip, which is that of its audio, so that mouth and audio cannot drift apart.
//
// Banks do not contain recordings, so the demo generates a hum whose loudness follows the openness of the mouth. If
// audio cannot be played, the clock of the page is used instead.

const HUM_HZ = 140;
const LOUDEST = 0.12;
/** The sample rate of the hum, the lowest that browsers accept. */
const RATE_HZ = 8000;
/** The part of the way to the loudness of its frame that the hum moves per sample. */
const SMOOTH = 0.012;

export class Clock {
  #audio;
  #source;
  #hum;
  #loudness = [];
  #duration = 0;
  #startedAt = 0;
  #offset = 0;
  #playing = false;

  get playing() {
    return this.#playing;
  }

  /** Whether audio provides the time. */
  get isAudio() {
    return this.#audio?.state === "running";
  }

  /** Seconds since the start of the audio of the clip. */
  get time() {
    return this.#playing ? this.#offset + this.#now() - this.#startedAt : this.#offset;
  }

  /** Changes the clip. `loudness` has a number from 0 to 1 for every frame. */
  load(duration, loudness) {
    [this.#duration, this.#loudness, this.#hum] = [duration, loudness, undefined];
  }

  /** Continues playing. */
  async play() {
    this.pause();
    this.#audio ??= newAudio();
    await resumed(this.#audio);
    this.#begin();
  }

  pause(time = this.time) {
    this.#source?.stop();
    this.#source = undefined;
    this.#offset = time;
    this.#playing = false;
  }

  /** Jumps, and continues playing there if it was playing. */
  seek(time) {
    const isPlaying = this.#playing;
    this.pause(time);
    if (isPlaying) this.#begin();
  }

  #begin() {
    if (this.isAudio) {
      this.#hum ??= hum(this.#audio, this.#duration, this.#loudness);
      this.#source = this.#audio.createBufferSource();
      this.#source.buffer = this.#hum;
      this.#source.connect(this.#audio.destination);
      this.#source.start(0, this.#offset);
    }
    this.#startedAt = this.#now();
    this.#playing = true;
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

/** Waits until audio runs, with a time limit, because a browser may forbid audio or have no device. */
function resumed(audio) {
  const soon = new Promise((resolve) => setTimeout(resolve, 500));
  return Promise.race([audio?.resume().catch(() => {}), soon]);
}

function hum(audio, duration, loudness) {
  const buffer = audio.createBuffer(1, Math.max(1, Math.ceil(duration * RATE_HZ)), RATE_HZ);
  const samples = buffer.getChannelData(0);
  let volume = 0;
  for (let index = 0; index < samples.length; index++) {
    const frame = Math.floor((index / samples.length) * loudness.length);
    volume += ((loudness[frame] ?? 0) - volume) * SMOOTH;
    const phase = (2 * Math.PI * HUM_HZ * index) / RATE_HZ;
    samples[index] = LOUDEST * volume * (Math.sin(phase) + 0.4 * Math.sin(2 * phase) + 0.2 * Math.sin(3 * phase));
  }
  return buffer;
}
