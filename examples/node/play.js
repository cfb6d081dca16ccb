// Plays a clip: node play.js <key> <locale> <file>...
//
// The files are a bank or the index of a set, then patches and text banks.

import { openDialogue } from "@lipz/reader";

/** Seconds between two rendered frames. A game takes the time from its audio engine instead of counting. */
const STEP_SECONDS = 0.5;

const [key, tag, ...files] = process.argv.slice(2);
if (files.length === 0) {
  console.error("usage: node play.js <key> <locale> <file>...");
  process.exit(2);
}

// When the game starts.
const dialogue = await openDialogue(files);
const locale = dialogue.locale(tag);

// When the line starts. For a set, this loads the bank that contains the clip.
const clip = await dialogue.loadClip(key);
if (!clip || !locale) {
  console.error(`play: ${clip ? tag : key}: there is no such thing`);
  process.exit(1);
}
const cursor = clip.cursor({ hold: "readable" });

// Once per rendered frame.
for (let time = 0; !cursor.isOver; time += STEP_SECONDS) {
  const { events } = cursor.advanceTo(time);
  events.forEach((event) => console.log("  *", [event.character, event.verb, event.object].filter(Boolean).join(" ")));
  console.log(`${cursor.viseme} ${cursor.segment?.text(locale)?.text ?? ""}`.trimEnd());
}
