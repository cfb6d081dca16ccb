// The openness of the mouth of a clip, for its graph and its hum.

/** The openness of the mouth in each frame, from 0 to 1. */
export function levelsOf(clip) {
  const levels = new Map();
  return Array.from(clip.frames, (viseme, frame) => {
    if (!levels.has(viseme)) levels.set(viseme, clip.opennessAt(clip.startOfFrame(frame)) ?? 0);
    return levels.get(viseme);
  });
}
