// The data source of the page: the server, or the files that `lipz preview --output` wrote next to it.

const api = (path, query = {}) => {
  const url = new URL(`../api/${path}`, import.meta.url);
  url.search = new URLSearchParams(query);
  return url;
};

/** Returns a response, or throws the reason for its absence. */
async function got(path, query) {
  const response = await fetch(api(path, query)).catch(() => undefined);
  if (response === undefined) throw new Error("lipz preview no longer responds: start it again, and open its new address");
  if (!response.ok) throw new Error((await response.text()).trim());
  return response;
}

async function posted(path, change) {
  const headers = { "Content-Type": "application/json" };
  const response = await fetch(api(path), { method: "POST", headers, body: JSON.stringify(change) }).catch(() => undefined);
  if (response === undefined) throw new Error("lipz preview no longer responds: nothing was saved");
  return response;
}

/** The server. */
const server = {
  isLive: true,
  clips: async () => (await got("clips")).json(),
  /** Returns the bank as `{ bytes, tag }`. The tag matches that of a list of its clips. */
  async bank() {
    const response = await got("bank");
    return { bytes: await response.arrayBuffer(), tag: response.headers.get("ETag")?.replaceAll('"', "") };
  },
  clip: async (key) => (await got("clip", { key })).json(),
  sprites: async () => (await got("sprites")).json(),
  phones: async (key) => (await got("phones", { key })).json(),
  sound: async (key) => (await got("sound", { key })).arrayBuffer(),
  changed: async (since) => (await (await got("changes", { since })).json()).version,
  /** Returns the clip with a change, as `{ answer, bank }`. */
  async draft(change) {
    const response = await posted("draft", change);
    if (!response.ok) throw new Error((await response.text()).trim());
    const bytes = await response.arrayBuffer();
    const length = new DataView(bytes).getUint32(0, true);
    const answer = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
    return { answer, bank: answer.has_bank ? bytes.slice(4 + length) : undefined };
  },
  async save(change) {
    const response = await posted("save", change);
    if (response.headers.get("Content-Type") !== "application/json") throw new Error((await response.text()).trim());
    return response.json();
  },
};

export const source = globalThis.lipzExport ?? server;
