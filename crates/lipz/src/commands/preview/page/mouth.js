// The visemes of a Lipz file: codes, and separately the starts of segments. Every change returns a new object.

const DELIMITER = "|";
const REST = "-";

export class Mouth {
  /** `codes` has one code per frame; `starts` has the first frame of each segment except the first. */
  constructor(codes, starts) {
    this.codes = codes;
    this.starts = starts;
  }

  #runs;

  /** Parses the element `visemes`. */
  static read(visemes) {
    const parts = visemes.split(DELIMITER).map((part) => Array.from(part.trim()));
    const starts = [];
    let frame = 0;
    for (const part of parts.slice(0, -1)) starts.push((frame += part.length));
    return new Mouth(parts.flat(), starts);
  }

  /** Returns the element `visemes`. */
  toString() {
    let text = "";
    let next = 0;
    for (let frame = 0; frame <= this.codes.length; frame++) {
      while (this.starts[next] === frame) {
        text += DELIMITER;
        next += 1;
      }
      text += this.codes[frame] ?? "";
    }
    return text;
  }

  /** Runs of one code: `{ code, start, end }`. */
  get runs() {
    return (this.#runs ??= this.#found());
  }

  #found() {
    const runs = [];
    this.codes.forEach((code, frame) => {
      const last = runs.at(-1);
      if (last?.code === code) last.end = frame + 1;
      else runs.push({ code, start: frame, end: frame + 1 });
    });
    return runs;
  }

  /** Returns the part of the spoken frames of a segment that comes before a frame; that of all frames if it rests. */
  shareBefore(segment, frame) {
    const [start, end] = [this.starts[segment - 1] ?? 0, this.starts[segment] ?? this.codes.length];
    const spoken = (from, to) => this.codes.slice(from, to).filter((code) => code !== REST).length;
    const all = spoken(start, end);
    return all > 0 ? spoken(start, frame) / all : (frame - start) / Math.max(1, end - start);
  }

  /** Returns the visemes with a different code in a frame; after the last frame, with an additional one. */
  typed(frame, code) {
    const codes = this.codes.slice();
    codes[Math.min(frame, codes.length)] = code;
    return new Mouth(codes, this.starts);
  }

  /** Returns the visemes without the last frame. */
  shorter() {
    const codes = this.codes.slice(0, -1);
    return new Mouth(codes, this.starts.map((start) => Math.min(start, codes.length)));
  }

  /** Returns the visemes with a segment start at a frame, or without it if one is there already. */
  divided(at) {
    const frame = Math.min(at, this.codes.length);
    const starts = this.starts.filter((start) => start !== frame);
    const isThere = starts.length < this.starts.length;
    return new Mouth(this.codes, isThere ? starts : [...starts, frame].sort((a, b) => a - b));
  }

  /** Returns the visemes with the edge between two runs at a different frame. Both runs keep at least one frame. */
  edge(from, to) {
    const runs = this.runs;
    const after = runs.findIndex(({ start }) => start === from);
    if (after < 1) return this;
    const place = Math.max(runs[after - 1].start + 1, Math.min(to, runs[after].end - 1));
    const codes = this.codes.slice();
    codes.fill(runs[after].code, Math.min(place, from), runs[after].end);
    codes.fill(runs[after - 1].code, runs[after - 1].start, place);
    return new Mouth(codes, this.starts);
  }

  /** Returns the visemes with a segment, from 1, starting at a different frame, between its neighbours. */
  start(segment, to) {
    const least = this.starts[segment - 2] ?? 0;
    const most = this.starts[segment] ?? this.codes.length;
    if (segment < 1 || segment > this.starts.length) return this;
    return new Mouth(this.codes, this.starts.with(segment - 1, Math.max(least, Math.min(to, most))));
  }
}
