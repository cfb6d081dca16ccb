// Opening files that are dropped on the page, or chosen: banks, patches over them, and text banks.

import { LipzError, openDialogue } from "../lipz.js";

/** The statuses of files that need a bank below them (lipz.h): texts, and patches. */
const [TEXTS_ONLY, OTHER_BASE] = [29, 37];

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

/**
 * Opens files: a bank with what is over it, or what goes over those that are open, `below`. Returns the dialogue and its
 * files, and whether it has those of `below`. Throws an error that names the file.
 */
export async function opened(dropped, below) {
  const files = await Promise.all(dropped.map(async (file) => ({ name: file.name, bytes: await file.arrayBuffer() })));
  const [bases, patches, texts] = [[], [], []];
  for (const file of files) (await kindOf(file, { bases, patches, texts })).push(file);
  const all = [...(bases.length > 0 ? bases : below), ...patches, ...texts];
  return { dialogue: await openDialogue(all), files: all, isAdded: bases.length === 0 };
}

/** Which of these a file belongs to: opened by itself, it is a bank or says what it is. */
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
