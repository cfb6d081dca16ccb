// Reads files in browsers.

/** The contents of the file with this URL. */
export async function read(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`the server responded with HTTP ${response.status}`);
  return response.arrayBuffer();
}

/** The name of the file with this URL, in which some characters are encoded, such as `%20`. */
export function nameOf(url) {
  try {
    return decodeURIComponent(new URL(url, page()).pathname.split("/").at(-1));
  } catch {
    return String(url);
  }
}

/** The URL of the file with this name next to a given file. */
export function beside(url, fileName) {
  return new URL(encodeURIComponent(fileName), new URL(url, page())).href;
}

/** The base of relative URLs. */
const page = () => globalThis.document?.baseURI ?? globalThis.location?.href;
