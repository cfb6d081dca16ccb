// The emotions of single words from the Lipz specification and from Fallout. A test compares the table with that in
// docs/guides/faces.md.

import { EMOTION_COLOURS } from "./emotion.js";

/** The value of an emotion without a number. */
const USUAL = 5;

export const PRESETS = {
  neutral: {},
  calm: {},
  amused: { joy: 3 },
  happy: { joy: USUAL },
  sad: { sadness: USUAL },
  irritated: { anger: 3 },
  lying: { perplexed: 1 },
  angry: { anger: USUAL },
  suspicious: { perplexed: 2, anger: 1 },
  confused: { perplexed: USUAL },
  afraid: { fear: USUAL },
  thinking: { perplexed: 2 },
  evil: { anger: 5, joy: 5 },
  good: { joy: 3 },
  bad: { anger: 3 },
};

/** The emotions of a word after `feels`; empty for unknown words. */
export function emotionsOf(word) {
  if (Object.hasOwn(EMOTION_COLOURS, word ?? "")) return { [word]: USUAL };
  return Object.hasOwn(PRESETS, word ?? "") ? PRESETS[word] : {};
}
