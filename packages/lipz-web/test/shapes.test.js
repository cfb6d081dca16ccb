// Shapes of models by their names, and their weights, compared with those of the golden dumps, which Rust writes.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { LipzError, openDialogue, rig } from "../node.js";
import { nearest } from "../nearest.js";
import { KINDS } from "../shape-names.js";

const golden = (name) => new URL(`banks/${name}`, import.meta.url);
const dialogue = await openDialogue([golden("rigs.lipzbank")]);
const [clip] = dialogue.clips();
/** The time of the weights in dumps. */
const TIME = { us: 500_000 };

/** The rigs of a dump, with the weights of the first clip that has any. */
async function dumpedRigs(name) {
  const text = await readFile(golden(name), "utf8");
  const lines = Array.from(text.split("\n\nclip ")[1].matchAll(/^ {2}rig "([^"]+)" (.*)$/gm));
  return lines.map(([, rigName, words]) => {
    const found = words.matchAll(/(\S+) (-?[\d.]+)(?: |$)/g);
    const pairs = Array.from(found, ([, weight, value]) => [weight, Number(value)]);
    return { rigName, weights: new Map(pairs) };
  });
}

/** Names as models have them, with the index of each in a larger model. */
const named = (names, rename) => ["Basis", ...names.map(rename)];
const OVR = "sil PP FF TH DD kk CH SS nn RR aa E I O U".split(" ");
const VROID = `ALL_Neutral ALL_Angry ALL_Joy ALL_Sorrow ALL_Surprised BRW_Joy EYE_Close EYE_Joy MTH_Close MTH_Joy
  MTH_A MTH_I MTH_U MTH_E MTH_O`.split(/\s+/);

test("the kinds have the weights of the rigs that lipz packs", () => {
  for (const [kind, { mouth, rest }] of Object.entries(KINDS).filter(([kind]) => dialogue.rig(kind))) {
    assert.deepEqual([...mouth, ...rest], dialogue.rig(kind).weightNames, kind);
  }
  const packed = Object.keys(KINDS).filter((kind) => dialogue.rig(kind));
  assert.deepEqual(packed, ["arkit", "ovr", "vrm", "mmd", "live2d"]);
});

test("every rig moves a model by the weights of the golden dump", async () => {
  const rigs = await dumpedRigs("rigs.dump");
  assert.equal(rigs.length, 11);
  let moved = 0;
  for (const { rigName, weights } of rigs) {
    const bankRig = dialogue.rig(rigName);
    const shapes = rig(named(bankRig.weightNames, (name) => `Face.${name}`), bankRig);
    assert.deepEqual([shapes.kind, shapes.missing, shapes.report], [rigName, [], undefined]);
    const influences = new Float64Array(weights.size + 1).fill(-9);
    const settings = { out: new Float64Array(weights.size) };
    shapes.apply(clip.weightsAt(TIME, bankRig, settings), influences);
    assert.deepEqual(Array.from(influences), [-9, ...weights.values()], rigName);
    const set = new Map();
    shapes.forEach(settings.out, (name, weight, index) => set.set(name, [weight, index]));
    let index = 0;
    for (const [name, value] of weights) assert.deepEqual(set.get(`Face.${name}`), [value, ++index]);
    moved += Array.from(weights.values()).filter((value) => value !== 0).length;
  }
  assert.ok(moved > 20, moved);
});

test("weights at a time are those of their parts", async () => {
  const specials = await openDialogue([golden("phones.lipzbank")]);
  let compared = 0;
  for (const [of, name] of [[dialogue, "arkit"], [dialogue, "vrm"], [specials, "arkit"]]) {
    const bankRig = of.rig(name);
    for (const played of of.clips()) {
      const who = played.hasEvents ? "mara" : undefined;
      for (let time = 0; time < 2; time += 0.13) {
        const face = played.faceAt(time, who);
        const settings = { emotions: played.emotionsAt(time, who), face };
        const parts = bankRig.weights(played.articulationAt(time), settings);
        assert.deepEqual(played.weightsAt(time, bankRig, { who }), parts);
        compared += 1;
      }
    }
  }
  assert.ok(compared > 50, compared);
  const isForeign = (error) => error instanceof LipzError && /different dialogue/.test(error.message);
  assert.throws(() => clip.weightsAt(0, specials.rig("arkit")), isForeign);
});

test("names are recognised in the ways in which models write them", () => {
  const arkit = [...KINDS.arkit.mouth, ...KINDS.arkit.rest];
  const models = {
    arkit: [
      named(arkit, (name) => name),
      named(arkit, (name) => `blendShape1.${name}`),
      named(arkit, (name) => name[0].toUpperCase() + name.slice(1)),
      named(arkit, (name) => name.replace(/Left$/, "_L").replace(/Right$/, "_R")),
      named(arkit, (name) => name.replace(/(Left|Right)$/, (side) => side[0])),
      named(arkit, (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)),
      [...OVR.map((name) => `viseme_${name}`), ...arkit],
    ],
    ovr: [OVR, ...["viseme_", "vrc.v_", "Wolf3D_Head.viseme_"].map((prefix) => named(OVR, (name) => prefix + name))],
    vrm: [
      "aa ih ou ee oh happy angry sad relaxed surprised blink".split(" "),
      "Neutral A I U E O Blink Joy Angry Sorrow Fun Surprised".split(" "),
      VROID.map((name) => `Fcl_${name}`),
      VROID.map((name) => `Face.M_F00_000_00_Fcl_${name}`),
    ],
    mmd: ["真面目 困る にこり 怒り まばたき 笑い あ い う え お ん".split(" ")],
    live2d: [
      "ParamAngleX ParamEyeLOpen ParamEyeROpen ParamMouthForm ParamMouthOpenY".split(" "),
      "PARAM_MOUTH_FORM PARAM_MOUTH_OPEN_Y PARAM_EYE_L_OPEN PARAM_EYE_R_OPEN".split(" "),
    ],
    blair: [Array.from("AEFLMOSUW-"), named(Array.from("AEFLMOSUW"), (code) => `Mouth_${code}`).concat("rest")],
    toonboom: [Array.from("ABCDEFGX"), Array.from("ABCDEFGHX", (code) => `mouth-${code}`)],
    rms: [["rest", ...Array.from("0123456789", (code) => `Mouth ${code}`)]],
  };
  for (const [kind, lists] of Object.entries(models)) {
    for (const names of lists) {
      const { kind: found, report, map, weightNames } = rig(names);
      assert.deepEqual([found, report], [kind, undefined], names.join(" "));
      assert.equal(new Set(Object.values(map)).size, weightNames.length, "each weight has a shape of its own");
    }
  }
});

test("each weight leads to its own shape", () => {
  const vroid = VROID.map((name) => `Fcl_${name}`);
  const names = Object.fromEntries(Object.entries(rig(vroid).map).map(([weight, index]) => [weight, vroid[index]]));
  assert.equal(names.blink, "Fcl_EYE_Close");
  assert.deepEqual([names.happy, names.aa, names.oh], ["Fcl_ALL_Joy", "Fcl_MTH_A", "Fcl_MTH_O"]);
  // three.js: an object with the index of each name.
  assert.deepEqual(rig({ mouthClose: 7, jawOpen: 3 }).map, { jawOpen: 3, mouthClose: 7 });
  assert.deepEqual(rig(["jawOpen", "a.jawOpen", "jawOpen"]).map, { jawOpen: 0 });
  // Names like those of members of objects.
  assert.equal(rig(["constructor", "__proto__", "aa"]).kind, "ovr");
});

test("missing shapes are reported, with similar names", () => {
  const { kind, missing, report } = rig(["jawOpen", "mouthFunel", "mouthPuckerr", "smile"]);
  assert.equal(kind, "arkit");
  assert.equal(missing.length, 34);
  const funnel = missing.find(({ name }) => name === "mouthFunnel");
  assert.deepEqual(funnel, { name: "mouthFunnel", suggestion: "mouthFunel" });
  assert.equal(
    report,
    "34 of 35 shapes of arkit are missing: mouthClose, mouthFunnel (did you mean mouthFunel?), " +
      "mouthPucker (did you mean mouthPuckerr?), mouthRollLower, mouthRollUpper, 29 more",
  );
  const misspelt = rig(["jawOpne", "Smile"]);
  assert.deepEqual([misspelt.kind, misspelt.missing], [undefined, [{ name: "jawOpen", suggestion: "jawOpne" }]]);
  assert.match(misspelt.report, /^none of 2 shapes .*\(jawOpne, Smile\); expected jawOpen \(did you mean jawOpne\?\)$/);
  assert.match(rig([]).report, /^none of 0 shapes/);
  assert.throws(() => misspelt.apply([0], []), /none of 2 shapes/);
});

test("names of a project's own rig are found, too", () => {
  const facefx = dialogue.rig("facefx");
  const shapes = rig(["head|Open", "head|w", "head|sh_ch", "wide"], facefx);
  assert.deepEqual(shapes.map, { open: 0, W: 1, ShCh: 2, wide: 3 });
  assert.equal(shapes.missing.length, 5);
  const vrchat = dialogue.rig("vrchat");
  assert.equal(rig(OVR.map((name) => `viseme_${name}`), vrchat).map["vrc.v_aa"], 10);
});

test("a shape for each viseme", () => {
  const shapes = rig(Array.from("AEFLMOSUW", (code) => `Mouth_${code}`));
  const influences = [9, 9, 9, 9, 9, 9, 9, 9, 9, 9];
  shapes.show("L", influences);
  assert.deepEqual(influences, [0, 0, 0, 1, 0, 0, 0, 0, 0, 9]);
  shapes.show("-", influences);
  assert.deepEqual(influences, [0, 0, 0, 0, 0, 0, 0, 0, 0, 9]);
});

test("wrong arguments are errors that name the remedy", () => {
  assert.throws(() => rig("jawOpen"), /jawOpen is not a list of names/);
  assert.throws(() => rig(undefined), TypeError);
  assert.throws(() => rig(["jawOpen"], "arkit"), /arkit is not a rig: .* dialogue.rig/);
  assert.throws(() => clip.weightsAt(0, dialogue.rig("missing")), /undefined is not a rig: name it in \[rig\]/);
  assert.throws(() => rig(["jawOpen"]).apply([1, 2], []), /there are 2 weights, but 35 of arkit: pass their rig/);
});

test("nothing is allocated for a rendered frame", () => {
  const { gc } = globalThis;
  const shapes = rig(dialogue.rig("arkit").weightNames);
  const [weights, influences] = [new Float32Array(35), new Float32Array(35)];
  const frames = (count) => {
    for (let i = 0; i < count; i++) shapes.apply(weights, influences);
  };
  frames(100_000);
  gc?.();
  const before = process.memoryUsage().heapUsed;
  frames(100_000);
  assert.ok(process.memoryUsage().heapUsed - before < 100_000, "less than a byte for each");
});

test("similar names", () => {
  assert.equal(nearest("jawOpen", ["JAW-OPEN"]), "JAW-OPEN");
  assert.equal(nearest("fps", ["fbs"]), "fbs");
  assert.equal(nearest("fps", ["fbz"]), undefined);
  assert.equal(nearest("visemes", ["events", "vismees"]), "vismees");
  assert.equal(nearest("灯台守り", ["灯台守る"]), "灯台守る");
});
