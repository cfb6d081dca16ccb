//! Ids as a TypeScript module.

use super::c::comment;
use super::source_text::{NOTICE, quoted};
use super::tree::{IdFolder, Leaf};
use super::words::{camel, words};
use lipz_bank::{Clip, ClipId};
use std::fmt::Write;

/// The constant of the locales, next to those of the folders.
const LOCALES: &str = "locales";

/// Words that cannot name a constant of a module (ECMA-262, "Keywords and Reserved Words").
const RESERVED: [&str; 49] = [
    "arguments",
    "await",
    "break",
    "case",
    "catch",
    "class",
    "const",
    "continue",
    "debugger",
    "default",
    "delete",
    "do",
    "else",
    "enum",
    "eval",
    "export",
    "extends",
    "false",
    "finally",
    "for",
    "function",
    "if",
    "implements",
    "import",
    "in",
    "instanceof",
    "interface",
    "let",
    "new",
    "null",
    "package",
    "private",
    "protected",
    "public",
    "return",
    "static",
    "super",
    "switch",
    "this",
    "throw",
    "true",
    "try",
    "typeof",
    "undefined",
    "var",
    "void",
    "while",
    "with",
    "yield",
];

/// Returns `act1.maraHello` for `act1/mara-hello`.
pub(super) fn identifiers(key: &str) -> Vec<String> {
    let names = key.split('/').enumerate().map(|(depth, part)| {
        let name = camel(&words(part));
        // After a `.`, reserved words are allowed.
        let is_taken = depth == 0 && (name == LOCALES || RESERVED.contains(&name.as_str()));
        if is_taken { format!("{name}_") } else { name }
    });
    names.collect()
}

/// Returns the file.
pub(super) fn module(root: &IdFolder<'_>, locales: &[&str], clips: &[Clip<'_>]) -> String {
    let mut out = format!("// {NOTICE}\n\n");
    for (name, clip) in &root.clips {
        about(&mut out, clip, "");
        let name = root.name_beside_folders(name);
        let _ = writeln!(out, "export const {name} = {};\n", value(clip));
    }
    for (name, folder) in &root.folders {
        let _ = writeln!(out, "export const {name} = {{");
        members(&mut out, folder, 1);
        out.push_str("} as const;\n\n");
    }
    let _ = writeln!(out, "/** The locales of the bank. */\nexport const {LOCALES} = {{");
    for locale in locales {
        let _ = writeln!(out, "  {}: {},", camel(&words(locale)), quoted(locale));
    }
    out.push_str("} as const;\n\n/** The keys of the clips. */\nexport type ClipKey =");
    for clip in clips {
        let _ = write!(out, "\n  | {}", quoted(clip.key()));
    }
    out.push_str(if clips.is_empty() { " never;\n" } else { ";\n" });
    out
}

fn members(out: &mut String, folder: &IdFolder<'_>, depth: usize) {
    let indent = "  ".repeat(depth);
    for (name, clip) in &folder.clips {
        about(out, clip, &indent);
        let _ = writeln!(out, "{indent}{}: {},", folder.name_beside_folders(name), value(clip));
    }
    for (name, folder) in &folder.folders {
        let _ = writeln!(out, "{indent}{name}: {{");
        members(out, folder, depth + 1);
        let _ = writeln!(out, "{indent}}},");
    }
}

fn about(out: &mut String, clip: &Leaf<'_>, indent: &str) {
    let _ = writeln!(out, "{indent}/** {} */", comment(&clip.about()));
}

fn value(clip: &Leaf<'_>) -> String {
    format!("0x{}n", ClipId::from_u64(clip.id))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_follow_typescript() {
        let path = |key| identifiers(key).join(".");
        assert_eq!(path("act1/mara-good-evening"), "act1.maraGoodEvening");
        assert_eq!(path("class/new"), "class_.new");
        assert_eq!(path("locales/locales"), "locales_.locales");
        assert_eq!(path("1/2nd"), "_1._2nd");
    }
}
