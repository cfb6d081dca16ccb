// The clock of a clip: that of its recording during playback, so that mouth and audio cannot drift apart. Without a
// recording, and backwards, it is the clock of the page.

/** The time to wait for audio, because a browser may block it or have no device. */
const PATIENCE_MS = 500;

export class Clock {
  #audio;
  #buffer;
  #source;
  #offset = 0;
  #startedAt = 0;
  #rate = 0;
  #loop;

  get playing() {
    return this.#rate !== 0;
  }

  /** The playback speed: 1 for normal, 0 for paused, negative for backwards. */
  get rate() {
    return this.#rate;
  }

  /** Whether the time comes from the recording. */
  get isAudio() {
    return this.#source !== undefined;
  }

  /** Seconds since the start of the recording. */
  get time() {
    if (!this.playing) return this.#offset;
    const time = this.#offset + Math.max(0, this.#now() - this.#latency - this.#startedAt) * this.#rate;
    const { start, end } = this.#loop ?? {};
    return this.#loop && this.#rate > 0 && time >= end ? start + ((time - start) % (end - start)) : Math.max(0, time);
  }

  /** Decodes the samples of a recording. */
  async decode(bytes) {
    this.#audio ??= new AudioContext();
    return this.#audio.decodeAudioData(bytes);
  }

  /** Takes the recording of a different clip; undefined for none. */
  load(buffer) {
    const { time, rate } = this;
    this.pause();
    this.#buffer = buffer;
    this.#offset = time;
    if (rate !== 0) this.#begin(rate);
  }

  /** Plays from the current time. */
  async play(rate) {
    this.pause();
    if (this.#buffer) {
      this.#audio ??= new AudioContext();
      await Promise.race([this.#audio.resume().catch(() => {}), new Promise((done) => setTimeout(done, PATIENCE_MS))]);
    }
    this.#begin(rate);
  }

  pause(time = this.time) {
    this.#source?.stop();
    this.#source = undefined;
    this.#offset = time;
    this.#rate = 0;
  }

  /** Jumps to a time; continues playing. */
  seek(time) {
    const rate = this.#rate;
    this.pause(time);
    if (rate !== 0) this.#begin(rate);
  }

  /** Sets the seconds between which to loop; undefined for the whole clip. */
  set loop(loop) {
    const { time } = this;
    this.#loop = loop;
    if (this.playing) this.seek(loop && (time < loop.start || time >= loop.end) ? loop.start : time);
  }

  #begin(rate) {
    const canSound = this.#buffer && rate > 0 && this.#audio?.state === "running" && this.#offset < this.#buffer.duration;
    if (canSound) {
      const source = this.#audio.createBufferSource();
      source.buffer = this.#buffer;
      source.playbackRate.value = rate;
      if (this.#loop) Object.assign(source, { loop: true, loopStart: this.#loop.start, loopEnd: this.#loop.end });
      source.connect(this.#audio.destination);
      source.start(0, this.#offset);
      this.#source = source;
    }
    this.#startedAt = this.#now();
    this.#rate = rate;
  }

  /** The audio latency in seconds. That of wireless headphones is visible. */
  get #latency() {
    return (this.isAudio && this.#audio.outputLatency) || 0;
  }

  #now() {
    return this.isAudio ? this.#audio.currentTime : performance.now() / 1000;
  }
}
