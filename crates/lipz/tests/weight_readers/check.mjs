// Reads exported animations with the readers of other projects, and compares the weights of each frame with the rows of
// an Audio2Face export of the same clip.
//
// The test copies this file into the folder with the readers.
//
// usage: node check.mjs FORMAT FILE EXPECTED.json
import { strict as assert } from "node:assert";
import { readFileSync } from "node:fs";

const [format, file, expectedFile] = process.argv.slice(2);
const expected = JSON.parse(readFileSync(expectedFile));
/** The largest distance that the help of the command states, and the rounding of both files. */
const TOLERANCE = 0.0021;

/** Returns the value of keys at a time, by straight lines. */
function interpolated(times, values, time) {
  let next = times.findIndex((key) => key > time + 1e-6);
  if (next === -1) return values.at(-1);
  if (next === 0) return values[0];
  const share = (time - times[next - 1]) / (times[next] - times[next - 1]);
  return values[next - 1] + (values[next] - values[next - 1]) * share;
}

/** Fails if the validator finds an error or a warning. */
async function validate(bytes) {
  const validator = (await import("gltf-validator")).default;
  const { issues } = await validator.validateBytes(new Uint8Array(bytes));
  const serious = issues.messages.filter((message) => message.severity < 2);
  assert.deepEqual(serious, []);
}

/** Each reader returns a function from the name of a weight and a time in seconds to the weight. */
const readers = {
  async gltf(bytes) {
    await validate(bytes);
    const { NodeIO } = await import("@gltf-transform/core");
    const document = await new NodeIO().readBinary(new Uint8Array(bytes));
    const [animation] = document.getRoot().listAnimations();
    const [channel] = animation.listChannels();
    assert.equal(channel.getTargetPath(), "weights");
    const names = channel.getTargetNode().getMesh().getExtras().targetNames;
    const times = [...channel.getSampler().getInput().getArray()];
    const values = channel.getSampler().getOutput().getArray();
    return (name, time) => {
      const index = names.indexOf(name);
      if (index === -1) return undefined;
      return interpolated(times, times.map((_, frame) => values[frame * names.length + index]), time);
    };
  },

  async vrma(bytes) {
    await validate(bytes);
    globalThis.self ??= globalThis;
    const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
    const { VRMAnimationLoaderPlugin } = await import("@pixiv/three-vrm-animation");
    const loader = new GLTFLoader();
    loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    const gltf = await loader.parseAsync(buffer, "");
    const [animation] = gltf.userData.vrmAnimations;
    const { preset, custom } = animation.expressionTracks;
    return (name, time) => {
      const track = preset.get(name) ?? custom.get(name);
      return track && interpolated([...track.times], [...track.values], time);
    };
  },

  async vmd(bytes) {
    const { Parser } = (await import("mmd-parser")).default ?? (await import("mmd-parser"));
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    const motion = new Parser().parseVmd(buffer, true);
    return (name, time) => {
      const keys = motion.morphs.filter((morph) => morph.morphName === name);
      if (keys.length === 0) return undefined;
      return interpolated(keys.map((key) => key.frameNum / 30), keys.map((key) => key.weight), time);
    };
  },

  async spine(bytes) {
    const spine = await import("@esotericsoftware/spine-core");
    const atlas = new spine.TextureAtlas("");
    const json = new spine.SkeletonJson(new spine.AtlasAttachmentLoader(atlas));
    const data = json.readSkeletonData(JSON.parse(bytes.toString()));
    const state = new spine.AnimationState(new spine.AnimationStateData(data));
    const entry = state.setAnimation(0, data.animations[0].name, false);
    const skeleton = new spine.Skeleton(data);
    return (name, time) => {
      const bone = skeleton.bones.find((bone) => bone.data.name === name);
      if (!bone) return undefined;
      entry.trackTime = time;
      state.apply(skeleton);
      return (bone.pose ?? bone).x / 100;
    };
  },

  /** The specification of motion3.json: a point, and for each segment its kind and its end. */
  async live2d(bytes) {
    const motion = JSON.parse(bytes.toString());
    assert.equal(motion.Meta.CurveCount, motion.Curves.length);
    return (name, time) => {
      const curve = motion.Curves.find((curve) => curve.Id === name);
      if (!curve) return undefined;
      const [times, values] = [[curve.Segments[0]], [curve.Segments[1]]];
      for (let at = 2; at < curve.Segments.length; at += 3) {
        assert.equal(curve.Segments[at], 0, "a linear segment");
        times.push(curve.Segments[at + 1]);
        values.push(curve.Segments[at + 2]);
      }
      return interpolated(times, values, time);
    };
  },

  /** Godot's text resources: keys of blend shapes are time, transition and value. */
  async godot(bytes) {
    const tracks = new Map();
    for (const [, path, keys] of bytes.toString().matchAll(/path = NodePath\("(.*)"\)[^]*?PackedFloat32Array\((.*)\)/g)) {
      tracks.set(path.replace("Face:", ""), keys.split(", ").map(Number));
    }
    return (name, time) => {
      const keys = tracks.get(name);
      if (!keys) return undefined;
      const every = (offset) => keys.filter((_, index) => index % 3 === offset);
      return interpolated(every(0), every(2), time);
    };
  },

  /** Unity's curves: Hermite splines with percentages. */
  async unity(bytes) {
    const curves = new Map();
    for (const curve of bytes.toString().split("  - serializedVersion: 2\n").slice(1)) {
      const name = curve.match(/attribute: "blendShape\.(.*)"/)[1];
      const numbers = (field) => [...curve.matchAll(new RegExp(` ${field}: (\\S+)`, "g"))].map((match) => Number(match[1]));
      curves.set(name, { times: numbers("time"), values: numbers("value"), into: numbers("inSlope"), out: numbers("outSlope") });
    }
    return (name, time) => {
      const curve = curves.get(name);
      if (!curve) return undefined;
      const next = curve.times.findIndex((key) => key > time + 1e-6);
      if (next < 1) return curve.values.at(next) / 100;
      const length = curve.times[next] - curve.times[next - 1];
      const t = (time - curve.times[next - 1]) / length;
      const [from, to] = [curve.values[next - 1], curve.values[next]];
      const [out, into] = [curve.out[next - 1] * length, curve.into[next] * length];
      return ((2 * t ** 3 - 3 * t ** 2 + 1) * from + (t ** 3 - 2 * t ** 2 + t) * out
        + (-2 * t ** 3 + 3 * t ** 2) * to + (t ** 3 - t ** 2) * into) / 100;
    };
  },
};

const weight = await readers[format](readFileSync(file));
let [compared, largest] = [0, 0];
for (const [frame, row] of expected.weightMat.entries()) {
  for (const [index, name] of expected.facsNames.entries()) {
    const value = weight(name, frame / expected.exportFps);
    // The expected file has all shapes of ARKit, and those that the rig lacks never move.
    if (value === undefined) {
      assert.equal(row[index], 0, `${name} is missing`);
      continue;
    }
    assert.ok(Math.abs(value - row[index]) <= TOLERANCE, `${name} in frame ${frame}: ${value}, not ${row[index]}`);
    compared += 1;
    largest = Math.max(largest, row[index]);
  }
}
assert.ok(compared >= expected.numFrames && largest > 0.3, "the face moves");
console.log(`${format}: ${compared} weights`);
