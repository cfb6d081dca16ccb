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

/** A bank of a stack: its bytes, or with those of a text bank whose locales it uses in place of its own. */
export type LayerBytes = Bytes | { readonly bank: Bytes; readonly texts?: Bytes };

/**
 * Opens and verifies a bank and the layers over it (`lipz pack --over`), the base first.
 *
 * @throws {LipzError} if one of them is damaged, or was packed over other banks than those before it.
 */
export function openLayers(files: readonly LayerBytes[], options?: OpenOptions): Promise<Layers>;

/**
 * Opens a set of banks by its index (`.lipzset`). `load` gives the bytes of a bank by the name of its file, which is beside the
 * index; it is called when a clip of that bank is asked for.
 *
 * @throws {LipzError} if the bytes are not an index.
 */
export function openSet(
  index: Bytes,
  load: (fileName: string) => Bytes | Promise<Bytes>,
  options?: OpenOptions,
): Promise<BankSet>;

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
  /**
   * Uses the locales of a text bank (`lipz pack --split-locales`) from now on, in place of those of the bank or of another
   * text bank. Gives the bank. @throws {LipzError} if it belongs to other clips.
   */
  useTexts(bytes: Bytes): this;
  /** The locales of the voices: that of the originals first. None in a bank without dubs. */
  readonly voices: string[];
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
  /** The babble profile with this name. */
  babble(name: string): Babble | undefined;
  /** The profile of the project, `[babble]` in its settings; that of the Second Life viewer if it has none. */
  readonly defaultBabble: Babble;
  /** The face profile with this name. */
  faceProfile(name: string): FaceProfile | undefined;
  /** The profile of the project, `[face]` in its settings; the usual one if it has none. */
  readonly defaultFaceProfile: FaceProfile;
}

/** What the index of a set says about a bank. */
export interface BankOfSet {
  readonly fileName: string;
  readonly clipCount: number;
  readonly lengthBytes: number;
  readonly fingerprint: bigint;
  readonly checksum: bigint;
}

/** Banks that answer as one. */
export class BankSet {
  private constructor();
  /** What the index says about each bank, in order. */
  readonly banks: readonly BankOfSet[];
  /** The number of clips in all banks. */
  readonly clipCount: number;
  readonly fingerprint: bigint;
  /** The number of the bank that has the clip with this key or id, if any bank has it. */
  bankNumberOf(keyOrId: string | bigint): number;
  /** The bank with this number, verified: loaded once, and again only if that fails. @throws {LipzError} */
  bank(number: number): Promise<Bank>;
  /** The clip with this key, or with this id if it is a bigint, of its bank. @throws {LipzError} */
  clip(keyOrId: string | bigint): Promise<Clip | undefined>;
}

/** A bank with patches, dubs and mods over it: the topmost of them answers, with a {@link Clip} as any other. */
export class Layers {
  private constructor();
  readonly layerCount: number;
  /** The tags of the locales, in their order. */
  readonly locales: string[];
  readonly defaultLocale: string | undefined;
  /** The clip with this key, or with this id if it is a bigint. */
  clip(keyOrId: string | bigint): Clip | undefined;
  /** All clips, in the order of their keys by code points. */
  clips(): Clip[];
  /** The locales of the voices: that of the originals first. None in a stack without dubs. */
  readonly voices: string[];
  /** The babble profile with this name. */
  babble(name: string): Babble | undefined;
  /** The profile of the project. */
  readonly defaultBabble: Babble;
  /** The face profile with this name, of the topmost layer that says something about profiles. */
  faceProfile(name: string): FaceProfile | undefined;
  /** The profile of the project. */
  readonly defaultFaceProfile: FaceProfile;
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
  /** The locale of the voice that the clip is spoken in; undefined in a bank without dubs. */
  readonly voice: string | undefined;
  /** The clip as it is played in a voice, and whose mouth it has; undefined if the bank has no such voice. */
  inVoice(tag: string): { clip: Clip; spoken: "original" | "dub" | "other-dub" } | undefined;
  /** The curve with this name, `jawOpen`; undefined if the clip has none. */
  curve(name: string): Curve | undefined;
  /** What the speaker feels at a time: neutral without curves of emotion, and without a frame rate. */
  emotionsAt(time: Time): Emotions;
  /**
   * What a character of the clip feels at a time: `mara feels fear 4` in its events is in the curve `mara.fear`. That of the
   * speaker has curves without a name, too.
   */
  emotionsOf(character: string, time: Time, settings?: { isSpeaker?: boolean }): Emotions;
  /**
   * The speaker's face at a time: generated from the time, the profile and the id of the clip, the same on every machine.
   * Curves of the clip win over what is generated. @throws {LipzError} with a profile of another bank.
   */
  faceAt(time: Time, settings?: FaceSettings): Face;
  /**
   * The face of a character of the clip at a time: with the curves that have the name in front, and blinks by their own
   * emotions. The head of somebody who listens moves for these curves and for what is looked at only. @throws {LipzError} with
   * a profile of another bank.
   */
  faceOf(character: string, time: Time, settings?: FaceSettings & { isSpeaker?: boolean }): Face;
  /** All curves, in the order of their names. */
  readonly curves: Curve[];
  /** The clip with this frame rate, where its file leaves it unspecified. */
  orFps(numerator: number, denominator?: number): Clip;
  /** The clip with this viseme type, where its file leaves it unspecified. */
  orVisemeType(type: VisemeType): Clip;
  /** A cursor that waits for the sound to begin. @throws {LipzError} without a frame rate. */
  cursor(settings?: CursorSettings): Cursor;
  /**
   * The cursor at the same time in this clip: of a newer version of the bank. Set its speaker again: names belong to
   * their bank.
   */
  resume(cursor: Cursor): Cursor;
  /** How far the mouth is open at a time, 0 to 0.99; undefined if the clip has no frames or no viseme type: let it babble. */
  opennessAt(time: Time): number | undefined;
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

/**
 * A number that changes while a clip plays: a blend shape, an emotion. Between two keys it changes evenly; outside of them it is
 * that of the first or last. Keep it while the clip plays: it remembers which key was needed last, so that the next picture
 * needs no search.
 */
export class Curve {
  private constructor();
  readonly name: string;
  readonly keyCount: number;
  /** In the order of their frames. Values are whole thousandths. */
  readonly keys: { readonly frame: number; readonly value: number }[];
  /** The value at the start of a frame. */
  value(frame: number): number;
  /** The value at a time; undefined without a frame rate. */
  valueAt(time: Time): number | undefined;
}

/** The attributes of emotion. */
export type Emotion =
  | "sadness"
  | "anger"
  | "joy"
  | "fear"
  | "disgust"
  | "surprise"
  | "shock"
  | "perplexed"
  | "asleep"
  | "pain"
  | "exertion"
  | "shout";

/** All attributes of emotion. */
export const EMOTIONS: readonly Emotion[];

export interface Emotions {
  /** 0 to 10, where the file says nothing else. */
  readonly values: Readonly<Record<Emotion, number>>;
  /** The attribute with the highest value; undefined for a neutral face. */
  readonly strongest: Emotion | undefined;
  /** The sum of all values. */
  readonly sum: number;
}

/** What a face does at a time, besides its mouth and its emotions. Angles are in degrees. */
export interface Face {
  /** How far the lids are closed: 0 to 1. */
  readonly blink: number;
  /** How far the head is raised; negative if it is lowered. */
  readonly headPitch: number;
  /** How far the head is turned to the left of the character. */
  readonly headYaw: number;
  /** How far the head is tilted towards the left shoulder. */
  readonly headRoll: number;
  /** How far the eyes are raised in the head. */
  readonly eyePitch: number;
  /** How far the eyes are turned in the head. */
  readonly eyeYaw: number;
  /** How far the brows are raised: 0 to 1. Only curves raise them. */
  readonly brows: number;
  /** A shrug of the face, 0 to 1. Only curves make one. */
  readonly shrug: number;
  /** How hard somebody breathes: 0 to 10. Only curves say so. */
  readonly breath: number;
}

export interface FaceSettings {
  /** How the face moves; that of the project without it. */
  profile?: FaceProfile;
  /** What is looked at; somebody straight ahead without it. */
  lookAt?: LookAt;
}

/** A direction in degrees, as seen from the head at rest. */
export interface LookAt {
  /** How far up it is. */
  pitch: number;
  /** How far to the left of the character it is. */
  yaw: number;
  /** Whether it is somebody, over whose face, hands and body the eyes go (without it, it is), or something that they stay on. */
  isPerson?: boolean;
}

/** How a face moves by itself. */
export class FaceProfile {
  private constructor();
  readonly name: string;
  /** The face of somebody who says nothing, at a time since anything. The seed tells them apart from others. */
  idleAt(time: Time, settings?: { seed?: number | bigint; lookAt?: LookAt }): Face;
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
  readonly verb:
    | "feels" | "sees" | "stares" | "stops staring" | "points" | "stops pointing" | "does"
    | "nods" | "shakes" | "breathes" | "blinks" | "looks away";
  /** The emotion, target or action; the number of a gesture, as it is written; undefined where there is none. */
  readonly object: string | undefined;
}

export interface CursorSettings {
  /** How far mouth shapes are ahead of the sound: seconds, or one or two frames of the clip. */
  lead?: number | { readonly us: number } | { readonly frames: 1 | 2 };
  /**
   * How many frames a consonant shows at least; `"readable"` is two frames at 24 fps, `{ picture: 1 / 60 }` as long as a
   * display shows one picture, in seconds.
   */
  hold?: number | "readable" | { readonly picture: number };
  /** Who speaks, so whose events name no character. */
  speaker?: string | undefined;
}

/**
 * Where a clip is while it is played. Once per picture, call `advanceTo` with the position of the sound, and draw what the
 * other members say. docs/PLAYBACK.md has a table of what happens when time goes on, stands still, jumps, loops and ends.
 */
export class Cursor {
  private constructor();
  readonly clip: Clip;
  /** In seconds. */
  get lead(): number;
  set lead(lead: NonNullable<CursorSettings["lead"]>);
  /** In frames. */
  get hold(): number;
  set hold(hold: NonNullable<CursorSettings["hold"]>);
  speaker: string | undefined;
  /**
   * The sound has reached a time. Gives what has begun since the last call, each once, however long ago: also segments
   * without frames. What you drop does not come again.
   */
  advanceTo(time: Time): Due;
  /** The sound has jumped from its end to its start and has reached a time since: what was left, then what has begun. */
  loopTo(time: Time): Due;
  /** Jumps, forward or back. Nothing is due; the next `advanceTo` starts with what begins in the frame of this time. */
  seek(time: Time): void;
  /** Ends the clip before the sound does, as when a player skips it: gives what was left. */
  finish(): Due;
  /** The frame at the position of the sound; undefined before the start and from the end on. */
  readonly frame: number | undefined;
  /** Whether the sound is past the last frame. Then everything has been due. */
  readonly isOver: boolean;
  /** The mouth shape to draw, with lead and hold. */
  readonly viseme: Viseme;
  /** How far that mouth is open, 0 to 0.99; undefined if the clip has no mouth shapes: let it babble. */
  readonly openness: number | undefined;
  /** The segment whose subtitle to show; undefined before the start and from the end on. */
  readonly segment: Segment | undefined;
  /** What a character feels, stares and points at; without a name, the speaker. */
  state(character?: string): Character;
  /** Every character that an event of the clip is about, with its state: what to set after a jump. */
  characters(): Character[];
}

/** What a move has made due. */
export interface Due {
  /** The events in order, if they are Character Event Syntax; those that name no character are the speaker's. */
  readonly events: Event[];
  /** The segments in order: for event strings in another syntax. */
  readonly segments: Segment[];
}

/** A member is undefined if no event has said anything: it is as it was before the clip. */
export interface Character {
  /** Undefined for a speaker that the cursor does not know. */
  readonly name: string | undefined;
  readonly feels: string | undefined;
  readonly staresAt: string | undefined;
  readonly pointsAt: string | undefined;
}

/** The power of a voice that nobody measures. */
export const UNMEASURED: number;

/** A babble profile: what moves the mouth of a voice without mouth shapes. */
export class Babble {
  private constructor();
  readonly name: string;
  /**
   * How far lips are pursed (`ooh`) and the jaw is open (`aah`), 0 to 0.99, so long after somebody has begun to speak, at
   * a power of the voice from 0 to 1.
   */
  at(elapsed: Time, power?: number): { readonly ooh: number; readonly aah: number };
}
