//! The measured tasks, each in a separate process.

use crate::Failure;
use clap::ValueEnum;
use cpu_time::ProcessTime;
use lipz_benches::peak_bytes;
use lipz_compiler::{
    Compiled, Compiler, DeliveredFiles, Input, LintResult, Memory, Options, OutputFile, Outputs, Phases, discover,
    discover_with_reports,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::hint::black_box;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A task.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(super) enum Work {
    List,
    Stat,
    Read,
    Borrowed,
    Value,
    Pack,
    Strip,
    Again,
    Watch,
    Check,
}

impl Work {
    pub(super) const ALL: [Work; 10] = [
        Work::List,
        Work::Stat,
        Work::Read,
        Work::Borrowed,
        Work::Value,
        Work::Pack,
        Work::Strip,
        Work::Again,
        Work::Watch,
        Work::Check,
    ];

    /// Returns its name in the table.
    pub(super) fn name(self) -> &'static str {
        match self {
            Work::List => "list the tree",
            Work::Stat => "list, stat of every file",
            Work::Read => "list, read",
            Work::Borrowed => "list, read, serde_json into a borrowed struct",
            Work::Value => "list, read, serde_json into a `Value`",
            Work::Pack => "**pack**",
            Work::Strip => "**pack, stripped**",
            Work::Again => "**pack --cache after one file changed**",
            Work::Watch => "**watch, when one file changed**",
            Work::Check => "**check --cache, nothing changed**",
        }
    }

    /// Returns its name on the command line of the child.
    pub(super) fn argument(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

/// The measurements of one run of a task.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub(super) struct Measurement {
    /// Elapsed time, from the path of the folder to the end of the task.
    pub(super) seconds: f64,
    /// Processor time of all threads, in the program and in the system.
    pub(super) processor_seconds: f64,
    /// Times of its phases, by name. Those in brackets are sums over threads.
    pub(super) phases: Vec<(String, f64)>,
    /// Peak of the process's memory; `None` on systems that do not report it.
    pub(super) peak_bytes: Option<u64>,
    /// Length of the bank in bytes.
    pub(super) bank_bytes: Option<u64>,
}

pub(super) fn run(work: Work, folder: &Path, bank: &Path, threads: usize) -> Result<Measurement, Failure> {
    let mut measurement = Measurement::default();
    let mut watched = None;
    match work {
        Work::Again => change_one_of_the_cache(folder, bank, threads)?,
        Work::Watch => watched = Some(Watched::new(folder, bank, threads)?),
        // Makes the cache for the measured run.
        Work::Check => check(folder, bank, threads)?,
        _ => {}
    }
    let (start, processor_start) = (Instant::now(), ProcessTime::now());
    match work {
        Work::List => {
            black_box(lipz_benches::list(folder).map_err(|error| error.to_string())?);
        }
        Work::Stat => each_path(folder, threads, |path| {
            path.metadata()
                .map(|metadata| usize::try_from(metadata.len()).unwrap_or(usize::MAX))
                .map_err(|error| failed(path, &error))
        })?,
        Work::Read => each_file(folder, threads, |bytes| Ok(bytes.len()))?,
        Work::Borrowed => each_file(folder, threads, |bytes| {
            let clip: Borrowed<'_> = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
            Ok(black_box(clip).visemes.len())
        })?,
        Work::Value => each_file(folder, threads, |bytes| {
            let value: serde_json::Value = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
            Ok(black_box(value).as_object().map_or(0, serde_json::Map::len))
        })?,
        Work::Pack => pack(folder, bank, threads, false, &mut measurement)?,
        Work::Strip => pack(folder, bank, threads, true, &mut measurement)?,
        Work::Again => pack_again(folder, bank, threads, &mut measurement)?,
        Work::Watch => watched.ok_or("nothing is watched")?.pack(&mut measurement)?,
        Work::Check => check(folder, bank, threads)?,
    }
    measurement.seconds = start.elapsed().as_secs_f64();
    measurement.processor_seconds = processor_start.elapsed().as_secs_f64();
    measurement.peak_bytes = peak_bytes();
    Ok(measurement)
}

/// A clip in a program with fixed elements and locales. Strings borrow from the file.
#[derive(Deserialize)]
#[expect(dead_code, reason = "what is measured is filling it")]
struct Borrowed<'f> {
    fps: f64,
    viseme_type: &'f str,
    visemes: &'f str,
    events: Option<&'f str>,
    #[serde(rename = "text_en-us")]
    text_en: Option<&'f str>,
    #[serde(rename = "text_de-de")]
    text_de: Option<&'f str>,
    #[serde(rename = "text_fr-fr")]
    text_fr: Option<&'f str>,
    #[serde(rename = "text_ru-ru")]
    text_ru: Option<&'f str>,
    #[serde(rename = "text_ja-jp")]
    text_ja: Option<&'f str>,
    #[serde(rename = "text_zh-cn")]
    text_zh: Option<&'f str>,
    #[serde(rename = "text_ko-kr")]
    text_ko: Option<&'f str>,
    #[serde(rename = "text_ar-sa")]
    text_ar: Option<&'f str>,
    #[serde(rename = "text_el-gr")]
    text_el: Option<&'f str>,
    #[serde(rename = "text_he-il")]
    text_he: Option<&'f str>,
    #[serde(rename = "text_hi-in")]
    text_hi: Option<&'f str>,
    #[serde(rename = "text_th-th")]
    text_th: Option<&'f str>,
}

/// Lists the files and calls a function with the bytes of each, on `threads` threads.
fn each_file(
    folder: &Path,
    threads: usize,
    work: impl Fn(&[u8]) -> Result<usize, Failure> + Sync,
) -> Result<(), Failure> {
    each_path(folder, threads, |path| work(&std::fs::read(path).map_err(|error| failed(path, &error))?))
}

/// Lists the files and calls a function with the path of each, on `threads` threads.
fn each_path(
    folder: &Path,
    threads: usize,
    work: impl Fn(&Path) -> Result<usize, Failure> + Sync,
) -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| error.to_string())?;
    let files = lipz_benches::list(folder).map_err(|error| error.to_string())?;
    let sizes: Result<Vec<usize>, Failure> = pool.install(|| files.par_iter().map(|path| work(path)).collect());
    black_box(sizes?);
    Ok(())
}

fn failed(path: &Path, error: &io::Error) -> Failure {
    format!("`{}`: {error}", path.display())
}

fn pack(folder: &Path, bank: &Path, threads: usize, strip: bool, measurement: &mut Measurement) -> Result<(), Failure> {
    let options = Options::new().strip(strip).threads(threads);
    packing(folder, measurement, |inputs| Compiler::new(options.clone()).pack(inputs, bank))
}

/// Packs with a cache next to the bank.
fn pack_again(folder: &Path, bank: &Path, threads: usize, measurement: &mut Measurement) -> Result<(), Failure> {
    let options = Options::new().threads(threads);
    let (bank, cache) = remembered(bank);
    packing(folder, measurement, |inputs| Compiler::new(options.clone()).pack_cached(inputs, &bank, &cache))
}

/// Returns bank and cache of [`pack_again`], which no other task uses.
fn remembered(bank: &Path) -> (PathBuf, PathBuf) {
    (bank.with_extension("again.lipzbank"), bank.with_extension("cache"))
}

/// Makes the cache if it does not exist, then changes a file.
fn change_one_of_the_cache(folder: &Path, bank: &Path, threads: usize) -> Result<(), Failure> {
    if !remembered(bank).1.exists() {
        pack_again(folder, bank, threads, &mut Measurement::default())?;
    }
    let files = lipz_benches::list(folder).map_err(|error| error.to_string())?;
    files.first().map_or(Ok(()), |path| change(path))
}

/// Makes a text of a file one letter longer.
fn change(path: &Path) -> Result<(), Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| failed(path, &error))?;
    let longer = text.replacen("\"text_en-us\": \"", "\"text_en-us\": \"a", 1);
    if longer == text {
        return Err(format!("`{}` has no text to change", path.display()));
    }
    std::fs::write(path, longer).map_err(|error| failed(path, &error))
}

/// A folder that was packed and is watched, and in which a file has changed.
struct Watched {
    compiler: Compiler<'static>,
    inputs: Vec<Input>,
    outputs: Outputs,
    memory: Memory,
}

impl Watched {
    fn new(folder: &Path, bank: &Path, threads: usize) -> Result<Watched, Failure> {
        let inputs = discover(&[folder.to_owned()], None).map_err(|error| error.to_string())?;
        let first = inputs.first().map(|input| PathBuf::from(input.name())).ok_or("no file to change")?;
        let mut watched = Watched {
            compiler: Compiler::new(Options::new().threads(threads)),
            inputs,
            outputs: Outputs::new(bank.with_extension("watched.lipzbank")),
            memory: Memory::default(),
        };
        // The first run, and one that only allocates memory for the next.
        for changed in [None, Some(&[0][..])] {
            change(&first)?;
            watched.pack_again(changed).into_bank().map_err(|error| error.to_string())?;
        }
        change(&first)?;
        Ok(watched)
    }

    fn pack_again(&mut self, changed: Option<&[usize]>) -> Compiled<DeliveredFiles> {
        self.outputs.pack_again(&self.compiler, &self.inputs, changed, &mut self.memory)
    }

    /// Packs the changes that the system has reported.
    fn pack(&mut self, measurement: &mut Measurement) -> Result<(), Failure> {
        let start = Instant::now();
        let packed = self.pack_again(Some(&[0]));
        if packed.is_unchanged {
            return Err("the file that changed left the bank as it was".to_owned());
        }
        measurement.phases = phases(Duration::ZERO, start.elapsed(), &packed.phases);
        let delivered = packed.into_bank().map_err(|error| error.to_string())?;
        measurement.bank_bytes = delivered.files.first().map(|file| file.length_bytes as u64);
        Ok(())
    }
}

/// Checks with a separate cache, and only what the compiler checks.
fn check(folder: &Path, bank: &Path, threads: usize) -> Result<(), Failure> {
    let inputs = discover(&[folder.to_owned()], None).map_err(|error| error.to_string())?;
    let compiler = Compiler::new(Options::new().threads(threads));
    let nothing = |_: &Input, _: &[u8]| LintResult::default();
    let checked = compiler.check_cached(&inputs, &nothing, &bank.with_extension("checked.cache"), b"");
    match checked.compiled.reports.iter().flat_map(|report| &report.diagnostics).next() {
        Some(diagnostic) => Err(format!("checking made-up clips: {}", diagnostic.message)),
        None => Ok(()),
    }
}

/// Finds the inputs and passes them to `pack`. Measures its phases.
fn packing(
    folder: &Path,
    measurement: &mut Measurement,
    pack: impl FnOnce(&[Input]) -> Compiled<OutputFile>,
) -> Result<(), Failure> {
    let start = Instant::now();
    let (inputs, reports) = discover_with_reports(&[folder.to_owned()], None);
    let discovered = start.elapsed();
    let start = Instant::now();
    let compiled = pack(&inputs);
    let packing = start.elapsed();
    let diagnostic = reports.iter().chain(&compiled.reports).flat_map(|report| &report.diagnostics).next();
    if let Some(diagnostic) = diagnostic {
        return Err(format!("packing made-up clips: {}", diagnostic.message));
    }
    measurement.bank_bytes = compiled.bank.map(|file| file.length_bytes as u64);
    measurement.phases = phases(discovered, packing, &compiled.phases);
    Ok(())
}

fn phases(discovered: Duration, packing: Duration, phases: &Phases) -> Vec<(String, f64)> {
    let accounted = phases.cache + phases.files + phases.localise + phases.lower + phases.finish;
    let parts = [
        ("discover", discovered),
        ("cache", phases.cache),
        ("files", phases.files),
        ("(recall, all threads)", phases.recall),
        ("(read, all threads)", phases.read),
        ("(parse, all threads)", phases.parse),
        ("(check, all threads)", phases.check),
        ("localise", phases.localise),
        ("lower", phases.lower),
        ("verify; write and sync", phases.finish),
        ("in no phase", packing.saturating_sub(accounted)),
    ];
    parts.map(|(name, time)| (name.to_owned(), time.as_secs_f64())).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_of_work_gets_through() {
        let temporary = lipz_benches::temporary_folder().unwrap();
        let folder = temporary.path().join("clips");
        let bank = temporary.path().join("measured.lipzbank");
        lipz_benches::write_clips(230, 12, 3, &folder).unwrap();
        let mut sizes = Vec::new();
        for work in Work::ALL {
            let measurement = run(work, &folder, &bank, 2).unwrap();
            assert!(measurement.seconds > 0.0);
            assert_eq!(measurement.peak_bytes.is_some(), cfg!(target_os = "linux"));
            sizes.extend(measurement.bank_bytes);
            let parts = measurement.phases.iter().filter(|(name, _)| !name.starts_with('('));
            assert!(parts.map(|(_, seconds)| seconds).sum::<f64>() <= measurement.seconds);
        }
        let [whole, stripped, again, watched] = sizes[..] else { panic!("{sizes:?}") };
        assert!(stripped < whole && whole <= again && again <= watched, "a longer text each time: {sizes:?}");
    }
}
