// The data source of an exported page: scripts next to it, because a page opened from a disk must not fetch files.

const taken = {};

const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)).buffer;

/** Returns the contents of a file in `data/`. */
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

/** Returns the index of a clip in the list, after which its files are named. */
async function place(key) {
  return (await loaded("clips")).clips.findIndex((clip) => clip.key === key);
}

globalThis.lipzExport = {
  isLive: false,
  /** The function that each file in `data/` calls. */
  take: (name, value) => (taken[name] = value),
  clips: () => loaded("clips"),
  bank: async () => ({ bytes: bytes(await loaded("bank")), tag: (await loaded("clips")).bank }),
  wasm: async () => bytes(await loaded("wasm")),
  clip: async (key) => loaded(`clip-${await place(key)}`),
  sprites: () => loaded("sprites"),
  phones: async (key) => (await loaded(`clip-${await place(key)}`)).phones,
  sound: async (key) => bytes(await loaded(`sound-${await place(key)}`)),
};
