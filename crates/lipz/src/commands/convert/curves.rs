//! `lipz convert --write-curves`: writes the curves that lipz generates from texts and events into the Lipz files.

use super::{Convert, generated_curve};
use crate::CommandResult;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::inputs::with_inputs;
use crate::shared::rewrite_mode::{RewriteMode, files, reads_standard_input};
use crate::shared::settings_file::Project;
use crate::{Outcome, console};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Bank, Clip};
use lipz_compiler::{Compiler, Content, GestureKeys, Input};
use lipz_diagnostics::escape;
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::{Document, Element, RawJson, Value, curve};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// The keys of a curve.
pub(super) type Keys = Vec<(u32, CurveValue)>;

/// A run that writes curves.
struct CurveConversion<'a> {
    /// The names of curves to write; all curves if empty.
    names: &'a [String],
    rewriting: RewriteMode,
    is_quiet: bool,
}

/// Writes the curves with these names into the files, or all.
pub(super) fn run(arguments: &Convert, names: &[String], project: Project, reporter: &mut Reporter) -> CommandResult {
    let is_standard = reads_standard_input(&project.settings.sources, reporter)?;
    let rewriting = match is_standard {
        true => arguments.rewriting_standard_input(reporter)?,
        false => arguments.rewriting(reporter)?,
    };
    let curves = CurveConversion { names, rewriting, is_quiet: arguments.sources.is_quiet() };
    curves.run(project, is_standard, arguments.prints_result(), reporter)
}

impl CurveConversion<'_> {
    fn run(&self, project: Project, is_standard: bool, prints_result: bool, reporter: &mut Reporter) -> CommandResult {
        let Project { mut settings, .. } = project;
        settings.options = std::mem::take(&mut settings.options).strip(true);
        #[expect(clippy::redundant_closure_for_method_calls, reason = "the method has only one lifetime")]
        let mut worked = with_inputs(&settings, None, self.is_quiet, |compiler, inputs| compiler.compile(inputs));
        let outcome = worked.outcome();
        let mut reports = std::mem::take(&mut worked.reports);
        let bytes = match worked.compiled.bank.take() {
            Some(bytes) if outcome == Outcome::Clean => bytes,
            _ => return Err(reporter.abort(reports, outcome)),
        };
        let bank = match Bank::open(&bytes) {
            Ok(bank) => bank,
            // The compiler has verified this bank.
            Err(error) => return Err(reporter.usage(format!("the packed bank is invalid: {error}"), "report this bug")),
        };
        self.refuse_unmade(&bank, &worked.inputs, reporter)?;
        let files_to_write = Files::new();
        let compiler = Compiler::new(settings.options.clone());
        let results = compiler.each_file(&worked.inputs, |input, bytes| {
            let style = settings.options.get_default_locale();
            let Some(made) = self.with_curves(input, bytes, &bank, style) else { return Ok(None) };
            let shown = self.rewriting.rewrite(&files_to_write, input, bytes, &made.after);
            shown.map(|shown| Some((shown, made.names)))
        });
        let unwritten = files_to_write.finish();
        let (mut counts, mut shown) = (CurveCounts::default(), String::new());
        for (input, result) in std::iter::zip(worked.inputs.iter(), results) {
            match result.and_then(|result| result) {
                Ok(None) => {
                    counts.unchanged += 1;
                    if let (Content::Bytes { bytes, .. }, RewriteMode::InPlace) = (&input.content, self.rewriting) {
                        shown.push_str(&String::from_utf8_lossy(bytes));
                    }
                }
                Ok(Some((difference, names))) => {
                    counts.add(names);
                    shown.push_str(&difference);
                }
                Err(report) => reports.push(report),
            }
        }
        counts.changed -= unwritten.len();
        reports.extend(unwritten);
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        let keys = settings.options.get_gestures().keys;
        match self.rewriting {
            _ if self.is_quiet || worked.inputs.is_empty() => {}
            RewriteMode::InPlace if is_standard => {}
            RewriteMode::InPlace => shown.push_str(&counts.summary("with new curves", keys)),
            RewriteMode::Nothing | RewriteMode::Diff => reporter.remark(&counts.summary("would get curves", keys)),
        }
        if prints_result {
            reporter.print(&shown)?;
        } else {
            reporter.summary(&shown)?;
        }
        let would_change = self.rewriting != RewriteMode::InPlace && counts.changed > 0;
        Ok(outcome.max(if would_change { Outcome::Errors } else { Outcome::Clean }))
    }
}

/// A file with its new curves.
struct ConvertedCurves {
    after: String,
    names: Vec<String>,
}

impl CurveConversion<'_> {
    /// Refuses names that match no curve of any clip.
    fn refuse_unmade(&self, bank: &Bank<'_>, inputs: &[Input], reporter: &mut Reporter) -> Result<(), crate::Abort> {
        if self.names.is_empty() {
            return Ok(());
        }
        let clips = || inputs.iter().filter_map(|input| bank.clip_by_key(&input.key));
        let mut made: BTreeSet<String> = clips()
            .flat_map(|clip| clip.curves().map(|curve| curve.name().as_str().to_owned()).collect::<Vec<_>>())
            .collect();
        made.extend(clips().flat_map(|clip| generated_curve::names(&clip)));
        let Some(unmade) = self.names.iter().find(|name| !made.contains(*name)) else { return Ok(()) };
        let tip = match made.is_empty() {
            true => "pass `--config face.keys=words` to generate gestures from texts".to_owned(),
            false => format!("choose one of these curves: {}", made.into_iter().collect::<Vec<_>>().join(", ")),
        };
        Err(reporter.usage(format!("these files do not produce a curve {}", escape::quoted(unmade)), &tip))
    }

    /// Returns the file with the curves that it lacks, or `None` if it lacks none.
    fn with_curves(
        &self,
        input: &Input,
        bytes: &[u8],
        bank: &Bank<'_>,
        default_locale: Option<&str>,
    ) -> Option<ConvertedCurves> {
        let before = lipz_file::parse(bytes).document?;
        let clip = bank.clip_by_key(&input.key)?;
        let own = match before.get(curve::ELEMENT).map(|element| &element.value) {
            Some(Value::Other(value)) => value.members(&mut Vec::new())?,
            _ => Vec::new(),
        };
        let own: HashSet<&str> = own.iter().map(|member| member.name.text.as_ref()).collect();
        let is_new = |name: &str| {
            let is_wanted = self.names.is_empty() || self.names.iter().any(|wanted| wanted == name);
            is_wanted && !own.contains(name)
        };
        let made = self.made(&clip, &bank.default_face_profile(), &is_new);
        if made.is_empty() {
            return None;
        }
        let text = String::from_utf8_lossy(bytes);
        let style = Style { default_locale, line_ending: LineEnding::detect(&text) };
        let after = with_curves(&before, &made, &text, style.line_ending)?;
        let names = made.into_iter().map(|(name, _)| name).collect();
        Some(ConvertedCurves { after: rewrite(&text, &before, &after, style), names })
    }

    /// Returns the new curves of a clip: curves from the bank, and the requested ones of those that the reader
    /// generates.
    fn made(&self, clip: &Clip<'_>, profile: &FaceProfile<'_>, is_new: &impl Fn(&str) -> bool) -> Vec<(String, Keys)> {
        let in_bank = clip.curves().filter(|curve| is_new(curve.name().as_str())).map(|curve| {
            let keys = curve.keys().map(|key| (key.frame, key.value)).collect();
            (curve.name().as_str().to_owned(), keys)
        });
        let mut made: Vec<(String, Keys)> = in_bank.collect();
        for name in self.names.iter().filter(|name| is_new(name)).collect::<BTreeSet<_>>() {
            made.extend(generated_curve::keys(name, clip, profile).map(|keys| (name.clone(), keys)));
        }
        made
    }
}

/// Returns the document with the new curves after its own, which keep their spelling, in the layout of its file.
fn with_curves<'s>(
    before: &Document<'s>,
    made: &[(String, Keys)],
    text: &str,
    line_ending: LineEnding,
) -> Option<Document<'s>> {
    let curves = made.iter().map(|(name, keys)| (name.as_str(), keys.clone()));
    let mut after = before.clone();
    match after.elements.iter_mut().find(|element| element.name.text == curve::ELEMENT) {
        Some(Element { value: Value::Other(value), .. }) => value.text = Cow::Owned(curve::add(value, curves)?),
        Some(_) => return None,
        None => {
            let written = curve::write(curves);
            let lines = written.split('\n');
            let written = match line_ending {
                _ if !text.trim_end().contains('\n') => lines.map(str::trim).collect::<Vec<_>>().join(" "),
                LineEnding::Lf => written,
                LineEnding::CrLf => lines.collect::<Vec<_>>().join("\r\n"),
            };
            let value = Value::Other(RawJson::new(written));
            after.elements.push(Element { name: Cow::Borrowed(curve::ELEMENT).into(), value });
        }
    }
    Some(after)
}

/// The numbers of written curves.
#[derive(Default)]
struct CurveCounts {
    changed: usize,
    unchanged: usize,
    /// The number of files to which each curve was added, by its name.
    curves: BTreeMap<String, usize>,
}

impl CurveCounts {
    fn add(&mut self, names: Vec<String>) {
        self.changed += 1;
        names.into_iter().for_each(|name| *self.curves.entry(name).or_default() += 1);
    }

    fn summary(&self, what: &str, keys: GestureKeys) -> String {
        let mut text = format!("{} {what}, {} unchanged\n", files(self.changed), console::grouped(self.unchanged));
        for (name, count) in &self.curves {
            text += &format!("  {} in {}\n", escape::text(name), files(*count));
        }
        if self.changed == 0 && keys != GestureKeys::Words {
            text += "hint: `--config face.keys=words` also generates gestures from texts\n";
        }
        text
    }
}
