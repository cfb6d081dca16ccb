// Examines the mouth that an example draws, from inside its page, in the middle of each phone of a line, and reports.

const SIZE = { width: 320, height: 240 };
const LINE = { bank: "rigs.lipzbank", key: "english" };
/** The phones of the line. Each lasts 200 ms, after 200 ms of silence. */
const PHONES =
  "AA AE AH AO AW AY B CH D DH EH ER EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W Y Z ZH".split(" ");
const middleOf = (index) => 0.3 + 0.4 * index;
/** Different mouths differ in at least this number of pixels, each by this much. */
const DIFFERENT = { pixels: 100, by: 64 };
/** The time to load an engine and its model. */
const LOADING_MS = 60_000;

// What is drawn can be read after the rendered frame, too.
const { getContext } = HTMLCanvasElement.prototype;
HTMLCanvasElement.prototype.getContext = function (kind, settings) {
  return getContext.call(this, kind, { ...settings, preserveDrawingBuffer: true });
};

const nextFrame = () => new Promise(requestAnimationFrame);

/** The green of each pixel, from 0 to 255: lips have little of it, and the white around them has all. */
function greens(canvas) {
  const context = new OffscreenCanvas(SIZE.width, SIZE.height).getContext("2d");
  context.drawImage(canvas, 0, 0, SIZE.width, SIZE.height);
  return context.getImageData(0, 0, SIZE.width, SIZE.height).data.filter((_, index) => index % 4 === 1);
}

/** The number of white pixels from the middle of the mouth on, in steps of this length, up to the lips. */
function openFor(pixels, step) {
  const middle = (SIZE.height / 2) * SIZE.width + SIZE.width / 2;
  let count = 0;
  while (pixels[middle + count * step] > 200) count += 1;
  return count;
}

function areDifferent(a, b) {
  const count = a.reduce((sum, value, index) => sum + (Math.abs(value - b[index]) > DIFFERENT.by ? 1 : 0), 0);
  return count >= DIFFERENT.pixels;
}

/** Waits until something is drawn at the edges of the canvas and the lips: the model is loaded. */
async function drawn(canvasOf, draw) {
  const until = performance.now() + LOADING_MS;
  while (performance.now() < until) {
    draw(0);
    await nextFrame();
    const canvas = canvasOf();
    const pixels = canvas ? greens(canvas) : [];
    if (pixels.some((green) => green > 200) && pixels.some((green) => green < 150)) return;
  }
  throw new Error("no mouth was drawn");
}

/** Examines an example. `start` takes an element and the files, and returns a function that draws a time. */
export async function examine(model, start) {
  try {
    const element = document.querySelector("canvas, div");
    const draw = await start(element, { ...LINE, model });
    const canvasOf = () => (element.matches("canvas") ? element : element.querySelector("canvas"));
    await drawn(canvasOf, draw);
    const mouths = [];
    const open = {};
    for (const [index, phone] of PHONES.entries()) {
      draw(middleOf(index));
      // Some engines draw in their own rendered frame, and the first may have begun before.
      await nextFrame();
      await nextFrame();
      const pixels = greens(canvasOf());
      open[phone] = { high: openFor(pixels, SIZE.width), wide: openFor(pixels, 1) };
      if (mouths.every((mouth) => areDifferent(mouth, pixels))) mouths.push(pixels);
    }
    report({ mouths: mouths.length, open });
  } catch (error) {
    report({ error: error.stack ?? String(error) });
  }
}

const report = (found) => fetch("/report", { method: "POST", body: JSON.stringify(found) });
addEventListener("error", ({ message }) => report({ error: message }));
addEventListener("unhandledrejection", ({ reason }) => report({ error: String(reason) }));
