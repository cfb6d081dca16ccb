/** A drawn face: for pages of games, previews and pictures. It is drawn in SVG, in a page or as text. */

import type { Emotion, Viseme, VisemeType } from "./lipz.js";

/**
 * What a face does. What is not named is neutral, and numbers out of range are as the nearest in it. Angles are in degrees:
 * pitch is positive upwards, yaw to the left of the character, roll towards the left shoulder. `clip.faceAt(time)` has all of them
 * but the mouth, emotions and blend shapes.
 */
export interface Pose {
  /** The mouth shape; rest if it is undefined, or no code of the type. */
  readonly viseme?: Viseme;
  readonly visemeType?: VisemeType | undefined;
  /** Values from 0 to 10, which are added: `clip.emotionsAt(time).values`. */
  readonly emotions?: Readonly<Partial<Record<Emotion, number>>>;
  /** How far the lids are closed: 0 to 1. */
  readonly blink?: number;
  readonly headPitch?: number;
  readonly headYaw?: number;
  readonly headRoll?: number;
  /** Where the eyes look, in the head. */
  readonly eyePitch?: number;
  readonly eyeYaw?: number;
  /** How far the brows are raised: 0 to 1. */
  readonly brows?: number;
  /** A shrug of the face: 0 to 1. */
  readonly shrug?: number;
  /** How hard somebody breathes: 0 to 10. */
  readonly breath?: number;
  /**
   * Weights of blend shapes from 0 to 1, with the names of ARKit, beside those that emotions have: `{ jawOpen: 0.4 }`. Names
   * that the drawing has no muscle for are ignored.
   */
  readonly shapes?: Readonly<Record<string, number | undefined>>;
}

/** A face in an `<svg>` of the page, whose contents and `viewBox` it replaces. */
export class FaceDrawing {
  constructor(svg: SVGSVGElement);
  /** Draws a pose. It depends on this pose alone; only what has changed since the last one is touched. */
  show(pose: Pose): void;
}

/**
 * The elements of a face as text, for an `<svg>` or a `<g>`, without a page: in node, or in a worker. Faces in one document
 * need different `id`s; by default, each has a number.
 */
export function faceMarkup(pose?: Pose, id?: string): string;

/** What a face fills: x, y, width and height of the `viewBox`. */
export const VIEW_BOX: readonly [number, number, number, number];

/** The codes of each viseme type, and the sounds or the loudness that each stands for. */
export const VISEMES: Readonly<Record<VisemeType, Readonly<Record<Viseme, string>>>>;

/** The colour of each attribute of emotion, `#rrggbb`. */
export const EMOTION_COLOURS: Readonly<Record<Emotion, string>>;

/**
 * What emotions do to a face: weights of blend shapes with the names of ARKit, for a rig of your own, added up and not limited.
 * Beside them: `tears`, `sweat`, `flush`, `pale`, `sick` and `pupils` (negative: small), and `headPitch` and `headRoll` in degrees.
 */
export function weightsOf(emotions?: Pose["emotions"]): Record<string, number>;

/**
 * The emotions of a single word, for clips that have no curves of emotion: `emotionsOf(cursor.state().feels)`. The words are those
 * of the Lipz specification and of Fallout, and the attributes themselves; of others nothing is known.
 */
export function emotionsOf(word: string | undefined): Readonly<Partial<Record<Emotion, number>>>;
