// Examines the demo at several times, in several locales, while it plays, and with its controls.

import * as controls from "./controls.js";
import * as faces from "./faces.js";
import * as motion from "./motion.js";

const FRAMES = "SOOOOSEEEFEESAASS---OOOSSSOO-------SOOUUUASSEELAAAS---AASSSSSSSEEFFOSSASEEASLLS-------------";
const TEXTS = {
  "en-us": ["Good evening, Otto.", "You are late,", "and the fog is early."],
  "de-de": ["Guten Abend, Otto.", "Du bist spät dran,", "und der Nebel ist zu früh."],
  "ja-jp": ["こんばんは、オットー。", "あんたは遅刻、", "霧は早すぎよ。"],
};
const EVENTS = ["feels neutral", "sees otto", "points fog"];
const STARTS = [0, 35, 54];
const FPS = 24;

const failures = [];
let checks = 0;

function same(found, expected, what) {
  checks += 1;
  if (found !== expected) failures.push(`${what}: ${JSON.stringify(found)} instead of ${JSON.stringify(expected)}`);
}

/** Opens the demo with a query in a window of this width, and returns its document and its player. */
async function demo(query, width = 1000) {
  const frame = document.querySelector("iframe");
  frame.width = width;
  await new Promise((resolve) => {
    frame.onload = resolve;
    frame.src = `/demo/index.html?${new URLSearchParams(query)}`;
  });
  return { page: frame.contentDocument, window: frame.contentWindow, player: await frame.contentWindow.player };
}

function shown(page) {
  const text = (id) => page.getElementById(id).textContent;
  return { viseme: text("viseme"), subtitle: text("subtitle"), event: text("event") };
}

function segmentOf(frame) {
  return STARTS.findLastIndex((start) => start <= frame);
}

/** The page shows the contents of the Lipz file for this frame. */
function showsFrame(page, frame, locale) {
  const { viseme, subtitle, event } = shown(page);
  same(viseme, FRAMES[frame], `viseme of frame ${frame}`);
  same(subtitle, TEXTS[locale][segmentOf(frame)], `${locale} at frame ${frame}`);
  same(event, EVENTS[segmentOf(frame)], `event at frame ${frame}`);
  same(page.querySelectorAll(".segment.now").length, 1, "segments that are marked");
}

async function still() {
  for (const locale of Object.keys(TEXTS)) {
    const { page, player } = await demo({ locale, at: 40 / FPS });
    showsFrame(page, 40, locale);
    for (const frame of [0, 6, 34, 35, 53, 54, 91]) {
      player.seek(frame / FPS);
      showsFrame(page, frame, locale);
    }
    player.seek(1000);
    same(shown(page).viseme, "-", "viseme behind the end");
    same(shown(page).subtitle, "", "subtitle behind the end");
  }
}

/** The demo plays by the clock of the audio: mouths open and close, and the playhead moves. */
async function playing() {
  const { page, player } = await demo({ locale: "de-de" });
  const opened = () => page.querySelector("#face [data-part=inside]").getAttribute("d");
  const visemes = new Set();
  const mouths = new Set();
  page.getElementById("play").click();
  let last = 0;
  const until = performance.now() + 20_000;
  while (last < 2 && performance.now() < until) {
    await new Promise((resolve) => setTimeout(resolve, 20));
    const { time } = player.clock;
    same(time >= last, true, "time goes on");
    last = time;
    visemes.add(shown(page).viseme);
    mouths.add(opened());
  }
  same(last >= 2, true, "two seconds were played");
  same(visemes.size >= 4 && mouths.size >= 4, true, "the mouth moves");
  const clock = player.clock.isAudio ? "clock of the audio" : "clock of the page";
  page.getElementById("play").click();
  same(player.clock.playing, false, "pause");
  showsFrame(page, player.clip.frameAt(player.clock.time), "de-de");
  return clock;
}

let clock = "";
const isStill = location.search === "?still";
try {
  if (!isStill) {
    await still();
    clock = await playing();
  }
  for (const [name, look] of Object.entries(isStill ? motion : { ...controls, ...faces })) {
    await look(demo, (found, expected, what) => same(found, expected, `${name}: ${what}`));
  }
} catch (error) {
  failures.push(error.stack ?? String(error));
}
await fetch("/report", { method: "POST", body: JSON.stringify({ failures, checks, clock }) });
