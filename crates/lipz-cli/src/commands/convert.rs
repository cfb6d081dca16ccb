//! `lipz convert`: Lipz files with the codes of another viseme type.

use crate::rewriting::{Rewriting, failure, files};
use crate::sources::{Sources, parse_viseme_type};
use crate::{Outcome, console, render};
use clap::Args;
use lipz::{Code, Diagnostic, Level};
use lipz_bank::VisemeType;
use lipz_compiler::{Input, Report, convert, count, discover, each_file, key, replace_file};
use std::path::{Path, PathBuf};

/// Convert Lipz files to another viseme type: blair to toonboom, toonboom to blair.
///
/// Only the codes and `viseme_type` change. Blair's L and U have no shape of their own in Toon Boom's
/// chart; files that lose them are named. There is no way from or to rms.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz convert voices --viseme-type toonboom -o voices-toonboom
  lipz convert voices --viseme-type blair --in-place")]
pub(crate) struct Convert {
    #[command(flatten)]
    pub(crate) sources: Sources,

    /// The viseme type to convert to: blair, toonboom
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type)]
    viseme_type: VisemeType,

    /// Replace the files
    #[arg(long, required_unless_present = "output")]
    in_place: bool,

    /// Write all files into this folder, converted or not, under their keys
    #[arg(short, long, value_name = "FOLDER", conflicts_with = "in_place")]
    output: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Convert) -> Outcome {
    let sources = &arguments.sources;
    let (inputs, mut reports) = discover(&sources.sources, sources.root.as_deref());
    if let Some(folder) = &arguments.output {
        key::check(&inputs, &mut reports);
        reports.extend(inputs.iter().filter_map(|input| in_the_way(folder, input)));
        if !reports.is_empty() {
            render::findings(&reports);
            return failure(&reports);
        }
    }
    let bar = console::progress_bar(inputs.len(), sources.quiet);
    let options = sources.options();
    let results = each_file(&inputs, &options, &|count| bar.inc(count), |input, bytes| {
        let converted = convert(bytes, arguments.viseme_type, &options);
        let is_changed = converted.text.is_some();
        let written = match converted.diagnostics.iter().any(|finding| finding.level == Level::Error) {
            true => Ok(()),
            false => arguments.write(input, bytes, converted.text.as_deref()),
        };
        let found = !converted.diagnostics.is_empty();
        let findings = found.then(|| Report::of_file(&input.name, bytes, converted.diagnostics));
        (is_changed, findings.into_iter().chain(written.err()).collect::<Vec<_>>())
    });
    bar.finish_and_clear();
    let (mut changed, mut unchanged) = (0, 0);
    for result in results {
        let (is_changed, of_file) = result.unwrap_or_else(|report| (false, vec![report]));
        match (count(&of_file, Level::Error), is_changed) {
            (0, true) => changed += 1,
            (0, false) => unchanged += 1,
            _ => {}
        }
        reports.extend(of_file);
    }
    render::findings(&reports);
    let printed = if sources.quiet || inputs.is_empty() {
        Outcome::Clean
    } else {
        let (changed, unchanged) = (files(changed), console::grouped(unchanged));
        console::print(&format!("{changed} converted to {}, {unchanged} unchanged\n", arguments.viseme_type))
    };
    if count(&reports, Level::Error) > 0 { failure(&reports) } else { printed }
}

impl Convert {
    /// Writes a file, whose new text is `after` if it has one, to where it was asked for.
    fn write(&self, input: &Input, before: &[u8], after: Option<&str>) -> Result<(), Report> {
        match (&self.output, after) {
            (Some(folder), after) => replace_file(&output(folder, input), after.map_or(before, str::as_bytes)),
            (None, Some(after)) => Rewriting::InPlace.rewrite(input, before, after).map(|_| ()),
            (None, None) => Ok(()),
        }
    }
}

/// Where the converted file is written.
fn output(folder: &Path, input: &Input) -> PathBuf {
    folder.join(format!("{}.{}", input.key, key::EXTENSION))
}

/// The finding for an output file that exists.
fn in_the_way(folder: &Path, input: &Input) -> Option<Report> {
    let path = output(folder, input);
    path.symlink_metadata().ok()?;
    let shown = console::path(&path);
    let finding = Diagnostic::new(Code::WouldOverwrite, format!("`{shown}` is there already"));
    Some(Report::about(
        shown,
        finding.note("nothing was written").help("write into another folder, or replace the sources with --in-place"),
    ))
}
