//! `lipz inspect`: shows the contents of a bank, or of the bank that Lipz files would make.

mod recorded;
mod set;
mod stats;

use crate::Abort;
use crate::CommandResult;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::DialogueArguments;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::locales::choose;
use crate::shared::set_file::SetFile;
use crate::shared::settings_file::Project;
use crate::{Outcome, console};
use clap::{Args, ValueEnum};
use lipz_bank::{ClipId, Dialogue, Locale};
use lipz_compiler::inspect::{BankSummary, ClipDetails, ClipSummary, LayerSummary, Timeline};
use lipz_compiler::{MinCoverage, face};
use lipz_diagnostics::{Code, Report, escape, suggest};
use lipz_sync::RecordedClip;
use std::fmt::Write;
use std::iter::zip;
use unicode_width::UnicodeWidthStr;

/// Show a bank or Lipz files: a summary, one clip as a timeline, or statistics.
///
/// Lipz files are packed in memory. A single file is shown as a timeline, with the texts of the default locale, or of the
/// first --locale. If a project has recordings, --show=stats also counts missing, unused and unclear ones.
#[derive(Args, Debug)]
#[command(override_usage = "lipz inspect [BANK] [KEY] [OPTIONS]")]
#[command(after_help = "Examples:
  lipz inspect voices/act1/mara-hello.lipz
  lipz inspect voices act1/mara-hello --locale de-de
  lipz inspect dialogue.lipzbank
  lipz inspect dialogue.lipzbank act1/ --show clips
  lipz inspect voices --show stats
  lipz inspect dialogue.lipzset
  lipz inspect dialogue.lipzbank act1/mara-hello --locale de-de
  lipz inspect dialogue.lipzbank act1/mara-hello --output-format json
  lipz inspect dialogue.lipzbank+dialogue.de-de.lipztexts act1/mara-hello")]
pub(crate) struct Inspect {
    #[command(flatten)]
    dialogue: DialogueArguments,

    /// Clip to show; with --show=clips, the start of keys
    #[arg(value_name = "KEY")]
    pub(crate) key: Option<String>,

    /// Show the list of clips, or statistics
    #[arg(long, value_enum, value_name = "WHAT")]
    show: Option<InspectView>,

    /// Only texts in this locale; may be given several times
    #[arg(long, value_name = "LOCALE", conflicts_with = "show")]
    pub(crate) locale: Vec<String>,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum InspectView {
    /// A line for each clip
    Clips,
    /// Clips, seconds, words, visemes, and bytes for each section
    Stats,
}

impl Run for Inspect {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if self.show == Some(InspectView::Stats) {
            return stats::run(&self.dialogue, self.key.as_deref(), reporter);
        }
        let prefix = self.show.map(|_| self.key.as_deref().unwrap_or_default());
        let (named, project) = match self.set(reporter)? {
            None => self.files(reporter)?,
            Some(set) => match (self.key.as_ref().filter(|_| prefix.is_none()), prefix) {
                // A single bank is sufficient.
                (Some(key), _) => {
                    let number = set.index(reporter)?.bank_of(ClipId::from_key(key));
                    let file = set.bank(number, reporter)?;
                    (DialogueFiles::one(file).named(set.name()), None)
                }
                (None, Some(_)) => self.files(reporter)?,
                (None, None) if !self.locale.is_empty() => return Err(Inspect::no_clip(reporter)),
                (None, None) => return set::inspect(&set, reporter),
            },
        };
        let files = named.verified(reporter)?;
        let dialogue = named.dialogue(&files, reporter)?;
        let json = reporter.wants_json();
        let is_one = self.dialogue.names_file() && dialogue.clip_count() == 1;
        let only = dialogue.clips().next().filter(|_| is_one).map(|clip| clip.key());
        match (self.key.as_deref().or(only), prefix) {
            (_, Some(prefix)) => list(&dialogue, prefix, json, reporter)?,
            (None, None) if !self.locale.is_empty() => return Err(Inspect::no_clip(reporter)),
            (Some(key), None) => {
                let recorded = project.map(|project| recorded::find(&project, key, reporter)).transpose()?.flatten();
                clip(&dialogue, key, (&named.name, recorded), self, reporter)?;
            }
            (None, None) => summary(&BankSummary::from_dialogue(&dialogue), &named.name, json, reporter)?,
        }
        Ok(Outcome::Clean)
    }
}

impl Inspect {
    /// Returns the set that the arguments name, if it has no patches.
    fn set(&self, reporter: &mut Reporter) -> Result<Option<SetFile>, Abort> {
        match self.dialogue.bank_without_options(reporter)? {
            Some(path) => SetFile::open(path, reporter),
            None => Ok(None),
        }
    }

    fn no_clip(reporter: &mut Reporter) -> Abort {
        let tip = "name a clip of the bank, or a Lipz file";
        reporter.usage("`--locale` applies only to a clip, but no clip is named", tip)
    }

    /// Returns the files, and the project if they come from one. Incomplete translations are allowed here.
    fn files(&self, reporter: &mut Reporter) -> Result<(DialogueFiles, Option<Project>), Abort> {
        // A bank does not need the settings next to it, which may be invalid.
        if let Some(bank) = self.dialogue.bank_without_options(reporter)? {
            return Ok((DialogueFiles::open(bank, reporter)?, None));
        }
        let mut project = self.dialogue.project(reporter)?;
        project.settings.options = std::mem::take(&mut project.settings.options).min_coverage(MinCoverage::new());
        let files = self.dialogue.files_with_clip(&project, self.key.as_deref(), reporter)?;
        Ok((files, Some(project)))
    }
}

fn clip(
    dialogue: &Dialogue<'_>,
    key: &str,
    (path, recorded): (&str, Option<RecordedClip>),
    arguments: &Inspect,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    let clip = dialogue.clip_by_key(key).ok_or_else(|| {
        let near = near_keys(dialogue, key);
        let help = match near.is_empty() {
            true => "list the clips of the bank with `--show clips`".to_owned(),
            false => format!("did you mean {}?", near.join(", ")),
        };
        let message = format!("the bank has no clip {}", escape::quoted(key));
        reporter.fail(Report::failure(path, Code::NoSuchClip, message, &help))
    })?;
    let mut all: Vec<Locale> = dialogue.locales().collect();
    all.sort_unstable_by_key(|locale| dialogue.locale_tag(*locale));
    let tagged = || all.iter().map(|locale| (dialogue.locale_tag(*locale), *locale));
    let asked = arguments.locale.iter().map(|asked| choose(asked, path, tagged(), |(tag, _)| tag));
    let asked = asked.map(|chosen| chosen.map(|(_, locale)| locale));
    let mut locales: Vec<Locale> = asked.collect::<Result<_, _>>().map_err(|report| reporter.fail(report))?;
    if locales.is_empty() {
        locales = all;
    }
    if !ClipDetails::is_bounded(dialogue, &clip, &locales) {
        let message = format!("{} repeats too many texts and events to be shown", escape::quoted(clip.key()));
        let help = "pack the bank again from its sources with lipz";
        return Err(reporter.fail(Report::failure(path, Code::BankDamaged, message, help)));
    }
    if reporter.wants_json() {
        let clip = ClipDetails::new(dialogue, &clip, &locales);
        return reporter
            .print_json(&recorded::WithRecording { clip: &clip, recorded: recorded.as_ref().map(Into::into) });
    }
    if arguments.locale.is_empty() {
        // The default locale comes first, because the bands show the first one.
        locales.sort_by_key(|locale| dialogue.default_locale() != Some(*locale));
    }
    let timeline = Timeline::default().width(console::width()).styled(true).render(dialogue, &clip, &locales);
    reporter.print(&(timeline + &recorded.map_or(String::new(), |recorded| recorded::text(&recorded))))
}

/// Returns keys that contain the last part of the requested key, or else those with a similar spelling.
fn near_keys(dialogue: &Dialogue<'_>, key: &str) -> Vec<String> {
    let mut keys: Vec<&str> = dialogue.clips().map(|clip| clip.key()).collect();
    keys.sort_unstable();
    let wanted = last_part(key).trim_end_matches(".lipz");
    let mut near: Vec<&str> =
        keys.iter().copied().filter(|known| !wanted.is_empty() && known.contains(wanted)).collect();
    if near.is_empty() {
        // A key without a folder is compared with the last parts.
        let compared = |known| if key.contains('/') { known } else { last_part(known) };
        let distance = |known| suggest::distance(key, compared(known));
        let mut ranked: Vec<(usize, &str)> = keys.iter().filter_map(|known| Some((distance(known)?, *known))).collect();
        ranked.sort_unstable();
        near = ranked.into_iter().map(|(_, known)| known).collect();
    }
    near.into_iter().take(3).map(|key| format!("`{}`", escape::text(key))).collect()
}

/// Returns the part after the last `/` of a key.
fn last_part(key: &str) -> &str {
    key.rsplit('/').next().unwrap_or(key)
}

fn list(dialogue: &Dialogue<'_>, prefix: &str, json: bool, reporter: &mut Reporter) -> Result<(), Abort> {
    let mut clips: Vec<ClipSummary<'_>> = dialogue.clips_under(prefix).map(|clip| ClipSummary::from(&clip)).collect();
    clips.sort_unstable_by_key(|clip| clip.key);
    if json {
        return reporter.print_json(&clips);
    }
    if clips.is_empty() {
        reporter.remark(&format!("no key starts with `{}`\n", escape::text(prefix)));
    }
    let keys: Vec<_> = clips.iter().map(|clip| escape::text(clip.key)).collect();
    let width = keys.iter().map(|key| key.width()).max().unwrap_or(0);
    let mut text = String::new();
    for (clip, key) in clips.iter().zip(&keys) {
        let seconds = clip.duration_us.map_or("      ?".into(), |us| format!("{:7.2}", us as f64 / 1e6));
        let blanks = " ".repeat(width - key.width());
        let segments = console::counted(clip.segments as usize, "segment");
        let _ = writeln!(text, "{key}{blanks}  {seconds} s  {:>5} frames  {segments:>11}", clip.frames);
    }
    reporter.print(&text)
}

/// Returns a description of the banks below a layer and of its removals.
fn about_layer(layer: &LayerSummary<'_>) -> String {
    let mut text = format!("  patch over {}\n", layer.over.join(", "));
    if !layer.removed_clips.is_empty() {
        let removed = console::counted(layer.removed_clips.len(), "clip");
        let ids: Vec<&str> = layer.removed_clips.iter().take(SHOWN_IDS).map(String::as_str).collect();
        let more = if ids.len() < layer.removed_clips.len() { ", ..." } else { "" };
        let _ = writeln!(text, "  removes {removed}: id {}{more}", ids.join(", "));
    }
    if !layer.removed_locales.is_empty() {
        let tags: Vec<_> = layer.removed_locales.iter().map(|tag| escape::text(tag)).collect();
        let _ = writeln!(text, "  removes the locales {}", tags.join(", "));
    }
    text
}

/// The most ids of removed clips that a summary shows. JSON contains all.
const SHOWN_IDS: usize = 8;

fn summary(summary: &BankSummary<'_>, path: &str, json: bool, reporter: &mut Reporter) -> Result<(), Abort> {
    if json {
        return reporter.print_json(summary);
    }
    let mut text = String::new();
    let (format, bytes) = (&summary.format, console::grouped(summary.length_bytes));
    let _ = writeln!(text, "{path}: lipz bank, format {format}, {bytes} bytes, no fault");
    let _ = writeln!(
        text,
        "  {}, {}, {}, {}{:.1} s of speech{}",
        console::counted(summary.clips, "clip"),
        console::counted(summary.frames, "frame"),
        console::counted(summary.segments, "segment"),
        match summary.curves {
            0 => String::new(),
            count => format!("{}, ", console::counted(count, "curve")),
        },
        summary.seconds,
        match summary.clips_without_fps {
            0 => String::new(),
            count => format!(" (and {} without a frame rate)", console::counted(count, "clip")),
        }
    );
    let _ = writeln!(text, "  fingerprint {}, checksum {}", summary.fingerprint, summary.checksum);
    if let Some(layer) = &summary.layer {
        text.push_str(&about_layer(layer));
    }
    text.push('\n');
    let _ = writeln!(text, "  {:<12} {:>8} {:>9} {:>8}", "locale", "texts", "fallback", "missing");
    for locale in &summary.locales {
        let default = if locale.is_default { "  default" } else { "" };
        let _ = writeln!(
            text,
            "  {:<12} {:>8} {:>9} {:>8}{default}",
            escape::text(locale.tag),
            locale.texts,
            locale.fallbacks,
            locale.missing
        );
    }
    if !summary.voices.is_empty() {
        let _ = writeln!(text, "\n  {:<12} {:>8}", "voice", "dubs");
    }
    for voice in &summary.voices {
        let dubs = if voice.is_original { "original".to_owned() } else { console::grouped(voice.dubs) };
        let _ = writeln!(text, "  {:<12} {dubs:>8}", escape::text(voice.tag));
    }
    let _ = writeln!(text, "\n  {:<12} {:>12}", "section", "bytes");
    for (tag, bytes) in &summary.sections {
        let tag = String::from_utf8_lossy(&tag.0);
        let _ = writeln!(text, "  {:<12} {:>12}", escape::text(&tag), console::grouped(*bytes));
    }
    text.push_str(&profiles(summary));
    reporter.print(&text)
}

/// Returns the profiles of babble, faces and articulation, and the rigs.
fn profiles(summary: &BankSummary<'_>) -> String {
    let mut text = String::new();
    for babble in &summary.babble {
        let _ = writeln!(text, "\n  babble {}, {:.3} digits a second", escape::text(babble.name()), babble.rate());
        let loops =
            [("ooh", babble.ooh(), babble.ooh_power_transfer()), ("aah", babble.aah(), babble.aah_power_transfer())];
        for (name, digits, power) in loops {
            let (digits, power) = (String::from_utf8_lossy(digits), String::from_utf8_lossy(power));
            let _ = writeln!(text, "  {name:<12} {digits}  power {power}");
        }
    }
    for profile in &summary.faces {
        let _ = writeln!(text, "\n  face {}", escape::text(profile.name()));
        for (setting, number) in zip(face::SETTINGS, face::numbers(profile)) {
            let _ = writeln!(text, "  {:<16} {:>8}", setting.name, setting.shown(number).to_string());
        }
    }
    for profile in &summary.articulation {
        let _ = writeln!(
            text,
            "\n  articulation {}: gain {} %, jaw {} %, lead {} ms, level {} dB",
            escape::text(profile.name),
            profile.gain_percent,
            profile.jaw_percent,
            profile.lead_ms,
            profile.level_db
        );
    }
    for rig in &summary.rigs {
        let weights = console::counted(rig.weights.len(), "weight");
        let _ = writeln!(text, "\n  rig {}: {weights}", escape::text(rig.name));
    }
    text
}
