//! `--lines`: the lines of a game's script that have no clip, and the clips that have no line.

mod texts;

use crate::console;
use crate::reporter::{Abort, Reporter};
use crate::shared::input_file;
use crate::shared::inputs::RunResult;
use crate::shared::settings_file::Project;
use crate::shared::voices::originals;
use lipz_compiler::{Compiler, Input};
use lipz_diagnostics::{Code, Diagnostic, Report, bound, escape};
use lipz_interop::{Script, ScriptLine};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use texts::SourceText;

/// The most clips that a diagnostic names.
const SHOWN_CLIPS: usize = 3;

/// The hint for texts that cannot be compared.
pub(super) const AMBIGUOUS: &str = "hint: lipz did not compare the texts of clips in several languages with the script. Set \
                                    `default-locale` in lipz.toml\n";

/// The clips that fit a line.
struct FittingClips<'a> {
    line: ScriptLine<'a>,
    keys: Vec<&'a str>,
}

/// Compares the clips with the lines of the script in a file. Dubs have no lines of their own. Returns whether texts were
/// not compared because the source locale is unknown.
pub(super) fn check(
    path: &Path,
    project: &Project,
    run: &mut RunResult<'_>,
    reporter: &mut Reporter,
) -> Result<bool, Abort> {
    let bytes = input_file::read(path).map_err(|error| reporter.fail(input_file::unreadable(path, &error)))?;
    let name = console::path(path);
    let inputs = &*run.inputs;
    let source_locale = super::translations::source_locale(project, inputs);
    let (script, source, found) = match texts_beside(path, reporter)? {
        Some(texts) => Script::read_lines_with_texts(&name, &bytes, &texts, source_locale.as_deref()),
        None => Script::read_lines(&name, &bytes, source_locale.as_deref()),
    };
    let unreadable = Report::new(source.clone(), found);
    if unreadable.has_errors() {
        return Err(reporter.refuse(vec![unreadable]));
    }
    let options = &project.settings.options;
    let originals: Vec<Input> = originals(inputs, &project.settings.voices()).into_iter().cloned().collect();
    let fitting = fitting_clips(&script, &originals);
    let is_ambiguous = AtomicBool::new(false);
    // `lipz check` reports files that cannot be read.
    let compared = Compiler::new(options.clone()).each_file(&originals, |input, bytes| {
        let line = script.line_of(&input.key);
        let found = match line.and_then(|line| fitting.get(line.path)) {
            Some(fitting) if fitting.keys.len() > 1 => None,
            Some(fitting) if fitting.keys.contains(&input.key.as_str()) => {
                let document = lipz_file::parse(bytes).document.unwrap_or_default();
                match SourceText::of(&document, source_locale.as_deref()) {
                    SourceText::Found(text) => texts::difference(&name, fitting.line, text),
                    SourceText::Missing => None,
                    SourceText::Ambiguous => {
                        is_ambiguous.store(true, Ordering::Relaxed);
                        None
                    }
                }
            }
            _ => Some(without_line(&name)),
        };
        found.map(|found| Report::from_bytes(input.name(), bytes, vec![found]))
    });
    let mut found = unreadable.diagnostics;
    for line in script.lines() {
        found.extend(not_one_clip(line, fitting.get(line.path)));
        bound::limit_many(&mut found);
    }
    bound::limit(&mut found);
    let mut reports: Vec<Report> = compared.into_iter().filter_map(Result::ok).flatten().collect();
    reports.push(Report::new(source, found));
    reports.iter_mut().for_each(|report| options.apply_levels(report));
    reports.retain(|report| !report.diagnostics.is_empty());
    run.reports.extend(reports);
    lipz_diagnostics::reports::sort(&mut run.reports);
    Ok(is_ambiguous.into_inner())
}

/// Reads the texts of the lines, if the script has them in a second file, and if that exists.
fn texts_beside(path: &Path, reporter: &mut Reporter) -> Result<Option<Vec<u8>>, Abort> {
    let Some(texts) = Script::texts_beside(path) else { return Ok(None) };
    match input_file::read(&texts) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(reporter.fail(input_file::unreadable(&texts, &error))),
    }
}

/// Returns the clips of each line, by the path of the line. A clip with exactly this key is the only one.
fn fitting_clips<'a>(script: &'a Script, clips: &'a [Input]) -> BTreeMap<&'a str, FittingClips<'a>> {
    let mut fitting = BTreeMap::<&str, FittingClips<'a>>::new();
    for clip in clips {
        let Some(line) = script.line_of(&clip.key) else { continue };
        fitting.entry(line.path).or_insert_with(|| FittingClips { line, keys: Vec::new() }).keys.push(&clip.key);
    }
    for FittingClips { line, keys } in fitting.values_mut() {
        if keys.iter().any(|key| line.has_path(key)) {
            keys.retain(|key| line.has_path(key));
        }
    }
    fitting
}

/// Returns the diagnostic for a line that has no clip or several.
fn not_one_clip(line: ScriptLine<'_>, fitting: Option<&FittingClips<'_>>) -> Option<Diagnostic> {
    let id = escape::quoted(line.path);
    let Some(FittingClips { keys, .. }) = fitting else {
        let message = format!("no clip has the key of the line {id}");
        let found = Diagnostic::at(Code::LineWithoutClip, line.span, message);
        return Some(found.help("add a Lipz file for it, or correct the ID"));
    };
    if keys.len() < 2 {
        return None;
    }
    let shown: Vec<String> = keys.iter().take(SHOWN_CLIPS).map(|key| escape::quoted(key).to_string()).collect();
    let rest = match keys.len() - shown.len() {
        0 => String::new(),
        rest => format!(" and {rest} more"),
    };
    let found = Diagnostic::at(Code::LineWithoutClip, line.span, format!("the line {id} fits several clips"));
    let found = found.note(format!("its clips: {}{rest}", shown.join(", ")));
    Some(found.help("write the whole key of its clip as the ID"))
}

fn without_line(script: &str) -> Diagnostic {
    let message = format!("no line of {script} has the key of the clip");
    let help = "remove the Lipz file if the line was cut, or rename it like the ID of its line";
    Diagnostic::new(Code::ClipWithoutLine, message).help(help)
}
