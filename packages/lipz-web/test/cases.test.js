// The cases of fixtures/playback/cases.txt, played by the package: it answers as the reader in Rust does.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { open } from "../lipz.js";

const beside = (path) => new URL(path, import.meta.url);

/** The time that words start with, and the words behind it. */
function timeOf([unit, value, ...rest]) {
  if (unit === "us") return [{ us: BigInt(value) }, rest];
  if (unit === "samples") return [{ position: BigInt(value), rateHz: Number(rest[0]) }, rest.slice(1)];
  const words = { nan: NaN, inf: Infinity, "-inf": -Infinity };
  const seconds = words[value] ?? Number(value);
  // A clock of JavaScript has 64 bits: what one with 32 bits tells is rounded before.
  if (unit === "f32") return [Math.fround(seconds), rest];
  assert.equal(unit, "seconds");
  return [seconds, rest];
}

/** Takes `of CHARACTER` or `speaker CHARACTER` from the front of words, if that stands there. */
function whoOf(words) {
  if (words[0] !== "of" && words[0] !== "speaker") return undefined;
  const [what, character] = words.splice(0, 2);
  return { character, isSpeaker: what === "speaker" };
}

class Stage {
  #curves = new Map();
  #bank;
  #clip;
  #cursor;
  #locale;

  /** The lines that a command answers. */
  async command([verb, ...words]) {
    switch (verb) {
      case "bank":
        this.#bank = (await open(await readFile(beside(`banks/${words[0]}.lipzbank`)))).verify();
        this.#locale = undefined;
        this.#curves.clear();
        // As a game does that keeps its cursor while the bank is replaced.
        this.#clip = this.#clip && this.#bank.clip(this.#clip.id);
        if (this.#cursor && this.#clip) this.#cursor = this.#clip.resume(this.#cursor);
        return [];
      case "texts":
        this.#bank.useTexts(await readFile(beside(`banks/${words[0]}.lipztexts`))).verify();
        this.#locale = undefined;
        return [];
      case "locale":
        this.#locale = this.#bank.locales.find((tag) => tag === words[0]);
        return this.#locale ? [] : ["no locale"];
      case "clip":
        return this.#start(words);
      case "speaker":
        this.#cursor.speaker = words[0];
        return [];
      case "lead":
        this.#cursor.lead = { one: { frames: 1 }, two: { frames: 2 } }[words[0]] ?? { us: Number(words[0]) };
        return [];
      case "hold":
        if (words[0] === "display") this.#cursor.hold = { picture: Number(words[1]) / 1e6 };
        else this.#cursor.hold = words[0] === "readable" ? "readable" : Number(words[0]);
        return [];
      case "advance":
        return this.#moved(this.#cursor.advanceTo(timeOf(words)[0]));
      case "loop":
        return this.#moved(this.#cursor.loopTo(timeOf(words)[0]));
      case "seek":
        this.#cursor.seek(timeOf(words)[0]);
        return this.#moved({ segments: [], events: [] });
      case "finish":
        return this.#moved(this.#cursor.finish());
      case "state":
        return [character(this.#cursor.state(words[0] === "-" ? undefined : words[0]), words[0])];
      case "characters":
        return this.#cursor.characters().map((found) => character(found, found.name ?? "-"));
      case "babble":
        return this.#babble(words);
      case "curves":
        return this.#clip.curves.map(({ name, keys }) =>
          [`${name}:`, ...keys.map(({ frame, value }) => `${frame}:${thousandths(value)}`)].join(" "),
        );
      case "curve":
        return this.#curve(words);
      case "emotions":
        return [this.#emotions(words)];
      case "voices":
        return this.#bank.voices;
      case "voice": {
        const voiced = this.#clip.inVoice(words[0]);
        if (voiced === undefined) return ["no voice"];
        return [`${voiced.spoken.replace("-", " ")}: ${voiced.clip.key}, spoken in ${voiced.clip.voice}`];
      }
      case "face":
      case "idle":
        return this.#face(verb, words);
      default:
        return assert.fail(`no command: ${verb}`);
    }
  }

  #start([key, ...given]) {
    this.#clip = this.#bank.clip(key);
    for (let at = 0; at < given.length; at += 2) {
      const [what, value] = given.slice(at);
      this.#clip = what === "rate" ? this.#clip.orFps(...value.split("/").map(Number)) : this.#clip.orVisemeType(value);
    }
    this.#cursor = undefined;
    if (this.#clip.fps === undefined) return ["no frame rate"];
    this.#cursor = this.#clip.cursor();
    return [];
  }

  #moved({ segments, events }) {
    const { frame, isOver, viseme, openness, segment } = this.#cursor;
    const shown = [`frame ${frame ?? (isOver ? "over" : "waiting")}`, `viseme ${viseme}`];
    if (openness !== undefined) shown.push(`open ${Math.round(openness * 10_000)}`);
    const text = this.#locale && segment?.text(this.#locale);
    if (segment) shown.push(`segment ${segment.index}${text ? `: ${text.text}${text.isFallback ? " (fallback)" : ""}` : ""}`);
    const due = segments.map(({ index, event }) => `due ${index}${event === undefined ? "" : `: ${event}`.trimEnd()}`);
    const words = ({ character, verb, object }) => [character, verb, object].filter((word) => word !== undefined).join(" ");
    return [shown.join(", "), ...due, ...events.map((event) => `event ${words(event)}`)];
  }

  #curve([name, ...words]) {
    const curve = this.#clip.curve(name);
    if (curve === undefined) return ["no curve"];
    const read = (from) => (words[0] === "frame" ? from.value(Number(words[1])) : from.valueAt(timeOf(words)[0]));
    const value = read(curve);
    // The same curve as read before, wherever: its cursor changes nothing.
    const id = `${this.#clip.key} ${this.#clip.fps?.numerator} ${name}`;
    if (!this.#curves.has(id)) this.#curves.set(id, curve);
    assert.equal(read(this.#curves.get(id)), value);
    return [value === undefined ? "no frame rate" : String(thousandths(value))];
  }

  #emotions(words) {
    const who = whoOf(words);
    const [time] = timeOf(words);
    return emotions(who ? this.#clip.emotionsOf(who.character, time, who) : this.#clip.emotionsAt(time));
  }

  #face(verb, words) {
    const who = whoOf(words);
    const [name, look] = words.splice(0, 2);
    const profile = name === "default" ? this.#bank.defaultFaceProfile : this.#bank.faceProfile(name);
    if (profile === undefined) return ["no profile"];
    let lookAt;
    if (look !== "ahead") {
      const [pitch, yaw] = words.splice(0, 2).map((angle) => Number(angle) / 1000);
      lookAt = { pitch, yaw, isPerson: look === "person" };
    }
    const seed = verb === "idle" ? BigInt(words.shift()) : undefined;
    const [time] = timeOf(words);
    if (verb === "idle") return [face(profile.idleAt(time, { seed, lookAt }))];
    const settings = { profile, lookAt };
    return [face(who ? this.#clip.faceOf(who.character, time, { ...who, ...settings }) : this.#clip.faceAt(time, settings))];
  }

  #babble([name, ...words]) {
    const babble = name === "default" ? this.#bank.defaultBabble : this.#bank.babble(name);
    if (babble === undefined) return ["no profile"];
    const [time, [kind, value]] = timeOf(words);
    // A level is a power in 65,536ths, and exact as such.
    const power = kind === "level" ? Number(value) / 65_536 : value === "nan" ? NaN : Number(value);
    const { ooh, aah } = babble.at(time, power);
    return [`ooh ${Math.round(ooh * 10_000)}, aah ${Math.round(aah * 10_000)}`];
  }
}

const thousandths = (value) => Math.round(value * 1000);

function emotions({ values, strongest, sum }) {
  const felt = Object.entries(values).filter(([, value]) => value !== 0);
  const told = felt.map(([name, value]) => `${name} ${thousandths(value)}, `).join("");
  return `${told}strongest ${strongest ?? "neutral"}, sum ${thousandths(sum)}`;
}

function face(found) {
  const told = (...names) => names.map((name) => thousandths(found[name])).join(" ");
  const moved = `head ${told("headPitch", "headYaw", "headRoll")}, eyes ${told("eyePitch", "eyeYaw")}`;
  return `blink ${told("blink")}, ${moved}, brows ${told("brows")}, shrug ${told("shrug")}, breath ${told("breath")}`;
}

const character = ({ feels, staresAt, pointsAt }, name) =>
  `${name}: feels ${feels ?? "-"}, stares ${staresAt ?? "-"}, points ${pointsAt ?? "-"}`;

test("the package answers as the cases say", async (t) => {
  const expected = await readFile(beside("cases.txt"), "utf8");
  const stage = new Stage();
  let found = "";
  let commands = 0;
  for (const line of expected.trimEnd().split("\n").filter((line) => !line.startsWith("  "))) {
    found += `${line}\n`;
    if (line === "" || line.startsWith("#")) continue;
    commands += 1;
    for (const answer of await stage.command(line.split(" "))) found += `  ${answer}\n`;
  }
  t.diagnostic(`${commands} commands`);
  // Line by line first: the first line that differs says more than the whole.
  const lines = expected.split("\n");
  found.split("\n").forEach((line, index) => assert.equal(line, lines[index], `cases.txt:${index + 1}`));
  assert.equal(found, expected);
});
