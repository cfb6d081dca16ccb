// Opens files as a dialogue: reads them, finds the banks of a set, and copies all into the memory of one module.

import { Dialogue } from "./dialogue.js";
import { LipzError, NONE, NOT_A_SET, OK, TOO_SHORT } from "./error.js";
import { FIRST, Memory } from "./memory.js";
import * as c from "./structs.js";

/** The flags of lipz.h. */
const VERIFIED = 0;
const UNVERIFIED = 1;

const CHECK_PATH = "check the path of the file";
const NAME_BANK = "name it after the index, or pass the option `load`";
const COPY_MODULE = "copy lipz.wasm from the package next to the bundle, or pass its URL as the option `wasm`";

/**
 * The function `openDialogue` of a platform. `read` reads a file, `beside` returns the path of a file next to it, and
 * `nameOf` returns its name without its folder.
 */
export function openerWith({ read, beside, nameOf }) {
  let compiled;

  /** The contents of the file with this path or URL. */
  async function contentsOf(from) {
    try {
      return bytesOf(await read(from));
    } catch (cause) {
      throw new LipzError(cause.message, { file: String(from), remedy: CHECK_PATH, cause });
    }
  }

  /** The module of the package, which bundlers copy or leave behind. */
  async function ownModule() {
    try {
      // Bundlers search for this expression, and copy the file.
      return await WebAssembly.compile(bytesOf(await read(new URL("./lipz.wasm", import.meta.url))));
    } catch (cause) {
      // A missing file, the page that some servers send instead, or a bundle without a URL of its own.
      throw new LipzError(cause.message, { file: "lipz.wasm", remedy: COPY_MODULE, cause });
    }
  }

  /** The compiled module: that of the program, or the file next to this one, which is compiled once. */
  async function moduleOf(source) {
    if (source instanceof WebAssembly.Module) return source;
    if (isPath(source)) return WebAssembly.compile(await contentsOf(source));
    if (source) return WebAssembly.compile(source);
    if (compiled === undefined) {
      compiled = ownModule();
      // After a failure, the next call tries again.
      compiled.catch(() => (compiled = undefined));
    }
    return compiled;
  }

  /** A bank of a set that is not loaded, with its name and a function to load it. */
  function absent(index, fileName, load) {
    if (index.from !== undefined && load === undefined) {
      const from = beside(index.from, fileName);
      return { name: from, load: () => contentsOf(from) };
    }
    return { name: fileName, load: () => loadedBy(load, fileName) };
  }

  /** The name of a file without its folder. */
  function fileNameOf({ from, name }) {
    return from === undefined ? name.split(/[/\\]/).at(-1) : nameOf(from);
  }

  return async function openDialogue(files, { verify = true, load, wasm } = {}) {
    if (!Array.isArray(files)) throw new TypeError("the files are not an array: write openDialogue([file])");
    const sources = files.map(sourceOf);
    const filled = async (source) => ({ ...source, bytes: source.bytes ?? (await contentsOf(source.from)) });
    const reading = Promise.all(sources.map(filled));
    const [module, [index, ...others]] = await Promise.all([moduleOf(wasm), reading]);
    const memory = new Memory(await WebAssembly.instantiate(module));
    const all = index ? [index] : [];
    const { fileNames, isDamaged } = index ? setOf(memory, index) : { fileNames: [] };
    for (const fileName of fileNames) {
      const place = others.findIndex((source) => fileNameOf(source) === fileName);
      all.push(place < 0 ? absent(index, fileName, load) : others.splice(place, 1)[0]);
    }
    // The first bank of a set has its locales and profiles, which must not change later.
    if (fileNames.length > 0) all[1].bytes ??= await all[1].load();
    all.push(...others);
    const contents = stored(memory, all);
    const named = all.map(({ name, load }) => ({ name, load }));
    return new Dialogue(memory, named, contents, verify || isDamaged ? VERIFIED : UNVERIFIED);
  };
}

const isPath = (file) => typeof file === "string" || file instanceof URL;

/** The name of a file that the program passed, with its bytes or its location. */
function sourceOf(file, number) {
  if (isPath(file)) return { name: String(file), from: file };
  const { name, bytes } = isBytes(file) ? { name: `files[${number}]`, bytes: file } : (file ?? {});
  if (typeof name !== "string" || !isBytes(bytes)) {
    throw new TypeError(`files[${number}] is not a path, a URL, bytes or { name, bytes }`);
  }
  return { name, bytes: bytesOf(bytes) };
}

/** Whether a value is bytes, possibly from a different window. */
function isBytes(value) {
  const type = Object.prototype.toString.call(value).slice("[object ".length, -1);
  return ArrayBuffer.isView(value) || type === "ArrayBuffer" || type === "SharedArrayBuffer";
}

function bytesOf(bytes) {
  return ArrayBuffer.isView(bytes)
    ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    : new Uint8Array(bytes);
}

/** The bytes of a bank of a set, from the `load` option of the program. */
async function loadedBy(load, fileName) {
  if (load === undefined) {
    throw new LipzError("the bank of the set is missing", { file: fileName, remedy: NAME_BANK });
  }
  try {
    return bytesOf(await load(fileName));
  } catch (cause) {
    throw new LipzError(cause.message, { file: fileName, cause });
  }
}

/** The names of the banks in the first file, if it is the index of a set, and whether the index is damaged. */
function setOf(memory, index) {
  const { byteLength: length_bytes } = index.bytes;
  index.data = placeOf(memory, index);
  const contents = memory.put(FIRST, c.lipz_bytes, { data: index.data, length_bytes });
  const fileNames = [];
  for (;;) {
    const { status, answer } = memory.call(c.lipz_set_bank, "lipz_set_bank_by_index", contents, fileNames.length);
    if (status !== OK) return { fileNames, isDamaged: ![NONE, NOT_A_SET, TOO_SHORT].includes(status) };
    fileNames.push(memory.string(answer.file_name));
  }
}

/** Copies the contents of all files, and returns the address of their list. */
function stored(memory, files) {
  const list = memory.allocate(files.length * c.lipz_bytes.size);
  files.forEach((file, number) => {
    const length_bytes = file.bytes?.byteLength ?? 0;
    const data = file.data ?? (file.bytes ? placeOf(memory, file) : 0);
    memory.write(list + number * c.lipz_bytes.size, c.lipz_bytes, { data, length_bytes });
  });
  return list;
}

/** Copies the contents of a file, and returns their address. */
function placeOf(memory, { name, bytes }) {
  try {
    return memory.store(bytes, (at) => at);
  } catch (cause) {
    throw new LipzError(`the memory has no room for ${bytes.byteLength} bytes`, { file: name, cause });
  }
}
