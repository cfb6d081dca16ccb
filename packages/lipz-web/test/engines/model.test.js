// The models of the tests are valid glTF.

import assert from "node:assert/strict";
import { test } from "node:test";
import validator from "gltf-validator";
import { faceGlb, faceVrm } from "./model.js";

const MODELS = { "face.glb": [faceGlb, 67], "face.vrm": [faceVrm, 5] };

for (const [name, [make, targets]] of Object.entries(MODELS)) {
  test(`${name} is valid`, async () => {
    const { issues, info } = await validator.validateBytes(new Uint8Array(make()), { uri: name });
    const { numErrors, numWarnings, messages } = issues;
    assert.deepEqual([numErrors, numWarnings], [0, 0], JSON.stringify(messages));
    assert.equal(info.hasMorphTargets, true);
    const json = JSON.parse(make().toString("utf8", 20, 20 + make().readUInt32LE(12)));
    assert.equal(new Set(json.meshes[0].extras.targetNames).size, targets);
  });
}
