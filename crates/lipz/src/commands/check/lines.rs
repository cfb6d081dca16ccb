//! `--lines`: the lines of a game's script that have no clip, and the clips that have no line.

use crate::console;
use crate::reporter::{Abort, Reporter};
use crate::shared::input_file;
use crate::shared::settings_file::Project;
use lipz_compiler::{Compiler, Input, Options};
use lipz_diagnostics::{Code, Diagnostic, Report, bound, escape};
use lipz_file::locale::{TextName, text_name};
use lipz_file::text::display;
use lipz_file::{Document, JsonString, Value};
use lipz_interop::{Script, ScriptLine};
use std::collections::HashSet;
use std::path::Path;

/// The comparison of a clip with the script.
struct ComparedClip {
    /// The ID of its line.
    id: Option<String>,
    report: Option<Report>,
}

/// Compares the clips with the lines of the script in a file. Dubs have no lines of their own.
pub(super) fn check(
    path: &Path,
    project: &Project,
    inputs: &[Input],
    reporter: &mut Reporter,
) -> Result<Vec<Report>, Abort> {
    let bytes = input_file::read(path).map_err(|error| reporter.fail(input_file::unreadable(path, &error)))?;
    let name = console::path(path);
    let (script, source, found) = Script::read(&name, &bytes, None);
    let unreadable = Report::new(source.clone(), found);
    if unreadable.has_errors() {
        return Err(reporter.refuse(vec![unreadable]));
    }
    let options = &project.settings.options;
    let voices = project.settings.voices();
    let keys: HashSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
    let is_original = |input: &&Input| voices.original_of(&input.key, |key| keys.contains(key)).is_none();
    let originals: Vec<Input> = inputs.iter().filter(is_original).cloned().collect();
    let compared = Compiler::new(options.clone()).each_file(&originals, |input, bytes| {
        let line = script.line_of(&input.key);
        let parsed = lipz_file::parse(bytes);
        let document = parsed.document.unwrap_or_default();
        let found = match line {
            None => Some(without_line(&name)),
            Some(line) => differing(&name, line, &document, options),
        };
        let report = found.map(|found| Report::from_bytes(input.name(), bytes, vec![found]));
        ComparedClip { id: line.map(|line| line.path.to_owned()), report }
    });
    // `lipz check` reports files that cannot be read.
    let compared: Vec<ComparedClip> = compared.into_iter().filter_map(Result::ok).collect();
    let used: HashSet<&str> = compared.iter().filter_map(|clip| clip.id.as_deref()).collect();
    let mut found = unreadable.diagnostics;
    for line in script.lines().iter().filter(|line| !used.contains(line.path)) {
        let message = format!("no clip has the key of the line {}", escape::quoted(line.path));
        let diagnostic = Diagnostic::at(Code::LineWithoutClip, line.span, message);
        found.push(diagnostic.help("add a Lipz file for it, or correct the ID"));
        bound::limit_many(&mut found);
    }
    bound::limit(&mut found);
    let mut reports: Vec<Report> = compared.into_iter().filter_map(|clip| clip.report).collect();
    reports.push(Report::new(source, found));
    reports.iter_mut().for_each(|report| options.apply_levels(report));
    reports.retain(|report| !report.diagnostics.is_empty());
    Ok(reports)
}

fn without_line(script: &str) -> Diagnostic {
    let message = format!("no line of {script} has the key of the clip");
    let help = "remove the Lipz file if the line was cut, or rename it like the ID of its line";
    Diagnostic::new(Code::ClipWithoutLine, message).help(help)
}

/// Returns the diagnostic for a text that differs from that of its line.
fn differing(script: &str, line: ScriptLine<'_>, document: &Document<'_>, options: &Options) -> Option<Diagnostic> {
    let text = source_text(document, options)?;
    let own: Vec<String> = text.text.split('|').map(|segment| display(segment).text.into_owned()).collect();
    let is_same = spoken(&own.join(" ")) == spoken(&display(line.text).text);
    if is_same || line.text.trim().is_empty() {
        return None;
    }
    let message = format!("the text differs from the line in {script}");
    let note = format!("the line is {}", escape::quoted(line.text.trim()));
    let found = Diagnostic::at(Code::LineDiffers, text.span(), message).note(note);
    Some(found.help("change the text in the Lipz file or in the script"))
}

/// Returns the text of a clip in the default locale.
fn source_text<'d>(document: &'d Document<'_>, options: &Options) -> Option<&'d JsonString<'d>> {
    let locale = options.get_default_locale()?;
    let is_source = |name: &str| match text_name(name) {
        Some(TextName::NoLocale) => true,
        Some(text) => text.tag().is_some_and(|tag| tag == locale),
        None => false,
    };
    document.elements.iter().find_map(|element| match &element.value {
        Value::String(string) if is_source(&element.name.text) => Some(string),
        _ => None,
    })
}

/// Returns the words of a text without the spaces between them.
fn spoken(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
