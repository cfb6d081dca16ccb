// Writes Godot packages (PCK, format 3), which contain the files of a project.

import { createHash } from "node:crypto";

const HEADER_BYTES = 112;
const ALIGNMENT = 16;
const FILE_OFFSETS_ARE_RELATIVE = 2;

const padding = (length, to) => Buffer.alloc((to - (length % to)) % to);

function u32(...numbers) {
  const bytes = Buffer.alloc(numbers.length * 4);
  numbers.forEach((number, index) => bytes.writeUInt32LE(number, index * 4));
  return bytes;
}

function u64(number) {
  const bytes = Buffer.alloc(8);
  bytes.writeBigUInt64LE(BigInt(number));
  return bytes;
}

/** The bytes of a package with these files: pairs of a path below `res://` and contents. */
export function packed(files) {
  const body = [];
  const directory = [u32(files.length)];
  let offset = 0;
  for (const [path, contents] of files) {
    const name = Buffer.from(path);
    const padded = Buffer.concat([name, padding(name.length, 4)]);
    const hash = createHash("md5").update(contents).digest();
    directory.push(u32(padded.length), padded, u64(offset), u64(contents.length), hash, u32(0));
    const filling = padding(contents.length, ALIGNMENT);
    body.push(contents, filling);
    offset += contents.length + filling.length;
  }
  const version = u32(3, 4, 6, 0, FILE_OFFSETS_ARE_RELATIVE);
  const start = Buffer.concat([Buffer.from("GDPC"), version, u64(HEADER_BYTES), u64(HEADER_BYTES + offset)]);
  const header = Buffer.concat([start, Buffer.alloc(HEADER_BYTES - start.length)]);
  return Buffer.concat([header, ...body, ...directory]);
}

/** The list of classes with names, which Godot's editor writes into a project. */
export function classList(scripts) {
  const classes = scripts.flatMap(([path, contents]) => {
    const text = contents.toString();
    const [, name] = /^class_name (\w+)/m.exec(text) ?? [];
    if (name === undefined) return [];
    const [, base = "RefCounted"] = /^extends (\w+)/m.exec(text) ?? [];
    const members = [
      `"base": &"${base}", "class": &"${name}", "icon": "", "is_abstract": false`,
      `"is_tool": ${/^@tool/m.test(text)}, "language": &"GDScript", "path": "res://${path}"`,
    ];
    return [`{ ${members.join(", ")} }`];
  });
  return Buffer.from(`list=[${classes.join(", ")}]\n`);
}
