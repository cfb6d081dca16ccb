// Serves the package to a browser on this machine: node demo/serve.js [port]

import { createServer } from "node:http";
import { access, readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const ROOT = fileURLToPath(new URL("..", import.meta.url));
const PORT = 8080;
const TYPES = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".wasm": "application/wasm" };
/** Files that the repository has outside the package: the module is built, and the banks are fixtures. */
const ELSEWHERE = {
  "lipz.wasm": "../../target/web/lipz.wasm",
  "demo/dialogue.lipzbank": "../../fixtures/banks/v1/drama.lipzbank",
  "demo/faces.lipzbank": "../../fixtures/banks/v1/faces.lipzbank",
};

/** The path of a file of the package; undefined if it is missing. */
async function place(path) {
  const places = [join(ROOT, path), ...(Object.hasOwn(ELSEWHERE, path) ? [join(ROOT, ELSEWHERE[path])] : [])];
  for (const found of places) {
    if (await access(found).then(() => true, () => false)) return found;
  }
  return undefined;
}

/** A server for the files of the package, which listens on a port of this machine only. */
export async function serve(port, post = () => false) {
  const server = createServer(async (request, response) => {
    const { pathname, search } = new URL(request.url, "http://localhost");
    if (request.method === "POST" && (await post(pathname, request))) return response.end();
    if (pathname === "/") return response.writeHead(302, { Location: `/demo/index.html${search}` }).end();
    try {
      // `normalize` removes every `..` after the leading slash.
      const path = normalize(decodeURIComponent(pathname)).slice(1);
      const type = TYPES[extname(path)] ?? "application/octet-stream";
      const contents = await readFile(await place(path));
      response.writeHead(200, { "Content-Type": type }).end(contents);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve, reject) => server.once("error", reject).listen(port, "127.0.0.1", resolve));
  return server;
}

/** A message about missing files; undefined if all files exist. */
async function missing() {
  for (const path of Object.keys(ELSEWHERE)) {
    if ((await place(path)) === undefined) return `${path} is missing: run \`cargo xtask web\` in the repository`;
  }
  return undefined;
}

async function main(argument) {
  const port = Number(argument ?? PORT);
  if (!Number.isInteger(port) || port < 0 || port > 65535) throw new Error(`${argument} is not a port: node demo/serve.js [port]`);
  const why = await missing();
  if (why) throw new Error(why);
  const server = await serve(port);
  console.log(`http://127.0.0.1:${server.address().port}/`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  main(process.argv[2]).catch((error) => {
    console.error(error.code === "EADDRINUSE" ? `The port is in use: node demo/serve.js [port]` : error.message);
    process.exitCode = 1;
  });
}
