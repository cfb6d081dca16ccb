// Articulation: how far jaw, lips and tongue are from rest, and the weights of a model's shapes.

import { EMOTIONS } from "./curve.js";
import { FIRST, FOURTH, SECOND, THIRD } from "./memory.js";
import * as c from "./structs.js";
import { THOUSAND } from "./words.js";

/** The articulators, in the order of lipz.h. */
export const ARTICULATORS = Object.freeze([
  "jaw",
  "opening",
  "closure",
  "teeth",
  "rounding",
  "spreading",
  "tongueTip",
  "tongueOut",
  "tongueBack",
]);

const NULL = 0;
const BYTES_OF_WEIGHT = 4;

/** An articulation, from the fields of a result. */
export function articulationOf({ thousandths }) {
  return Object.fromEntries(ARTICULATORS.map((name, index) => [name, thousandths[index] / THOUSAND]));
}

const inThousandths = (value = 0) => Math.round(value * THOUSAND);

export class ArticulationProfile {
  #fields;

  constructor(memory, fields) {
    this.#fields = fields;
    this.name = memory.string(fields.name);
  }

  /** Writes it into the memory of a dialogue and returns its address. It is not valid in a different dialogue. */
  put(memory) {
    return memory.put(SECOND, c.lipz_articulation_profile, this.#fields);
  }
}

export class Rig {
  #memory;
  #fields;
  /** The address of its weights in the memory. */
  #weights;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
    this.#weights = memory.allocate(fields.weight_count * BYTES_OF_WEIGHT);
    this.name = memory.string(fields.name);
    const name = (_, index) =>
      memory.string(memory.ask(c.lipz_string, "lipz_rig_weight_name", memory.put(FIRST, c.lipz_rig, fields), index));
    this.weightNames = Object.freeze(Array.from({ length: fields.weight_count }, name));
  }

  /** The weights, in the order of `weightNames`. */
  weights(articulation, { emotions, face, out = new Float32Array(this.weightNames.length) } = {}) {
    const memory = this.#memory;
    const mouth = { thousandths: ARTICULATORS.map((name) => inThousandths(articulation[name])) };
    const structs = [
      memory.put(FIRST, c.lipz_rig, this.#fields),
      memory.put(SECOND, c.lipz_articulation, mouth),
      emotions === undefined ? NULL : memory.put(THIRD, c.lipz_emotions, fieldsOfEmotions(emotions)),
      face === undefined ? NULL : memory.put(FOURTH, c.lipz_face, fieldsOfFace(face)),
    ];
    const count = this.weightNames.length;
    memory.must(memory.status("lipz_rig_weights", ...structs, this.#weights, count));
    const { buffer, byteOffset } = memory.bytes(this.#weights, count * BYTES_OF_WEIGHT);
    new Int32Array(buffer, byteOffset, count).forEach((value, index) => (out[index] = value / THOUSAND));
    return out;
  }
}

function fieldsOfEmotions({ values }) {
  return { thousandths: EMOTIONS.map((name) => inThousandths(values[name])), strongest: 0, sum: 0 };
}

/** A rig reads only these three. */
function fieldsOfFace({ blink, brows, shrug }) {
  const [lids, raised, shrugged] = [blink, brows, shrug].map(inThousandths);
  const still = { head_pitch: 0, head_yaw: 0, head_roll: 0, eye_pitch: 0, eye_yaw: 0, breath: 0 };
  return { ...still, blink: lids, brows: raised, shrug: shrugged };
}
