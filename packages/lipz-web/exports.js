// The exports of the package, except the function that opens files.

export { ARTICULATORS, ArticulationProfile, Rig } from "./articulation.js";
export { Babble, UNMEASURED } from "./babble.js";
export { Clip } from "./clip.js";
export { Cursor } from "./cursor.js";
export { Curve, EMOTIONS } from "./curve.js";
export { Dialogue } from "./dialogue.js";
export { LipzError } from "./error.js";
export { FaceProfile } from "./face-profile.js";
export { Locale, Voice } from "./handle.js";
export { Segment } from "./segment.js";
export { rig } from "./shapes.js";
