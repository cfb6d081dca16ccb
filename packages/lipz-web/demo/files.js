// Opens files that the user drops on the page or chooses: banks, their patches, and text banks.

import { LipzError, openDialogue } from "../lipz.js";

/** The statuses in lipz.h of files that need a bank below them: text banks and patches. */
const [TEXTS_ONLY, OTHER_BASE] = [29, 37];

/** Calls `use` with the files that the user drops on the page or chooses in `input`. */
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
    // Allows the user to choose the same file again.
    input.value = "";
  });
}

/**
 * Opens a bank with the files on top of it, or files on top of the open ones, `below`. Returns the dialogue and its
 * files, and whether they include those of `below`. Throws an error that names the file.
 */
export async function opened(dropped, below) {
  const files = await Promise.all(dropped.map(async (file) => ({ name: file.name, bytes: await file.arrayBuffer() })));
  const [bases, patches, texts] = [[], [], []];
  for (const file of files) (await kindOf(file, { bases, patches, texts })).push(file);
  const all = [...(bases.length > 0 ? bases : below), ...patches, ...texts];
  return { dialogue: await openDialogue(all), files: all, isAdded: bases.length === 0 };
}

/** The kind of a file: opened alone, it is a bank, or its error shows its kind. */
async function kindOf(file, { bases, patches, texts }) {
  try {
    await openDialogue([file], { verify: false });
    return bases;
  } catch (error) {
    if (!(error instanceof LipzError)) throw error;
    if (error.status === OTHER_BASE) return patches;
    if (error.status === TEXTS_ONLY) return texts;
    throw error;
  }
}
