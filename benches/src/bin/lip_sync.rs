//! `cargo xtask lip-sync`: measures the speed and memory of lip sync, from a sentence to an hour.
//!
//! Each recording is processed in a separate process, to measure its peak memory. It is the sentence of
//! `fixtures/speech`, repeated with pauses. It is generated while it is read, so that it takes no memory itself.

use clap::{Parser, ValueEnum};
use cpu_time::ProcessTime;
use lipz_benches::peak_bytes;
use lipz_speech::{AlignOptions, Aligner, Language, Model, Pronouncer, RenderRules, RmsRules, Sound, render, rms};
use lipz_types::{Fps, VisemeType};
use std::hint::black_box;
use std::io::{Read, Result as IoResult, Seek, SeekFrom};
use std::process::Command;

/// Why a measurement failed.
type Failure = String;

/// "Bobby ripped the ledger.": 16 bits, one channel.
const BOBBY: &[u8] = include_bytes!("../../../fixtures/speech/bobby.wav");
const SENTENCE: &str = "Bobby ripped the ledger. ";
const HEADER_BYTES: usize = 44;
const RATE_HZ: usize = 48_000;
const SAMPLE_BYTES: usize = 2;
/// The pause after each sentence: 0.4 s.
const PAUSE_BYTES: usize = RATE_HZ / 10 * 4 * SAMPLE_BYTES;
const FILM: Fps = Fps::whole(24);

/// Measure lip sync: speed relative to real time on one core, and peak memory.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask lip-sync", max_term_width = 100)]
struct Settings {
    /// Lengths of the recordings in seconds
    #[arg(long, value_name = "SECONDS,…", value_delimiter = ',', default_value = "2,60,600,3600")]
    seconds: Vec<usize>,

    /// One task, in a separate process
    #[arg(long, hide = true)]
    work: Option<Work>,
}

/// The source of visemes.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Work {
    /// The recording and its text.
    Text,
    /// The recording alone.
    Phones,
    /// Its loudness.
    Rms,
}

fn main() -> Result<(), Failure> {
    let settings = Settings::parse();
    if let Some(work) = settings.work {
        return settings.seconds.iter().try_for_each(|&seconds| measured(work, seconds));
    }
    println!("| sound | made of | processor s | × real time | peak MB |\n| --: | --- | --: | --: | --: |");
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    for seconds in settings.seconds {
        for work in ["text", "phones", "rms"] {
            let status = Command::new(&own).args(["--seconds", &seconds.to_string(), "--work", work]).status();
            if !status.map_err(|error| error.to_string())?.success() {
                return Err(format!("{work} of {seconds} s failed"));
            }
        }
    }
    Ok(())
}

/// Generates visemes, and prints a row of the table.
fn measured(work: Work, seconds: usize) -> Result<(), Failure> {
    let source = Recording::new(seconds);
    let text = SENTENCE.repeat(source.times);
    let start = ProcessTime::now();
    let sound = Sound::read(source, Some("wav")).map_err(|error| error.to_string())?;
    let aligner = Aligner::new(Model::english(), AlignOptions::default());
    let mouth = |alignment| render(&alignment, FILM, VisemeType::Blair, &RenderRules::default());
    let (name, mouth) = match work {
        Work::Text => {
            let script = Pronouncer::new(Language::ENGLISH).script(&text);
            ("sound and text", mouth(aligner.align(&sound, &script)))
        }
        Work::Phones => ("sound alone", mouth(aligner.listen(&sound))),
        Work::Rms => ("loudness", rms(&sound, FILM, &RmsRules::default())),
    };
    black_box(mouth);
    let processor_s = start.elapsed().as_secs_f64();
    let real_s = sound.duration_us() as f64 / 1e6;
    let peak = peak_bytes().map_or_else(|| "not measured".to_owned(), |bytes| format!("{:.1}", bytes as f64 / 1e6));
    println!("| {real_s:.0} s | {name} | {processor_s:.2} | {:.0} | {peak} |", real_s / processor_s);
    Ok(())
}

/// A WAV file that repeats the sentence.
struct Recording {
    header: Vec<u8>,
    /// A sentence and a pause.
    once: Vec<u8>,
    times: usize,
    position: usize,
}

impl Recording {
    /// Returns a recording of at least this length.
    fn new(seconds: usize) -> Recording {
        let mut once = BOBBY.get(HEADER_BYTES..).unwrap_or_default().to_vec();
        once.resize(once.len() + PAUSE_BYTES, 0);
        let times = (seconds * RATE_HZ * SAMPLE_BYTES).div_ceil(once.len());
        let mut header = BOBBY.get(..HEADER_BYTES).unwrap_or_default().to_vec();
        let samples_bytes = u32::try_from(times * once.len()).unwrap_or(u32::MAX);
        for (place, length) in [(4, samples_bytes.saturating_add(36)), (40, samples_bytes)] {
            header.splice(place..place + 4, length.to_le_bytes());
        }
        Recording { header, once, times, position: 0 }
    }

    fn length(&self) -> usize {
        self.header.len() + self.times * self.once.len()
    }
}

impl Read for Recording {
    fn read(&mut self, buffer: &mut [u8]) -> IoResult<usize> {
        if self.position >= self.length() {
            return Ok(0);
        }
        let rest = match self.position.checked_sub(self.header.len()) {
            None => self.header.get(self.position..),
            Some(at) => self.once.get(at % self.once.len()..),
        };
        let count = rest.unwrap_or_default().read(buffer)?;
        self.position += count;
        Ok(count)
    }
}

impl Seek for Recording {
    fn seek(&mut self, to: SeekFrom) -> IoResult<u64> {
        let (from, by) = match to {
            SeekFrom::Start(at) => (0, i64::try_from(at).unwrap_or(i64::MAX)),
            SeekFrom::End(by) => (self.length(), by),
            SeekFrom::Current(by) => (self.position, by),
        };
        self.position = from.saturating_add_signed(isize::try_from(by).unwrap_or_default());
        Ok(self.position as u64)
    }
}
