// The types of the package, as programs use them: types.test.js compiles this file.

import { type Rig, type Shapes, LipzError, openDialogue, rig } from "@lipz/reader";

const dialogue = await openDialogue(["dialogue.lipzbank"], { wasm: "/lipz.wasm" });
const clip = dialogue.clip("act1/mara-good-evening");
const weights: Rig | undefined = dialogue.rig("arkit");
if (clip && weights) {
  const shapes: Shapes = rig(new Set(["jawOpen"]), weights);
  const named: Shapes = rig({ jawOpen: 0 });
  const floats: Float32Array = clip.weightsAt(1.5, weights);
  const numbers: number[] = clip.weightsAt({ us: 1 }, weights, { who: "mara", lookAt: { pitch: 1, yaw: 2 }, out: [] });
  shapes.apply(floats, numbers);
  named.forEach(numbers, (name: string, weight: number, index: number) => (numbers[index] = weight + name.length));
  shapes.show(clip.visemeAt(1), floats);
  const index: number | undefined = shapes.map["jawOpen"];
  const suggestions: (string | undefined)[] = shapes.missing.map(({ suggestion }) => suggestion);
  const report: string | undefined = shapes.report ?? suggestions[index ?? 0];
  if (report) throw new Error(report);
  // @ts-expect-error a name is not a list of names
  rig("jawOpen");
  // @ts-expect-error the rig of a bank is an object
  rig(["jawOpen"], "arkit");
}
export const isOurs = (error: unknown): boolean => error instanceof LipzError;
