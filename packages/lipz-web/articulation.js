// Articulation: how far jaw, lips and tongue are from rest, and the weights of a model's shapes.

import { EMOTIONS } from "./curve.js";
import { throwForeign } from "./error.js";
import { FOURTH, SECOND, THIRD } from "./memory.js";
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
  /** Its address in the memory, and that of its weights. */
  #address;
  #weights;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#address = memory.allocate(c.lipz_rig.size);
    memory.write(this.#address, c.lipz_rig, fields);
    this.#weights = memory.allocate(fields.weight_count * BYTES_OF_WEIGHT);
    this.name = memory.string(fields.name);
    const name = (_, index) => memory.string(memory.ask(c.lipz_string, "lipz_rig_weight_name", this.#address, index));
    this.weightNames = Object.freeze(Array.from({ length: fields.weight_count }, name));
  }

  /** The weights, in the order of `weightNames`. */
  weights(articulation, { emotions, face, out } = {}) {
    const memory = this.#memory;
    const mouth = { thousandths: ARTICULATORS.map((name) => inThousandths(articulation[name])) };
    const structs = [
      memory.put(SECOND, c.lipz_articulation, mouth),
      emotions === undefined ? NULL : memory.put(THIRD, c.lipz_emotions, fieldsOfEmotions(emotions)),
      face === undefined ? NULL : memory.put(FOURTH, c.lipz_face, fieldsOfFace(face)),
    ];
    return this.weightsFrom(memory, structs, out);
  }

  /** The weights for an articulation, emotions and a face at these addresses of the memory. */
  weightsFrom(memory, [mouth, emotions, face], out = new Float32Array(this.weightNames.length)) {
    if (memory !== this.#memory) throwForeign("rig");
    const count = this.weightNames.length;
    memory.must(memory.status("lipz_rig_weights", this.#address, mouth, emotions, face, this.#weights, count));
    for (let index = 0; index < count; index++) {
      out[index] = memory.int(this.#weights + index * BYTES_OF_WEIGHT) / THOUSAND;
    }
    return out;
  }
}

/** Returns a rig. For any other value, such as a name or undefined, throws an error that explains how to get one. */
export function rigOf(value) {
  if (value instanceof Rig) return value;
  const remedy = "name it in [rig] of lipz.toml, and look it up with dialogue.rig(name)";
  throw new TypeError(`${String(value)} is not a rig: ${remedy}`);
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
