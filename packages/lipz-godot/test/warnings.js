// Finds what Godot's editor warns about in scripts, because the engine of the tests is a release build, which does not
// warn: unused and shadowing names, divisions of whole numbers, and inference from values of any type.

/** Members of base classes and global names that a local name would shadow. */
const SHADOWED = new Set(
  `abs acos asin atan call ceil char clamp cos exp floor free fmod get get_class hash has_method is_class is_same
  len lerp load log max min name notification ord owner pow preload print process_mode range round script seed set sign
  sin snapped sqrt str tan tr type_string typeof wrap`.split(/\s+/),
);
const NODE_MEMBERS = new Set(["name", "owner", "process_mode"]);
const IGNORE = "@warning_ignore(";
/** What is certainly not a division of whole numbers. */
const FLOAT = /\.\d|\bfloat\(|\d\.0|1e\d|"/;
/** Methods that return a value of any type. */
const ANY_TYPE = /:= [\w.]+\.(pop_front|pop_back|get|call|get_ref|front|back)\(/;

const withoutText = (line) => line.replace(/"(?:\\.|[^"\\])*"/g, '""').replace(/#.*/, "");

/** The names of the members of a script, with their kinds. */
function membersOf(lines) {
  const members = new Map();
  for (const line of lines) {
    const [, kind, name] =
      /^(?:@export\S* |@onready )?(?:static )?(var|const|func|signal|enum) (\w+)/.exec(line) ?? [];
    if (name !== undefined) members.set(name, kind);
  }
  return members;
}

/** The local names of a line: parameters, variables and those of loops. */
function localsOf(line) {
  const names = [];
  const declared = /^\s+(?:var|const) (\w+)/.exec(line) ?? /^\s+for (\w+)/.exec(line);
  if (declared) names.push(declared[1]);
  for (const [, list] of line.matchAll(/func(?: \w+)?\(([^)]*)\)/g)) {
    names.push(...list.split(",").map((part) => /^\s*(\w+)/.exec(part)?.[1]).filter(Boolean));
  }
  return names;
}

const uses = (text, name) => text.match(new RegExp(`(?<![\\w.])${name}\\b|\\bself\\.${name}\\b`, "g"))?.length ?? 0;

/** The warnings about one script. */
function warningsOf(path, text) {
  const lines = text.split("\n").map(withoutText);
  const members = membersOf(lines);
  const code = lines.join("\n");
  const isNode = /^extends (Node|Node2D|Node3D)$/m.test(text);
  const found = [];
  let body = "";
  lines.forEach((line, index) => {
    const warn = (message) => found.push(`${path}:${index + 1}: ${message}`);
    const isIgnored = (lines[index - 1] ?? "").includes(IGNORE);
    if (/^(static )?func /.test(line)) {
      const end = lines.findIndex((other, at) => at > index && /^\S/.test(other) && !/^\)/.test(other));
      body = lines.slice(index, end < 0 ? undefined : end).join("\n");
    }
    for (const name of localsOf(line)) {
      const isShadowing = members.has(name) || (SHADOWED.has(name) && (isNode || !NODE_MEMBERS.has(name)));
      if (isShadowing) warn(`${name} shadows a ${members.get(name) ?? "global name or a member of a base class"}`);
      if (!name.startsWith("_") && uses(body, name) < 2) warn(`${name} is not used`);
    }
    const [, own] = /^(?:static )?(?:var|const) (\w+)/.exec(line) ?? [];
    const isPrivate = own?.startsWith("_") || /= preload\(/.test(line);
    if (isPrivate && !isIgnored && uses(code, own) < 2) warn(`${own} is not used`);
    if (/[\w)\]] \/ [\w(]/.test(line) && !FLOAT.test(line) && !isIgnored) warn("a division of whole numbers");
    if (ANY_TYPE.test(line)) warn("the type is inferred from a value of any type");
  });
  return found;
}

/** The warnings about all scripts of an addon: pairs of their paths and contents. */
export function warnings(scripts) {
  return scripts
    .filter(([path]) => path.endsWith(".gd"))
    .flatMap(([path, contents]) => warningsOf(path, contents.toString()));
}
