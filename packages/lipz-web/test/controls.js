// The controls of the demo, one function for each. Functions receive `demo`, which opens the page, and `same`, which
// compares.

const soon = (ms = 50) => new Promise((resolve) => setTimeout(resolve, ms));

/** Waits until a condition holds, for at most five seconds. */
async function until(holds) {
  for (let tries = 0; tries < 100 && !holds(); tries++) await soon();
  return Boolean(holds());
}

async function file(name) {
  const response = await fetch(`/test/banks/${name}`);
  return new File([await response.arrayBuffer()], name);
}

function press(window, key, init = {}, target = window.document.body) {
  target.dispatchEvent(new window.KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...init }));
}

/** Drops files on the page. */
async function dropped(window, ...files) {
  const dataTransfer = new window.DataTransfer();
  files.forEach((dropped) => dataTransfer.items.add(dropped));
  const init = { dataTransfer, bubbles: true, cancelable: true };
  window.document.body.dispatchEvent(new window.DragEvent("dragenter", init));
  const isDropping = window.document.body.classList.contains("dropping");
  window.document.body.dispatchEvent(new window.DragEvent("drop", init));
  await (await window.player).opening;
  return isDropping;
}

/** The share of the visible columns of the graph that are not empty. */
function painted(page) {
  const canvas = page.querySelector("canvas.frames");
  const { width, height } = canvas;
  // Above the labels.
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height - 14);
  let columns = 0;
  for (let x = 0; x < width; x++) {
    for (let y = 0; y < height - 14; y++) {
      if (data[4 * (y * width + x) + 3] > 60) {
        columns += 1;
        break;
      }
    }
  }
  return columns / width;
}

/** Visemes are visible in clips of any length, on any screen. */
export async function graph(demo, same) {
  for (const width of [1000, 375, 320]) {
    const { page, window, player } = await demo({}, width);
    same(await dropped(window, await file("long.lipzbank")), true, "the page takes a file");
    same(player.clip.key, "monologue", "the clip of the dropped bank");
    const scroll = page.getElementById("timeline");
    same(scroll.scrollWidth, 1440 * 4, `${width}: pixels of 1440 frames`);
    const part = painted(page);
    same(part > 0.7 && part < 0.8, true, `${width}: three of four pixels of a frame, ${part}`);
    page.getElementById("fit").click();
    await soon();
    same(scroll.scrollWidth, scroll.clientWidth, `${width}: the whole clip is in view`);
    same(painted(page) > 0.95, true, `${width}: the graph of the whole clip, ${painted(page)}`);
    const frame = window.frameElement;
    const track = page.querySelector(".track");
    const isWhole = (before) => track.offsetWidth !== before && scroll.scrollWidth === scroll.clientWidth;
    for (const other of [width - 40, width]) {
      const before = track.offsetWidth;
      frame.width = other;
      same(await until(() => isWhole(before)), true, `${width}: it stays in view in a window of ${other} pixels`);
    }
    page.getElementById("in").click();
    await soon();
    same(scroll.scrollWidth > scroll.clientWidth, true, `${width}: zoomed in`);
    player.seek(59);
    const { left, right } = scroll.getBoundingClientRect();
    const playhead = page.querySelector(".playhead").getBoundingClientRect().left;
    same(playhead > left && playhead < right, true, `${width}: the playhead is in view`);
    same(page.querySelectorAll(".segment.point").length, 1, "a segment without frames is a line");
  }
}

/** Texts run in the direction of their script, both in the timeline and below the face. */
export async function directions(demo, same) {
  for (const [locale, direction] of [["ar-sa", "rtl"], ["he-il", "rtl"], ["de-de", "ltr"], ["ja-jp", "ltr"]]) {
    const { page, window } = await demo({ locale, at: 0.5 });
    const texts = [...page.querySelectorAll(".segment span"), page.getElementById("subtitle")];
    same(texts.length, 4, locale);
    for (const text of texts) {
      same(window.getComputedStyle(text).direction, direction, `${locale}: ${text.textContent}`);
      same(text.lang, locale, "its language");
    }
  }
}

/** A different language appears at the same time of the clip, which continues to play. */
export async function languages(demo, same) {
  const { page, window, player } = await demo({ locale: "en-us" });
  player.seek(0.5);
  await player.toggle();
  const select = page.getElementById("locale");
  select.value = "de-de";
  select.dispatchEvent(new window.Event("change"));
  same(player.clock.playing, true, "it plays on");
  same(player.clock.time >= 0.5, true, "where it was");
  same(page.querySelector(".segment span").textContent, "Guten Abend, Otto.", "the timeline");
  await player.toggle();
  same(page.getElementById("subtitle").textContent, "Guten Abend, Otto.", "the subtitle");
}

/** Space plays; arrows, Home and End move the playhead. */
export async function keys(demo, same) {
  const { page, window, player } = await demo({});
  press(window, " ");
  same(await until(() => player.clock.playing), true, "Space plays");
  press(window, "ArrowRight", { shiftKey: true });
  same(player.clock.playing && player.clock.time >= 1, true, "a jump plays on");
  press(window, " ");
  same(player.clock.playing, false, "Space pauses");
  const slider = page.getElementById("timeline");
  const at = (expected, what) => same(Math.abs(player.clock.time - expected) < 1e-3, true, `${what}: ${player.clock.time}`);
  player.seek(1);
  press(window, "ArrowRight");
  at(25 / 24, "a frame on");
  press(window, "ArrowLeft");
  press(window, "ArrowLeft");
  at(23 / 24, "a frame back");
  press(window, "ArrowRight", { shiftKey: true });
  at(47 / 24, "a second on");
  press(window, "PageDown", {}, slider);
  at(23 / 24, "a second back on the slider");
  press(window, "ArrowUp", {}, slider);
  at(1, "a frame on, on the slider");
  press(window, "End");
  at(player.clip.duration, "the end");
  press(window, "ArrowLeft");
  at(91 / 24, "the last frame");
  press(window, "Home");
  at(0, "the start");
  press(window, "ArrowLeft");
  at(0, "nothing is before the start");
  player.seek(1);
  press(window, "Home", {}, page.getElementById("clip"));
  press(window, "ArrowRight", {}, page.getElementById("locale"));
  press(window, "ArrowRight", { altKey: true });
  at(1, "fields and the browser keep their keys");
  const width = page.querySelector(".track").offsetWidth;
  press(window, "+");
  same(page.querySelector(".track").offsetWidth > width, true, "zoom");
}

/** The timeline is a slider, for eyes and for screen readers. */
export async function slider(demo, same) {
  const { page, window, player } = await demo({});
  const timeline = page.getElementById("timeline");
  same(timeline.getAttribute("role"), "slider", "role");
  same(timeline.tabIndex, 0, "Tab reaches it");
  same(timeline.getAttribute("aria-valuemax"), "3.833", "its end");
  player.seek(1.6);
  same(timeline.getAttribute("aria-valuenow"), "1.600", "its value");
  same(timeline.getAttribute("aria-valuetext"), "1.60 seconds: You are late,", "what it says");
  const { left, width, top } = timeline.getBoundingClientRect();
  const point = (type, part) =>
    timeline.dispatchEvent(
      new window.PointerEvent(type, { pointerId: 1, button: 0, clientX: left + width * part, clientY: top + 5, bubbles: true }),
    );
  const at = (part, what) => same(Math.abs(player.clock.time / player.clip.duration - part) < 0.01, true, what);
  await player.toggle();
  point("pointerdown", 0.25);
  at(0.25, "a press");
  same(player.clock.playing, false, "it waits for the pointer");
  point("pointermove", 0.5);
  at(0.5, "a drag");
  point("pointermove", 2);
  at(1, "beyond the end");
  point("pointermove", 0.75);
  point("pointerup", 0.75);
  at(0.75, "where it was left");
  same(await until(() => player.clock.playing), true, "it plays on");
  await player.toggle();
  point("pointermove", 0.1);
  same(player.clock.time / player.clip.duration > 0.7, true, "no drag without a press");
}

/** The page reports missing values of the address, and the address follows the page. */
export async function address(demo, same) {
  const wrong = await demo({ clip: "nope/nope", locale: "xx-yy", at: "soon" });
  const notice = wrong.page.getElementById("notice");
  same(notice.hidden, false, "there is something to say");
  same(notice.textContent.includes("nope/nope") && notice.textContent.includes("xx-yy"), true, notice.textContent);
  same(wrong.player.clip.key, "act1/mara-good-evening", "a clip all the same");
  const { page, window, player } = await demo({ clip: "act1/otto-ticking", locale: "de-de", at: 1.25 });
  same(page.getElementById("notice").hidden, true, "nothing to say");
  same(player.clock.time, 1.25, "the time");
  player.seek(2);
  const select = page.getElementById("locale");
  select.value = "ja-jp";
  select.dispatchEvent(new window.Event("change"));
  const expected = "?clip=act1/otto-ticking&locale=ja-jp&at=2.00";
  same(await until(() => window.location.search === expected), true, window.location.search);
}

/** The search finds a clip among many. */
export async function search(demo, same) {
  const { page, window, player } = await demo({});
  const input = page.getElementById("clip");
  const list = page.getElementById("clips");
  const type = (query) => {
    input.value = query;
    input.dispatchEvent(new window.Event("input"));
    return Array.from(list.querySelectorAll("[data-key]"), (option) => option.dataset.key);
  };
  same(type("OTTO tick").join(), "act1/otto-ticking", "all words, in any case");
  same(input.getAttribute("aria-expanded"), "true", "the list is open");
  same(page.getElementById(input.getAttribute("aria-activedescendant")).textContent, "act1/otto-ticking", "the active one");
  press(window, "Enter", {}, input);
  same(player.clip.key, "act1/otto-ticking", "Enter takes it");
  same(list.hidden, true, "the list is closed");
  type("nell");
  press(window, "ArrowDown", {}, input);
  press(window, "ArrowDown", {}, input);
  press(window, "ArrowUp", {}, input);
  const second = list.querySelectorAll("[data-key]")[1].dataset.key;
  press(window, "Enter", {}, input);
  same(player.clip.key, second, "arrows move");
  same(type("no such clip").length, 0, "nothing");
  same(list.textContent.includes("No matching clips"), true, "and it says so");
  press(window, "Escape", {}, input);
  same(input.value, second, "Escape leaves it");
  player.clips.keys = Array.from({ length: 20_000 }, (_, index) => `scene/${index % 200}/line-${index}`);
  same(type("").length, 60, "as many as can be read");
  same(list.textContent.includes("19940 more"), true, "and how many are left");
  same(type("line-19999").join(), "scene/199/line-19999", "one among 20,000");
}

/** Dropped files are opened, or the page shows an error. */
export async function files(demo, same) {
  const { page, window, player } = await demo({});
  const failure = page.getElementById("failure");
  await dropped(window, new File(["no bank"], "notes.txt"));
  same(failure.hidden, false, "it says why");
  same(failure.textContent.startsWith("notes.txt: "), true, failure.textContent);
  same(player.clip.key, "act1/mara-good-evening", "the old bank stays");
  await dropped(window, await file("split.de-de.lipztexts"));
  same(failure.textContent.includes("other clips"), true, failure.textContent);
  await dropped(window, await file("split.de-de.lipztexts"), await file("split.lipzbank"));
  same(failure.hidden, true, "a bank and its texts");
  same(player.clip.key, "act1/blair", "its first clip");
  same(page.getElementById("locale").value, "de-de", "its locale");
  same(window.location.search, "", "no address leads to it");
  await dropped(window, await file("split.en-us.lipztexts"));
  same(page.getElementById("locale").value, "en-us", "other texts for the same bank");
  player.seek(0.5);
  same(page.getElementById("subtitle").textContent, "Mayor.", "which it shows");
  await dropped(window, await file("patch.lipzbank"));
  same(failure.textContent.startsWith("patch.lipzbank: "), true, failure.textContent);
  await dropped(window, await file("patch.lipzbank"), await file("small.lipzbank"));
  same(failure.hidden, true, "a patch and its bank, in any order");
  same(player.clips.find("patch/new").length, 1, "a clip of the patch");
}

/** Nothing breaks on the narrowest phone. */
export async function narrow(demo, same) {
  for (const width of [320, 375]) {
    const { page } = await demo({ clip: "act1/otto-twenty-years", locale: "de-de", at: 2.6 }, width);
    const { width: across, height } = page.getElementById("play").getBoundingClientRect();
    same(across, height, `${width}: the button is round`);
    same(page.getElementById("time").getBoundingClientRect().height < 30, true, `${width}: the time is one line`);
    same(page.documentElement.scrollWidth, page.documentElement.clientWidth, `${width}: nothing is wider than the page`);
  }
}

/** Events are shown as they happen, with the resulting states. */
export async function events(demo, same) {
  const { page, player } = await demo({ clip: "act1/otto-ticking" });
  same(page.getElementById("due").textContent, "does jumpfeels afraidnell stares otto", "at the start, also without frames");
  same(page.getElementById("state").textContent, "the speaker feels afraid · nell stares at otto", "what lasts");
  player.seek(3);
  same(page.getElementById("due").textContent, "", "a jump fires nothing");
  same(page.getElementById("state").textContent.includes("stares at parcel"), true, "and sets the scene");
}

/** A segment without frames at the end of a clip needs no space after it. */
export async function points(demo, same) {
  const { page } = await demo({ clip: "act3/nell-light", at: 3.39 });
  const scroll = page.getElementById("timeline");
  same(page.querySelectorAll(".segment.point").length, 1, "its line");
  same(scroll.scrollWidth, scroll.clientWidth, "nothing to scroll");
}

/** Lead and hold change the mouth. */
export async function mouths(demo, same) {
  const { page, player } = await demo({ at: 1 / 24 });
  const shown = () => page.getElementById("viseme").textContent;
  const before = shown();
  same(before, player.clip.frames[1], "as it is in the clip");
  player.seek(3.5 / 24);
  page.getElementById("lead").click();
  same(shown(), player.clip.frames[4], "a frame ahead");
  page.getElementById("lead").click();
  same(shown(), player.clip.frames[3], "as before");
}
