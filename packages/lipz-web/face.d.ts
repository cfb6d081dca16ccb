/** Drawn faces for pages of games, previews and pictures, as SVG in a page or as text. */

import type { Articulation, Emotion, Viseme, VisemeType } from "./lipz.js";

/**
 * The pose of a face. Missing members are neutral, and numbers are clamped to their range. Angles are in degrees: pitch
 * is positive upwards, yaw to the left of the character, roll towards the left shoulder. `clip.faceAt(time)` returns
 * all members except the viseme, emotions and blend shapes.
 */
export interface Pose {
  /** The mouth shape; rest if it is undefined or not a code of the type. */
  readonly viseme?: Viseme;
  readonly visemeType?: VisemeType | undefined;
  /** The movement of the mouth instead of a viseme, with values from 0 to 1: `clip.articulationAt(time)`. */
  readonly articulation?: Readonly<Partial<Articulation>> | undefined;
  /** Values from 0 to 10, whose effects are added: `clip.emotionsAt(time).values`. */
  readonly emotions?: Readonly<Partial<Record<Emotion, number>>>;
  /** The closure of the lids, from 0 to 1. */
  readonly blink?: number;
  readonly headPitch?: number;
  readonly headYaw?: number;
  readonly headRoll?: number;
  /** The direction of the eyes in the head. */
  readonly eyePitch?: number;
  readonly eyeYaw?: number;
  /** The height of the brows, from 0 to 1. */
  readonly brows?: number;
  /** The strength of a shrug of the face, from 0 to 1. */
  readonly shrug?: number;
  /** The strength of breath, from 0 to 10. */
  readonly breath?: number;
  /**
   * Weights of blend shapes from 0 to 1, with ARKit's names, in addition to those of emotions: `{ jawOpen: 0.4 }`.
   * Names without a muscle in the drawing are ignored.
   */
  readonly shapes?: Readonly<Record<string, number | undefined>>;
}

/** A face in an `<svg>` of the page, whose contents and `viewBox` it replaces. */
export class FaceDrawing {
  constructor(svg: SVGSVGElement);
  /** Draws a pose. The drawing depends only on this pose; unchanged elements are not touched. */
  show(pose: Pose): void;
}

/**
 * Returns the elements of a face as text, for an `<svg>` or a `<g>`. It works without a page, in node or in a worker.
 * Faces in one document need different `id`s; by default, each gets a number.
 */
export function faceMarkup(pose?: Pose, id?: string): string;

/** The area of a face: x, y, width and height of the `viewBox`. */
export const VIEW_BOX: readonly [number, number, number, number];

/** The codes of each viseme type, with the phones or the loudness of each. */
export const VISEMES: Readonly<Record<VisemeType, Readonly<Record<Viseme, string>>>>;

/** The colour of each attribute of emotion, `#rrggbb`. */
export const EMOTION_COLOURS: Readonly<Record<Emotion, string>>;

/**
 * Returns the effects of emotions on a face for your own rig: weights of blend shapes with ARKit's names, added up and
 * not limited. The result also has `tears`, `sweat`, `flush`, `pale`, `sick` and `pupils` (negative: small), and
 * `headPitch` and `headRoll` in degrees.
 */
export function weightsOf(emotions?: Pose["emotions"]): Record<string, number>;

/**
 * Returns the emotions of a single word, for clips without curves of emotion: `emotionsOf(cursor.state().feels)`.
 * Supported are the words of the Lipz specification and of Fallout, and the attributes themselves. The result is empty
 * for all other words.
 */
export function emotionsOf(word: string | undefined): Readonly<Partial<Record<Emotion, number>>>;
