// Serves the package to a browser on this machine: node demo/serve.js [port]

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const ROOT = fileURLToPath(new URL("..", import.meta.url));
const PORT = 8080;
const TYPES = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".wasm": "application/wasm" };

/** A server of the files of the package, which listens on a port of this machine alone. */
export async function serve(port, post = () => false) {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    if (request.method === "POST" && (await post(pathname, request))) return response.end();
    try {
      // `normalize` leaves no `..` behind the leading slash.
      const path = join(ROOT, normalize(decodeURIComponent(pathname)));
      const type = TYPES[extname(path)] ?? "application/octet-stream";
      const contents = await readFile(path);
      response.writeHead(200, { "Content-Type": type }).end(contents);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  return server;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const server = await serve(Number(process.argv[2] ?? PORT));
  console.log(`http://127.0.0.1:${server.address().port}/demo/index.html`);
}
