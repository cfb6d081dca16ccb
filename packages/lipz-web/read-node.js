// Reads files in node: paths and `file:` URLs from disk, other URLs from a server.

import { readFile } from "node:fs/promises";
import { basename, dirname, join } from "node:path";
import * as web from "./read-web.js";

/** Whether a string is a URL rather than a path; `C:` is a drive. */
const hasUrl = (file) => file instanceof URL || /^[a-z][a-z+.-]+:/i.test(file);

/** The contents of the file with this path or URL. */
export async function read(file) {
  if (!hasUrl(file)) return readFile(file);
  const url = new URL(file);
  return url.protocol === "file:" ? readFile(url) : web.read(url);
}

/** The name of the file with this path or URL. */
export const nameOf = (file) => (hasUrl(file) ? web.nameOf(file) : basename(file));

/** The path or URL of the file with this name next to a given file. */
export function beside(file, fileName) {
  return hasUrl(file) ? web.beside(file, fileName) : join(dirname(file), fileName);
}
