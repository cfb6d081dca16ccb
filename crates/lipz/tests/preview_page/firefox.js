// Drives Firefox by WebDriver BiDi, over a socket: keys and pointers as a person uses them. Node 20 needs
// `--experimental-websocket`.

import { spawn } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { middleOf } from "./element.js";

const FIREFOX = process.env.FIREFOX ?? "firefox";
/** Nothing is asked, fetched or shown at the start; sound may play, and pages may be left. */
const SETTINGS = {
  "app.normandy.enabled": false,
  "app.update.disabledForTesting": true,
  "browser.shell.checkDefaultBrowser": false,
  "browser.startup.page": 0,
  "datareporting.policy.dataSubmissionEnabled": false,
  "dom.disable_beforeunload": true,
  "media.autoplay.blocking_policy": 0,
  "media.autoplay.default": 0,
  "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false,
  "services.settings.server": "data:,",
  "toolkit.telemetry.enabled": false,
};
/** How long to wait for what has to happen: machines of CI are slow. */
const PATIENCE_MS = 30_000;

/** Keys that are not the characters that they type, by the numbers of WebDriver. */
const CODES = { Backspace: "\uE003", Tab: "\uE004", Enter: "\uE007", Escape: "\uE00C", PageDown: "\uE00F", End: "\uE010",
  Home: "\uE011", ArrowLeft: "\uE012", ArrowUp: "\uE013", ArrowRight: "\uE014", ArrowDown: "\uE015" };
const MODIFIERS = { shift: "\uE008", control: "\uE009", alt: "\uE00A", meta: "\uE03D" };

export class Browser {
  /** Without a device for sound, none plays. */
  static hasSound = false;
  #process;
  #folder;
  #socket;
  #pending = new Map();
  #next = 0;
  #pages = new Map();

  static async start() {
    const browser = new Browser();
    browser.#folder = await mkdtemp(join(tmpdir(), "lipz-preview-"));
    const scheme = process.env.SCHEME === undefined ? {} : { "layout.css.prefers-color-scheme.content-override": process.env.SCHEME === "dark" ? 0 : 1 };
    const settings = Object.entries({ ...SETTINGS, ...scheme }).map(([name, value]) => `user_pref("${name}", ${JSON.stringify(value)});\n`);
    await writeFile(join(browser.#folder, "user.js"), settings.join(""));
    const flags = ["--headless", "--no-remote", "--profile", browser.#folder, "--remote-debugging-port", "0", "about:blank"];
    browser.#process = spawn(FIREFOX, flags, { stdio: ["ignore", "ignore", "pipe"] });
    await browser.#connect();
    await browser.send("session.new", { capabilities: { alwaysMatch: { unhandledPromptBehavior: { default: "accept" } } } });
    await browser.send("session.subscribe", { events: ["log.entryAdded"] });
    return browser;
  }

  /** Waits until Firefox says where it listens, and listens to it. */
  async #connect() {
    let told = "";
    const address = await new Promise((resolve, reject) => {
      this.#process.once("error", reject).once("exit", () => reject(new Error(`Firefox has ended: ${told}`)));
      this.#process.stderr.setEncoding("utf8").on("data", (part) => {
        told += part;
        const found = /WebDriver BiDi listening on (ws:\S+)/.exec(told);
        if (found) resolve(found[1]);
      });
    });
    this.#process.removeAllListeners("exit");
    this.#socket = new WebSocket(`${address}/session`);
    this.#socket.onmessage = ({ data }) => this.#hear(JSON.parse(data));
    await new Promise((resolve, reject) => Object.assign(this.#socket, { onopen: resolve, onerror: reject }));
  }

  #hear(message) {
    if (message.method === "log.entryAdded") this.#pages.get(message.params.source.context)?.hear(message.params);
    const { resolve, reject } = this.#pending.get(message.id) ?? {};
    this.#pending.delete(message.id);
    if (message.type === "error") reject?.(new Error(`${message.error}: ${message.message}`));
    else resolve?.(message.result);
  }

  send(method, params = {}) {
    const id = (this.#next += 1);
    this.#socket.send(JSON.stringify({ id, method, params }));
    return new Promise((resolve, reject) => this.#pending.set(id, { resolve, reject }));
  }

  /** Opens a page of a size. */
  async open(url, width = 1280, height = 900) {
    const { context } = await this.send("browsingContext.create", { type: "tab" });
    const page = new Page((method, params) => this.send(method, { context, ...params }), context);
    this.#pages.set(context, page);
    await page.size(width, height);
    await page.go(url);
    return page;
  }

  async end() {
    const gone = new Promise((resolve) => this.#process.once("exit", resolve));
    this.#socket.close();
    this.#process.kill("SIGKILL");
    await gone;
    await rm(this.#folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

class Page {
  /** What the page has complained about. */
  complaints = [];
  #context;

  constructor(send, context) {
    this.send = send;
    this.#context = context;
  }

  hear({ level, text }) {
    if (level === "error") this.complaints.push(text);
  }

  go(url) {
    return this.send("browsingContext.navigate", { url, wait: "none" });
  }

  size(width, height, scale = 1) {
    return this.send("browsingContext.setViewport", { viewport: { width, height }, devicePixelRatio: scale });
  }

  /** The value of an expression in the page. */
  async value(expression) {
    const whole = `(async () => JSON.stringify(await (${expression})))()`;
    const asked = { expression: whole, target: { context: this.#context }, awaitPromise: true };
    const { type, result, exceptionDetails } = await this.send("script.evaluate", asked);
    if (type === "exception") throw new Error(exceptionDetails.text);
    return result.value === undefined ? undefined : JSON.parse(result.value);
  }

  /** Waits until an expression is true. */
  async until(expression) {
    const end = Date.now() + PATIENCE_MS;
    while (!(await this.value(expression).catch(() => false))) {
      if (Date.now() > end) throw new Error(`never: ${expression}; ${this.complaints.join("\n")}`);
      await new Promise((resolve) => setTimeout(resolve, 25));
    }
  }

  key(key, ...modifiers) {
    const held = modifiers.map((name) => MODIFIERS[name]);
    const value = CODES[key] ?? key;
    const down = [...held, value].map((value) => ({ type: "keyDown", value }));
    const up = [value, ...held.reverse()].map((value) => ({ type: "keyUp", value }));
    return this.#act({ type: "key", id: "keyboard", actions: [...down, ...up] });
  }

  async type(text) {
    const actions = Array.from(text).flatMap((value) => [{ type: "keyDown", value }, { type: "keyUp", value }]);
    await this.#act({ type: "key", id: "keyboard", actions });
  }

  /** The middle of an element, in the window. */
  async middle(selector) {
    return this.value(middleOf(selector));
  }

  async click(selector) {
    const { x, y } = await this.middle(selector);
    await this.#point([move(x, y), { type: "pointerDown", button: 0 }, { type: "pointerUp", button: 0 }]);
  }

  /** Drags an element to the right. */
  async drag(selector, byX) {
    const { x, y } = await this.middle(selector);
    const moves = [move(x + byX / 2, y), move(x + byX, y)];
    await this.#point([move(x, y), { type: "pointerDown", button: 0 }, ...moves, { type: "pointerUp", button: 0 }]);
  }

  #point(actions) {
    return this.#act({ type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions });
  }

  #act(source) {
    return this.send("input.performActions", { actions: [source] });
  }

  /** A picture of the window, as PNG. */
  async picture() {
    return Buffer.from((await this.send("browsingContext.captureScreenshot")).data, "base64");
  }
}

const move = (x, y) => ({ type: "pointerMove", x: Math.round(x), y: Math.round(y) });
