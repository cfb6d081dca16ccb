// Where an exported page has its data from: scripts beside it, as a page that is opened from a disk may fetch nothing.

const taken = {};

const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)).buffer;

/** What a file in `data/` has. */
function loaded(name) {
  return new Promise((resolve, reject) => {
    if (name in taken) return resolve(taken[name]);
    const script = document.createElement("script");
    script.src = `data/${name}.js`;
    script.onload = () => {
      script.remove();
      resolve(taken[name]);
    };
    script.onerror = () => reject(new Error(`data/${name}.js is missing: copy the whole folder`));
    document.head.append(script);
  });
}

/** The place of a clip in the list, by which its files are named. */
async function place(key) {
  return (await loaded("clips")).clips.findIndex((clip) => clip.key === key);
}

globalThis.lipzExport = {
  isLive: false,
  /** What each file in `data/` calls. */
  take: (name, value) => (taken[name] = value),
  clips: () => loaded("clips"),
  bank: async () => ({ bytes: bytes(await loaded("bank")), tag: (await loaded("clips")).bank }),
  wasm: async () => bytes(await loaded("wasm")),
  clip: async (key) => loaded(`clip-${await place(key)}`),
  phones: async (key) => (await loaded(`clip-${await place(key)}`)).phones,
  sound: async (key) => bytes(await loaded(`sound-${await place(key)}`)),
};
