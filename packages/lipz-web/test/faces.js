// The face of the demo and the curves below its timeline, one function for each, as in controls.js.

const soon = (ms = 50) => new Promise((resolve) => setTimeout(resolve, ms));
const part = (page, name) => page.querySelector(`#face [data-part=${name}]`);
const FACES = { bank: "faces" };

/** The emotions of the speaker are visible, and available to screen readers. */
export async function feelings(demo, same) {
  const { page, player } = await demo({ ...FACES, clip: "twelve" });
  const names = "sadness anger joy fear disgust surprise shock perplexed asleep pain exertion shout".split(" ");
  const text = (id) => page.getElementById(id).textContent;
  const looks = () => [...page.querySelectorAll("#face [data-part]")].map((part) => part.outerHTML).join("");
  same(text("feeling"), "", "nothing at the start");
  same(part(page, "mood").getAttribute("opacity"), "0", "no light");
  const faces = new Set([looks()]);
  for (const [index, name] of names.entries()) {
    player.seek((13 * (index + 1) + 12) / 12);
    same(text("feeling"), `${name} 8`, name);
    same(part(page, "mood").getAttribute("opacity"), "0.84", `the light of ${name}`);
    faces.add(looks());
  }
  same(faces.size, 13, "a face for each");
  const timeline = page.getElementById("timeline");
  same(timeline.getAttribute("aria-valuetext").endsWith(": Shout. (shout 8)"), true, timeline.getAttribute("aria-valuetext"));
  same(page.getElementById("face").getAttribute("aria-describedby"), "feeling", "what describes the face");
}

/** Without curves, the word in an event sets the face. */
export async function words(demo, same) {
  const { page, player } = await demo({ clip: "act1/otto-ticking" });
  same(page.getElementById("state").textContent.includes("the speaker feels afraid"), true, "what the event says");
  same(part(page, "moodNear").getAttribute("stop-color"), "#8f63d4", "the colour of fear");
  const brow = part(page, "browLeft").getAttribute("d");
  const calm = await demo({ clip: "act1/mara-good-evening" });
  same(part(calm.page, "browLeft").getAttribute("d") === brow, false, "its brows");
  same(player.clip.curves.length, 0, "no curves");
}

/** Curves move eyes, brows, head and all other shapes of a rig. */
export async function rigs(demo, same) {
  const { page, player } = await demo({ ...FACES, clip: "rig" });
  const seen = (name, attribute) => part(page, name).getAttribute(attribute);
  const changes = (from, to, name, attribute, what) => {
    player.seek(from);
    const before = seen(name, attribute);
    player.seek(to);
    same(seen(name, attribute) === before, false, what);
  };
  changes(0, 0.5, "leftUpper", "d", "a blink");
  changes(0, 0.66, "browLeft", "d", "brows");
  changes(0, 0.8, "features", "transform", "the head");
  changes(0.5, 1, "leftIris", "cx", "the eyes");
  changes(1.7, 2.2, "body", "d", "breath");
  changes(1.7, 2.4, "upperLip", "d", "a blend shape of a rig");
  changes(0, 0.2, "inside", "d", "the mouth");
}

/** A face blinks, moves and looks by itself, as the reader computes, and looks at the target of a stare. */
export async function specials(demo, same) {
  const { page, player } = await demo({ ...FACES, clip: "twelve" });
  const times = Array.from({ length: 560 }, (_, index) => index / 40);
  const shut = times.find((time) => player.clip.faceAt(time).blink === 1);
  const height = (name) => part(page, name).getBBox().height;
  same(shut !== undefined, true, "in 14 seconds there is a blink");
  player.seek(0);
  const before = height("leftWhite");
  player.seek(shut);
  same(height("leftWhite") < 0.4 * before, true, `closed lids, ${height("leftWhite")} of ${before}`);
  const places = new Set();
  for (const time of times.slice(0, 100)) {
    player.seek(time);
    places.add(part(page, "features").getAttribute("transform"));
  }
  same(places.size > 5, true, "the head moves");
  const staring = await demo({ ...FACES, clip: "leave", at: 0.5 });
  const eye = () => Number(part(staring.page, "leftIris").getAttribute("cx"));
  const aside = eye();
  staring.player.seek(3.5);
  same(Math.abs(aside - eye()) > 2, true, `eyes on otto, ${aside}, and not, ${eye()}`);
}

/** The face looks at the target of `sees` for a second. */
export async function sights(demo, same) {
  const { page, player } = await demo({ clip: "act1/mara-good-evening" });
  const seen = player.clip.segments.find(({ events }) => events.some(({ verb }) => verb === "sees"));
  const since = player.clip.startOfFrame(seen.startFrame);
  const eye = (time) => {
    player.seek(time);
    return Number(part(page, "leftIris").getAttribute("cx"));
  };
  const onOtto = eye(since + 0.1);
  same(Math.abs(onOtto - eye(since - 0.1)) > 2, true, "eyes turn to what is seen");
  same(eye(since + 0.9), onOtto, "and stay on it");
  same(Math.abs(onOtto - eye(since + 1.1)) > 2, true, "for a second");
}

/** Each curve has a name, a colour and its value at the playhead. */
export async function curves(demo, same) {
  const { page, player } = await demo({ ...FACES, clip: "rig", at: 0.5 });
  const section = page.getElementById("curves");
  const rows = () => [...section.querySelectorAll("li")];
  const shown = () => rows().map((row) => `${row.querySelector(".name").textContent} ${row.querySelector(".value").textContent}`);
  same(section.hidden, false, "they are there");
  same(section.querySelector("summary").textContent, "9 curves", "how many");
  same(shown().slice(0, 3).join(), "blink 1,breath 0,brows 0.467", "values at the playhead");
  player.seek(1.5);
  same(shown()[4], "eyeYaw -15", "values elsewhere");
  same(new Set(rows().map((row) => row.style.getPropertyValue("--curve"))).size, 9, "a colour for each");
  same(section.querySelector(".band").hasAttribute("hidden"), true, "no band without emotions");
  const [line] = rows();
  same(line.querySelector(".line").getAttribute("d").startsWith("M0 0.92L0 0.92L5 0.92L6 0.08L7 0.92"), true, "its plot");
  section.querySelector("details").open = false;
  same(section.offsetHeight < 60, true, "they can be folded away");
  const drama = await demo({});
  same(drama.page.getElementById("curves").hidden, true, "nothing without curves");
}

/** Emotions are a stacked band of their colours. */
export async function band(demo, same) {
  const { page, player } = await demo({ ...FACES, clip: "leave" });
  const full = player.clip.curve("joy").keys.find(({ value }) => value === 1).frame;
  const areas = [...page.querySelectorAll(".band path")];
  same(areas.map((area) => area.textContent).join(), "anger,joy,fear,surprise", "their names");
  same(areas[0].getAttribute("fill"), "#e0483c", "the colour of anger");
  same(areas[1].getAttribute("d").includes(`${full} 0.3L`), true, "joy 1 is above anger 6");
  same(page.querySelectorAll(".curves li").length, 5, "and each by itself, with those of others");
}

/** Curves zoom and scroll with the timeline, and dragging on them moves the playhead. */
export async function zoomed(demo, same) {
  for (const width of [1000, 320]) {
    const { page, window, player } = await demo({ ...FACES, clip: "twelve" }, width);
    const scroll = page.getElementById("timeline");
    const plot = page.querySelector(".curves li svg");
    const view = () => plot.getAttribute("viewBox").split(" ").map(Number);
    for (const id of ["fit", "in", "in", "in"]) page.getElementById(id).click();
    await soon();
    player.seek(9);
    await soon();
    const perFrame = page.querySelector(".track").getBoundingClientRect().width / player.clip.frameCount;
    same(Math.abs(view()[0] - scroll.scrollLeft / perFrame) < 0.1, true, `${width}: the same start`);
    same(Math.abs(view()[2] - scroll.clientWidth / perFrame) < 0.1, true, `${width}: the same length`);
    const [above, below] = [...page.querySelectorAll(".playhead")].map((playhead) => playhead.getBoundingClientRect().left);
    same(Math.abs(above - below) < 1, true, `${width}: one playhead, ${above} and ${below}`);
    const { left, top, width: across } = plot.getBoundingClientRect();
    const point = (type, x) => new window.PointerEvent(type, { pointerId: 1, button: 0, clientX: x, clientY: top + 5, bubbles: true });
    const expected = ((view()[0] + view()[2] / 4) / player.clip.frameCount) * player.clip.duration;
    plot.dispatchEvent(point("pointerdown", left + across / 4));
    plot.dispatchEvent(point("pointerup", left + across / 4));
    same(Math.abs(player.clock.time - expected) < 0.05, true, `${width}: a press on a curve, ${player.clock.time}`);
    same(page.documentElement.scrollWidth, page.documentElement.clientWidth, `${width}: nothing is wider than the page`);
  }
}

/** A finger that scrolls the page over the curves does not move the playhead; tapping and dragging do. */
export async function fingers(demo, same) {
  const { page, window, player } = await demo({ ...FACES, clip: "rig", at: 1 });
  const plot = page.querySelector(".curves li svg");
  const { left, width } = plot.getBoundingClientRect();
  const touch = (type, part) => {
    const init = { pointerId: 2, pointerType: "touch", button: 0, clientX: part === undefined ? 0 : left + width * part, bubbles: true };
    plot.dispatchEvent(new window.PointerEvent(type, init));
  };
  const at = (part, what) => same(Math.abs(player.clock.time / player.clip.duration - part) < 0.01, true, `${what}: ${player.clock.time}`);
  touch("pointerdown", 0.7);
  touch("pointercancel");
  same(player.clock.time, 1, "a scroll");
  touch("pointerdown", 0.7);
  touch("pointerup", 0.7);
  at(0.7, "a tap");
  touch("pointerdown", 0.2);
  touch("pointermove", 0.3);
  touch("pointercancel");
  at(0.3, "a drag that the browser takes over");
}

/** The face moves between the frames of a clip, and the articulators are curves. */
export async function articulation(demo, same) {
  const { page, player } = await demo({ clip: "act1/mara-good-evening" });
  const { fps, frameCount } = player.clip;
  const inside = (time) => (player.seek(time), part(page, "inside").getAttribute("d"));
  const times = Array.from({ length: frameCount * 4 }, (_, index) => (index / 4 + 0.1) / (fps.numerator / fps.denominator));
  const shapes = times.map(inside);
  const still = shapes.filter((shape, index) => index > 0 && shape === shapes[index - 1]).length;
  same(new Set(shapes).size > frameCount, true, `more mouths than frames: ${new Set(shapes).size}, ${still} repeated`);
  const section = page.getElementById("articulation");
  same(section.hidden, false, "the box");
  same(section.querySelector("summary").textContent, "9 articulators", "its title");
  same(section.querySelectorAll("li").length, 0, "nothing is drawn while it is closed");
  section.querySelector("details").open = true;
  await soon();
  same(Array.from(section.querySelectorAll(".name"), (name) => name.textContent).slice(0, 3).join(), "jaw,opening,closure", "names");
  const values = () => section.querySelector(".value").textContent;
  const moving = new Set(times.map((time) => (player.seek(time), values())));
  same(moving.size > 10, true, "the jaw moves");
}

/** Images in the address replace the face: one per viseme, or a sheet. */
export async function sprites(demo, same) {
  const clip = "act1/mara-good-evening";
  const { page, player } = await demo({ clip, sprites: "mouths/{code}.svg" });
  const { style } = page.getElementById("sprite");
  same(page.getElementById("face").hasAttribute("hidden"), true, "no face");
  const start = player.clip.duration / 2;
  player.seek(start);
  const viseme = page.getElementById("viseme").textContent;
  same(viseme !== "-" && style.backgroundImage.includes(`mouths/${viseme}.svg`), true, style.backgroundImage);
  const sheet = await demo({ clip, sprites: `mouths.png#-${viseme}` });
  sheet.player.seek(start);
  const shown = sheet.page.getElementById("sprite").style;
  same(shown.backgroundPosition.startsWith("100%"), true, `the second of two: ${shown.backgroundPosition}`);
  same(shown.backgroundSize, "200% 100%", "its size");
}

/** Space folds the curves if they have the focus, and does not play. */
export async function folding(demo, same) {
  const { page, window, player } = await demo({ ...FACES, clip: "rig" });
  const press = new window.KeyboardEvent("keydown", { key: " ", bubbles: true, cancelable: true });
  page.querySelector("summary").dispatchEvent(press);
  await soon(600);
  same(press.defaultPrevented || player.clock.playing, false, "the browser has the key");
}

/** The playhead stays in view when the window gets narrower. */
export async function narrower(demo, same) {
  const { page, window } = await demo({ ...FACES, clip: "twelve", at: 13 });
  window.frameElement.width = 320;
  await soon(200);
  const { left, right } = page.getElementById("timeline").getBoundingClientRect();
  const playhead = page.querySelector(".track .playhead").getBoundingClientRect().left;
  same(playhead > left && playhead < right, true, `${playhead} in ${left} to ${right}`);
}

/** There are two banks, and the address selects one. */
export async function banks(demo, same) {
  const { page, window, player } = await demo({ ...FACES, clip: "rig" });
  same(player.clip.key, "rig", "the clip of the address");
  const select = page.getElementById("bank");
  select.value = "dialogue";
  select.dispatchEvent(new window.Event("change"));
  await player.opening;
  same(player.clip.key, "act1/mara-good-evening", "the first clip of the other bank");
  select.value = "faces";
  select.dispatchEvent(new window.Event("change"));
  await player.opening;
  await soon(400);
  same(window.location.search, "?bank=faces&clip=leave&locale=en-us", "the address");
  const wrong = await demo({ bank: "../x", clip: "rig" });
  same(wrong.page.getElementById("notice").textContent.includes("bank “../x”"), true, "a bank that is not there");
}

/** A clip without a viseme type is drawn with the type that has its codes. */
export async function types(demo, same) {
  const { page, player } = await demo({ ...FACES, clip: "loud" });
  same(player.clip.visemeType, "rms", "digits are loudness");
  const mouths = new Set();
  for (let frame = 0; frame < 10; frame++) {
    player.seek(frame / 12);
    mouths.add(part(page, "inside").getAttribute("d") + part(page, "lowerLip").getAttribute("d"));
  }
  same(mouths.size, 10, "ten mouths");
  same(page.getElementById("viseme").ariaLabel, "Mouth shape 9: fully open", "what the code is");
}
