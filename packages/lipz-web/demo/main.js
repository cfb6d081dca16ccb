// Plays the clips of a bank: index.html?clip=act1/mara-good-evening&locale=de-de&at=1.5

import { FaceDrawing, VISEMES } from "../face.js";
import { openDialogue } from "../lipz.js";
import { asked, follow, forget } from "./address.js";
import { Articulators } from "./articulators.js";
import { Clips } from "./clips.js";
import { Clock } from "./clock.js";
import { onFiles, opened } from "./files.js";
import { onKeys } from "./keys.js";
import { Curves } from "./curves.js";
import { levelsOf } from "./levels.js";
import { posesOf, withType } from "./pose.js";
import { SpriteDrawing, spritesOf } from "./sprites.js";
import { Timeline } from "./timeline.js";

/** The banks next to the page, each with its initial clip. The first bank is the default. */
const BANKS = { dialogue: "act1/mara-good-evening", faces: "leave" };
const [FIRST_BANK] = Object.keys(BANKS);
/** The frame rate for clips that do not specify one. */
const FRAMES_PER_SECOND = 24;
/** The number of events that stay on the page. */
const MOST_DUE = 4;

const $ = (id) => document.getElementById(id);
const clock = new Clock();
const face = new FaceDrawing($("face"));
const sprite = new SpriteDrawing($("sprite"));
/** The images in the address instead of the face: `mouths/{code}.svg`, or a sheet with its codes. */
const { sprites: images } = asked();
const curves = new Curves($("curves"), scrub);
const articulators = new Articulators($("articulation"), scrub);
const timeline = new Timeline($("timeline"), scrub, (view) => [curves, articulators].forEach((box) => box.look(view)));
const clips = new Clips($("clip"), $("clips"), (key) => choose(key));

let dialogue;
/** The files of the dialogue. */
let sources = [];
let clip;
let cursor;
/** The face at a time. */
let poseAt;
/** Whether the address leads to this bank, which is not the case for a dropped bank. */
let isAddressed = true;
/** A promise that is fulfilled when the last dropped files are open. */
let opening;
/** Whether the clip was playing when the pointer grabbed the playhead. */
let wasPlaying;

/** Shows a clip from its start, or at a time. */
function choose(key, time = 0) {
  clock.pause(0);
  clip = clipOf(key);
  clips.chosen = key;
  cursor = clip.cursor();
  settle();
  poseAt = posesOf(clip);
  sprite.sprites = images && spritesOf(images, Object.keys(VISEMES[clip.visemeType]));
  $("face").toggleAttribute("hidden", sprite.isShown);
  const levels = levelsOf(clip);
  clock.load(clip.duration, levels);
  timeline.show(clip, levels, locale());
  curves.show(clip);
  articulators.show(clip);
  seek(time);
}

/** The clip with this key, with the defaults for drawing it. */
function clipOf(key) {
  return withType(dialogue.clip(key).orFps(FRAMES_PER_SECOND));
}

/** The chosen locale. */
function locale() {
  return dialogue.locale($("locale").value);
}

/** The lead and hold that are set on the page. */
function settle() {
  cursor.lead = $("lead").checked ? { frames: 1 } : 0;
  cursor.hold = $("hold").checked ? "readable" : 0;
}

/** Jumps, and continues playing if it was playing. */
function seek(time) {
  const at = Math.max(0, Math.min(Number.isFinite(time) ? time : 0, clip.duration));
  cursor.seek(at);
  $("due").replaceChildren();
  clock.seek(at);
  show();
  address();
}

function scrub(time, isDown) {
  wasPlaying ??= clock.playing;
  if (clock.playing) clock.pause();
  seek(time);
  if (isDown) return;
  if (wasPlaying && clock.time < clip.duration) toggle();
  wasPlaying = undefined;
}

async function toggle() {
  if (clock.playing) {
    clock.pause();
    show();
    return address();
  }
  if (clock.time >= clip.duration) seek(0);
  await clock.play();
  show();
  requestAnimationFrame(tick);
}

function tick() {
  if (!clock.playing) return;
  if (clock.time >= clip.duration) {
    clock.pause(clip.duration);
    address();
  } else {
    requestAnimationFrame(tick);
  }
  show();
}

/** Draws the page, whose content depends only on the cursor. */
function show() {
  const { time } = clock;
  happen(cursor.advanceTo(time).events);
  const { viseme, segment } = cursor;
  const text = segment?.text(locale());
  const feeling = felt(clip.emotionsAt(time));
  if (sprite.isShown) sprite.show(viseme);
  else face.show(poseAt(cursor, time));
  timeline.mark(time, segment, text?.text, feeling);
  curves.mark(time);
  articulators.mark(time);
  $("feeling").textContent = feeling;
  $("viseme").textContent = viseme;
  $("viseme").title = $("viseme").ariaLabel = `Mouth shape ${viseme}: ${VISEMES[clip.visemeType][viseme] ?? "none"}`;
  $("time").textContent = `${time.toFixed(2)} / ${clip.duration.toFixed(2)} s`;
  $("event").textContent = segment?.event ?? "";
  $("subtitle").textContent = text?.text ?? "";
  // The bank does not record the locale of a fallback text.
  $("subtitle").lang = text?.isFallback ? "" : $("locale").value;
  $("subtitle").dir = "auto";
  $("subtitle").classList.toggle("fallback", text?.isFallback ?? false);
  $("play").classList.toggle("playing", clock.playing);
  $("play").ariaLabel = clock.playing ? "Pause" : "Play";
}

/** Emotions of the speaker, the strongest first: `anger 2.2, joy 1`. */
function felt({ values }) {
  const strongest = Object.entries(values).filter(([, value]) => value > 0).sort(([, a], [, b]) => b - a);
  return strongest.map(([emotion, value]) => `${emotion} ${Number(value.toFixed(1))}`).join(", ");
}

/** Shows events as they happen, and the resulting states. */
function happen(events) {
  for (const { character, verb, object, strength } of events) {
    const item = document.createElement("li");
    item.textContent = [character, verb, object, strength].filter((word) => word !== undefined).join(" ");
    $("due").append(item);
  }
  while ($("due").children.length > MOST_DUE) $("due").firstChild.remove();
  const states = cursor.characters().map(({ name, feels, staresAt, pointsAt }) => {
    const lasts = [feels && `feels ${feels}`, staresAt && `stares at ${staresAt}`, pointsAt && `points at ${pointsAt}`];
    const all = lasts.filter(Boolean).join(", ");
    return all && `${name ?? "the speaker"} ${all}`;
  });
  $("state").textContent = states.filter(Boolean).join(" · ");
}

function address() {
  const bank = $("bank").value === FIRST_BANK ? undefined : $("bank").value;
  if (isAddressed) follow(bank, clip.key, $("locale").value, clock.playing ? 0 : clock.time);
}

/** Plays the clips of a dialogue. The page reports anything in the address that is missing. */
function use(found, { clip: key, locale, at } = {}, missing = []) {
  ({ dialogue, files: sources } = found);
  const keys = dialogue.clips().filter((clip) => clip.frameCount > 0).map((clip) => clip.key);
  if (keys.length === 0) throw new Error("No clip of this bank has mouth shapes");
  const usual = BANKS[$("bank").value];
  const first = keys.includes(usual) ? usual : keys[0];
  const isClip = key === undefined || keys.includes(key);
  if (!isClip) missing.push(`The bank has no clip “${key}” with mouth shapes. Showing ${first}.`);
  missing.push(...languages(locale));
  clips.keys = keys;
  notice(missing);
  choose(isClip ? (key ?? first) : first, Number(at ?? 0));
}

/** Fills the choice of locales. Returns messages, if the requested locale is missing. */
function languages(locale) {
  const tags = dialogue.locales.map(({ tag }) => tag).sort();
  const kept = tags.find((tag) => tag === locale);
  const chosen = kept ?? dialogue.defaultLocale?.tag ?? tags[0];
  $("locale").replaceChildren(...tags.map((tag) => new Option(tag, tag, false, tag === chosen)));
  if (locale === undefined || kept !== undefined) return [];
  return [`The bank has no subtitles in “${locale}”.${chosen ? ` Showing ${chosen}.` : ""}`];
}

function notice(lines) {
  $("notice").textContent = lines.join(" ");
  $("notice").hidden = lines.length === 0;
}

function fail(error) {
  $("failure").textContent = error.message;
  $("failure").hidden = false;
}

async function drop(files) {
  if (files.length === 0) return;
  try {
    const found = await opened(files, sources);
    $("failure").hidden = true;
    isAddressed = false;
    forget();
    if (found.isAdded && found.dialogue.clip(clip.key)) return replace(found);
    $("bank").value = "";
    use(found);
  } catch (error) {
    fail(error);
  }
}

/** Continues with the same clip in a dialogue with more files, so that new texts appear. */
function replace(found) {
  const before = new Set(dialogue.locales.map(({ tag }) => tag));
  const shown = $("locale").value;
  ({ dialogue, files: sources } = found);
  clip = clipOf(clip.key);
  cursor = clip.resume(cursor);
  poseAt = posesOf(clip);
  notice(languages(dialogue.locales.map(({ tag }) => tag).find((tag) => !before.has(tag)) ?? (shown || undefined)));
  clips.keys = dialogue.clips().filter((clip) => clip.frameCount > 0).map((clip) => clip.key);
  const levels = levelsOf(clip);
  clock.load(clip.duration, levels);
  timeline.update(clip, levels, locale());
  curves.show(clip);
  articulators.show(clip);
  show();
}

/** Shows a bank that is next to the page. */
async function load(name, wanted, missing) {
  const files = [new URL(`${name}.lipzbank`, import.meta.url)];
  const found = { dialogue: await openDialogue(files), files };
  isAddressed = true;
  $("bank").value = name;
  $("failure").hidden = true;
  use(found, wanted, missing);
}

/** Shows the bank, clip, locale and time in the address. */
function loadAsked() {
  const wanted = asked();
  const isBank = wanted.bank === undefined || Object.hasOwn(BANKS, wanted.bank);
  const missing = isBank ? [] : [`The bank “${wanted.bank}” is not next to this page. Showing ${FIRST_BANK}.`];
  return load(isBank ? (wanted.bank ?? FIRST_BANK) : FIRST_BANK, wanted, missing);
}

async function start() {
  onFiles($("file"), (files) => (opening = drop(files)));
  $("play").onclick = toggle;
  $("locale").onchange = () => {
    notice([]);
    timeline.texts(locale());
    show();
    address();
  };
  for (const id of ["lead", "hold"]) $(id).onchange = () => (settle(), show());
  $("in").onclick = () => timeline.zoom(true);
  $("out").onclick = () => timeline.zoom(false);
  $("fit").onclick = () => timeline.fit();
  $("bank").onchange = () => (opening = load($("bank").value).catch(fail));
  await loadAsked();
  onKeys({
    toggle,
    frames: (count) => seek(clip.startOfFrame(Math.max(0, (clip.frameAt(clock.time) ?? clip.frameCount) + count)) ?? 0),
    seconds: (count) => seek(clock.time + count),
    start: () => seek(0),
    end: () => seek(clip.duration),
    zoom: (isIn) => timeline.zoom(isIn),
  });
  return { seek, toggle, clock, clips, get opening() { return opening; }, get clip() { return clip; } };
}

/** The player, for tests and for the console. */
globalThis.player = start();
globalThis.player.catch(fail);
