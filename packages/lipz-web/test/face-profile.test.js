// Faces in node, in every unit of time, with a profile and a direction. The cases compare them with the reader in Rust.

import assert from "node:assert/strict";
import { test } from "node:test";
import { FaceProfile, LipzError, openDialogue } from "../node.js";

const banks = new URL("./banks/", import.meta.url);
const dialogue = await openDialogue([new URL("curves.lipzbank", banks)]);
const [clip] = dialogue.clips();

test("a face depends on the time, the profile and the direction alone", () => {
  const profile = dialogue.defaultFaceProfile;
  assert.ok(profile instanceof FaceProfile);
  assert.equal(profile.name, "default");
  assert.equal(dialogue.faceProfile("robot"), undefined);
  for (let step = 0; step < 200; step += 1) {
    const face = clip.faceAt(step / 20);
    assert.deepEqual(clip.faceAt({ us: step * 50_000 }, undefined, profile), face);
    assert.deepEqual(clip.faceAt({ position: step * 2400, rateHz: 48_000 }), face);
    assert.ok(face.blink >= 0 && face.blink <= 1);
  }
  assert.ok(Array.from({ length: 400 }, (_, step) => clip.faceAt(step / 20)).some(({ blink }) => blink === 1));
});

test("the head follows the eyes beyond 20 degrees", () => {
  const profile = dialogue.defaultFaceProfile;
  const door = profile.idleAt(1, 0, { pitch: -30, yaw: 50, isPerson: false });
  assert.deepEqual([door.eyePitch, door.headPitch, door.eyeYaw, door.headYaw], [-20, -10, 20, 30]);
  const person = profile.idleAt(1, 0, { pitch: 0, yaw: 50 });
  assert.ok(person.headYaw > 10);
  assert.notDeepEqual(profile.idleAt(1.5, 1), profile.idleAt(1.5, 2n ** 63n));
});

test("a profile of another dialogue is refused", async () => {
  const other = await openDialogue([new URL("specials.lipzbank", banks)]);
  const robot = other.faceProfile("robot");
  assert.equal(robot.name, "robot");
  assert.throws(() => clip.faceAt(0, undefined, robot), LipzError);
  const talk = other.clip("talk");
  // A robot blinks only once the speaker gets angry, which is later.
  const lids = Array.from({ length: 250 }, (_, index) => talk.faceAt(index / 100, undefined, robot).blink);
  assert.deepEqual(new Set(lids), new Set([0]));
});
