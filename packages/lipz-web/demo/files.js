// Opening files that are dropped on the page, or chosen: a bank, and text banks beside it.

import { LipzError, open } from "../lipz.js";

/** The status of a file that has texts only (lipz.h). */
const TEXTS_ONLY = 29;

/** Calls `use` with the files that are dropped on the page or chosen in `input`. */
export function onFiles(input, use) {
  const isFiles = (event) => event.dataTransfer?.types.includes("Files");
  let inside = 0;
  const over = (change) => (event) => {
    if (!isFiles(event)) return;
    inside += change;
    document.body.classList.toggle("dropping", inside > 0);
  };
  addEventListener("dragenter", over(1));
  addEventListener("dragleave", over(-1));
  addEventListener("dragover", (event) => isFiles(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!isFiles(event)) return;
    event.preventDefault();
    inside = 0;
    document.body.classList.remove("dropping");
    use(Array.from(event.dataTransfer.files));
  });
  input.addEventListener("change", () => {
    use(Array.from(input.files));
    // The same file can be chosen again.
    input.value = "";
  });
}

/** The bank of some files; texts alone are put beside `bank`. Throws an error that names the file. */
export async function opened(files, bank) {
  const texts = [];
  let found;
  for (const file of files) {
    const bytes = await file.arrayBuffer();
    try {
      found = (await open(bytes)).verify();
    } catch (error) {
      if (!(error instanceof LipzError) || error.status !== TEXTS_ONLY) throw named(file, error);
      texts.push([file, bytes]);
    }
  }
  const result = found ?? bank;
  for (const [file, bytes] of texts) {
    try {
      result.useTexts(bytes).verify();
    } catch (error) {
      throw named(file, error);
    }
  }
  return result;
}

function named(file, error) {
  return new Error(`${file.name}: ${error.message}`, { cause: error });
}
