//! `lipz shard link`: links the objects of all shards to one bank, or to a set of banks.

use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::run_flags::{JobsFlag, QuietFlag};
use crate::shared::split::Split;
use crate::shared::{output_file, patterns, stdio};
use crate::{Outcome, console, interrupt};
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{Link, LinkedSet, SET_EXTENSION};
use lipz_compiler::{Compiler, Replace};
use std::path::{Path, PathBuf};

/// Link the objects of all shards to one bank, or to a set of banks.
///
/// The bank has the same bytes as the bank that `lipz pack` makes from all sources. This step handles fallback, dubs, key clashes
/// and coverage, with the settings in the objects.
///
/// A set is for dialogue of more than 4 GiB. `-o dialogue.lipzset` writes a bank for each shard, and finally the index of the
/// set. Programs query a set like a bank.
#[derive(Args, Debug)]
#[command(override_usage = "lipz shard link <OBJECT>... --output <BANK> [OPTIONS]")]
#[command(after_help = "Examples:
  lipz shard link *.lipzobj -o dialogue.lipzbank
  lipz shard link 0-of-2.lipzobj 1-of-2.lipzobj -o dialogue.lipzbank
  lipz shard link *.lipzobj -o dialogue.lipzset")]
pub(super) struct LinkArguments {
    /// Objects of all shards, in any order
    #[arg(value_name = "OBJECT", required = true, num_args = 1..)]
    objects: Vec<PathBuf>,

    /// Bank to write, or index of a set (.lipzset)
    #[arg(short, long, value_name = "BANK")]
    output: PathBuf,

    #[command(flatten)]
    jobs: JobsFlag,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for LinkArguments {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if stdio::is_meant(&self.output) {
            return Err(
                reporter.usage("a linked bank cannot be written to standard output", "name a file with `--output`")
            );
        }
        output_file::refuse_source(&self.output, reporter)?;
        let objects = patterns::files(&self.objects);
        for object in &objects {
            output_file::refuse_same(&[("an object", object), ("the output", &self.output)], reporter)?;
        }
        let link = Link::open(&objects).map_err(|reports| {
            let outcome = Outcome::from_reports(&reports);
            reporter.abort(reports, outcome)
        })?;
        let settings = settings(&link, reporter)?;
        let options = settings.options.clone().voices(settings.voices()).threads(self.jobs.threads());
        let split = Split { locales: settings.split_locales, voices: settings.split_voices };
        split.refuse_both(reporter)?;
        let is_split = split.locales || split.voices;
        if self.is_set() && is_split {
            let tip =
                "link to one bank, or remove `split-locales` and `split-voices` from lipz.toml and make a new plan";
            return Err(reporter.usage("a set cannot be split by locale or by voice", tip));
        }
        let bar = console::progress_bar(link.clip_count(), self.quiet.is_set());
        let compiler =
            Compiler::new(options).around_writes(|write| interrupt::whole(write)).progress(|clips| bar.inc(clips));
        if self.is_set() {
            let linked = compiler.link_to_set(&link, &self.output);
            bar.finish_and_clear();
            return self.finish_set(linked, link.clip_count(), reporter);
        }
        let (length_bytes, reports, whole) = if is_split {
            let linked = compiler.link_to_bank(&link);
            (linked.bank.as_ref().map(Vec::len), linked.reports, linked.bank)
        } else {
            let linked = compiler.link(&link, &self.output);
            (linked.bank.map(|file| file.length_bytes), linked.reports, None)
        };
        bar.finish_and_clear();
        let outcome = Outcome::from_reports(&reports);
        let Some(length_bytes) = length_bytes else { return Err(reporter.abort(reports, outcome)) };
        reporter.add(reports);
        if let Some(bank) = whole {
            let delivered = interrupt::whole(|| split.outputs(&self.output).deliver(&bank, Replace::Always));
            delivered.map_err(|report| reporter.fail(report))?;
        }
        if !self.quiet.is_set() {
            let (objects, clips) =
                (console::counted(objects.len(), "object"), console::counted(link.clip_count(), "clip"));
            let (path, bytes) = (console::path(&self.output), console::grouped(length_bytes));
            reporter.summary(&format!("{objects} linked into {path} ({clips}, {bytes} bytes)\n"))?;
        }
        Ok(outcome)
    }
}

impl LinkArguments {
    /// Whether the output is the index of a set.
    fn is_set(&self) -> bool {
        self.output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(SET_EXTENSION))
    }

    fn finish_set(&self, linked: LinkedSet, clips: usize, reporter: &mut Reporter) -> CommandResult {
        let outcome = Outcome::from_reports(&linked.reports);
        let Some(files) = linked.files else { return Err(reporter.abort(linked.reports, outcome)) };
        reporter.add(linked.reports);
        if !self.quiet.is_set() {
            let (banks, clips) = (console::counted(files.banks.len(), "bank"), console::counted(clips, "clip"));
            let bytes: usize = files.banks.iter().chain([&files.index]).map(|file| file.length_bytes).sum();
            let (path, bytes) = (console::path(&self.output), console::grouped(bytes));
            reporter.summary(&format!("{banks} linked into the set {path} ({clips}, {bytes} bytes)\n"))?;
        }
        Ok(outcome)
    }
}

/// Returns the settings of the objects. Their warnings have been shown before.
fn settings(link: &Link, reporter: &mut Reporter) -> Result<Settings, Abort> {
    let Some((path, text)) = link.settings() else { return Ok(Settings::default()) };
    let folder = Path::new(path).parent().unwrap_or(Path::new(""));
    Settings::parse(text, path, folder).map_err(|report| reporter.refuse(vec![report]))
}
