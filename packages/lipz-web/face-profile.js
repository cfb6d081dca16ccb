// Faces that move by themselves: lids, head and eyes at a time.

import { FOURTH, SECOND, THIRD } from "./memory.js";
import * as c from "./structs.js";
import { THOUSAND } from "./words.js";

const NULL = 0;

/** The address of a character for a function of lipz.h; null for the speaker. */
export function whoOf(memory, who) {
  if (who === undefined) return NULL;
  const isSpeaker = typeof who !== "string";
  const [data, length_bytes] = memory.text(isSpeaker ? who.speaker : who);
  return memory.put(FOURTH, c.lipz_who, { name: { data, length_bytes }, is_speaker: Number(isSpeaker) });
}

/** The address of a profile for a function of lipz.h; null for that of the project. */
export function profileOf(memory, profile) {
  return profile === undefined ? NULL : profile.put(memory);
}

/** The address of the target of a gaze for a function of lipz.h; null for a person straight ahead. */
export function lookAtOf(memory, lookAt) {
  if (lookAt === undefined) return NULL;
  const { pitch, yaw, isPerson = true } = lookAt;
  const [up, left] = [pitch, yaw].map((degrees) => Math.round(degrees * THOUSAND));
  return memory.put(THIRD, c.lipz_look_at, { pitch: up, yaw: left, is_person: Number(isPerson) });
}

/** A face, from the fields of a result. */
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
    this.name = memory.string(fields.name);
  }

  /** Writes it into the memory of a dialogue and returns its address. It is not valid in a different dialogue. */
  put(memory) {
    return memory.put(SECOND, c.lipz_face_profile, this.#fields);
  }

  /** The face of a silent character, whose eyes blink and look. */
  idleAt(time, seed = 0, lookAt) {
    const memory = this.#memory;
    const settings = [this.put(memory), lookAtOf(memory, lookAt)];
    return faceOf(memory.ask(c.lipz_face, "lipz_face_idle_at", memory.time(time), BigInt(seed), ...settings));
  }
}
