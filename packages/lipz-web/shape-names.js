// The names that models give to their shapes: morph targets, expressions, parameters.
//
// Each kind has the name of the bank's rig whose weights its shapes take (crates/lipz-compiler/rigs), or of a viseme
// type. A test compares the lists with those rigs.

const bothSides = (...names) => names.flatMap((name) => [`${name}Left`, `${name}Right`]);

/**
 * The kinds of shapes. If a model has the shapes of several kinds, the first one is used. `mouth` lists the weights of
 * the mouth, by which a kind is recognised, and `rest` all others. `also` has further names of a weight.
 */
export const KINDS = {
  // Apple: ARFaceAnchor.BlendShapeLocation.
  arkit: {
    mouth: [
      ...["jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthRollLower", "mouthRollUpper", "mouthShrugLower"],
      ...bothSides("mouthPress", "mouthStretch", "mouthSmile", "mouthFrown", "mouthUpperUp", "mouthLowerDown"),
    ],
    rest: [
      ...["tongueOut", ...bothSides("cheekSquint", "noseSneer", "browDown"), "browInnerUp"],
      ...bothSides("browOuterUp", "eyeWide", "eyeSquint", "eyeBlink"),
    ],
  },
  // OpenXR: XrFaceTrackingVisemeMETA. Oculus Lipsync had single letters for the last three.
  ovr: {
    mouth: ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"],
    rest: [],
    also: { ih: ["I"], oh: ["O"], ou: ["U"] },
  },
  // VRM 1.0: VRMC_vrm, expressions. The other names are from VRM 0 and VRoid.
  vrm: {
    mouth: ["aa", "ih", "ou", "ee", "oh"],
    rest: ["happy", "angry", "sad", "surprised", "blink"],
    also: {
      ...{ aa: ["A"], ih: ["I"], ou: ["U"], ee: ["E"], oh: ["O"] },
      ...{ happy: ["Fcl_ALL_Joy", "Joy"], angry: ["Fcl_ALL_Angry"], sad: ["Fcl_ALL_Sorrow", "Sorrow"] },
      ...{ surprised: ["Fcl_ALL_Surprised"], blink: ["Fcl_EYE_Close"] },
    },
  },
  mmd: { mouth: ["あ", "い", "う", "え", "お", "ん"], rest: ["まばたき", "にこり", "怒り", "困る"] },
  // Cubism: "Standard Parameter List". Cubism 2 wrote PARAM_MOUTH_OPEN_Y.
  live2d: { mouth: ["ParamMouthOpenY", "ParamMouthForm"], rest: ["ParamEyeLOpen", "ParamEyeROpen"] },
  // Viseme types: a shape for each code.
  blair: { mouth: Array.from("AEFLMOSUW"), rest: ["-"], also: { "-": ["rest"] } },
  toonboom: { mouth: Array.from("ABCDEFG"), rest: ["-"], also: { "-": ["rest", "X"] } },
  rms: { mouth: Array.from("0123456789"), rest: ["-"], also: { "-": ["rest"] } },
};

/** The names of meshes and deformers before that of a shape: `blendShape1.jawOpen`, `M_F00_000_00_Fcl_MTH_A`. */
const PATH = /^.*(?:[.:|/](?!$)|(?=Fcl_))/;
/** The kind of a shape before its name: `viseme_aa`, `v_aa`, `Fcl_MTH_A`, `Mouth_A`. */
const PREFIX = /^(?:arkit|fcl_mth|lipsync|mouth|mth|phoneme|v|viseme)[_ -]/i;
/** The short form of a side at the end of a name: `mouthSmile_L`, `eyeBlink.R`, `jawL`. */
const SIDE = /[_. -]([lrLR])$|([a-z])([LR])$/;

const withSide = (_, separated, before = "", joined) => before + (/l/i.test(separated ?? joined) ? "Left" : "Right");

/** The letters and digits of a name in lower case, which alone are compared. */
export function lettersOf(name) {
  // A hyphen is the code of rest.
  return name === "-" ? name : name.replace(/[^\p{L}\p{N}]/gu, "").toLowerCase();
}

/** The place of the bare name among the forms: without path and prefix. */
export const BARE = 2;

/** The forms in which a name is compared, in the order of their similarity to it. */
export function formsOf(name) {
  const [plain, sided] = [name, name.replace(SIDE, withSide)].map((form) => form.replace(PATH, ""));
  return [name, plain, plain.replace(PREFIX, ""), sided, sided.replace(PREFIX, "")].map(lettersOf);
}
