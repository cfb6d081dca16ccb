//! `lipz export subtitles`: a subtitle file per clip and locale.

use crate::CommandResult;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::formats;
use crate::shared::inputs::find;
use crate::shared::output_file::{OVERWRITE, in_the_way, may_write, write_all};
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::subtitle_formats::SubtitleFormatArgument;
use crate::shared::values::parse_locale;
use clap::Args;
use lipz_compiler::{Compiler, Input, Options, key};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::locale::{TextName, split_variant, text_name};
use lipz_interop::subtitles::{SubtitleFormat, SubtitleOptions, cues};
use std::path::PathBuf;

/// Export texts as subtitles: KEY.LOCALE.srt or .vtt for each clip and locale.
///
/// Meta information is left out, except `{speaker: Mara}`, which names the speaker of the text after it. WebVTT stores the
/// speaker as a voice.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz export subtitles vtt voices -o subtitles
  lipz export subtitles srt voices -o subtitles --locale de-de,fr-fr")]
pub(crate) struct ExportSubtitles {
    /// Format to write
    #[arg(value_enum, value_name = "FORMAT")]
    subtitle_format: SubtitleFormatArgument,

    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// Folder to write into
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,

    /// Only these locales, as in de-de,fr-fr [default: all]
    #[arg(long, value_name = "LOCALE", value_delimiter = ',', value_parser = parse_locale)]
    locale: Vec<String>,

    /// Speaker of texts that do not name one
    #[arg(long, value_name = "NAME")]
    speaker: Option<String>,

    /// Replace existing files
    #[arg(long)]
    overwrite: bool,
}

/// The subtitles and diagnostics of one clip.
struct ExportedSubtitles {
    /// Locales and the contents of their files.
    files: Vec<(String, String)>,
    report: Option<Report>,
}

impl Run for ExportSubtitles {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(self, reporter)
    }
}

fn run(arguments: &ExportSubtitles, reporter: &mut Reporter) -> CommandResult {
    arguments.stdin.apply(arguments.sources.paths(), reporter)?;
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
    if !arguments.overwrite {
        reports.extend(files.iter().filter_map(|(path, _)| in_the_way(path, OVERWRITE)));
    }
    let is_free = may_write(&reports);
    let files = files.iter().filter(|_| is_free).map(|(path, file)| (path.clone(), file.as_bytes()));
    let written = write_all(files, &mut reports);
    let summary = format!("{} written into {}\n", console::counted(written, "file"), console::path(&arguments.output));
    reporter.end(reports, (!arguments.sources.is_quiet() && written > 0).then_some(summary))
}

impl ExportSubtitles {
    fn path(&self, input: &Input, locale: &str) -> PathBuf {
        let format = SubtitleFormat::from(self.subtitle_format);
        formats::path(&self.output, &input.key, &format!("{locale}.{}", format.extension()))
    }
}

/// Returns the subtitles of one Lipz file.
fn one(arguments: &ExportSubtitles, input: &Input, bytes: &[u8], options: &Options) -> ExportedSubtitles {
    let parsed = lipz_file::parse(bytes);
    let mut diagnostics = parsed.diagnostics;
    let subtitle_options = SubtitleOptions {
        default_rate: options.get_default_fps().map(formats::rate),
        default_locale: options.get_default_locale(),
        speaker: arguments.speaker.as_deref(),
    };
    let mut files = Vec::new();
    let document = parsed.document.unwrap_or_default();
    let mut locales: Vec<String> = Vec::new();
    for element in &document.elements {
        let locale = match text_name(&element.name.text) {
            Some(TextName::NoLocale) => options.get_default_locale().map(str::to_owned),
            name => name.and_then(TextName::tag),
        };
        // Of two texts in a locale, which `lipz check` reports, the first counts.
        let Some(locale) = locale.filter(|locale| !locales.contains(locale)) else { continue };
        locales.push(locale.clone());
        let (varied, key) = split_variant(&locale);
        if !arguments.locale.is_empty() && !arguments.locale.iter().any(|wanted| wanted == varied) {
            continue;
        }
        if key.is_some() {
            let message = format!("`text_{locale}` is a variant, and is not exported");
            diagnostics.push(
                Diagnostic::at(Code::SubtitleLoss, element.name.span(), message)
                    .note("a subtitle file has one text for each cue"),
            );
            continue;
        }
        let Some(cues) = cues(&document, &locale, &subtitle_options, &mut diagnostics) else { break };
        if !cues.is_empty() {
            let file = SubtitleFormat::from(arguments.subtitle_format).write(&cues, &mut diagnostics);
            files.push((locale, file));
        }
    }
    options.get_levels().apply(&mut diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        files.clear();
    }
    let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics));
    ExportedSubtitles { files, report }
}
