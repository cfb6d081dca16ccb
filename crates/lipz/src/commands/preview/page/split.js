// Texts and events that follow their segments: when a segment starts in the middle of another one, or joins it.

const DELIMITER = "|";
/** Scripts without spaces between words: Thai, Lao, Burmese, Khmer, Japanese, Chinese. */
const UNSPACED = /[\u0E00-\u0EFF\u1000-\u109F\u1780-\u17FF\u3040-\u30FF\u31F0-\u31FF\u3400-\u9FFF\uF900-\uFAFF]/;

/** Returns the text with a segment divided at a position in it. */
export function dividedAt(text, segment, at) {
  const parts = text.split(DELIMITER);
  const start = parts.slice(0, segment).reduce((sum, part) => sum + part.length + 1, 0);
  const own = parts[segment];
  const place = Math.max(0, Math.min(at - start, own.length));
  return replaced(parts, segment, [own.slice(0, place).trimEnd(), own.slice(place).trimStart()]);
}

/** Returns the text with a segment divided between two words, after a share of its letters. */
export function dividedByShare(text, segment, share) {
  const own = text.split(DELIMITER)[segment];
  const letters = (part) => part.replaceAll(/\{[^{}]*\}/g, "").replaceAll(/[^\p{L}\p{N}]/gu, "").length;
  const all = letters(own);
  const distance = (place) => Math.abs(letters(own.slice(0, place)) - share * all);
  const places = gaps(own);
  const place = places.reduce((best, place) => (distance(place) < distance(best) ? place : best), places[0]);
  const start = text.split(DELIMITER).slice(0, segment).reduce((sum, part) => sum + part.length + 1, 0);
  return dividedAt(text, segment, start + place);
}

/** Returns the events with a new segment after one, in which nothing happens. */
export function dividedEvents(text, segment) {
  const parts = text.split(DELIMITER);
  return replaced(parts, segment, [parts[segment], ""]);
}

/** Returns the text with a segment joined to the one before it. */
export function joined(text, segment, separator) {
  const parts = text.split(DELIMITER);
  const both = [parts[segment - 1].trim(), parts[segment].trim()].filter(Boolean);
  return [...parts.slice(0, segment - 1), both.join(separator), ...parts.slice(segment + 1)].join(DELIMITER);
}

/** Returns the length of what belongs to the word after a text: its meta, such as `{anger 6}`, and opening marks. */
export const leading = (text) => text.match(/(?:\{[^{}]*\}\s*)*[^\p{L}\p{N}\s{}.,!?;:…]*$/u)[0].length;

/** Returns the number of segments of a text. */
export const count = (text) => text.split(DELIMITER).length;

/** Returns the positions at which a segment can be divided: its ends, and the starts of words outside of braces. */
function gaps(own) {
  const places = [0];
  let depth = 0;
  for (let at = 1; at < own.length; at++) {
    const [before, here] = [own[at - 1], own[at]];
    if (before === "{") depth += 1;
    if (before === "}") depth = Math.max(0, depth - 1);
    const isStart = /\s/.test(before) && !/\s/.test(here);
    const isBetween = UNSPACED.test(before) && UNSPACED.test(here);
    if (depth === 0 && (isStart || isBetween)) places.push(at);
  }
  return [...places, own.length];
}

const replaced = (parts, at, both) => [...parts.slice(0, at), ...both, ...parts.slice(at + 1)].join(DELIMITER);
