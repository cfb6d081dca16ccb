/** Reader of lipz dialogue banks: bytes → {@link Bank} → {@link Clip} → {@link Segment}. */

/** Where the bytes of a bank are. They are copied. */
export type Bytes = ArrayBuffer | ArrayBufferView;

/**
 * A point in time since the audio of a clip began: in seconds, as the clocks of browsers tell it, in
 * microseconds, or as a position in samples. Times outside of the clip lead to no frame, and so to rest.
 */
export type Time =
  | number
  | { readonly us: number | bigint }
  | { readonly position: number | bigint; readonly rateHz: number };

export type VisemeType = "blair" | "toonboom" | "rms";

/** A mouth shape: one character of the viseme type; `-` is rest in all three. */
export type Viseme = string;

export interface OpenOptions {
  /** The reader, if `lipz.wasm` is not beside `lipz.js`: its bytes, or compiled. */
  readonly wasm?: WebAssembly.Module | BufferSource;
}

/**
 * Opens a bank: checks header and directory, in a time that does not depend on the number of clips.
 *
 * @throws {LipzError} if the bytes are not a bank of a known version, or were cut off.
 */
export function open(bytes: Bytes, options?: OpenOptions): Promise<Bank>;

/** A file that is refused, or a call that makes no sense. */
export class LipzError extends Error {
  /** The number of the status in lipz.h. */
  readonly status?: number;
  /** Where the damage is: bytes from the start of the file. */
  readonly offsetBytes?: number;
}

export class Bank {
  private constructor();
  /** Checks every byte and reference, of the text bank too. Gives the bank. @throws {LipzError} */
  verify(): this;
  /** Uses the locales of a text bank from now on. Gives the bank. @throws {LipzError} */
  useTexts(bytes: Bytes): this;
  readonly clipCount: number;
  /** Hash of what the clips are: a bank and its text banks share it. */
  readonly fingerprint: bigint;
  /** The tags of the locales, in their order: `en-us`. */
  readonly locales: string[];
  readonly defaultLocale: string | undefined;
  /** The clip with this key, or with this id if it is a bigint. */
  clip(keyOrId: string | bigint): Clip | undefined;
  /** The clip in a slot, a number below `clipCount`. */
  clipAt(slot: number): Clip | undefined;
  /** All clips, in the order of their keys by code points, as in the bank. */
  clips(): Clip[];
}

export class Clip {
  private constructor();
  readonly id: bigint;
  /** The path of the Lipz file below its source root, without extension. */
  readonly key: string;
  /** The frame codes, one character per frame. */
  readonly frames: string;
  readonly frameCount: number;
  /** Frames per second as an exact ratio; undefined if unspecified. */
  readonly fps: { readonly numerator: number; readonly denominator: number } | undefined;
  readonly visemeType: VisemeType | undefined;
  readonly hasVisemes: boolean;
  readonly hasEvents: boolean;
  /** The length in seconds; undefined without a frame rate. */
  readonly duration: number | undefined;
  readonly segments: Segment[];
  /** The recording that the clip was made for; undefined if the bank says nothing about it. */
  readonly recording: Recording | undefined;
  /** The clip with this frame rate, where its file leaves it unspecified. */
  orFps(numerator: number, denominator?: number): Clip;
  /** The second at which a frame starts to show; undefined without a frame rate. */
  startOfFrame(frame: number): number | undefined;
  /** The viseme of a frame; rest outside of the clip. */
  viseme(frame: number): Viseme;
  /** The frame that shows at a time; undefined outside of the clip. */
  frameAt(time: Time): number | undefined;
  /** The viseme that shows at a time; rest outside of the clip. */
  visemeAt(time: Time): Viseme;
  /** The segment at a time; undefined outside of the clip. */
  segmentAt(time: Time): Segment | undefined;
  segment(index: number): Segment | undefined;
}

export interface Recording {
  /** The length in seconds. */
  readonly duration: number;
  /** XXH3, 64 bits with seed 0, of all bytes of the file. */
  readonly contentHash: bigint;
}

export class Segment {
  private constructor();
  /** Its place in the clip, from 0. */
  readonly index: number;
  readonly startFrame: number;
  /** The frame behind its last one. */
  readonly endFrame: number;
  /** The text in a locale of the bank; undefined if the clip has none, also by fallback. */
  text(locale: string): Text | undefined;
  /** The event string; undefined if the file has no events, empty if nothing happens. */
  readonly event: string | undefined;
  /** The events, if they are Character Event Syntax. */
  readonly events: Event[];
}

export interface Text {
  /** As a player sees it. */
  readonly text: string;
  /** Whether the clip has no text of its own in the locale, and this is that of another one. */
  readonly isFallback: boolean;
}

export interface Event {
  /** Who; undefined for the speaker of the clip. */
  readonly character: string | undefined;
  readonly verb: "feels" | "sees" | "stares" | "stops staring" | "points" | "stops pointing" | "does";
  /** The emotion, target or action. */
  readonly object: string | undefined;
}
