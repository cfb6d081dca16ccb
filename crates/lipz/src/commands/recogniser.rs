//! `lipz recogniser`: a neural network that hears phones, as `lipz sync` reads it.

use crate::commands::Run;
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::formats::unreadable;
use crate::shared::output_file;
use crate::{Outcome, console};
use clap::Args;
use lipz_diagnostics::{Code, Report, escape};
use lipz_sync::{Recogniser, RecogniserError};
use serde_json::Value;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The network, and the file beside it with the names of its tokens.
const NETWORK: &str = "asr_waveform.hama";
const TOKENS: &str = "g2p_vocab.json";
/// What the network names besides the tokens of that file, in this order.
const OWN_TOKENS: [&str; 2] = ["<wb>", "<blank>"];

/// Convert a neural network that hears phones, for recordings without a text.
///
/// lipz has no such network: get the Python package `hama` (version 1.7.0), look at its licence, and unpack it. Its folder
/// `hama/assets` has the files asr_waveform.hama and g2p_vocab.json.
///
/// `lipz sync --recogniser FILE` uses what this command writes.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz recogniser hama/assets -o phones.lipznet
  lipz recogniser hama/assets/asr_waveform.hama -o phones.lipznet")]
pub(crate) struct RecogniserArguments {
    /// asr_waveform.hama, with g2p_vocab.json beside it; or their folder
    #[arg(value_name = "FILE")]
    source: PathBuf,

    /// The file to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Print nothing but diagnostics
    #[arg(short, long)]
    quiet: bool,
}

impl Run for RecogniserArguments {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let network = if self.source.is_dir() { self.source.join(NETWORK) } else { self.source.clone() };
        let names = network.with_file_name(TOKENS);
        output_file::refuse_source(&self.output, reporter)?;
        let files = [("the network", network.as_path()), ("the tokens", &names), ("the output", &self.output)];
        output_file::refuse_same(&files, reporter)?;
        let hama = read(&network, reporter)?;
        let tokens = tokens(&read(&names, reporter)?).ok_or_else(|| {
            let message = "the names of the tokens cannot be used: there is no list `decoder` of strings";
            reporter.fail(unusable(&names, message))
        })?;
        let bytes = Recogniser::convert(&hama, &tokens);
        let bytes = bytes.and_then(|bytes| Recogniser::from_bytes(&bytes).map(|_| bytes)).map_err(|error| {
            let why = match error {
                RecogniserError::OtherFile => "it is no network of `hama`".to_owned(),
                error => error.to_string(),
            };
            reporter.fail(unusable(&network, format!("the network cannot be used: {why}")))
        })?;
        output_file::write(&self.output, &bytes, reporter)?;
        if !self.quiet {
            let place = console::path(&self.output);
            reporter.summary(&format!("recogniser of {} tokens written to {place}\n", tokens.len()))?;
        }
        Ok(Outcome::Clean)
    }
}

/// The bytes of a file, of which no more are read than a network has.
fn read(path: &Path, reporter: &mut Reporter) -> Result<Vec<u8>, Abort> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(Recogniser::LONGEST_FILE).read_to_end(&mut bytes));
    read.map_err(|error| reporter.fail(unreadable(path, &error)))?;
    Ok(bytes)
}

/// The names of all tokens.
fn tokens(vocabulary: &[u8]) -> Option<Vec<String>> {
    let vocabulary: Value = serde_json::from_slice(vocabulary).ok()?;
    let names = vocabulary.get("decoder")?.as_array()?.iter().map(|name| name.as_str().map(str::to_owned));
    names.chain(OWN_TOKENS.map(|name| Some(name.to_owned()))).collect()
}

fn unusable(path: &Path, message: impl Into<String>) -> Report {
    let help = "get version 1.7.0 of the Python package `hama` again";
    Report::failure(escape::text(&path.to_string_lossy()).into_owned(), Code::UnusableModel, message, help)
}
