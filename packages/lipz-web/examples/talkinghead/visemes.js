// The visemes of a line for TalkingHead (npm: @met4citizen/talkinghead), whose `speakAudio` takes three arrays.

import { rig } from "@lipz/reader";

/** The visemes of TalkingHead: those of Oculus Lipsync. */
const VISEMES = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U"];
/** The time between two queries of the line. Shorter visemes are not visible. */
const STEP_MS = 20;

/**
 * The strongest visemes of a line: their names, starts and durations in milliseconds. `weights` is the rig `ovr` of the
 * bank. Pass them together with the recording:
 *
 *     head.speakAudio({ audio, ...visemesOf(clip, dialogue.rig("ovr")) });
 */
export function visemesOf(clip, weights) {
  const shapes = rig(VISEMES, weights);
  const [settings, influences] = [{ out: new Float32Array(VISEMES.length) }, new Float32Array(VISEMES.length)];
  const [visemes, vtimes, vdurations] = [[], [], []];
  const endMs = Math.round(clip.duration * 1000);
  for (let ms = 0; ms < endMs; ms += STEP_MS) {
    shapes.apply(clip.weightsAt(ms / 1000, weights, settings), influences);
    const strongest = VISEMES[influences.indexOf(Math.max(...influences))];
    const lengthMs = Math.min(STEP_MS, endMs - ms);
    if (strongest === visemes.at(-1)) {
      vdurations[vdurations.length - 1] += lengthMs;
    } else {
      visemes.push(strongest);
      vtimes.push(ms);
      vdurations.push(lengthMs);
    }
  }
  return { visemes, vtimes, vdurations };
}
