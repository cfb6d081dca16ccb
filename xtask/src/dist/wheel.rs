//! The wheel for `pip install lipz`: the finished program, installed as a script, and the reader for Python.
//!
//! No tool writes it, because those that do would compile the program again for each format.

use super::archive::{Entry, sha256, zip};
use super::contents::{Contents, read};
use super::platform::Platform;
use crate::Failure;
use crate::paths::workspace_root;
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use std::fs;

pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The folder of the Python package in this repository.
const PACKAGE: &str = "packages/lipz-python";

/// The folders of its modules.
const MODULES: [&str; 2] = ["lipz", "lipz/reader"];

/// The licences of the program with the data in it, as in the manifest of lipz-speech.
pub(super) const LICENCE: &str = "(MIT OR Apache-2.0) AND BSD-2-Clause AND Unicode-3.0";

/// Returns the name of the wheel.
pub(super) fn name(platform: &Platform) -> String {
    format!("lipz-{VERSION}-py3-none-{}.whl", platform.wheel_tag)
}

/// Returns the wheel.
pub(super) fn wheel(platform: &Platform, contents: &Contents) -> Result<Vec<u8>, Failure> {
    let (data, info) = (format!("lipz-{VERSION}.data"), format!("lipz-{VERSION}.dist-info"));
    let mut entries = modules()?;
    entries.push(Entry::program(format!("{data}/scripts/{}", platform.program()), contents.program.clone()));
    let share = format!("{data}/data/share");
    entries.extend(contents.manual.iter().map(|page| page.below(&format!("{share}/man/man1"))));
    for completion in &contents.completions {
        if let Some(path) = shared_completion(&completion.path) {
            entries.push(Entry { path: format!("{share}/{path}"), content: completion.content.clone() });
        }
    }
    entries.extend(contents.licences.iter().map(|licence| licence.below(&format!("{info}/licenses"))));
    entries.push(Entry::file(format!("{info}/METADATA"), metadata(contents)));
    entries.push(Entry::file(format!("{info}/WHEEL"), description(platform)));
    let record = record(&entries, &info);
    entries.push(Entry::file(format!("{info}/RECORD"), record));
    zip(&entries).map_err(|error| format!("the wheel: {error}"))
}

/// Returns the files of the Python modules, in the order of their paths.
fn modules() -> Result<Vec<Entry>, Failure> {
    let mut entries = Vec::new();
    for module in MODULES {
        let folder = workspace_root().join(PACKAGE).join(module);
        let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
        let mut names = Vec::new();
        for entry in fs::read_dir(&folder).map_err(failed)? {
            names.push(entry.map_err(failed)?.file_name().to_string_lossy().into_owned());
        }
        names.sort();
        // Not the folders of the interpreter's cache.
        for name in names.iter().filter(|name| name.ends_with(".py") || name.as_str() == "py.typed") {
            entries.push(Entry::file(format!("{module}/{name}"), read(&folder.join(name))?));
        }
    }
    Ok(entries)
}

/// Returns the path below `share` at which a shell looks for completions. Elvish and PowerShell have none.
fn shared_completion(name: &str) -> Option<&'static str> {
    match name {
        "lipz.bash" => Some("bash-completion/completions/lipz"),
        "lipz.fish" => Some("fish/vendor_completions.d/lipz.fish"),
        "_lipz" => Some("zsh/site-functions/_lipz"),
        _ => None,
    }
}

fn metadata(contents: &Contents) -> String {
    let mut text = format!(
        "Metadata-Version: 2.4\nName: lipz\nVersion: {VERSION}\n\
         Summary: Compiles lip sync, subtitles and events of voice lines for games\n\
         Project-URL: Source, https://github.com/lipz/lipz\n\
         Keywords: lip-sync,dialogue,subtitles,viseme,localization\nLicense-Expression: {LICENCE}\n"
    );
    for licence in &contents.licences {
        text.push_str(&format!("License-File: {}\n", licence.path));
    }
    text.push_str("Requires-Python: >=3.8\nDescription-Content-Type: text/markdown\n\n");
    text + &contents.readme
}

fn description(platform: &Platform) -> String {
    let mut text = "Wheel-Version: 1.0\nGenerator: cargo xtask dist\nRoot-Is-Purelib: false\n".to_owned();
    for tag in platform.wheel_tag.split('.') {
        text.push_str(&format!("Tag: py3-none-{tag}\n"));
    }
    text
}

/// Returns the list of all entries with checksums and lengths, which includes itself without either.
fn record(entries: &[Entry], info: &str) -> String {
    use super::archive::Content::{File, Link, Program};
    let mut text = String::new();
    for Entry { path, content } in entries {
        let (File(bytes) | Program(bytes)) = content else {
            debug_assert!(!matches!(content, Link(_)), "wheels have no links");
            continue;
        };
        text.push_str(&format!("{path},sha256={},{}\n", URL_SAFE_NO_PAD.encode(sha256(bytes)), bytes.len()));
    }
    text + &format!("{info}/RECORD,,\n")
}
