//! `lipz import subtitles`: imports texts and segments of clips from subtitle files.

mod subtitle_file;

use crate::CommandResult;
use crate::commands::Run;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::existing_file::ExistingFile;
use crate::shared::formats;
use crate::shared::input_file;
use crate::shared::lint_flags::LintFlags;
use crate::shared::output_file;
use crate::shared::patterns;
use crate::shared::run_flags::QuietFlag;
use crate::shared::settings_file::SettingsFile;
use crate::shared::values::{parse_fps, parse_locale, with_default_locale};
use clap::Args;
use lipz_bank::Fps;
use lipz_compiler::{Content, Input, Options, key};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::format::{Style, format};
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, Element};
use lipz_interop::subtitles::{SubtitleFormat, SubtitleOptions, clip, join};
use lipz_interop::{DEFAULT_RATE, Encoding, to_utf8};
use lipz_texts::TextLints;
use std::path::{Path, PathBuf};
use subtitle_file::SubtitleFile;

/// Import subtitles as texts of clips: KEY.LOCALE.srt or .vtt.
///
/// A missing clip is created at rest, with a segment for each cue. A clip without segments gets those of the cues.
/// A clip with segments keeps them, and each cue becomes the text of the segment that it overlaps most. Everything else in
/// the file stays, including its layout.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import subtitles subtitles -o voices
  lipz import subtitles mayor.srt -o voices --locale en-us --fps 24")]
pub(crate) struct ImportSubtitles {
    /// Subtitle files or folders of them
    #[arg(value_name = "FILES", required = true)]
    files: Vec<PathBuf>,

    /// Folder of the clips
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,

    /// Locale of files without one in their name [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Option<String>,

    /// Frame rate of clips without one [default: that of lipz.toml, or 24]
    #[arg(long, value_name = "FPS", value_parser = parse_fps)]
    fps: Option<Fps>,

    /// Encoding of files that are not UTF-8, such as shift_jis [default: windows-1252 for .srt]
    #[arg(long, value_name = "NAME", value_parser = formats::encoding)]
    encoding: Option<&'static Encoding>,

    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    lints: LintFlags,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for ImportSubtitles {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(self, reporter)
    }
}

fn run(arguments: &ImportSubtitles, reporter: &mut Reporter) -> CommandResult {
    let mut options = arguments.file.project(std::slice::from_ref(&arguments.output), reporter)?.settings.options;
    arguments.lints.apply(&mut options);
    let mut of_files = options.clone();
    if let Some(locale) = &arguments.locale {
        of_files = with_default_locale(of_files, locale).map_err(|error| reporter.fail(error.to_report()))?;
        // Texts of clips without a locale are in that of the project.
        if options.get_default_locale().is_none() {
            options = of_files.clone();
        }
    }
    let mut reports = Vec::new();
    let mut found = subtitle_file::find(&patterns::files(&arguments.files), &of_files, &mut reports, reporter)?;
    found.sort_by(|a, b| a.key.cmp(&b.key));
    let clips: Vec<&[SubtitleFile]> = found.chunk_by(|a, b| a.key == b.key).collect();
    let path =
        |clip: &[SubtitleFile]| clip.first().map(|file| formats::path(&arguments.output, &file.key, key::EXTENSION));
    let input =
        |clip: &&[SubtitleFile]| Some(Input { key: clip.first()?.key.clone(), content: Content::File(path(clip)?) });
    key::check(&clips.iter().filter_map(input).collect::<Vec<_>>(), &mut reports);
    let mut written = 0;
    if output_file::may_write(&reports) {
        let files = Files::new();
        for clip in clips {
            let Some(path) = path(clip) else { continue };
            match one(arguments, &options, &path, clip, &files, &mut reports) {
                Ok(is_written) => written += usize::from(is_written),
                Err(report) => reports.push(report),
            }
        }
        let unwritten = files.finish();
        written -= unwritten.len();
        reports.extend(unwritten);
    }
    let clips = console::counted(written, "clip");
    let summary = format!("texts of {clips} imported into {}\n", console::path(&arguments.output));
    reporter.end(reports, (!arguments.quiet.is_set() && written > 0).then_some(summary))
}

/// Merges the subtitles of one clip into its Lipz file. Returns false if the file stays unchanged.
fn one(
    arguments: &ImportSubtitles,
    options: &Options,
    path: &Path,
    found: &[SubtitleFile],
    files: &Files,
    reports: &mut Vec<Report>,
) -> Result<bool, Report> {
    let existing = ExistingFile::find(path)?;
    let before = existing.as_ref().map(ExistingFile::document).transpose()?;
    let mut document = before.clone();
    let fps = arguments.fps.or(options.get_default_fps());
    let rate = fps.map_or(DEFAULT_RATE, formats::rate);
    let locale = options.get_default_locale();
    let of_project = SubtitleOptions { default_rate: Some(rate), default_locale: locale, speaker: None };
    let mut is_changed = false;
    for file in found {
        let bytes = input_file::read(&file.path).map_err(|error| input_file::unreadable(&file.path, &error))?;
        let mut diagnostics = Vec::new();
        let is_legacy = file.format == SubtitleFormat::Srt;
        let bytes = to_utf8(&bytes, arguments.encoding, is_legacy, &mut diagnostics);
        let cues = file.format.read(&bytes, &mut diagnostics);
        if !diagnostics.iter().any(Diagnostic::is_error) {
            let joined = match &document {
                Some(document) => join(document.clone(), &cues, &file.locale, &of_project, &mut diagnostics),
                None => clip(&cues, &file.locale, rate, &mut diagnostics),
            };
            if !diagnostics.iter().any(Diagnostic::is_error) {
                let mut lost = lost_placeholders(&joined, &file.locale, options);
                options.get_levels().apply(&mut lost);
                if !lost.iter().any(Diagnostic::is_error) {
                    document = Some(joined);
                    is_changed = true;
                }
                diagnostics.extend(lost);
            }
        }
        options.get_levels().apply(&mut diagnostics);
        if !diagnostics.is_empty() {
            reports.push(Report::from_bytes(console::path(&file.path), &bytes, diagnostics));
        }
    }
    let Some(document) = document.filter(|_| is_changed) else { return Ok(false) };
    match (&existing, &before) {
        (Some(existing), Some(before)) => existing.update(files, before, &document, locale)?,
        _ => {
            let after = format(&document, Style { default_locale: locale, ..Style::default() });
            files.replace(path, after.as_bytes())?;
        }
    }
    Ok(true)
}

/// Reports placeholders of the default locale's text that are missing from the imported one. Subtitles show texts without
/// the parts in braces, so translators of subtitles do not see them.
fn lost_placeholders(document: &Document<'_>, locale: &str, options: &Options) -> Vec<Diagnostic> {
    let Some(source) = options.get_default_locale().filter(|source| *source != locale) else { return Vec::new() };
    let is_compared = |element: &Element<'_>| match text_name(&element.name.text) {
        // The text of the default locale.
        Some(TextName::NoLocale) => true,
        Some(name) => name.tag().is_some_and(|tag| tag == locale || tag == source),
        None => false,
    };
    let elements = document.elements.iter().filter(|element| is_compared(element)).cloned();
    let mut found = Vec::new();
    TextLints::new(source).default_locale(Some(source.to_owned())).check(
        "",
        &Document { elements: elements.collect() },
        &mut found,
    );
    found.retain(|found| found.code == Code::Placeholder);
    for one in &mut found {
        // The positions are those of the Lipz file.
        (one.primary, one.labels) = (None, Vec::new());
    }
    found.dedup();
    found
}
