//! Patterns in `lipz.toml` that do not match anything.

use crate::console;
use crate::shared::input_file;
use crate::shared::settings_file::Project;
use lipz_compiler::Input;
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, escape};
use std::ops::Range;
use std::path::Path;

/// Reports the patterns of `[dubs]` and `[lints]` that do not match anything in the whole project. `inputs` are all of
/// its Lipz files.
pub(super) fn check(project: &Project, file: &Path, inputs: &[Input]) -> Option<Report> {
    let text = input_file::read(file).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default();
    let options = &project.settings.options;
    let voices = project.settings.voices();
    let is_dub = |key: &str| match (voices.of_key(key), voices.original.as_deref()) {
        (Some((locale, _)), Some(original)) => locale != original,
        _ => false,
    };
    let originals: Vec<&str> = inputs.iter().map(|input| input.key.as_str()).filter(|key| !is_dub(key)).collect();
    let of_dubs = project.settings.audio.sync_statuses.unused(&originals).into_iter().map(|pattern| {
        let message = format!("{} in [dubs] does not match the key of any original", escape::quoted(pattern));
        let help = "correct the pattern, or remove it; the keys of dubs do not count";
        place(&text, "dubs", pattern, message).help(help)
    });
    let names: Vec<String> = inputs.iter().map(Input::name).collect();
    let of_lints = options.unused_patterns(&names).into_iter().map(|pattern| {
        let message = format!("{} in [lints] does not match any file", escape::quoted(pattern));
        let help = "correct the pattern, or remove it; it starts in the folder of lipz.toml";
        place(&text, "lints", pattern, message).help(help)
    });
    let found: Vec<Diagnostic> = of_dubs.chain(of_lints).collect();
    let mut report = Report::new(Source::new(console::path(file), &*text), found);
    options.apply_levels(&mut report);
    (!report.diagnostics.is_empty()).then_some(report)
}

/// Returns the diagnostic at the pattern in a table of the settings; without a position if it is written with escapes.
fn place(settings: &str, table: &str, pattern: &str, message: String) -> Diagnostic {
    let mut is_in_table = false;
    let mut start = 0;
    for line in settings.split_inclusive('\n') {
        let written = line.trim_start();
        if written.starts_with('[') {
            is_in_table = written.trim_start_matches(['[', ' ']).starts_with(table);
        }
        let found = if is_in_table && !written.starts_with('#') { key_in(line, pattern) } else { None };
        if let Some(key) = found {
            return Diagnostic::at(Code::UnusedPattern, Span::new(start + key.start, start + key.end), message);
        }
        start += line.len();
    }
    Diagnostic::new(Code::UnusedPattern, message)
}

/// Returns the place of a key, with or without quotes, in a line of TOML.
fn key_in(line: &str, key: &str) -> Option<Range<usize>> {
    let quoted = ['"', '\''].into_iter().find_map(|quote| line.find(&format!("{quote}{key}{quote}")));
    let bare = || {
        let at = line.find(key)?;
        let is_alone = line.get(..at)?.trim().is_empty() && line.get(at + key.len()..)?.trim_start().starts_with('=');
        is_alone.then_some(at..at + key.len())
    };
    quoted.map(|at| at..at + key.len() + 2).or_else(bare)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_found_in_their_table() {
        let settings =
            "# \"a/*\" was moved\n[lints]\n# \"a/*\"\n\"a/*\" = {}\n[dubs]\n'a/*' = 3\notta = 4\n[lints.\"b\"]\n";
        for (table, pattern, at) in [
            ("lints", "a/*", Some(34)),
            ("dubs", "a/*", Some(52)),
            ("dubs", "otta", Some(62)),
            ("lints", "b", Some(78)),
            ("dubs", "b", None),
        ] {
            let found = place(settings, table, pattern, String::new());
            assert_eq!(found.primary.map(|label| label.span.start), at, "{table} {pattern}");
        }
    }
}
