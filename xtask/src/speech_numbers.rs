//! Numbers in words for lipz-speech: the part of CLDR's rules (RBNF) for years, numbers and ordinals.

use crate::Failure;
use crate::paths::{temporary_folder, workspace_root};
use crate::tools::succeed;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package of the rules.
const PACKAGE: &str = "cldr-rbnf@48.2.0";

/// Makes `data/numbers/rules.txt` of lipz-speech. The same package leads to the same bytes.
pub(crate) fn run() -> Result<(), Failure> {
    let folder = temporary_folder()?;
    let package = fetched(PACKAGE, folder.path())?;
    let read = |path: &Path| std::fs::read_to_string(path).map_err(|error| format!("`{}`: {error}", path.display()));

    let mut languages = BTreeMap::new();
    for entry in listed(&package.join("rbnf"))?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        // Languages, without their regional variants.
        let Some(code) = name.strip_suffix("-SpelloutRules.txt").filter(|code| matches!(code.len(), 2 | 3)) else {
            continue;
        };
        if let Some(rules) = needed(&read(&entry.path())?) {
            languages.insert(code.to_owned(), rules);
        }
    }
    let mut text = format!("# Made of {PACKAGE} by `cargo xtask speech-numbers`. LICENSE-UNICODE is its licence.\n");
    for (code, rules) in &languages {
        text.push_str(&format!("@{code}\n{rules}"));
    }
    let target = workspace_root().join("crates/lipz-speech/data/numbers");
    let write = |name: &str, text: &str| {
        println!("{name}: {} bytes, {} languages", text.len(), languages.len());
        std::fs::write(target.join(name), text).map_err(|error| format!("`{name}` cannot be written: {error}"))
    };
    write("rules.txt", &text)?;
    write("LICENSE-UNICODE", &read(&package.join("LICENSE"))?)
}

/// Fetches a package of npm, and unpacks it in this folder.
pub(crate) fn fetched(package: &str, folder: &Path) -> Result<PathBuf, Failure> {
    let mut npm = Command::new("npm");
    succeed(npm.args(["pack", "--silent", "--pack-destination"]).arg(folder).arg(package), "npm pack")?;
    let mut files = listed(folder)?.flatten().map(|entry| entry.path());
    let archive = files.find(|path| path.extension().is_some_and(|extension| extension == "tgz"));
    let archive = archive.ok_or("npm fetched no package")?;
    succeed(Command::new("tar").arg("-xzf").arg(archive).arg("-C").arg(folder), "tar")?;
    Ok(folder.join("package"))
}

fn listed(folder: &Path) -> Result<std::fs::ReadDir, Failure> {
    std::fs::read_dir(folder).map_err(|error| format!("`{}`: {error}", folder.display()))
}

/// Returns the required rule sets of a language, in their order; `None` if it has none for numbers.
fn needed(text: &str) -> Option<String> {
    let mut sets: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in text.lines() {
        match (line.strip_suffix(':').filter(|name| name.starts_with('%')), sets.last_mut()) {
            (Some(name), _) => sets.push((name, Vec::new())),
            (None, Some((_, rules))) => rules.push(line),
            (None, None) => {}
        }
    }
    let has = |name: &str| sets.iter().any(|(set, _)| *set == name);
    let ordinals = ["%spellout-ordinal", "%spellout-ordinal-masculine", "%spellout-ordinal-sinokorean"];
    let first_ordinal = || sets.iter().map(|(set, _)| *set).find(|set| set.starts_with("%spellout-ordinal"));
    let ordinal = ordinals.into_iter().find(|name| has(name)).or_else(first_ordinal);
    let mut open: Vec<&str> =
        ["%spellout-numbering-year", "%spellout-numbering"].into_iter().filter(|name| has(name)).collect();
    if !has("%spellout-numbering") {
        return None;
    }
    open.extend(ordinal);
    let mut reached = BTreeSet::new();
    while let Some(name) = open.pop() {
        if !reached.insert(name) {
            continue;
        }
        let rules = sets.iter().filter(|(set, _)| *set == name).flat_map(|(_, rules)| rules);
        for rule in rules {
            // The name of a rule set is between two of `<`, `>` or `=`.
            let names = rule.split(['<', '>', '=', ';']).filter(|part| part.starts_with('%'));
            open.extend(names);
        }
    }
    let mut kept = String::new();
    for (name, rules) in sets.iter().filter(|(name, _)| reached.contains(name)) {
        let name = if Some(*name) == ordinal { "%ordinal" } else { name };
        kept.push_str(&format!("{name}:\n"));
        for rule in rules.iter().filter(|rule| !rule.starts_with("Inf") && !rule.starts_with("NaN")) {
            let rule = ordinal.map_or((*rule).to_owned(), |ordinal| {
                ["<", ">", "="].iter().fold((*rule).to_owned(), |rule, mark| {
                    rule.replace(&format!("{mark}{ordinal}{mark}"), &format!("{mark}%ordinal{mark}"))
                })
            });
            let (number, text) = rule.split_once(':').unwrap_or((&rule, ""));
            kept.push_str(&format!("{number}:{}\n", text.trim_start().trim_end_matches(';')));
        }
    }
    Some(with_short_names(&kept))
}

/// Returns the rules with numbers instead of the names of their sets, which are a quarter of all bytes. `%0` is the set
/// for numbers.
fn with_short_names(rules: &str) -> String {
    let mut names = vec!["%spellout-numbering", "%spellout-numbering-year", "%ordinal"];
    let (mut short, mut rest) = (String::new(), rules);
    while let Some(at) = rest.find('%') {
        short.push_str(&rest[..at]);
        let end = rest[at..].find(['<', '>', '=', ':', ';', '\n']).map_or(rest.len(), |length| at + length);
        let name = &rest[at..end];
        let number = names.iter().position(|known| *known == name).unwrap_or(names.len());
        if number == names.len() {
            names.push(name);
        }
        short.push_str(&format!("%{number}"));
        rest = &rest[end..];
    }
    short + rest
}
