// What numbers of lipz.h mean in JavaScript: verbs, viseme types, times, events.

export const VISEME_TYPES = [undefined, "blair", "toonboom", "rms"];
const VERBS = [
  undefined, "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
  "nods", "shakes", "breathes", "blinks", "looks away",
];
const NO_NAME = 0xffffffff;

/** Weights are whole numbers of ten-thousandths. */
export const TEN_THOUSAND = 10_000;
export const MICROS_PER_SECOND = 1_000_000;

/** The unit of a time, as functions of lipz.h are named, and their arguments. */
export function at(time) {
  if (typeof time === "number") return ["seconds", time];
  if ("us" in time) return ["us", BigInt(time.us)];
  return ["samples", BigInt(time.position), time.rateHz];
}

/** A name; undefined if there is none. */
export function nameOf(memory, { name, id }) {
  return id === NO_NAME ? undefined : memory.string(name);
}

/** An event of these fields. */
export function eventOf(memory, { character, verb, object }) {
  return { character: nameOf(memory, character), verb: VERBS[verb], object: nameOf(memory, object) };
}
