// Makes models for tests: a face with the shapes of Oculus and ARKit as GLB, and one of VRM 1.0. Both have only lips: a
// ring, whose inner edge each shape of the mouth moves.

/** Vertices of each edge of the lips. */
const COUNT = 32;
/** Half the width and half the height of the outer edge, and of the inner edge at rest. */
const OUTER = [1, 0.55];
const INNER = [0.7, 0.08];

/** The factor for the width of the inner edge, and half its height, for each shape that moves it. */
const OVR = {
  ...{ sil: [1, 0.08], PP: [1, 0.01], FF: [1, 0.05], TH: [1, 0.15], DD: [1, 0.12], kk: [1, 0.14], CH: [0.7, 0.15] },
  ...{ SS: [1.1, 0.1], nn: [1, 0.13], RR: [0.7, 0.14], aa: [1, 0.45], E: [1.15, 0.25], I: [1.25, 0.15] },
  ...{ O: [0.6, 0.35], U: [0.4, 0.18] },
};
const VRM = { aa: [1, 0.45], ih: [1.2, 0.15], ou: [0.4, 0.18], ee: [1.15, 0.25], oh: [0.6, 0.35] };
const MOVING = {
  ...{ jawOpen: [1, 0.45], mouthClose: [1, 0.01], mouthFunnel: [0.6, 0.3], mouthPucker: [0.5, 0.1] },
  ...{ mouthSmileLeft: [1.2, 0.08], mouthSmileRight: [1.2, 0.08], mouthStretchLeft: [1.1, 0.08] },
  ...{ mouthUpperUpLeft: [1, 0.16], mouthLowerDownLeft: [1, 0.2] },
};
/** All shapes of ARKit, in alphabetical order; a star stands for both sides. */
const ARKIT = `browDown* browInnerUp browOuterUp* cheekPuff cheekSquint* eyeBlink* eyeLookDown* eyeLookIn* eyeLookOut*
  eyeLookUp* eyeSquint* eyeWide* jawForward jawLeft jawOpen jawRight mouthClose mouthDimple* mouthFrown* mouthFunnel
  mouthLeft mouthLowerDown* mouthPress* mouthPucker mouthRight mouthRollLower mouthRollUpper mouthShrugLower
  mouthShrugUpper mouthSmile* mouthStretch* mouthUpperUp* noseSneer* tongueOut`
  .split(/\s+/)
  .flatMap((name) => (name.endsWith("*") ? ["Left", "Right"].map((side) => name.replace("*", side)) : [name]));

/** The bones that VRM 1.0 requires, each after its parent. */
const BONES = {
  ...{ hips: undefined, spine: "hips", head: "spine" },
  ...limb("hips", "UpperLeg", "LowerLeg", "Foot"),
  ...limb("spine", "UpperArm", "LowerArm", "Hand"),
};

function limb(root, ...parts) {
  const bones = ["left", "right"].flatMap((side) =>
    parts.map((part, place) => [side + part, place === 0 ? root : side + parts[place - 1]]),
  );
  return Object.fromEntries(bones);
}

const edge = ([width, height]) =>
  Array.from({ length: COUNT }, (_, index) => {
    const angle = (2 * Math.PI * index) / COUNT;
    return [width * Math.cos(angle), height * Math.sin(angle), 0];
  });

/** The offsets of all vertices for a shape. */
function offsets([widening, height]) {
  const inner = edge([INNER[0] * (widening - 1), height - INNER[1]]);
  return [...Array(COUNT).fill([0, 0, 0]), ...inner];
}

/** The contents of a glTF file: views of one buffer, and their accessors. */
class Contents {
  bytes = [];
  bufferViews = [];
  accessors = [];

  /** Adds numbers and returns the index of their accessor. */
  add(numbers, target, accessor) {
    const data = Buffer.from(numbers.buffer);
    this.bufferViews.push({ buffer: 0, byteOffset: this.length, byteLength: data.length, target });
    this.bytes.push(data, Buffer.alloc(-data.length & 3));
    this.accessors.push({ bufferView: this.bufferViews.length - 1, ...accessor });
    return this.accessors.length - 1;
  }

  vectors(vectors, target = 34962) {
    const rounded = vectors.map((vector) => vector.map(Math.fround));
    const bound = (of) => [0, 1, 2].map((axis) => of(...rounded.map((vector) => vector[axis])));
    const [min, max] = [bound(Math.min), bound(Math.max)];
    const accessor = { componentType: 5126, count: vectors.length, type: "VEC3", min, max };
    return this.add(Float32Array.from(rounded.flat()), target, accessor);
  }

  get length() {
    return this.bytes.reduce((sum, { length }) => sum + length, 0);
  }
}

/** A glTF file with the lips and these shapes: their names, width and height. `extend` adds to its JSON. */
function glb(shapes, extend = () => {}) {
  const contents = new Contents();
  const triangles = Array.from({ length: COUNT }, (_, index) => {
    const next = (index + 1) % COUNT;
    return [index, next, COUNT + index, next, COUNT + next, COUNT + index];
  });
  const attributes = { POSITION: contents.vectors([...edge(OUTER), ...edge(INNER)]) };
  attributes.NORMAL = contents.vectors(Array(2 * COUNT).fill([0, 0, 1]));
  const indices = Uint16Array.from(triangles.flat());
  const primitive = {
    attributes,
    indices: contents.add(indices, 34963, { componentType: 5123, count: indices.length, type: "SCALAR" }),
    material: 0,
    targets: Object.values(shapes).map((shape) => ({ POSITION: contents.vectors(offsets(shape)) })),
  };
  const names = Object.keys(shapes);
  const json = {
    asset: { version: "2.0", generator: "test/engines/model.js" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: "Face", mesh: 0 }],
    meshes: [{ name: "Face", primitives: [primitive], weights: names.map(() => 0), extras: { targetNames: names } }],
    materials: [
      {
        name: "Lips",
        pbrMetallicRoughness: { baseColorFactor: [0.8, 0.1, 0.15, 1], metallicFactor: 0 },
        doubleSided: true,
        extensions: { KHR_materials_unlit: {} },
      },
    ],
    extensionsUsed: ["KHR_materials_unlit"],
    accessors: contents.accessors,
    bufferViews: contents.bufferViews,
    buffers: [{ byteLength: contents.length }],
  };
  extend(json);
  return packed(json, Buffer.concat(contents.bytes));
}

/** The bytes of a GLB file. */
function packed(json, binary) {
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc(-text.length & 3, " ")]);
  const words = (...numbers) => Buffer.from(Uint32Array.from(numbers).buffer);
  const chunks = [words(padded.length, 0x4e4f534a), padded, words(binary.length, 0x004e4942), binary];
  const length = 12 + chunks.reduce((sum, chunk) => sum + chunk.length, 0);
  return Buffer.concat([words(0x46546c67, 2, length), ...chunks]);
}

/** A face with the 15 visemes of Oculus and the 52 shapes of ARKit. */
export function faceGlb() {
  const visemes = Object.entries(OVR).map(([name, shape]) => [`viseme_${name}`, shape]);
  const shapes = ARKIT.map((name) => [name, MOVING[name] ?? [1, INNER[1]]]);
  return glb(Object.fromEntries([...visemes, ...shapes]));
}

/** A face of VRM 1.0 with five expressions for the mouth. */
export function faceVrm() {
  return glb(VRM, (json) => {
    const bones = Object.keys(BONES);
    const nodeOf = (bone) => json.nodes.length + bones.indexOf(bone);
    const children = (bone) => bones.filter((child) => BONES[child] === bone).map(nodeOf);
    const nodes = bones.map((name) => ({ name, ...(children(name).length > 0 && { children: children(name) }) }));
    const humanBones = Object.fromEntries(bones.map((bone) => [bone, { node: nodeOf(bone) }]));
    json.scenes[0].nodes.push(nodeOf("hips"));
    json.nodes.push(...nodes);
    const expression = (index) => ({ morphTargetBinds: [{ node: 0, index, weight: 1 }] });
    const preset = Object.fromEntries(Object.keys(VRM).map((name, index) => [name, expression(index)]));
    const meta = { name: "Lips", authors: ["lipz"], licenseUrl: "https://vrm.dev/licenses/1.0/" };
    json.extensionsUsed.push("VRMC_vrm");
    json.extensions = { VRMC_vrm: { specVersion: "1.0", meta, humanoid: { humanBones }, expressions: { preset } } };
  });
}
