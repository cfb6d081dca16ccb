/**
 * Reader of lipz dialogue banks: files → {@link Dialogue} → {@link Clip} → {@link Segment}, and a {@link Cursor} that
 * follows the audio.
 *
 * Names and the order of arguments are those of the Rust crate `lipz-bank`: the time, who, the profile, options.
 */

/** Bytes of a file. They are copied. */
export type Bytes = ArrayBuffer | SharedArrayBuffer | ArrayBufferView;

/**
 * A file of a dialogue:
 *
 * * a URL, as a string or an object; in browsers relative to the page, in node a string without a scheme is a path;
 * * its bytes, with a name that error messages show and by which the index of a set finds its banks, or without one.
 */
export type Source = string | URL | Bytes | { readonly name: string; readonly bytes: Bytes };

/** How files are opened. */
export interface OpenOptions {
  /**
   * Whether every byte and every reference of the files is checked; true by default. Without that, opening takes a time
   * that does not depend on the number of clips. A damaged file may then have wrong answers, but no query reads outside
   * of the files.
   */
  readonly verify?: boolean;
  /**
   * Reads a bank of a set by the name of its file, in place of the file next to the index. Needed for an index that is
   * given as bytes, unless the banks are in the list of files.
   */
  readonly load?: (fileName: string) => Bytes | Promise<Bytes>;
  /** The module, if `lipz.wasm` is not next to `lipz.js`: its path or URL, its bytes, or compiled. */
  readonly wasm?: string | URL | BufferSource | WebAssembly.Module;
}

/**
 * Opens files as one dialogue.
 *
 * Name them from the bottom to the top: the base first, which is a bank or the index of a set; then patches,
 * downloads, mods and the dubs of a voice, each after those that it was packed over, and text banks, each after the
 * bank of its clips. The kind of a file is in its header.
 *
 * The banks of a set are next to its index. The first of them is loaded at once, because it has the locales and
 * profiles; each of the others with {@link Dialogue.loadClip}.
 *
 * @throws {LipzError} for the first file that cannot be read, is damaged, or does not fit those before it.
 */
export function openDialogue(files: readonly Source[], options?: OpenOptions): Promise<Dialogue>;

/** A file that cannot be used, or a call that makes no sense. The message has everything that the members have. */
export class LipzError extends Error {
  private constructor();
  /** The name of the file: its path or URL, the name that was given, or `files[1]` for bytes without one. */
  readonly file: string | undefined;
  /** The number of the status in lipz.h; undefined if the file could not be read. */
  readonly status: number | undefined;
  /** Where the damage is: bytes from the start of the file. */
  readonly offsetBytes: number | undefined;
  /** What to do about it. */
  readonly remedy: string | undefined;
}

/**
 * A locale of a dialogue. In another dialogue it leads to nothing, so look it up again when you have opened the files
 * again.
 */
export class Locale {
  private constructor();
  /** As in the element `text_en-us` of a Lipz file: `en-us`. */
  readonly tag: string;
  /** Whether it is the default locale. */
  readonly isDefault: boolean;
}

/** A voice: a language in which lines are recorded. It is that of one dialogue, as a {@link Locale} is. */
export class Voice {
  private constructor();
  /** The tag of its locale: `de-de`. */
  readonly tag: string;
  /** Whether it is the voice of the original recordings. */
  readonly isOriginal: boolean;
}

/** A file of a dialogue. */
export interface DialogueFile {
  /** Its path or URL, or the name that was given. */
  readonly name: string;
  /** `absent` for a bank of a set that is not loaded. */
  readonly kind: "absent" | "bank" | "patch" | "texts" | "set";
  /** The checksum in its header: files of different contents have different ones. 0 if it is absent. */
  readonly checksum: bigint;
}

/**
 * Files that answer as one bank: a bank or a set of banks, the patches over it, and text banks. The topmost file that
 * has a clip answers.
 *
 * A dialogue has a memory of its own, which is freed with it: there is nothing to close. To add files or to replace
 * them, open the new list, look up locales and voices again, and continue each {@link Cursor} with {@link Clip.resume}.
 */
export class Dialogue {
  private constructor();
  /** The files from the bottom to the top, the banks of a set behind its index. */
  readonly files: DialogueFile[];
  /** The number of clips, also of those in banks that are not loaded. With patches, loaded clips are counted. */
  readonly clipCount: number;
  /**
   * The clip with this key (`act1/mayor`), or with this id if it is a bigint; undefined if no file has it.
   *
   * @throws {LipzError} with status 261 if the bank of the set that would have it is not loaded: call {@link
   * Dialogue.loadClip} before, such as with the scene.
   */
  clip(keyOrId: string | bigint): Clip | undefined;
  /**
   * Like {@link Dialogue.clip}, and loads the bank of a set that would have the clip. Each bank is loaded once; after a
   * failure, the next call tries again. Without a set, the promise is fulfilled at once. Clips and handles from before
   * remain valid.
   *
   * @throws {LipzError} if the bank cannot be read, is damaged, or is not the one that the index names.
   */
  loadClip(keyOrId: string | bigint): Promise<Clip | undefined>;
  /** Loads all banks of a set that are not loaded. @throws {LipzError} as {@link Dialogue.loadClip}. */
  loadAll(): Promise<void>;
  /**
   * All clips of loaded files, each once: file by file, in each in the order of their keys by code points. In a
   * dialogue of one bank that is the order of all keys.
   */
  clips(): Clip[];
  /** The clips whose keys start with `prefix`, in the same order: `act1/` gives those of a folder. */
  clipsUnder(prefix: string): Clip[];
  /**
   * The locale with this tag, spelled as in the files: `en-us`. Look it up once, and pass it to {@link Segment.text}.
   */
  locale(tag: string): Locale | undefined;
  /** All locales, in no order. */
  readonly locales: Locale[];
  /** The default locale: that of the topmost file that says which one it is. */
  readonly defaultLocale: Locale | undefined;
  /**
   * The voice in this locale. Undefined if there are no dubs, or the project names no such voice: play the clips as
   * they are. Throws a {@link LipzError} if none is found while a bank of a set is not loaded that may have it: call
   * {@link Dialogue.loadAll}, or ask again with the first clip.
   */
  voice(tag: string): Voice | undefined;
  /** The voices: that of the originals first, then those of dubs in the order of their tags. None without dubs. */
  readonly voices: Voice[];
  /** The babble profile with this name, of the topmost file that has profiles. */
  babble(name: string): Babble | undefined;
  /** The babble profile of the project, `[babble]` in its settings; that of the Second Life viewer if it has none. */
  readonly defaultBabble: Babble;
  /** The face profile with this name, of the topmost file that has profiles. */
  faceProfile(name: string): FaceProfile | undefined;
  /** The face profile of the project, `[face]` in its settings; the usual one if it has none. */
  readonly defaultFaceProfile: FaceProfile;
}

/**
 * A time since the audio of a clip began: in seconds, in microseconds, or as a position in samples per channel. All
 * lead to the frame of exact arithmetic. Times before the start, from the end on, infinite or not a number lead to no
 * frame, and so to rest.
 */
export type Time =
  | number
  | { readonly us: number | bigint }
  | { readonly position: number | bigint; readonly rateHz: number };

/** The set of codes that a clip uses. */
export type VisemeType = "blair" | "toonboom" | "rms";

/** A mouth shape: one character of the viseme type; `-` is rest in all three. */
export type Viseme = string;

/**
 * Whose face and emotions of a clip.
 *
 * * undefined: the speaker, by the curves without a name, such as `fear`;
 * * a name: a different character, by the curves with this name in front, such as `mara.fear`;
 * * `{ speaker: "otto" }`: the speaker, also by the curves with that name. Of two curves for the same, the one counts
 *   that is farther from neutral.
 */
export type Who = string | { readonly speaker: string } | undefined;

/** One spoken line. */
export class Clip {
  private constructor();
  /** The hash of its key: names the clip in every version of the files. */
  readonly id: bigint;
  /** The path of its Lipz file below the source root, without extension. */
  readonly key: string;
  /** The frame codes, one character per frame. */
  readonly frames: string;
  /** The number of frames; 0 without visemes. */
  readonly frameCount: number;
  /** Frames per second as an exact ratio in lowest terms; undefined if unspecified. */
  readonly fps: { readonly numerator: number; readonly denominator: number } | undefined;
  /** The set of its codes; undefined if unspecified. */
  readonly visemeType: VisemeType | undefined;
  /** Whether the Lipz file has visemes. Without them there are no frames, and segments have no times. */
  readonly hasVisemes: boolean;
  /** Whether the Lipz file has events. */
  readonly hasEvents: boolean;
  /** The length in seconds; undefined without a frame rate. */
  readonly duration: number | undefined;
  /** All segments, in order. */
  readonly segments: Segment[];
  /** The recording that the clip was made for; undefined if the bank does not say. */
  readonly recording: Recording | undefined;
  /** The voice that the clip is spoken in; undefined without dubs. */
  readonly voice: Voice | undefined;
  /** All curves, in the order of their names. */
  readonly curves: Curve[];
  /** The clip with this frame rate, where its file leaves it unspecified. */
  orFps(numerator: number, denominator?: number): Clip;
  /** The clip with this viseme type, where its file leaves it unspecified. */
  orVisemeType(type: VisemeType): Clip;
  /** The second at which a frame starts to show; undefined without a frame rate. */
  startOfFrame(frame: number): number | undefined;
  /** The frame that shows at `time`; undefined outside of the clip. */
  frameAt(time: Time): number | undefined;
  /** The viseme of a frame; rest outside of the clip. */
  viseme(frame: number): Viseme;
  /** The viseme that shows at `time`; rest outside of the clip. */
  visemeAt(time: Time): Viseme;
  /**
   * How far the mouth is open at `time`, from 0 to 0.99. Undefined without frames, a viseme type or a frame rate: let
   * the mouth babble.
   */
  opennessAt(time: Time): number | undefined;
  /** The segment with this index, from 0. */
  segment(index: number): Segment | undefined;
  /** The segment at `time`; undefined outside of the clip. */
  segmentAt(time: Time): Segment | undefined;
  /**
   * The clip as it is played in `voice`: the dub in it; without one, the dub in a voice that this one falls back
   * to (`other-dub`); otherwise the original.
   */
  inVoice(voice: Voice): { clip: Clip; spoken: "original" | "dub" | "other-dub" };
  /** The curve with this name, `jawOpen`; undefined if the clip has none. */
  curve(name: string): Curve | undefined;
  /** What a character of the clip feels at `time`: neutral without curves of emotion, and without a frame rate. */
  emotionsAt(time: Time, who?: Who): Emotions;
  /**
   * The face of a character of the clip at `time`, generated as `profile` says, by default that of the project;
   * `lookAt` is by default a person straight ahead. Curves of the clip win over what is generated.
   *
   * The face depends on the time, the profile and the id of the clip alone, and is the same on every machine.
   * Characters who listen have the curves with their name in front, blink by their own emotions, and move their head
   * only for these curves and for what they look at.
   *
   * @throws {LipzError} with a profile of a different dialogue.
   */
  faceAt(time: Time, who?: Who, profile?: FaceProfile, lookAt?: LookAt): Face;
  /** A cursor that waits for the audio to begin. @throws {LipzError} without a frame rate: see {@link Clip.orFps}. */
  cursor(settings?: CursorSettings): Cursor;
  /**
   * The cursor at the same time in this clip, which may be from a newer dialogue. Set its speaker again: names are
   * those of their dialogue.
   */
  resume(cursor: Cursor): Cursor;
}

/** The recording that a clip was made for. Compare it with the audio that is about to be played. */
export interface Recording {
  /** In seconds, to the nearest microsecond. */
  readonly duration: number;
  /** XXH3 of all bytes of the file: 64 bits, seed 0. */
  readonly contentHash: bigint;
}

/** A part of a clip, with its own text and events. */
export class Segment {
  private constructor();
  /** Place of the segment in its clip, from 0. */
  readonly index: number;
  /** Its first frame. */
  readonly startFrame: number;
  /** The frame behind its last one. */
  readonly endFrame: number;
  /**
   * The display text in a locale, or in the locale that it falls back to; undefined if neither has a text for this
   * clip, and for a locale that is undefined or from a different dialogue. A segment of an existing text may be empty.
   */
  text(locale: Locale | undefined): Text | undefined;
  /** The event string, trimmed and otherwise as in the Lipz file; undefined if the file has no events. */
  readonly event: string | undefined;
  /** The events, if they are Character Event Syntax. */
  readonly events: Event[];
}

/** A display text. */
export interface Text {
  /** As a player sees it. */
  readonly text: string;
  /** Whether the clip has no text of its own in the locale, and this is that of the locale that it falls back to. */
  readonly isFallback: boolean;
}

/** An event of Character Event Syntax: `[character] verb object`. */
export interface Event {
  /** Who; undefined for the speaker of the clip. */
  readonly character: string | undefined;
  /** What happens. Verbs are added: skip those that you do not know. */
  readonly verb:
    | "feels" | "sees" | "stares" | "stops staring" | "points" | "stops pointing" | "does"
    | "nods" | "shakes" | "breathes" | "blinks" | "looks away";
  /** The emotion, target or action; undefined for other verbs. */
  readonly object: string | undefined;
  /** How far a gesture goes (`nods 6`), from 0 to 10; undefined if the event does not say. */
  readonly strength: number | undefined;
}

/** How a cursor shows a clip. */
export interface CursorSettings {
  /** How far mouth shapes are ahead of the audio: seconds, microseconds, or one or two frames of the clip. */
  lead?: number | { readonly us: number } | { readonly frames: 1 | 2 };
  /**
   * How many frames a consonant shows at least, up to 255. `"readable"` is two frames at 24 fps, the least that can be
   * read. `{ renderedFrame: 1 / 60 }` is enough for a display that shows each rendered frame for so many seconds.
   */
  hold?: number | "readable" | { readonly renderedFrame: number };
  /** Who speaks, so whose events name no character. */
  speaker?: string | undefined;
}

/**
 * Where a clip is while it is played. Once per rendered frame, call `advanceTo` with the position of the audio, and
 * draw what the other members return. docs/guides/playback.md has a table of what happens when time goes on, stands still,
 * jumps, loops and ends.
 */
export class Cursor {
  private constructor();
  /** The clip that is played. */
  readonly clip: Clip;
  /** How far mouth shapes are ahead of the audio, in seconds; see {@link CursorSettings}. */
  get lead(): number;
  set lead(lead: NonNullable<CursorSettings["lead"]>);
  /** How many frames a consonant shows at least; see {@link CursorSettings}. */
  get hold(): number;
  set hold(hold: NonNullable<CursorSettings["hold"]>);
  /** Who speaks, so whose events name no character. */
  speaker: string | undefined;
  /**
   * The audio has reached `time`. Returns what has begun since the last call, each once, however long ago: also
   * segments without frames. What you drop does not come again.
   */
  advanceTo(time: Time): Due;
  /**
   * The audio has jumped from its end to its start and has reached `time` since: what was left, then what has begun.
   */
  loopTo(time: Time): Due;
  /** Jumps, forward or back. Nothing is due; the next `advanceTo` starts with what begins in the frame of this time. */
  seek(time: Time): void;
  /** Ends the clip before the audio does, as when a player skips it: returns what was left. */
  finish(): Due;
  /** The frame at the position of the audio; undefined before the start and from the end on. */
  readonly frame: number | undefined;
  /** Whether the audio is past the last frame. Then everything has been due. */
  readonly isOver: boolean;
  /** The mouth shape to draw, with lead and hold. */
  readonly viseme: Viseme;
  /** How far that mouth is open, from 0 to 0.99; undefined without frames or a viseme type: let the mouth babble. */
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

/** The state of a character. A member is undefined if no event has said anything: it is as it was before the clip. */
export interface Character {
  /** Undefined for a speaker that the cursor does not have. */
  readonly name: string | undefined;
  /** The emotion, until changed. */
  readonly feels: string | undefined;
  /** The target, until `stops staring`. */
  readonly staresAt: string | undefined;
  /** The target, until `stops pointing`. */
  readonly pointsAt: string | undefined;
}

/**
 * A number that changes while a clip plays: a blend shape, an emotion. Between two keys it changes evenly; outside of
 * the keys it is that of the first or last. Keep it while the clip plays: it remembers which key was needed last, so
 * that the next rendered frame needs no search.
 */
export class Curve {
  private constructor();
  /** As in the Lipz file: `jawOpen`, `anger`, `mara.fear`. */
  readonly name: string;
  /** The number of keys. */
  readonly keyCount: number;
  /** All keys in the order of their frames. Values are whole thousandths. */
  readonly keys: { readonly frame: number; readonly value: number }[];
  /** The value at the start of a frame. */
  value(frame: number): number;
  /** The value at `time`; undefined without a frame rate. */
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

/** What a character feels: zeros for a neutral face. */
export interface Emotions {
  /** From 0 to 10, where the file says nothing else. */
  readonly values: Readonly<Record<Emotion, number>>;
  /** The attribute with the highest value; undefined for a neutral face. */
  readonly strongest: Emotion | undefined;
  /** The sum of all values. */
  readonly sum: number;
}

/**
 * What a face does at a time, besides its mouth and its emotions. Angles are in degrees: pitch is positive upwards, yaw
 * to the left of the character, roll towards the left shoulder.
 */
export interface Face {
  /** How far the lids are closed: 0 to 1. */
  readonly blink: number;
  /** How far the head is raised. */
  readonly headPitch: number;
  /** How far the head is turned. */
  readonly headYaw: number;
  /** How far the head is tilted. */
  readonly headRoll: number;
  /** How far the eyes are raised in the head. */
  readonly eyePitch: number;
  /** How far the eyes are turned in the head. */
  readonly eyeYaw: number;
  /** How far the brows are raised: 0 to 1. Only curves raise them. */
  readonly brows: number;
  /** A shrug of the face, 0 to 1. Only curves make one. */
  readonly shrug: number;
  /** How hard the character breathes: 0 to 10. Only curves say so. */
  readonly breath: number;
}

/** What a character looks at: a direction in degrees, as seen from the head at rest. */
export interface LookAt {
  /** How far up it is. */
  readonly pitch: number;
  /** How far to the left of the character it is. */
  readonly yaw: number;
  /**
   * Whether it is a person, over whose face, hands and body the eyes go, or something that they stay on; true by
   * default.
   */
  readonly isPerson?: boolean;
}

/** How a face moves by itself. It is that of one dialogue. */
export class FaceProfile {
  private constructor();
  /** As in the settings; `default` for that of the project. */
  readonly name: string;
  /**
   * The face of a character who does not speak, at a time that counts from anywhere: the eyes blink and look. The seed is
   * 0 by default. Give each character a different one, so that they do not blink at the same time.
   */
  idleAt(time: Time, seed?: number | bigint, lookAt?: LookAt): Face;
}

/** The power of a voice that a program does not measure: 0.75. */
export const UNMEASURED: number;

/** A babble profile: how the mouth of a voice without mouth shapes moves. */
export class Babble {
  private constructor();
  /** As in the settings; `default` for that of the project. */
  readonly name: string;
  /**
   * How far lips are pursed (`ooh`) and the jaw is open (`aah`), from 0 to 0.99, at a time since the character began to
   * speak, at a power of the voice from 0 to 1, by default {@link UNMEASURED}.
   */
  at(elapsed: Time, power?: number): { readonly ooh: number; readonly aah: number };
}
