// Plays the clips of a bank: index.html?clip=act1/mara-good-evening&locale=de-de&at=1.5

import { open } from "../lipz.js";
import { Clock } from "./clock.js";
import { face, openness } from "./mouth.js";
import { timeline } from "./timeline.js";

const BANK = new URL("dialogue.lipzbank", import.meta.url);
const FIRST_CLIP = "act1/mara-good-evening";
/** For clips whose file does not say how many frames a second has. */
const FRAMES_PER_SECOND = 24;

const $ = (id) => document.getElementById(id);
const query = new URLSearchParams(location.search);
const clock = new Clock();
const move = face($("face"));

let bank;
let clip;
let mark;

/** Shows the clip and the locale that are chosen, at a time. */
function choose(time = 0) {
  clip = bank.clip($("clip").value).orFps(FRAMES_PER_SECOND);
  mark = timeline($("timeline"), clip, $("locale").value, seek);
  seek(time);
}

function seek(time) {
  clock.pause(Math.max(0, Math.min(time, clip.duration)));
  show();
}

async function toggle() {
  if (clock.playing) return seek(clock.time);
  const loudness = Array.from(clip.frames, (viseme) => (viseme === "-" ? 0 : openness(viseme, clip.visemeType)));
  await clock.play(clock.time < clip.duration ? clock.time : 0, clip.duration, loudness);
  requestAnimationFrame(tick);
}

function tick() {
  if (!clock.playing) return;
  if (clock.time >= clip.duration) return seek(clip.duration);
  show();
  requestAnimationFrame(tick);
}

/** Everything that the page shows follows from one time. */
function show() {
  const { time } = clock;
  const viseme = clip.visemeAt(time);
  const segment = clip.segmentAt(time);
  const text = segment?.text($("locale").value);
  move(viseme, clip.visemeType);
  mark(time, segment);
  $("viseme").textContent = viseme;
  $("time").textContent = `${time.toFixed(2)} / ${clip.duration.toFixed(2)} s`;
  $("event").textContent = segment?.event ?? "";
  $("subtitle").textContent = text?.text ?? "";
  // Whose text a fallback is, the bank does not say.
  $("subtitle").lang = text?.isFallback ? "" : $("locale").value;
  $("subtitle").dir = "auto";
  $("subtitle").classList.toggle("fallback", text?.isFallback ?? false);
  $("play").classList.toggle("playing", clock.playing);
  $("play").ariaLabel = clock.playing ? "Pause" : "Play";
}

function fill(select, values, chosen) {
  select.replaceChildren(...values.map((value) => new Option(value, value, false, value === chosen)));
  select.onchange = () => choose();
}

async function start() {
  const response = await fetch(BANK);
  if (!response.ok) throw new Error(`${BANK} cannot be loaded (HTTP ${response.status})`);
  bank = (await open(await response.arrayBuffer())).verify();
  fill($("clip"), bank.clips().filter((clip) => clip.frameCount > 0).map((clip) => clip.key), query.get("clip") ?? FIRST_CLIP);
  fill($("locale"), bank.locales, query.get("locale") ?? bank.defaultLocale);
  $("play").onclick = toggle;
  choose(Number(query.get("at") ?? 0));
  return { seek, toggle, clock, get clip() { return clip; } };
}

/** The player, for tests and for the console. */
globalThis.player = start();
globalThis.player.catch((error) => {
  $("failure").textContent = error.message;
  $("failure").hidden = false;
});
