/**
 * Reader for lipz dialogue banks: files → {@link Dialogue} → {@link Clip} → {@link Segment}, and a {@link Cursor} that
 * follows the audio.
 *
 * Names and the order of arguments match the Rust crate `lipz-bank`: time, who, profile, options.
 */

/** The bytes of a file. The reader copies them. */
export type Bytes = ArrayBuffer | SharedArrayBuffer | ArrayBufferView;

/**
 * A file of a dialogue:
 *
 * * a URL, as a string or an object; relative to the page in browsers; in node, a string without a scheme is a path;
 * * its bytes, with or without a name; error messages show the name, and the index of a set finds its banks by it.
 */
export type Source = string | URL | Bytes | { readonly name: string; readonly bytes: Bytes };

/** Options for opening files. */
export interface OpenOptions {
  /**
   * Whether to check every byte and every reference of the files; true by default. With false, the time to open files
   * does not depend on the number of clips. Queries may then return wrong results for a damaged file, but they never
   * read outside the files.
   */
  readonly verify?: boolean;
  /**
   * Reads a bank of a set by its file name, instead of the file next to the index. Required for an index that you pass
   * as bytes, unless the banks are in the list of files.
   */
  readonly load?: (fileName: string) => Bytes | Promise<Bytes>;
  /** The wasm module, if `lipz.wasm` is not next to `lipz.js`: its path or URL, its bytes, or a compiled module. */
  readonly wasm?: string | URL | BufferSource | WebAssembly.Module;
}

/**
 * Opens files as one dialogue.
 *
 * Name them from the bottom to the top. The base comes first: a bank, or the index of a set. Patches, downloads, mods
 * and the dubs of a voice follow, each after the files over which it was packed, and text banks, each after the bank of
 * its clips. The header of a file determines its kind.
 *
 * The banks of a set are next to its index. The first bank is loaded immediately, because it has the locales and
 * profiles. {@link Dialogue.loadClip} loads the remaining banks.
 *
 * @throws {LipzError} for the first file that cannot be read, is damaged, or does not fit the files before it.
 */
export function openDialogue(files: readonly Source[], options?: OpenOptions): Promise<Dialogue>;

/** The error for an unusable file or an invalid call. The message includes the contents of all members. */
export class LipzError extends Error {
  private constructor();
  /** The name of the file: its path or URL, the name that you passed, or `files[1]` for bytes without a name. */
  readonly file: string | undefined;
  /** The status number in lipz.h; undefined if the file could not be read. */
  readonly status: number | undefined;
  /** The position of the damage, in bytes from the start of the file. */
  readonly offsetBytes: number | undefined;
  /** A suggested fix. */
  readonly remedy: string | undefined;
}

/**
 * A locale of a dialogue. It is not valid in a different dialogue, so look it up again after you open the files again.
 */
export class Locale {
  private constructor();
  /** The tag, as in the element `text_en-us` of a Lipz file: `en-us`. */
  readonly tag: string;
  /** Whether it is the default locale. */
  readonly isDefault: boolean;
}

/** A voice: a language in which lines are recorded. Like a {@link Locale}, it belongs to one dialogue. */
export class Voice {
  private constructor();
  /** The tag of its locale: `de-de`. */
  readonly tag: string;
  /** Whether it is the voice of the original recordings. */
  readonly isOriginal: boolean;
}

/** A file of a dialogue. */
export interface DialogueFile {
  /** Its path or URL, or the name that you passed. */
  readonly name: string;
  /** `absent` for a bank of a set that is not loaded. */
  readonly kind: "absent" | "bank" | "patch" | "texts" | "set";
  /** The checksum in its header, which differs between files with different contents; 0 if the file is absent. */
  readonly checksum: bigint;
}

/**
 * Files that act as one bank: a bank or a set of banks, its patches, and text banks. The topmost file that has a clip
 * counts.
 *
 * A dialogue has its own memory, which is freed with it. You do not have to close it. To add or replace files, open the
 * new list, look up locales and voices again, and continue each {@link Cursor} with {@link Clip.resume}.
 */
export class Dialogue {
  private constructor();
  /** The files from the bottom to the top. The banks of a set follow its index. */
  readonly files: DialogueFile[];
  /** The number of clips, including those in banks that are not loaded; with patches, only of the loaded clips. */
  readonly clipCount: number;
  /**
   * The clip with this key (`act1/mayor`), or with this id if the argument is a bigint; undefined if no file has it.
   *
   * @throws {LipzError} with status 261 if the set has a bank for the clip that is not loaded. Call
   * {@link Dialogue.loadClip} first, for example with the scene.
   */
  clip(keyOrId: string | bigint): Clip | undefined;
  /**
   * Like {@link Dialogue.clip}, but first loads the bank of the set for the clip. Each bank is loaded once. After a
   * failure, the next call tries again. Without a set, the promise is fulfilled immediately. Existing clips and handles
   * remain valid.
   *
   * @throws {LipzError} if the bank cannot be read, is damaged, or does not match the index.
   */
  loadClip(keyOrId: string | bigint): Promise<Clip | undefined>;
  /** Loads all banks of a set that are not loaded. @throws {LipzError} as {@link Dialogue.loadClip}. */
  loadAll(): Promise<void>;
  /**
   * All clips of loaded files, each once: file by file, and within a file in the order of their keys by code points. In
   * a dialogue of one bank, that is the order of all keys.
   */
  clips(): Clip[];
  /** The clips whose keys start with `prefix`, in the same order: `act1/` selects those of a folder. */
  clipsUnder(prefix: string): Clip[];
  /**
   * The locale with this tag, spelled as in the files: `en-us`. Look it up once, and pass it to {@link Segment.text}.
   */
  locale(tag: string): Locale | undefined;
  /** All locales, in no particular order. Tags with `-x-` are variants of texts: leave them out of a menu. */
  readonly locales: Locale[];
  /** The default locale, from the topmost file that sets one. */
  readonly defaultLocale: Locale | undefined;
  /**
   * The locale for texts of a variant: for `pl-pl` and the key `few`, the texts of `text_pl-pl-x-few` in Lipz files. A
   * key lists all cases that apply, the plural category first: `few`, or `few-fem`. The search removes names from the
   * end of the key (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip has any
   * of these, the result is the locale itself. Look variants up once per locale.
   */
  variant(locale: Locale, key: string): Locale;
  /**
   * The voice in this locale; undefined if there are no dubs, or if the project has no such voice. Play the clips
   * unchanged then.
   *
   * @throws {LipzError} if no voice is found, but a bank of a set that is not loaded may have it. Call
   * {@link Dialogue.loadAll}, or look the voice up again with the first clip.
   */
  voice(tag: string): Voice | undefined;
  /** The voices: first that of the originals, then those of dubs in the order of their tags. Empty without dubs. */
  readonly voices: Voice[];
  /** The babble profile with this name, from the topmost file that has profiles. */
  babble(name: string): Babble | undefined;
  /** The babble profile of the project, `[babble]` in its settings; by default that of the Second Life viewer. */
  readonly defaultBabble: Babble;
  /** The face profile with this name, from the topmost file that has profiles. */
  faceProfile(name: string): FaceProfile | undefined;
  /** The articulation profile with this name; undefined if the dialogue has none. */
  articulationProfile(name: string): ArticulationProfile | undefined;
  /** The rig with this name; undefined unless the settings of the project name it in `[rig]`. */
  rig(name: string): Rig | undefined;
  /** The face profile of the project, `[face]` in its settings, or the built-in profile. */
  readonly defaultFaceProfile: FaceProfile;
}

/**
 * A time since the start of the audio of a clip: in seconds, in microseconds, or as a position in samples per channel.
 * All units select the frame with exact arithmetic. Times before the start, from the end on, infinite times and NaN
 * select no frame, and therefore rest.
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
 * The character whose face or emotions to return.
 *
 * * undefined: the speaker, from the curves without a character, such as `fear`;
 * * a name: a different character, from the curves that start with this name, such as `mara.fear`;
 * * `{ speaker: "otto" }`: the speaker, from both kinds of curves. Where two curves have the same purpose, the curve
 *   that is farther from neutral counts.
 */
export type Who = string | { readonly speaker: string } | undefined;

/** One spoken line. */
export class Clip {
  private constructor();
  /** The hash of its key, which identifies the clip in every version of the files. */
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
  /** The recording that the clip was made for; undefined if the bank does not record it. */
  readonly recording: Recording | undefined;
  /** The voice in which the clip is spoken; undefined without dubs. */
  readonly voice: Voice | undefined;
  /** All curves, in the order of their names. */
  readonly curves: Curve[];
  /** The clip with this frame rate, if its file does not specify one. */
  orFps(numerator: number, denominator?: number): Clip;
  /** The clip with this viseme type, if its file does not specify one. */
  orVisemeType(type: VisemeType): Clip;
  /** The start time of a frame, in seconds; undefined without a frame rate. */
  startOfFrame(frame: number): number | undefined;
  /** The frame at `time`; undefined outside the clip. */
  frameAt(time: Time): number | undefined;
  /** The viseme of a frame; rest outside the clip. */
  viseme(frame: number): Viseme;
  /** The viseme at `time`; rest outside the clip. */
  visemeAt(time: Time): Viseme;
  /**
   * The openness of the mouth at `time`, from 0 to 0.99. Undefined without frames, a viseme type or a frame rate: use
   * babble instead.
   */
  opennessAt(time: Time): number | undefined;
  /** The segment with this index, from 0. */
  segment(index: number): Segment | undefined;
  /** The segment at `time`; undefined outside the clip. */
  segmentAt(time: Time): Segment | undefined;
  /**
   * The clip to play in `voice`: the dub in this voice; if there is none, the dub in a voice to which this voice falls
   * back (`other-dub`); otherwise the original.
   */
  inVoice(voice: Voice): { clip: Clip; spoken: "original" | "dub" | "other-dub" };
  /** The curve with this name, `jawOpen`; undefined if the clip has none. */
  curve(name: string): Curve | undefined;
  /** The emotions of a character of the clip at `time`; neutral without curves of emotion or without a frame rate. */
  emotionsAt(time: Time, who?: Who): Emotions;
  /**
   * The face of a character of the clip at `time`, generated from `profile`, by default the profile of the project. By
   * default, `lookAt` is a person straight ahead. Curves of the clip override generated values.
   *
   * The face depends only on the time, the profile and the id of the clip, and is the same on every machine. Listening
   * characters use the curves that start with their name, blink according to their own emotions, and move their head
   * only for these curves and for the target of their gaze.
   *
   * @throws {LipzError} with a profile of a different dialogue.
   */
  faceAt(time: Time, who?: Who, profile?: FaceProfile, lookAt?: LookAt): Face;
  /**
   * How far jaw, lips and tongue are from rest at a time, computed from the phones of the clip, or from its visemes if it
   * has no phones. By default, with the profile of the project.
   */
  articulationAt(time: Time, profile?: ArticulationProfile): Articulation;
  /**
   * The weights of a rig at `time`, in the order of `rig.weightNames`: those of {@link Rig.weights} for the articulation,
   * the emotions and the face of a character of the clip, but faster. Pass the same settings in each rendered frame to
   * avoid allocations.
   *
   * @throws {LipzError} with a rig or a profile of a different dialogue.
   */
  weightsAt<T extends { [index: number]: number } = Float32Array>(
    time: Time,
    rig: Rig,
    settings?: {
      readonly who?: Who;
      readonly profile?: ArticulationProfile;
      readonly faceProfile?: FaceProfile;
      readonly lookAt?: LookAt;
      readonly out?: T;
    },
  ): T;
  /** A cursor before the start of the audio. @throws {LipzError} without a frame rate: see {@link Clip.orFps}. */
  cursor(settings?: CursorSettings): Cursor;
  /**
   * The cursor at the same time in this clip, which may be from a newer dialogue. Set its speaker again, because names
   * belong to one dialogue.
   */
  resume(cursor: Cursor): Cursor;
}

/** The recording that a clip was made for. Compare it with the audio that you are about to play. */
export interface Recording {
  /** The length in seconds, to the nearest microsecond. */
  readonly duration: number;
  /** The XXH3 hash of all bytes of the file: 64 bits, seed 0. */
  readonly contentHash: bigint;
}

/** A part of a clip, with its own text and events. */
export class Segment {
  private constructor();
  /** The index of the segment in its clip, from 0. */
  readonly index: number;
  /** Its first frame. */
  readonly startFrame: number;
  /** The frame after its last frame. */
  readonly endFrame: number;
  /**
   * The display text in a locale, or in the locale to which it falls back. Undefined if neither has a text for this
   * clip, or if the locale is undefined or from a different dialogue. A segment of an existing text may be empty.
   */
  text(locale: Locale | undefined): Text | undefined;
  /** The event string of the Lipz file, trimmed; undefined if the file has no events. */
  readonly event: string | undefined;
  /** The events, if they are in Character Event Syntax. */
  readonly events: Event[];
}

/** A display text. */
export interface Text {
  /** The text as players see it. */
  readonly text: string;
  /** Whether the text comes from the fallback locale, because the clip has no text in the requested locale. */
  readonly isFallback: boolean;
}

/** An event in Character Event Syntax: `[character] verb object`. */
export interface Event {
  /** The character; undefined for the speaker of the clip. */
  readonly character: string | undefined;
  /** The verb. Later versions may add verbs, so ignore unknown ones. */
  readonly verb:
    | "feels" | "sees" | "stares" | "stops staring" | "points" | "stops pointing" | "does"
    | "nods" | "shakes" | "breathes" | "blinks" | "looks away";
  /** The emotion, target or action; undefined for other verbs. */
  readonly object: string | undefined;
  /** The strength of a gesture (`nods 6`), from 0 to 10; undefined if the event has none. */
  readonly strength: number | undefined;
}

/** Settings of a cursor. */
export interface CursorSettings {
  /** The lead of visemes before the audio: seconds, microseconds, or one or two frames of the clip. */
  lead?: number | { readonly us: number } | { readonly frames: 1 | 2 };
  /**
   * The minimum number of frames for which a consonant is shown, up to 255. `"readable"` is two frames at 24 fps, the
   * minimum that viewers can read. `{ renderedFrame: 1 / 60 }` is enough for a display that shows each rendered frame
   * for this number of seconds.
   */
  hold?: number | "readable" | { readonly renderedFrame: number };
  /** The speaker, to whom events without a character belong. */
  speaker?: string | undefined;
}

/**
 * The position in a clip while it plays. Once per rendered frame, call `advanceTo` with the position of the audio, and
 * draw what the other members return. docs/guides/playback.md has a table of the results when time moves on, stands
 * still, jumps, loops and ends.
 */
export class Cursor {
  private constructor();
  /** The clip that plays. */
  readonly clip: Clip;
  /** The lead of visemes before the audio, in seconds; see {@link CursorSettings}. */
  get lead(): number;
  set lead(lead: NonNullable<CursorSettings["lead"]>);
  /** The minimum number of frames for which a consonant is shown; see {@link CursorSettings}. */
  get hold(): number;
  set hold(hold: NonNullable<CursorSettings["hold"]>);
  /** The speaker, to whom events without a character belong. */
  speaker: string | undefined;
  /**
   * Advances to `time`, and returns the segments that have started since the last call, each once, however long ago,
   * including segments without frames. Use the result: nothing is returned twice.
   */
  advanceTo(time: Time): Due;
  /**
   * Advances to `time` after the audio has jumped from its end to its start. Returns the rest of the clip, then the
   * segments that have started again.
   */
  loopTo(time: Time): Due;
  /** Jumps, forward or back. Nothing is due. The next `advanceTo` starts with the segments of this frame. */
  seek(time: Time): void;
  /** Ends the clip before its audio ends, for example when a player skips it. Returns the rest of the clip. */
  finish(): Due;
  /** The frame at the position of the audio; undefined before the start and from the end on. */
  readonly frame: number | undefined;
  /** Whether the audio is past the last frame. Nothing more becomes due then. */
  readonly isOver: boolean;
  /** The viseme to draw, with lead and hold. */
  readonly viseme: Viseme;
  /** The openness of that viseme, from 0 to 0.99; undefined without frames or a viseme type: use babble instead. */
  readonly openness: number | undefined;
  /** The segment whose subtitle to show; undefined before the start and from the end on. */
  readonly segment: Segment | undefined;
  /** The emotion of a character, and the targets of its stare and its pointing; by default those of the speaker. */
  state(character?: string): Character;
  /** Every character that events of the clip mention, with the state to set after a jump. */
  characters(): Character[];
}

/** The events and segments that a move has made due. */
export interface Due {
  /** The events in order, if they are in Character Event Syntax. Events without a character belong to the speaker. */
  readonly events: Event[];
  /** The segments in order, for event strings in a different syntax. */
  readonly segments: Segment[];
}

/** The state of a character. A member is undefined if no event has set it: keep its value from before the clip. */
export interface Character {
  /** Undefined for the speaker, if the cursor has none. */
  readonly name: string | undefined;
  /** The emotion, until it changes. */
  readonly feels: string | undefined;
  /** The target, until `stops staring`. */
  readonly staresAt: string | undefined;
  /** The target, until `stops pointing`. */
  readonly pointsAt: string | undefined;
}

/**
 * A number that changes while a clip plays, such as a blend shape or an emotion. Between two keys, values are
 * interpolated linearly. Before the first and after the last key, the value is constant. Keep the object while the clip
 * plays: it stores the last key, so that the next rendered frame needs no search.
 */
export class Curve {
  private constructor();
  /** The name, as in the Lipz file: `jawOpen`, `anger`, `mara.fear`. */
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

/** The emotions of a character; zeros for a neutral face. */
export interface Emotions {
  /** From 0 to 10, unless the file has values outside this range. */
  readonly values: Readonly<Record<Emotion, number>>;
  /** The attribute with the highest value; undefined for a neutral face. */
  readonly strongest: Emotion | undefined;
  /** The sum of all values. */
  readonly sum: number;
}

/**
 * The pose of a face at a time, apart from its mouth and its emotions. Angles are in degrees: pitch is positive
 * upwards, yaw to the left of the character, roll towards the left shoulder.
 */
export interface Face {
  /** The closure of the lids, from 0 to 1. */
  readonly blink: number;
  /** The pitch of the head. */
  readonly headPitch: number;
  /** The yaw of the head. */
  readonly headYaw: number;
  /** The roll of the head. */
  readonly headRoll: number;
  /** The pitch of the eyes in the head. */
  readonly eyePitch: number;
  /** The yaw of the eyes in the head. */
  readonly eyeYaw: number;
  /** The height of the brows, from 0 to 1. Only curves set it. */
  readonly brows: number;
  /** The strength of a shrug of the face, from 0 to 1. Only curves set it. */
  readonly shrug: number;
  /** The strength of breath, from 0 to 10. Only curves set it. */
  readonly breath: number;
}

/** The target of a gaze: a direction in degrees, as seen from the head at rest. */
export interface LookAt {
  /** The angle upwards. */
  readonly pitch: number;
  /** The angle to the left of the character. */
  readonly yaw: number;
  /**
   * Whether the target is a person, so that the eyes move over face, hands and body instead of staying on a point; true
   * by default.
   */
  readonly isPerson?: boolean;
}

/** The settings for the movement that a face generates. A profile belongs to one dialogue. */
export class FaceProfile {
  private constructor();
  /** The name, as in the settings; `default` for the profile of the project. */
  readonly name: string;
  /**
   * The face of a silent character, whose eyes blink and look, at a time from any start. The seed is 0 by default. Use
   * a different seed for each character, so that they do not blink at the same time.
   */
  idleAt(time: Time, seed?: number | bigint, lookAt?: LookAt): Face;
}

/** The names of the nine articulators. */
export const ARTICULATORS: readonly (keyof Articulation)[];

/** How far jaw, lips and tongue are from rest at a time, each from 0 to 1. */
export interface Articulation {
  /** How far the jaw is lowered. */
  readonly jaw: number;
  /** How far the lips are apart, whatever the jaw does. */
  readonly opening: number;
  /** How firmly the lips are closed, as in *p*, *b* and *m*. */
  readonly closure: number;
  /** How far the lower lip is under the upper teeth, as in *f* and *v*. */
  readonly teeth: number;
  /** How far the lips are rounded and pushed forward. */
  readonly rounding: number;
  /** How far the corners of the lips are pulled apart. */
  readonly spreading: number;
  /** How far the tip of the tongue is raised. */
  readonly tongueTip: number;
  /** How far the tongue is between the teeth. */
  readonly tongueOut: number;
  /** How far the back of the tongue is raised. */
  readonly tongueBack: number;
}

/** How a character articulates: `[articulation.NAME]` in the settings. */
export class ArticulationProfile {
  private constructor();
  /** The name, as in the settings; `default` for the profile of the project. */
  readonly name: string;
}

/** The shapes of a model: `[rig]` in the settings. */
export class Rig {
  private constructor();
  /** The name, as in the settings: `arkit`. */
  readonly name: string;
  /** The names of the weights: `jawOpen`. */
  readonly weightNames: readonly string[];
  /**
   * The weights in the order of `weightNames`, usually from 0 to 1. Without emotions and face, the face is neutral. Pass
   * the same `out` in each rendered frame to avoid allocations of arrays.
   */
  weights<T extends { [index: number]: number } = Float32Array>(
    articulation: Articulation,
    settings?: { readonly emotions?: Emotions; readonly face?: Face; readonly out?: T },
  ): T;
}

/**
 * Recognises the shapes of a model by their names: morph targets, blend shapes, expressions or parameters, in the order
 * of the model, or as an object with the index of each name, such as three.js's `morphTargetDictionary`.
 *
 * Pass the rig of the bank whose weights the shapes take. Without a rig, the kind of which the model has the most shapes
 * is recognised: those of ARKit, Oculus (OpenXR), VRM 1.0 and 0, MikuMikuDance, Live2D, and the codes of a viseme type.
 * Names may differ in case and separators, and may have the name of a mesh or a deformer before them
 * (`blendShape1.jawOpen`), a prefix (`viseme_aa`) or a short side (`mouthSmile_L`).
 */
export function rig(names: (Iterable<string> & object) | Readonly<Record<string, number>>, bankRig?: Rig): Shapes;

/** The shapes of a model that take the weights of a rig. */
export interface Shapes {
  /**
   * The name of the rig whose weights the shapes take, for {@link Dialogue.rig}; for shapes of visemes, their type.
   * Undefined if no name is known.
   */
  readonly kind: "arkit" | "ovr" | "vrm" | "mmd" | "live2d" | VisemeType | (string & {}) | undefined;
  /** The names of the weights, in their order. */
  readonly weightNames: readonly string[];
  /** The index of the shape for the weight with each name. */
  readonly map: Readonly<Record<string, number>>;
  /** The weights without a shape, each with the similar name of a shape that was probably meant. */
  readonly missing: readonly { readonly name: string; readonly suggestion: string | undefined }[];
  /** A sentence about the missing shapes, for a log; undefined if none is missing. */
  readonly report: string | undefined;
  /**
   * Writes each weight to the influence of its shape, by the index of the shape. Other influences stay as they are.
   *
   * @throws {RangeError} unless there is a weight for each name.
   */
  apply(weights: ArrayLike<number>, influences: { [index: number]: number }): void;
  /**
   * Calls `set` with the name of each shape in the model, its weight and its index, for engines without an array of
   * influences. Pass the same function in each rendered frame to avoid allocations.
   *
   * @throws {RangeError} unless there is a weight for each name.
   */
  forEach(weights: ArrayLike<number>, set: (name: string, weight: number, index: number) => void): void;
  /** For shapes of visemes: sets the influence of the shape for `viseme` to 1, and those of all others to 0. */
  show(viseme: Viseme, influences: { [index: number]: number }): void;
}

/** The power for a voice that your program does not measure: 0.75. */
export const UNMEASURED: number;

/** A babble profile: the mouth movement for a voice without visemes. */
export class Babble {
  private constructor();
  /** The name, as in the settings; `default` for the profile of the project. */
  readonly name: string;
  /**
   * The pursing of the lips (`ooh`) and the opening of the jaw (`aah`), from 0 to 0.99, at a time since the character
   * started to speak. `power` is that of the voice, from 0 to 1, by default {@link UNMEASURED}.
   */
  at(elapsed: Time, power?: number): { readonly ooh: number; readonly aah: number };
}
