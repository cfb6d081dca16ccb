// Projects to be previewed, and the command that does it.

import { spawn } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

const RATE_HZ = 16_000;

/** A clip, laid out by hand: what is saved must keep that. */
export const MAYOR = `{
  "visemes" :    "MAAAEO--|MAAEEO------",
  "text_en-us" : "Mayor?  |{louder} Mayor!",
  "text_de-de" : "Meister?|{louder} Meister!",
  "events" :     "mara feels joy|points door",
  "fps" : 24, "viseme_type" : "blair",
  "note" : "as recorded"
}
`;
const OTTO = '{ "visemes": "MAEO----", "text_en-us": "Good evening, Otto.", "fps": 24, "viseme_type": "blair" }\n';
const WRONG = '{ "visemes": "MA|EO", "text_en-us": "One segment only.", "fps": 24, "viseme_type": "blair" }\n';
export const SETTINGS = 'sources = ["voices"]\ndefault-locale = "en-us"\n[audio]\nfolder = "recordings"\n';

export class Project {
  static async make(files) {
    const project = new Project();
    project.folder = await mkdtemp(join(tmpdir(), "lipz-project-"));
    const folders = new Set(Object.keys(files).map((name) => dirname(join(project.folder, name))));
    folders.forEach((folder) => mkdirSync(folder, { recursive: true }));
    for (const [name, contents] of Object.entries(files)) writeFileSync(join(project.folder, name), contents);
    return project;
  }

  /** Three clips: one with a recording, one without, one with an error. */
  static small() {
    return Project.make({
      "lipz.toml": SETTINGS,
      "voices/act1/mayor.lipz": MAYOR,
      "voices/act1/otto.lipz": OTTO,
      "voices/act2/wrong.lipz": WRONG,
      "recordings/act1/mayor.wav": tone(20 / 24),
    });
  }

  /** A clip of ten seconds in one line of its file. */
  static long() {
    const line = (text) => Array.from({ length: 10 }, (_, at) => `${text} ${at + 1}.`).join("|");
    const visemes = Array.from({ length: 10 }, () => "MAAAEO------MAAEEO------").join("|");
    const clip = { visemes, "text_en-us": line("Good evening, Otto"), "text_de-de": line("Guten Abend"), fps: 24, viseme_type: "blair" };
    return Project.make({ "lipz.toml": SETTINGS, "voices/long.lipz": `${JSON.stringify(clip)}\n`, "recordings/long.wav": tone(10) });
  }

  /** Many clips. */
  static large(count) {
    const clip = (index) => [`voices/scene-${index % 200}/line-${index}.lipz`, OTTO.replace("Otto", `Otto ${index}`)];
    const settings = { "lipz.toml": 'sources = ["voices"]\n' };
    return Project.make(Object.assign(settings, Object.fromEntries(Array.from({ length: count }, (_, index) => clip(index)))));
  }

  write(name, contents) {
    return writeFile(join(this.folder, name), contents);
  }

  remove(name) {
    return rm(join(this.folder, name));
  }

  read(name) {
    return readFile(join(this.folder, name), "utf8");
  }

  /** Starts the command, and gives the address of its page. */
  preview(...options) {
    this.process = spawn(process.env.LIPZ, ["preview", ...options], { cwd: this.folder, stdio: ["ignore", "pipe", "inherit"] });
    return new Promise((resolve, reject) => {
      this.process.once("error", reject).once("exit", (code) => reject(new Error(`lipz preview ended with ${code}`)));
      this.process.stdout.setEncoding("utf8").once("data", (line) => resolve(line.trim()));
    });
  }

  async end() {
    this.process?.removeAllListeners("exit").kill();
    await rm(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

/** A recording of some seconds, as WAV: a tone that swells and fades. */
function tone(seconds) {
  const count = Math.round(seconds * RATE_HZ);
  const bytes = Buffer.alloc(44 + 2 * count);
  bytes.write("RIFF", 0);
  bytes.writeUInt32LE(36 + 2 * count, 4);
  bytes.write("WAVEfmt ", 8);
  [[16, 16], [1, 20, 2], [1, 22, 2], [RATE_HZ, 24], [2 * RATE_HZ, 28], [2, 32, 2], [16, 34, 2]].forEach(([value, at, size]) =>
    size === 2 ? bytes.writeUInt16LE(value, at) : bytes.writeUInt32LE(value, at));
  bytes.write("data", 36);
  bytes.writeUInt32LE(2 * count, 40);
  for (let at = 0; at < count; at++) {
    const loudness = Math.abs(Math.sin((at / RATE_HZ) * 9));
    bytes.writeInt16LE(Math.round(9000 * loudness * Math.sin((2 * Math.PI * 180 * at) / RATE_HZ)), 44 + 2 * at);
  }
  return bytes;
}
