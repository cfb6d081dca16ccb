// The preview: a list of clips, and one of them on a timeline, with its face, audio, texts and diagnostics.

import { onKeys } from "./keys.js";
import { List } from "./list.js";
import { Player } from "./player.js";
import { source } from "./source.js";

const $ = (id) => document.getElementById(id);
/** The time to wait before repeating a request that the server did not answer. */
const RETRY_MS = 2000;

const player = new Player();
const list = new List(choose, (key) => player.said(key));
let listing;

/** Shows a clip, unless the user wants to keep unsaved changes. */
async function choose(key) {
  if (player.isChanged && !confirm("Your changes are not saved. Discard them?")) return;
  list.chosen = key;
  await player.choose(key).catch(fail);
  // At this point, because notices in the meantime belonged to the previous clip.
  notice(listing.diagnostics);
  document.title = `${key} – lipz preview`;
  address();
  clips(false);
}

/** Fetches the current list of clips, and the bank if it has changed. */
async function refresh() {
  const before = listing;
  // The first time, the bank is loaded in parallel with the list.
  const ahead = before ? undefined : source.bank();
  listing = await source.clips();
  if (listing.bank !== before?.bank) await player.open(await bank(listing.bank, ahead), listing.is_read_only);
  $("project").textContent = listing.name;
  list.show(listing);
  notice(listing.diagnostics);
  const keys = listing.clips.map(({ key }) => key);
  if (player.key === undefined) {
    const { clip, time } = place();
    const first = keys.includes(clip) ? clip : keys[0];
    if (first === undefined) return notice(["The project has no clips yet."]);
    list.chosen = first;
    await player.choose(first, time);
    document.title = `${first} – lipz preview`;
  } else if (keys.includes(player.key)) {
    list.chosen = player.key;
    await player.refresh();
  } else {
    notice([`The clip ${player.key} no longer exists. Showing its last version.`]);
  }
  $("failure").hidden = true;
}

/** Returns the bytes of the bank that a list names. The bank loaded ahead may be an older one. */
async function bank(tag, ahead) {
  const first = await ahead;
  return (first?.tag === tag ? first : await source.bank()).bytes;
}

/** Shows changes as long as the page is open. */
async function follow() {
  while (source.isLive) {
    try {
      const version = await source.changed(listing.version);
      if (version !== listing.version) await refresh();
    } catch (error) {
      fail(error);
      await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
    }
  }
}

function notice(lines) {
  $("notice").textContent = lines.join("\n");
  $("notice").hidden = lines.length === 0;
}

function fail(error) {
  $("failure").textContent = error.message;
  $("failure").hidden = false;
}

/** Sets the address to the clip, and to a time if there is one. */
function address(time) {
  const place = new URLSearchParams({ clip: player.key, ...(time && { at: shortTime(time) }) });
  history.replaceState(null, "", `#${place.toString().replaceAll("%2F", "/")}`);
}

/** Rounds up to whole milliseconds, because a frame starts at the time. */
const shortTime = (time) => Math.ceil(time * 1000 - 0.001) / 1000;

/** Returns the clip and the time in the address. */
function place() {
  const { clip, at } = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  return { clip, time: Number(at ?? 0) };
}

/** Goes to the clip in the address after the user has changed or followed it. */
async function followAddress() {
  const { clip, time } = place();
  if (!listing?.clips.some(({ key }) => key === clip)) return;
  if (clip !== player.key) await choose(clip);
  if (clip === player.key) player.seek(time);
}

/** Copies the address of the current view. */
async function link() {
  address(player.clock.time);
  const isCopied = await (navigator.clipboard?.writeText(location.href) ?? Promise.reject()).then(() => true, () => false);
  $("linked").textContent = isCopied ? "Copied." : "Copy the address of the page instead.";
}

/** Shows the list over the clip, on screens without room for both. */
function clips(isOpen) {
  document.body.classList.toggle("choosing", isOpen);
  $("clips-button").ariaExpanded = String(isOpen);
}

async function start() {
  $("clips-button").onclick = () => clips(!document.body.classList.contains("choosing"));
  $("link").onclick = link;
  addEventListener("hashchange", followAddress);
  addEventListener("beforeunload", (event) => player.isChanged && event.preventDefault());
  addEventListener("unhandledrejection", ({ reason }) => fail(reason));
  onKeys({
    ...player.actions,
    search() {
      clips(true);
      $("search").focus();
    },
  });
  await refresh();
  const shown = await new Promise((resolve) => requestAnimationFrame(() => setTimeout(() => resolve(performance.now()))));
  follow();
  return { player, list, shown };
}

/** The page, for tests and for the console. */
globalThis.preview = start();
globalThis.preview.catch(fail);
