//! The run: read, parse and check every file in parallel, then localise, lower and verify.

mod file;
mod read;

pub(crate) use read::FileReader;

use crate::clip::Clips;
use crate::lower::Layout;
use crate::output::replace_file_if;
use crate::{Input, MinCoverage, Options, Report, coverage, key, levels, localise, pseudo, report, shortfalls};
use file::Worker;
use lipz::Code;
use lipz::diagnostic::show;
use lipz_bank::{Bank, ErrorKind};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::{Duration, Instant};

/// What a run gave.
#[derive(Debug, Default)]
pub struct Compiled {
    /// The bank, verified; `None` if there are errors, or only a check was asked for.
    pub bank: Option<Vec<u8>>,
    /// All findings, sorted by file and place.
    pub reports: Vec<Report>,
    /// Where the time went.
    pub phases: Phases,
}

/// Time spent per phase. Reading, parsing and checking run on several threads: their times are
/// sums over the threads.
#[derive(Clone, Copy, Debug, Default)]
pub struct Phases {
    /// Reading files, all threads.
    pub read: Duration,
    /// Parsing, all threads.
    pub parse: Duration,
    /// Checking, all threads.
    pub check: Duration,
    /// The three above, on the clock.
    pub files: Duration,
    /// Resolving locales.
    pub localise: Duration,
    /// Laying out and filling the bank, and giving back what it was made from.
    pub lower: Duration,
    /// Verifying the bank and, in [`pack`], writing it at the same time.
    pub finish: Duration,
}

/// Is told how many more files are done, from several threads.
pub type Progress<'a> = dyn Fn(u64) + Sync + 'a;

/// Checks `inputs` and, if they have no errors, packs them into a bank.
///
/// The bytes of the bank depend only on keys, contents and options: not on the order of the inputs,
/// their folder, or the number of threads.
///
/// ```
/// use lipz_compiler::{Input, Options, compile};
/// let file = br#"{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair", "text_en-us": "Mayor!" }"#;
/// let compiled = compile(&[Input::from_bytes("act1/mayor", file)], &Options::default(), &|_| {});
/// assert!(compiled.reports.is_empty());
/// let bytes = compiled.bank.ok_or("no bank")?;
/// let bank = lipz_bank::Bank::open(&bytes)?.verify()?;
/// assert_eq!(bank.clip_by_key("act1/mayor").map(|clip| clip.frame_count()), Some(5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compile(inputs: &[Input], options: &Options, progress: &Progress<'_>) -> Compiled {
    make(inputs, options, progress, verify)
}

/// Does what [`compile`] does, and replaces the file at `path` by the bank as [`replace_file`](crate::replace_file) does. It is
/// verified while it is written to a temporary file, which takes the name `path` only after both: that is
/// faster than one after the other.
///
/// If the file cannot be written, a report says so, and there is no bank.
pub fn pack(inputs: &[Input], options: &Options, path: &Path, progress: &Progress<'_>) -> Compiled {
    make(inputs, options, progress, |bank| replace_file_if(path, bank, || verify(bank)))
}

/// Checks `inputs`, makes a bank of them and hands it to `finish`, without whose consent there is none.
fn make(
    inputs: &[Input],
    options: &Options,
    progress: &Progress<'_>,
    finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
) -> Compiled {
    let options = &match canonical(options) {
        Ok(options) => options,
        Err(report) => return Compiled { reports: vec![report], ..Compiled::default() },
    };
    in_pool(options, || {
        let mut run = read_all(inputs, options, progress);
        if report::has_errors(&run.reports) {
            return run.finish(None);
        }
        let start = Instant::now();
        let tags = Clips::join_locales(&mut run.clips);
        let clips = Clips::by_key(&run.clips);
        let localised = localise::localise(&clips, &tags, options);
        run.phases.localise = start.elapsed();
        let start = Instant::now();
        let layout = Layout::of(&clips, &localised, options);
        drop((clips, localised));
        let batches = std::mem::take(&mut run.clips);
        let bank = layout.and_then(|layout| layout.fill(batches)).map_err(|report| in_file(report, inputs));
        run.phases.lower = start.elapsed();
        let start = Instant::now();
        let finished = bank.and_then(|bank| {
            enough_texts(&bank, options)?;
            finish(&bank).map(|()| bank)
        });
        run.phases.finish = start.elapsed();
        match finished {
            Ok(bank) => run.finish(Some(bank)),
            Err(report) => {
                run.reports.push(report);
                run.finish(None)
            }
        }
    })
}

/// Checks `inputs` as [`compile`] does, without making a bank.
pub fn check_all(inputs: &[Input], options: &Options, progress: &Progress<'_>) -> Compiled {
    match canonical(options) {
        Ok(options) => in_pool(&options, || read_all(inputs, &options, progress).finish(None)),
        Err(report) => Compiled { reports: vec![report], ..Compiled::default() },
    }
}

/// The options with all locales in their canonical form, and the pseudo-locale among those to be packed.
fn canonical(options: &Options) -> Result<Options, Report> {
    let canonical = |tag: &String| {
        lipz::locale::canonical_tag(tag, options.extended_locales).ok_or_else(|| {
            let headline = format!("the project's locale {} is not a locale of the form ll-cc", show::name(tag));
            Report::failure("", Code::LocaleShape, headline, "name a language and a country: en-us")
        })
    };
    if options.pseudo && options.default_locale.is_none() {
        let headline = "a pseudo-locale is made of the default locale, and there is none".to_owned();
        return Err(Report::failure(
            "",
            Code::SettingValue,
            headline,
            "set the default locale: --default-locale en-us",
        ));
    }
    let chain = |(tag, chain): (&String, &Vec<String>)| {
        Ok((canonical(tag)?, chain.iter().map(canonical).collect::<Result<_, Report>>()?))
    };
    let share = |(tag, percent): (&String, &f64)| Ok((canonical(tag)?, *percent));
    let default_locale = options.default_locale.as_ref().map(canonical).transpose()?;
    let mut locales: Option<BTreeSet<String>> =
        options.locales.as_ref().map(|tags| tags.iter().map(canonical).collect()).transpose()?;
    if let (Some(locales), Some(default), true) = (&mut locales, &default_locale, options.pseudo) {
        locales.insert(pseudo::locale_for(default));
    }
    Ok(Options {
        default_locale,
        locales,
        fallbacks: options.fallbacks.iter().map(chain).collect::<Result<_, Report>>()?,
        min_coverage: MinCoverage {
            locales: options.min_coverage.locales.iter().map(share).collect::<Result<_, Report>>()?,
            ..options.min_coverage
        },
        ..options.clone()
    })
}

/// Runs `work` with the number of threads that was asked for; on the current ones if there is no
/// starting others.
pub(crate) fn in_pool<R: Send>(options: &Options, work: impl FnOnce() -> R + Send) -> R {
    match options.threads {
        Some(count) => match rayon::ThreadPoolBuilder::new().num_threads(count).build() {
            Ok(pool) => pool.install(work),
            Err(_) => work(),
        },
        None => work(),
    }
}

/// What is known after the files are read.
struct Run {
    clips: Vec<Clips>,
    reports: Vec<Report>,
    phases: Phases,
}

impl Run {
    fn finish(mut self, bank: Option<Vec<u8>>) -> Compiled {
        report::sort(&mut self.reports);
        Compiled { bank, reports: self.reports, phases: self.phases }
    }
}

fn read_all(inputs: &[Input], options: &Options, progress: &Progress<'_>) -> Run {
    let start = Instant::now();
    let mut run = Run { clips: Vec::new(), reports: Vec::new(), phases: Phases::default() };
    key::check(inputs, &mut run.reports);
    for report in &mut run.reports {
        levels::apply(&options.levels, &mut report.diagnostics);
    }
    let work = inputs.par_iter().fold(Worker::default, |mut worker, input| {
        worker.file(input, options);
        progress(1);
        worker
    });
    for worker in work.collect::<Vec<_>>() {
        run.clips.push(worker.clips);
        run.reports.extend(worker.reports);
        run.phases.read += worker.phases.read;
        run.phases.parse += worker.phases.parse;
        run.phases.check += worker.phases.check;
    }
    run.phases.files = start.elapsed();
    run
}

/// Whether as much is translated as the project asks for.
fn enough_texts(bank: &[u8], options: &Options) -> Result<(), Report> {
    if options.min_coverage == MinCoverage::default() {
        return Ok(());
    }
    // A damaged bank is found by who verifies it.
    let Ok(bank) = Bank::open(bank) else { return Ok(()) };
    let shortfalls = shortfalls(&coverage(&bank), &options.min_coverage);
    if shortfalls.is_empty() { Ok(()) } else { Err(Report::all_about("", shortfalls)) }
}

/// The report with the name of the file, where it has the key of a clip for a path.
fn in_file(mut report: Report, inputs: &[Input]) -> Report {
    if let Some(input) = inputs.iter().find(|input| input.key == report.source.path) {
        report.source.path = input.name();
    }
    report
}

/// What the reader finds at fault with the bank: a defect of this compiler, and better found now than in
/// a game.
fn verify(bank: &[u8]) -> Result<(), Report> {
    match Bank::open(bank).and_then(Bank::verify) {
        Ok(_) => Ok(()),
        Err(error) if error.kind() == ErrorKind::TooManySteps => Err(Report::failure(
            "",
            Code::BankTooLarge,
            "clips of very many segments share their texts in very many locales: readers would refuse the bank".into(),
            "make several banks, one per language",
        )),
        Err(error) => Err(Report::failure(
            "",
            Code::BankDamaged,
            format!("the bank that was made does not pass verification: {error}"),
            "this is a defect of lipz: please report it with the files that lead to it",
        )),
    }
}
