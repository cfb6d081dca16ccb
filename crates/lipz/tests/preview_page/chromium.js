// Drives Chromium by its own protocol, over a pipe: keys and pointers as a person uses them.

import { spawn } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { middleOf } from "./element.js";

const CHROMIUM = process.env.CHROMIUM ?? "chromium";
const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
  "--autoplay-policy=no-user-gesture-required", "--remote-debugging-pipe"];
/** How long to wait for what has to happen: machines of CI are slow. */
const PATIENCE_MS = 20_000;

/** Keys that are not the characters that they type. */
const CODES = { Enter: 13, Escape: 27, Home: 36, End: 35, ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40, Tab: 9, Backspace: 8, PageDown: 34 };
const MODIFIERS = { alt: 1, control: 2, meta: 4, shift: 8 };

export class Browser {
  static hasSound = true;
  #process;
  #folder;
  #pending = new Map();
  #next = 0;
  #listeners = [];

  static async start() {
    const browser = new Browser();
    browser.#folder = await mkdtemp(join(tmpdir(), "lipz-preview-"));
    const flags = [...FLAGS, `--user-data-dir=${browser.#folder}`, "about:blank"];
    browser.#process = spawn(CHROMIUM, flags, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    let text = "";
    browser.#process.stdio[4].setEncoding("utf8").on("data", (part) => {
      const messages = (text + part).split("\0");
      text = messages.pop();
      messages.forEach((message) => browser.#hear(JSON.parse(message)));
    });
    return browser;
  }

  #hear(message) {
    const { resolve, reject } = this.#pending.get(message.id) ?? {};
    this.#pending.delete(message.id);
    if (message.error) reject?.(new Error(message.error.message));
    else resolve?.(message.result);
    if (message.method) this.#listeners.forEach((listen) => listen(message));
  }

  send(method, params = {}, sessionId) {
    const id = (this.#next += 1);
    this.#process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => this.#pending.set(id, { resolve, reject }));
  }

  /** Opens a page of a size. */
  async open(url, width = 1280, height = 900) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page((method, params) => this.send(method, params, sessionId));
    this.#listeners.push((message) => message.sessionId === sessionId && page.hear(message));
    for (const domain of ["Page", "Runtime", "Log"]) await page.send(`${domain}.enable`);
    await page.size(width, height);
    await page.go(url);
    return page;
  }

  async end() {
    const gone = new Promise((resolve) => this.#process.once("exit", resolve));
    this.#process.kill("SIGKILL");
    await gone;
    await rm(this.#folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

class Page {
  /** What the page has complained about. */
  complaints = [];

  constructor(send) {
    this.send = send;
  }

  hear({ method, params }) {
    if (method === "Runtime.exceptionThrown") this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Log.entryAdded" && params.entry.level === "error") this.complaints.push(`${params.entry.text} ${params.entry.url ?? ""}`);
    // Nobody is there to answer: what is not saved may be dropped.
    if (method === "Page.javascriptDialogOpening") this.send("Page.handleJavaScriptDialog", { accept: true });
  }

  go(url) {
    return this.send("Page.navigate", { url });
  }

  size(width, height, scale = 1) {
    return this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: scale, mobile: false });
  }

  scheme(value) {
    return this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
  }

  /** The value of an expression in the page. */
  async value(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Waits until an expression is true. */
  async until(expression) {
    const end = Date.now() + PATIENCE_MS;
    while (!(await this.value(expression).catch(() => false))) {
      if (Date.now() > end) throw new Error(`never: ${expression}; ${this.complaints.join("\n")}`);
      await new Promise((resolve) => setTimeout(resolve, 25));
    }
  }

  async key(key, ...modifiers) {
    const flags = modifiers.reduce((all, name) => all | MODIFIERS[name], 0);
    const types = key.length === 1 && (flags & ~MODIFIERS.shift) === 0;
    const code = CODES[key] ?? key.toUpperCase().charCodeAt(0);
    const event = { key, modifiers: flags, windowsVirtualKeyCode: code, ...(types && { text: key }) };
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", ...event, ...(key === "Enter" && { text: "\r" }) });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", ...event });
  }

  async type(text) {
    await this.send("Input.insertText", { text });
  }

  /** The middle of an element, in the window. */
  async middle(selector) {
    return this.value(middleOf(selector));
  }

  async click(selector) {
    const { x, y } = await this.middle(selector);
    await this.#mouse("mousePressed", x, y);
    await this.#mouse("mouseReleased", x, y);
  }

  /** Drags an element to the right. */
  async drag(selector, byX) {
    const { x, y } = await this.middle(selector);
    await this.#mouse("mouseMoved", x, y);
    await this.#mouse("mousePressed", x, y);
    await this.#mouse("mouseMoved", x + byX / 2, y);
    await this.#mouse("mouseMoved", x + byX, y);
    await this.#mouse("mouseReleased", x + byX, y);
  }

  #mouse(type, x, y) {
    return this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1 });
  }

  /** A picture of the window, as PNG. */
  async picture() {
    return Buffer.from((await this.send("Page.captureScreenshot", { format: "png" })).data, "base64");
  }
}
