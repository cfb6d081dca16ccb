//! Patterns in `lipz.toml` that do not match anything.

use crate::console;
use crate::shared::input_file;
use crate::shared::settings_file::Project;
use lipz_compiler::Input;
use lipz_diagnostics::{Code, Diagnostic, Report, Source, escape};
use lipz_file::without_byte_order_mark;
use std::path::Path;

/// Reports the patterns of `[dubs]` and `[lints]` that do not match anything in the whole project. `inputs` are all of
/// its Lipz files.
pub(super) fn check(project: &Project, file: &Path, inputs: &[Input]) -> Option<Report> {
    let bytes = input_file::read(file).unwrap_or_default();
    let text = String::from_utf8_lossy(without_byte_order_mark(&bytes)).into_owned();
    let options = &project.settings.options;
    let voices = project.settings.voices();
    let is_dub = |key: &str| match (voices.of_key(key), voices.original.as_deref()) {
        (Some((locale, _)), Some(original)) => locale != original,
        _ => false,
    };
    let originals: Vec<&str> = inputs.iter().map(|input| input.key.as_str()).filter(|key| !is_dub(key)).collect();
    let of_dubs = project.settings.audio.sync_statuses.unused(&originals).into_iter().map(|(pattern, span)| {
        let message = format!("{} in [dubs] does not match the key of any original", escape::quoted(pattern));
        let help = "correct the pattern, or remove it; the keys of dubs do not count";
        Diagnostic::at(Code::UnusedPattern, span, message).help(help)
    });
    let names: Vec<String> = inputs.iter().map(Input::name).collect();
    let of_lints = options.unused_patterns(&names).into_iter().map(|(pattern, span)| {
        let message = format!("{} in [lints] does not match any file", escape::quoted(pattern));
        let help = "correct the pattern, or remove it; it starts in the folder of lipz.toml";
        Diagnostic::at(Code::UnusedPattern, span, message).help(help)
    });
    let found: Vec<Diagnostic> = of_dubs.chain(of_lints).collect();
    let mut report = Report::new(Source::new(console::path(file), &*text), found);
    options.apply_levels(&mut report);
    (!report.diagnostics.is_empty()).then_some(report)
}
