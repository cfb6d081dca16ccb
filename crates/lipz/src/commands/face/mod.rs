//! `lipz face`: the curves that lipz makes of texts and events, written into the Lipz files.

mod generated;

use crate::Ended;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::inputs::with_inputs;
use crate::shared::rewriting::{Rewriting, files, is_standard_input, reads_standard_input};
use crate::shared::settings_file::{Project, SettingsFile};
use crate::{Outcome, console};
use clap::{Args, ValueEnum};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Bank, Clip};
use lipz_compiler::{Compiler, Content, GestureKeys, Input};
use lipz_diagnostics::escape;
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::{Document, Element, Raw, Value, curve};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::PathBuf;

/// Write the curves that lipz makes of texts and events into the Lipz files, to be edited there.
///
/// A bank has them anyway: emotions, and with `keys` in `[face]` what heads, brows and breath do (docs/guides/faces.md). What a
/// file has wins, so a curve that is in it already is never changed, and one that is written no longer follows the
/// texts. To have it made again, remove it from the file.
///
/// Blinks and the motion of head and eyes are in no bank: the reader makes them. `--curve blink` (headPitch, headYaw, headRoll,
/// eyePitch, eyeYaw) writes what it makes for a clip, so that one blink can be changed and the others stay; `--curve mara.blink`
/// (mara.eyePitch, mara.eyeYaw) does so for somebody else, where events name them.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz face voices/act1/mayor.lipz --keys words
  lipz face voices --curve nod --curve shake
  lipz face voices/act1/mayor.lipz --curve blink
  lipz face voices --diff")]
pub(crate) struct Face {
    /// Folders, files or glob patterns; `-` reads standard input and writes to standard output [default: those of
    /// lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    #[command(flatten)]
    file: SettingsFile,

    /// What makes curves of gestures: events only, or also what is said and heard [default: `keys` of `[face]`]
    #[arg(long, value_name = "WHAT")]
    keys: Option<GesturesOf>,

    /// Write only the curve with this name, also one that the reader generates; can be given several times
    #[arg(long = "curve", value_name = "NAME")]
    curves: Vec<String>,

    /// List the files that would change, and write nothing; exit code 1 if there are any
    #[arg(long)]
    check: bool,

    /// Show what would change as a unified diff, and write nothing; exit code 1 if anything would
    #[arg(long)]
    diff: bool,

    /// Show no progress and no summary, only diagnostics, files and differences
    #[arg(short, long)]
    quiet: bool,
}

/// The keys of a curve.
type Keys = Vec<(u32, CurveValue)>;

/// What makes curves of gestures.
#[derive(ValueEnum, Clone, Copy, Debug)]
enum GesturesOf {
    /// `nods 4` and the like in events
    Events,
    /// Events, and what is said and heard
    Words,
}

impl From<GesturesOf> for GestureKeys {
    fn from(what: GesturesOf) -> GestureKeys {
        match what {
            GesturesOf::Events => GestureKeys::Events,
            GesturesOf::Words => GestureKeys::Words,
        }
    }
}

impl Run for Face {
    fn prints_result(&self) -> bool {
        self.rewriting() != Rewriting::InPlace || is_standard_input(&self.sources)
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let Project { mut settings, .. } = self.file.project(&self.sources, reporter)?;
        let is_standard = reads_standard_input(&settings.sources, reporter)?;
        let mut gestures = settings.options.get_gestures();
        gestures.keys = self.keys.map_or(gestures.keys, GestureKeys::from);
        settings.options = std::mem::take(&mut settings.options).strip(true).gestures(gestures);
        #[expect(clippy::redundant_closure_for_method_calls, reason = "the method alone is one for a single lifetime")]
        let mut worked = with_inputs(&settings, None, self.quiet, |compiler, inputs| compiler.compile(inputs));
        let outcome = worked.outcome();
        let mut reports = std::mem::take(&mut worked.reports);
        let bytes = match worked.compiled.bank.take() {
            Some(bytes) if outcome == Outcome::Clean => bytes,
            _ => return Err(reporter.abort(reports, outcome)),
        };
        let bank = match Bank::open(&bytes) {
            Ok(bank) => bank,
            // The compiler verified it.
            Err(error) => return Err(reporter.usage(format!("the bank in memory: {error}"), "report it as a fault")),
        };
        self.refuse_unmade(&bank, &worked.inputs, reporter)?;
        let files_to_write = Files::new();
        let compiler = Compiler::new(settings.options.clone());
        let results = compiler.each_file(&worked.inputs, |input, bytes| {
            let style = settings.options.get_default_locale();
            let Some(made) = self.with_curves(input, bytes, &bank, style) else { return Ok(None) };
            let shown = match (&input.content, self.rewriting()) {
                (Content::Bytes { .. }, Rewriting::InPlace) => Ok(made.after.clone()),
                (_, rewriting) => rewriting.rewrite(&files_to_write, input, bytes, &made.after),
            };
            shown.map(|shown| Some((shown, made.names)))
        });
        let unwritten = files_to_write.finish();
        let (mut counts, mut shown) = (Counts::default(), String::new());
        for (input, result) in std::iter::zip(worked.inputs.iter(), results) {
            match result.and_then(|result| result) {
                Ok(None) => {
                    counts.unchanged += 1;
                    if let (Content::Bytes { bytes, .. }, Rewriting::InPlace) = (&input.content, self.rewriting()) {
                        shown.push_str(&String::from_utf8_lossy(bytes));
                    }
                }
                Ok(Some((difference, names))) => {
                    counts.add(names);
                    if self.check {
                        shown.push_str(&escape::text(&input.name()));
                        shown.push('\n');
                    }
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
        match self.rewriting() {
            _ if self.quiet || worked.inputs.is_empty() => {}
            Rewriting::InPlace if is_standard => {}
            Rewriting::InPlace => shown.push_str(&counts.summary("with new curves", keys)),
            Rewriting::Nothing | Rewriting::Diff => reporter.remark(&counts.summary("to get curves", keys)),
        }
        if self.prints_result() {
            reporter.print(&shown)?;
        } else {
            reporter.summary(&shown)?;
        }
        let would_change = self.rewriting() != Rewriting::InPlace && counts.changed > 0;
        Ok(outcome.max(if would_change { Outcome::Errors } else { Outcome::Clean }))
    }
}

/// A file with its new curves.
struct Made {
    after: String,
    names: Vec<String>,
}

impl Face {
    fn rewriting(&self) -> Rewriting {
        match (self.diff, self.check) {
            (true, _) => Rewriting::Diff,
            (false, true) => Rewriting::Nothing,
            (false, false) => Rewriting::InPlace,
        }
    }

    /// Refuses names of curves that no clip has.
    fn refuse_unmade(&self, bank: &Bank<'_>, inputs: &[Input], reporter: &mut Reporter) -> Result<(), crate::Abort> {
        if self.curves.is_empty() {
            return Ok(());
        }
        let clips = || inputs.iter().filter_map(|input| bank.clip_by_key(&input.key));
        let mut made: BTreeSet<String> = clips()
            .flat_map(|clip| clip.curves().map(|curve| curve.name().as_str().to_owned()).collect::<Vec<_>>())
            .collect();
        made.extend(clips().flat_map(|clip| generated::names(&clip)));
        let Some(unmade) = self.curves.iter().find(|name| !made.contains(*name)) else { return Ok(()) };
        let tip = match made.is_empty() {
            true => {
                "these files say nothing that becomes a curve: `--keys words` looks at what is said, too".to_owned()
            }
            false => format!("these are: {}", made.into_iter().collect::<Vec<_>>().join(", ")),
        };
        Err(reporter.usage(format!("no curve {} is made of these files", escape::quoted(unmade)), &tip))
    }

    /// The file with the curves of its clip that it lacks; `None` if it lacks none.
    fn with_curves(&self, input: &Input, bytes: &[u8], bank: &Bank<'_>, default_locale: Option<&str>) -> Option<Made> {
        let before = lipz_file::parse(bytes).document?;
        let clip = bank.clip_by_key(&input.key)?;
        let own = match before.get(curve::ELEMENT).map(|element| &element.value) {
            Some(Value::Other(value)) => value.members(&mut Vec::new())?,
            _ => Vec::new(),
        };
        let own: HashSet<&str> = own.iter().map(|member| member.name.text.as_ref()).collect();
        let is_new = |name: &str| {
            let is_wanted = self.curves.is_empty() || self.curves.iter().any(|wanted| wanted == name);
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
        Some(Made { after: rewrite(&text, &before, &after, style), names })
    }

    /// The new curves of a clip: those that it has in the bank, and, of those that the reader generates, what is asked for.
    fn made(&self, clip: &Clip<'_>, profile: &FaceProfile<'_>, is_new: &impl Fn(&str) -> bool) -> Vec<(String, Keys)> {
        let in_bank = clip.curves().filter(|curve| is_new(curve.name().as_str())).map(|curve| {
            let keys = curve.keys().map(|key| (key.frame, key.value)).collect();
            (curve.name().as_str().to_owned(), keys)
        });
        let mut made: Vec<(String, Keys)> = in_bank.collect();
        for name in self.curves.iter().filter(|name| is_new(name)).collect::<BTreeSet<_>>() {
            made.extend(generated::keys(name, clip, profile).map(|keys| (name.clone(), keys)));
        }
        made
    }
}

/// The document with more curves, laid out as its file is: behind its own, which keep their spelling.
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
            let value = Value::Other(Raw::new(written));
            after.elements.push(Element { name: Cow::Borrowed(curve::ELEMENT).into(), value });
        }
    }
    Some(after)
}

/// What was written.
#[derive(Default)]
struct Counts {
    changed: usize,
    unchanged: usize,
    /// Files by the name of a curve that they got.
    curves: BTreeMap<String, usize>,
}

impl Counts {
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
            text += "curves of what is said are made with `--keys words`\n";
        }
        text
    }
}
