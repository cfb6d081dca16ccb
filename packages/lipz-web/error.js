// Errors for unusable files and invalid calls.

/** Statuses of lipz.h. */
export const OK = 0;
export const TOO_SHORT = 1;
export const NOT_A_SET = 42;
export const NONE = 256;
export const ABSENT = 261;

/** The remedy for each status. A test compares the names with those of lipz.h. */
export const REMEDIES = {
  LIPZ_NOT_A_BANK: [2, "name a file that lipz has packed"],
  LIPZ_UNSUPPORTED_VERSION: [4, "update lipz, or pack the file again"],
  LIPZ_SECTION_UNKNOWN: [10, "update lipz, or pack the file again"],
  LIPZ_OTHER_CLIPS: [28, "name these texts after the bank that they were split from, or pack both again"],
  LIPZ_TEXTS_ONLY: [29, "name the bank of these texts before them"],
  LIPZ_OTHER_BASE: [37, "before the patch, name the banks that it was packed over, or pack it again over these"],
  LIPZ_NOT_A_LAYER: [38, "open only one complete bank, and pack the others with --over"],
  LIPZ_LAYER_COUNT: [39, "name one bank and at most 15 patches"],
  LIPZ_NOT_A_SET: [42, "name a file that lipz has packed"],
  LIPZ_OTHER_BANK: [44, "copy all banks of the set together with its index"],
  LIPZ_ABSENT: [261, "load it first, with `await dialogue.loadClip(id)`"],
};

/** The statuses of damaged files. */
const DAMAGE = { least: 1, most: 255 };

/** The remedy for a status; undefined if the status is not about a file. */
export function remedyFor(status) {
  const found = Object.values(REMEDIES).find(([number]) => number === status);
  if (found) return found[1];
  return status >= DAMAGE.least && status <= DAMAGE.most ? "copy the file again, or pack it again" : undefined;
}

/** The error for an unusable file or an invalid call. */
export class LipzError extends Error {
  constructor(problem, { file, status, offsetBytes, remedy, cause } = {}) {
    super([file && `${file}: `, problem, remedy && `; ${remedy}`].filter(Boolean).join(""), cause && { cause });
    Object.assign(this, { name: "LipzError", file, status, offsetBytes, remedy });
  }
}

/** Throws the error for an argument that belongs to a different dialogue. */
export function throwForeign(kind) {
  const remedy = "look it up in the dialogue of the clip";
  throw new LipzError(`the ${kind} is from a different dialogue`, { remedy });
}
