// Sets of banks, in node: fixtures/banks/sets/dubbed.lipzset, which is dubbed.lipzbank in two.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { BankSet, LipzError, open, openSet } from "../lipz.js";

const file = (name) => readFile(new URL(`sets/${name}`, import.meta.url));
const index = await file("dubbed.lipzset");

test("a set answers as the one bank", async () => {
  const whole = (await open(await readFile(new URL("banks/dubbed.lipzbank", import.meta.url)))).verify();
  const loaded = [];
  const set = await openSet(index, (name) => (loaded.push(name), file(name)));
  assert.ok(set instanceof BankSet);
  assert.equal(set.clipCount, whole.clipCount);
  assert.equal(set.banks.length, 2);
  assert.equal(set.banks.reduce((sum, bank) => sum + bank.clipCount, 0), 3);
  assert.deepEqual(loaded, [], "nothing is loaded before it is asked for");
  for (const clip of whole.clips()) {
    for (const asked of [clip.key, clip.id]) {
      const found = await set.clip(asked);
      assert.deepEqual([found.key, found.frames], [clip.key, clip.frames]);
      const bank = await set.bank(set.bankNumberOf(asked));
      assert.equal(bank.clip(asked).key, clip.key);
      assert.deepEqual(bank.locales, whole.locales);
    }
    const own = (await set.clip(clip.key)).inVoice("de-de") ?? { clip, spoken: "original" };
    const { clip: played, spoken } = clip.inVoice("de-de");
    assert.deepEqual([own.clip.key, own.spoken], [played.key, spoken]);
  }
  assert.equal(await set.clip("nobody"), undefined);
  assert.deepEqual(loaded.sort(), set.banks.map((bank) => bank.fileName), "each bank is loaded once");
  assert.equal(typeof set.fingerprint, "bigint");
});

test("banks that are not those of the index are refused, and asked for again", async () => {
  await assert.rejects(openSet(await file("dubbed.0-of-2.51e62ffc7e3d30e7.lipzbank"), file), LipzError);
  const damaged = Uint8Array.from(index);
  damaged[100] ^= 1;
  await assert.rejects(openSet(damaged, file), (error) => error instanceof LipzError && error.offsetBytes === 8);
  let isOther = true;
  const names = (await openSet(index, file)).banks.map((bank) => bank.fileName);
  const set = await openSet(index, (name) => file(isOther ? names.find((other) => other !== name) : name));
  await assert.rejects(set.clip("aye"), (error) => error.status === 44);
  const forged = async (name) => {
    const [own, other] = await Promise.all([file(name), file(names.find((other) => other !== name))]);
    own.copy(other, 8, 8, 16);
    return other;
  };
  await assert.rejects((await openSet(index, forged)).clip("aye"), (error) => error.status === 44, "by its header alone");
  isOther = false;
  assert.equal((await set.clip("aye")).key, "aye");
  await assert.rejects(set.bank(2), LipzError);
});
