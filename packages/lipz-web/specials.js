// Faces that move by themselves: lids, head and eyes at a time.

import { BANK, FOURTH, SECOND, THIRD } from "./memory.js";
import * as c from "./structs.js";
import { at } from "./words.js";

const THOUSAND = 1000;
const NULL = 0;

/** The address of a character, for a function of lipz.h. */
export function whoOf(memory, name, isSpeaker = false) {
  const [data, length_bytes] = memory.text(name);
  return memory.put(FOURTH, c.lipz_who, { name: { data, length_bytes }, is_speaker: Number(isSpeaker) });
}

/** The addresses of a profile and of what somebody looks at, for a function of lipz.h; null for what is left out. */
export function settingsOf(memory, { profile, lookAt } = {}) {
  return [profile ? profile.put(memory) : NULL, lookAt ? memory.put(THIRD, c.lipz_look_at, direction(lookAt)) : NULL];
}

function direction({ pitch, yaw, isPerson = true }) {
  return { pitch: Math.round(pitch * THOUSAND), yaw: Math.round(yaw * THOUSAND), is_person: Number(isPerson) };
}

/** A face, of the fields of an answer. */
export function faceOf(fields) {
  const value = (name) => fields[name] / THOUSAND;
  return {
    blink: value("blink"),
    headPitch: value("head_pitch"),
    headYaw: value("head_yaw"),
    headRoll: value("head_roll"),
    eyePitch: value("eye_pitch"),
    eyeYaw: value("eye_yaw"),
    brows: value("brows"),
    shrug: value("shrug"),
    breath: value("breath"),
  };
}

export class FaceProfile {
  #memory;
  #fields;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
  }

  get name() {
    return this.#memory.string(this.#fields.name);
  }

  /** Writes it into the memory of a reader and gives its address. Of another bank, it is none there. */
  put(memory) {
    return memory.put(SECOND, c.lipz_face_profile, this.#fields);
  }

  /** The face of somebody who says nothing: they blink and look. */
  idleAt(time, { seed = 0, lookAt } = {}) {
    const [unit, ...args] = at(time);
    const settings = settingsOf(this.#memory, { profile: this, lookAt });
    const bank = this.#memory.slot(BANK);
    return faceOf(this.#memory.ask(c.lipz_face, `lipz_face_idle_at_${unit}`, bank, ...settings, BigInt(seed), ...args));
  }
}
