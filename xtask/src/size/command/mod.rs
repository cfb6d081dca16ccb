//! `cargo xtask size command`: lists the bytes of the published program by feature and crate, and counts the
//! instructions of `sync` and `pack`.
//!
//! Machine code is counted by the symbols of functions, which have the name of a crate. A generic function counts for
//! the first crate in its name that is not part of Rust. Embedded files are searched for in the constants.

mod features;
mod instructions;

use crate::Failure;
use crate::dist;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip};
use features::{FEATURES, OTHER};
use memchr::memmem;
use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The crates of a feature that are listed.
const LISTED: usize = 6;

/// Bytes by crate.
type Sizes = BTreeMap<String, u64>;

pub(super) fn run() -> Result<(), Failure> {
    let path = dist::program_with_symbols()?;
    let program = fs::read(&path).map_err(|error| format!("`{}`: {error}", path.display()))?;
    let file = object::File::parse(&*program).map_err(|error| format!("`{}`: {error}", path.display()))?;
    let (code, data) = (code(&file)?, data(&file)?);
    println!("| feature | code | embedded files | largest crates |\n|---|--:|--:|---|");
    for feature in FEATURES.iter().map(|feature| feature.name).chain([OTHER]) {
        print!("{}", row(feature, &code, &data));
    }
    println!("\n| section | bytes |\n|---|--:|");
    let mut sections: Vec<_> = file.sections().map(|section| (section.size(), section)).collect();
    sections.sort_by_key(|(bytes, _)| std::cmp::Reverse(*bytes));
    for (bytes, section) in sections.iter().filter(|(_, section)| is_loaded(section)).take(8) {
        println!("| {} | {bytes} |", section.name().unwrap_or_default());
    }
    if !has_program("valgrind") {
        return skip("valgrind");
    }
    println!();
    instructions::check(&path)
}

/// Whether a section remains in the stripped program.
fn is_loaded(section: &object::Section<'_, '_>) -> bool {
    !matches!(
        section.kind(),
        object::SectionKind::Metadata | object::SectionKind::Debug | object::SectionKind::OtherString
    ) && section.address() != 0
}

/// Returns the bytes of functions by crate.
fn code(file: &object::File<'_>) -> Result<Sizes, Failure> {
    let (mut sizes, mut seen) = (Sizes::new(), BTreeSet::new());
    for symbol in file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.size() > 0) {
        // Equal functions have several names.
        if seen.insert(symbol.address()) {
            let name = symbol.name().unwrap_or_default();
            *sizes.entry(crate_of(&format!("{:#}", rustc_demangle::demangle(name)))).or_default() += symbol.size();
        }
    }
    match sizes.is_empty() {
        true => Err("the program has no symbols".to_owned()),
        false => Ok(sizes),
    }
}

/// Returns the first crate in the name of a function that is not part of Rust.
fn crate_of(name: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut first = None;
    for (at, _) in name.match_indices("::") {
        let start = name[..at].rfind(|c: char| !is_word(c)).map_or(0, |before| before + 1);
        let word = &name[start..at];
        // A part of a longer path, or of `<T as Trait>::name`.
        if word.is_empty() || name[..start].ends_with("::") {
            continue;
        }
        if !["std", "core", "alloc"].contains(&word) {
            return word.to_owned();
        }
        first.get_or_insert(word);
    }
    first.unwrap_or("not Rust").to_owned()
}

/// Returns the bytes of embedded files by crate.
fn data(file: &object::File<'_>) -> Result<Sizes, Failure> {
    let mut sizes = Sizes::new();
    let mut constants = Vec::new();
    for section in file.sections().filter(|section| section.name().is_ok_and(|name| name.starts_with(".rodata"))) {
        constants.extend_from_slice(section.data().map_err(|error| format!(".rodata: {error}"))?);
    }
    let crates = workspace_root().join("crates");
    let failed = |error: std::io::Error| format!("`{}`: {error}", crates.display());
    for entry in fs::read_dir(&crates).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name().to_string_lossy().replace('-', "_");
        let mut files = Vec::new();
        collect_files(&entry.path(), &mut files).map_err(failed)?;
        for contents in files.iter().filter(|contents| contents.len() > 100) {
            if memmem::find(&constants, contents).is_some() {
                *sizes.entry(name.clone()).or_default() += contents.len() as u64;
            }
        }
    }
    Ok(sizes)
}

/// Collects the contents of the files in a folder that programs may embed.
fn collect_files(folder: &Path, files: &mut Vec<Vec<u8>>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect_files(&path, files)?;
        } else if path.extension().is_none_or(|extension| extension != "rs") {
            files.push(fs::read(path)?);
        }
    }
    Ok(())
}

fn row(feature: &str, code: &Sizes, data: &Sizes) -> String {
    let of = |sizes: &Sizes| -> Vec<(u64, String)> {
        let chosen = sizes.iter().filter(|(name, _)| features::feature_of(name) == feature);
        let mut chosen: Vec<_> = chosen.map(|(name, bytes)| (*bytes, name.clone())).collect();
        chosen.sort_by(|a, b| b.cmp(a));
        chosen
    };
    let (code, data) = (of(code), of(data));
    let sum = |sizes: &[(u64, String)]| sizes.iter().map(|(bytes, _)| bytes).sum::<u64>();
    let largest: Vec<String> = code.iter().take(LISTED).map(|(bytes, name)| format!("{name} {bytes}")).collect();
    format!("| {feature} | {} | {} | {} |\n", sum(&code), sum(&data), largest.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_belongs_to_the_first_crate_in_its_name() {
        for (name, expected) in [
            ("lipz_bank::bank::Bank::open", "lipz_bank"),
            ("<core::option::Option<lipz_file::Document> as core::clone::Clone>::clone", "lipz_file"),
            ("core::slice::sort::stable::driftsort_main::<similar::Change, std::vec::Vec<u8>>", "similar"),
            ("core::slice::sort::unstable::ipnsort::<u64>", "core"),
            ("memcpy", "not Rust"),
        ] {
            assert_eq!(crate_of(name), expected, "{name}");
        }
    }
}
