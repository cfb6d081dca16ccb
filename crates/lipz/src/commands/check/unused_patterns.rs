//! Patterns in `lipz.toml` that do not match anything.

use crate::console;
use crate::shared::input_file;
use crate::shared::settings_file::Project;
use lipz_compiler::Input;
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, escape};
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
        place(&text, pattern, message).help(help)
    });
    let names: Vec<String> = inputs.iter().map(Input::name).collect();
    let of_lints = options.unused_patterns(&names).into_iter().map(|pattern| {
        let message = format!("{} in [lints] does not match any file", escape::quoted(pattern));
        let help = "correct the pattern, or remove it; it starts in the folder of lipz.toml";
        place(&text, pattern, message).help(help)
    });
    let found: Vec<Diagnostic> = of_dubs.chain(of_lints).collect();
    let mut report = Report::new(Source::new(console::path(file), &*text), found);
    options.apply_levels(&mut report);
    (!report.diagnostics.is_empty()).then_some(report)
}

/// Returns the diagnostic at the pattern in the settings; without a position if the pattern is written with escapes there.
fn place(settings: &str, pattern: &str, message: String) -> Diagnostic {
    let at = ['"', '\''].into_iter().find_map(|quote| settings.find(&format!("{quote}{pattern}{quote}")));
    match at {
        Some(at) => Diagnostic::at(Code::UnusedPattern, Span::new(at, at + pattern.len() + 2), message),
        None => Diagnostic::new(Code::UnusedPattern, message),
    }
}
