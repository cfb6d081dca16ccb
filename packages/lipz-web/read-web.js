// Reading files in browsers.

/** The contents of the file with this URL. */
export async function read(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`the server answers with HTTP ${response.status}`);
  return response.arrayBuffer();
}

/** The URL of the file with this name next to a given file. */
export function beside(url, fileName) {
  const page = globalThis.document?.baseURI ?? globalThis.location?.href;
  return new URL(encodeURIComponent(fileName), new URL(url, page)).href;
}
