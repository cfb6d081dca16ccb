//! `lipz subtitles export`: a subtitle file per clip and locale.

use super::Format;
use crate::Ended;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::formats;
use crate::shared::inputs::find;
use crate::shared::project_flags::parse_locale;
use crate::shared::sources::Sources;
use clap::Args;
use lipz_compiler::{Compiler, Input, Options, key};
use lipz_diagnostics::{Report, Severity};
use lipz_file::locale::{TextName, text_name};
use lipz_interop::subtitles::{SubtitleFormat, SubtitleOptions, cues};
use std::path::PathBuf;

/// Write the texts of clips as subtitles: a file KEY.LOCALE.srt or .vtt for each clip and locale.
///
/// Meta information is not written, but `{speaker: Mara}` in a text names the speaker from there on, who becomes a
/// WebVTT voice.
#[derive(Args, Debug)]
pub(super) struct Export {
    /// The format to write
    #[arg(value_enum, value_name = "FORMAT")]
    subtitle_format: Format,

    #[command(flatten)]
    sources: Sources,

    /// The folder to write into
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,

    /// Write this locale only; may be given several times [default: all that the files have]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Vec<String>,

    /// The speaker where the texts name none
    #[arg(long, value_name = "NAME")]
    speaker: Option<String>,

    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

/// The subtitles of one clip, and what was found.
struct Made {
    /// Locales with their files.
    files: Vec<(String, String)>,
    report: Option<Report>,
}

pub(super) fn run(arguments: &Export, reporter: &mut Reporter) -> Ended {
    let project = arguments.sources.project(reporter)?;
    let (inputs, mut reports) = find(&project.settings);
    key::check(&inputs, &mut reports);
    let options = &project.settings.options;
    let results =
        Compiler::new(options.clone()).each_file(&inputs, |input, bytes| one(arguments, input, bytes, options));
    let mut files = Vec::new();
    for (input, result) in inputs.iter().zip(results) {
        match result {
            Ok(made) => {
                reports.extend(made.report);
                files.extend(made.files.into_iter().map(|(locale, file)| (arguments.path(input, &locale), file)));
            }
            Err(report) => reports.push(report),
        }
    }
    if !arguments.force {
        reports.extend(files.iter().filter_map(|(path, _)| formats::in_the_way(path)));
    }
    let mut written = 0;
    if formats::may_write(&reports) {
        let files_to_write = Files::new();
        for (path, file) in &files {
            match files_to_write.replace(path, file.as_bytes()) {
                Ok(()) => written += 1,
                Err(report) => reports.push(report),
            }
        }
        let unwritten = files_to_write.finish();
        written -= unwritten.len();
        reports.extend(unwritten);
    }
    let summary = format!("{} written into {}\n", console::counted(written, "file"), console::path(&arguments.output));
    reporter.end(reports, (!arguments.sources.is_quiet() && written > 0).then_some(summary))
}

impl Export {
    fn path(&self, input: &Input, locale: &str) -> PathBuf {
        let format = SubtitleFormat::from(self.subtitle_format);
        formats::path(&self.output, &input.key, &format!("{locale}.{}", format.extension()))
    }
}

/// The subtitles of one Lipz file.
fn one(arguments: &Export, input: &Input, bytes: &[u8], options: &Options) -> Made {
    let parsed = lipz_file::parse(bytes);
    let mut diagnostics = parsed.diagnostics;
    let subtitle_options = SubtitleOptions {
        default_rate: options.get_default_fps().map(formats::rate),
        speaker: arguments.speaker.as_deref(),
    };
    let mut files = Vec::new();
    let document = parsed.document.unwrap_or_default();
    for element in &document.elements {
        let Some(TextName::Canonical(locale)) = text_name(&element.name.text) else { continue };
        if !arguments.locale.is_empty() && !arguments.locale.contains(&locale) {
            continue;
        }
        let Some(cues) = cues(&document, &locale, &subtitle_options, &mut diagnostics) else { break };
        if !cues.is_empty() {
            let file = SubtitleFormat::from(arguments.subtitle_format).write(&cues, &mut diagnostics);
            files.push((locale, file));
        }
    }
    options.get_levels().apply(&mut diagnostics);
    if diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error) {
        files.clear();
    }
    let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics));
    Made { files, report }
}
