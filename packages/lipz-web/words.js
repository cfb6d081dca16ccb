// The meaning of the numbers in lipz.h: verbs, viseme types, names, events.

export const VISEME_TYPES = [undefined, "blair", "toonboom", "rms"];
const VERBS = [
  undefined, "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
  "nods", "shakes", "breathes", "blinks", "looks away",
];
/** The `bank` of a name that is missing. */
const NO_NAME = 0;
const NO_STRENGTH = 0xffffffff;

export const THOUSAND = 1000;
/** Weights are in ten-thousandths. */
export const TEN_THOUSAND = 10_000;
export const MICROS_PER_SECOND = 1_000_000;

/** A name; undefined if it is missing. */
export function nameOf(memory, { name, bank }) {
  return bank === NO_NAME ? undefined : memory.string(name);
}

/** An event with these fields. */
export function eventOf(memory, { character, verb, object, strength_thousandths: thousandths }) {
  return {
    character: nameOf(memory, character),
    verb: VERBS[verb],
    object: nameOf(memory, object),
    strength: thousandths === NO_STRENGTH ? undefined : thousandths / THOUSAND,
  };
}
