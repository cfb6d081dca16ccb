// The cases of fixtures/playback/cases.txt, played by the package, which must return the same results as the reader in
// Rust. They are played with single banks, and with the same dialogue in different files, in the folders of `layouts`.

import assert from "node:assert/strict";
import { existsSync, readdirSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { ARTICULATORS, openDialogue } from "../node.js";

const beside = (path) => new URL(path, import.meta.url);

const BANKS = beside("banks/");
const LAYOUTS = beside("layouts/");

/** Features that sections need beyond clips, cursors, segments, texts and events. The package has all of them. */
const HAS = new Set("articulation babble curves emotions faces hold lead refresh states text-banks voices".split(" "));

/** The folders of banks with which the cases are played. */
function folders() {
  const layouts = existsSync(LAYOUTS) ? readdirSync(LAYOUTS, { withFileTypes: true }) : [];
  return [BANKS, ...layouts.filter((entry) => entry.isDirectory()).map(({ name }) => new URL(`${name}/`, LAYOUTS))];
}

/** The path of a file, in the folder or otherwise among the banks. */
function placed(folder, file) {
  const url = new URL(file, folder);
  return existsSync(url) ? url : new URL(file, BANKS);
}

/** The files of a bank: those in `NAME.list`, one per line, or `NAME.lipzbank`. */
async function filesOf(folder, name) {
  const list = placed(folder, `${name}.list`);
  if (!existsSync(list)) return [placed(folder, `${name}.lipzbank`)];
  const lines = (await readFile(list, "utf8")).split("\n").map((line) => line.trim());
  return lines.filter((line) => line !== "").map((file) => new URL(file, list));
}

/** The time at the start of words, and the remaining words. */
function timeOf([unit, value, ...rest]) {
  if (unit === "us") return [{ us: BigInt(value) }, rest];
  if (unit === "samples") return [{ position: BigInt(value), rateHz: Number(rest[0]) }, rest.slice(1)];
  const words = { nan: NaN, inf: Infinity, "-inf": -Infinity };
  const seconds = words[value] ?? Number(value);
  // Times in JavaScript have 64 bits, so round those with 32 bits first.
  if (unit === "f32") return [Math.fround(seconds), rest];
  assert.equal(unit, "seconds");
  return [seconds, rest];
}

/** Takes `of CHARACTER` or `speaker CHARACTER` from the start of words, if present. */
function whoOf(words) {
  if (words[0] !== "of" && words[0] !== "speaker") return undefined;
  const [what, character] = words.splice(0, 2);
  return what === "speaker" ? { speaker: character } : character;
}

class Stage {
  #folder;
  #curves = new Map();
  #files = [];
  #dialogue;
  #clip;
  #cursor;
  #locale;

  constructor(folder) {
    this.#folder = folder;
  }

  /** The lines of the answer to a command. */
  async command([verb, ...words]) {
    switch (verb) {
      case "needs":
        for (const need of words) assert.ok(HAS.has(need), need);
        return [];
      case "bank":
        this.#files = await filesOf(this.#folder, words[0]);
        await this.#open();
        return [];
      case "texts":
        this.#files.push(placed(this.#folder, `${words[0]}.lipztexts`));
        await this.#open();
        return [];
      case "locale":
        this.#locale = this.#dialogue.locale(words[0]);
        return this.#locale ? [] : ["no locale"];
      case "variant":
        this.#locale = this.#dialogue.variant(this.#locale, words[0]);
        return [this.#locale.tag];
      case "clip":
        return this.#start(words);
      case "speaker":
        this.#cursor.speaker = words[0];
        return [];
      case "lead":
        this.#cursor.lead = { one: { frames: 1 }, two: { frames: 2 } }[words[0]] ?? { us: Number(words[0]) };
        return [];
      case "hold":
        if (words[0] === "display") this.#cursor.hold = { renderedFrame: Number(words[1]) / 1e6 };
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
        // Any bank of a set may have them.
        await this.#dialogue.loadAll();
        return this.#dialogue.voices.map(({ tag }) => tag);
      case "voice": {
        await this.#dialogue.loadAll();
        const voice = this.#dialogue.voice(words[0]);
        if (voice === undefined) return ["no voice"];
        const { clip, spoken } = this.#clip.inVoice(voice);
        return [`${spoken.replace("-", " ")}: ${clip.key}, spoken in ${clip.voice.tag}`];
      }
      case "articulation":
        return this.#articulation(words);
      case "weights":
        return this.#weights(words);
      case "face":
      case "idle":
        return this.#face(verb, words);
      default:
        return assert.fail(`no command: ${verb}`);
    }
  }

  /** Opens the files, like a game that keeps its cursor while they are replaced. */
  async #open() {
    this.#dialogue = await openDialogue(this.#files);
    this.#locale = undefined;
    this.#curves.clear();
    this.#clip = this.#clip && (await this.#dialogue.loadClip(this.#clip.id));
    if (this.#cursor && this.#clip) this.#cursor = this.#clip.resume(this.#cursor);
  }

  async #start([key, ...given]) {
    this.#clip = await this.#dialogue.loadClip(key);
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
    const words = ({ character, verb, object, strength }) =>
      [character, verb, object, strength].filter((word) => word !== undefined).join(" ");
    return [shown.join(", "), ...due, ...events.map((event) => `event ${words(event)}`)];
  }

  #curve([name, ...words]) {
    const curve = this.#clip.curve(name);
    if (curve === undefined) return ["no curve"];
    const read = (from) => (words[0] === "frame" ? from.value(Number(words[1])) : from.valueAt(timeOf(words)[0]));
    const value = read(curve);
    // The same curve as before, at any position: its cursor must not change the result.
    const id = `${this.#clip.key} ${this.#clip.fps?.numerator} ${name}`;
    if (!this.#curves.has(id)) this.#curves.set(id, curve);
    assert.equal(read(this.#curves.get(id)), value);
    return [value === undefined ? "no frame rate" : String(thousandths(value))];
  }

  #emotions(words) {
    const who = whoOf(words);
    const [time] = timeOf(words);
    return emotions(this.#clip.emotionsAt(time, who));
  }

  #face(verb, words) {
    const who = whoOf(words);
    const [name, look] = words.splice(0, 2);
    const profile = name === "default" ? this.#dialogue.defaultFaceProfile : this.#dialogue.faceProfile(name);
    if (profile === undefined) return ["no profile"];
    let lookAt;
    if (look !== "ahead") {
      const [pitch, yaw] = words.splice(0, 2).map((angle) => Number(angle) / 1000);
      lookAt = { pitch, yaw, isPerson: look === "person" };
    }
    const seed = verb === "idle" ? BigInt(words.shift()) : undefined;
    const [time] = timeOf(words);
    if (verb === "idle") return [face(profile.idleAt(time, seed, lookAt))];
    return [face(this.#clip.faceAt(time, who, profile, lookAt))];
  }

  /** The articulation with a profile at the time in these words; undefined if there is no such profile. */
  #mouth([name, ...words]) {
    const profile = name === "default" ? undefined : this.#dialogue.articulationProfile(name);
    if (profile === undefined && name !== "default") return undefined;
    return this.#clip.articulationAt(timeOf(words)[0], profile);
  }

  #articulation(words) {
    const mouth = this.#mouth(words);
    if (mouth === undefined) return ["no profile"];
    const name = (articulator) => articulator.replace(/[A-Z]/, (letter) => `_${letter.toLowerCase()}`);
    return [ARTICULATORS.map((articulator) => `${name(articulator)} ${thousandths(mouth[articulator])}`).join(", ")];
  }

  #weights([name, ...words]) {
    const rig = this.#dialogue.rig(name);
    if (rig === undefined) return ["no rig"];
    const mouth = this.#mouth(words);
    if (mouth === undefined) return ["no profile"];
    const [time] = timeOf(words.slice(1));
    const settings = { emotions: this.#clip.emotionsAt(time), face: this.#clip.faceAt(time), out: [] };
    const weights = rig.weights(mouth, settings);
    return [rig.weightNames.map((weight, index) => `${weight} ${thousandths(weights[index])}`).join(", ")];
  }

  #babble([name, ...words]) {
    const babble = name === "default" ? this.#dialogue.defaultBabble : this.#dialogue.babble(name);
    if (babble === undefined) return ["no profile"];
    const [time, [kind, value]] = timeOf(words);
    // A level is a power in 65,536ths, which is exact.
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

for (const folder of folders()) {
  test(`the package answers as the cases say, with ${folder.pathname.split("/").at(-2)}`, async (t) => {
    const expected = await readFile(beside("cases.txt"), "utf8");
    const stage = new Stage(folder);
    let found = "";
    let commands = 0;
    for (const line of expected.trimEnd().split("\n").filter((line) => !line.startsWith("  "))) {
      found += `${line}\n`;
      if (line === "" || line.startsWith("#")) continue;
      commands += 1;
      for (const answer of await stage.command(line.split(" "))) found += `  ${answer}\n`;
    }
    t.diagnostic(`${commands} commands`);
    // Compare line by line first, because the first different line is easier to read than the whole.
    const lines = expected.split("\n");
    found.split("\n").forEach((line, index) => assert.equal(line, lines[index], `cases.txt:${index + 1}`));
    assert.equal(found, expected);
  });
}
