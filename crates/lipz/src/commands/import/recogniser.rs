//! `lipz import recogniser`: converts a neural network that recognises phones for `lipz sync`.

use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::input_file::unreadable;
use crate::shared::output_file;
use crate::shared::run_flags::QuietFlag;
use crate::{Outcome, console};
use clap::Args;
use lipz_diagnostics::{Code, Report, escape};
use lipz_sync::{Recogniser, RecogniserError};
use serde_json::Value;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The network, and the file next to it with the names of its tokens.
const NETWORK: &str = "asr_waveform.hama";
const TOKENS: &str = "g2p_vocab.json";
/// The tokens that the network has after those of that file, in this order.
const OWN_TOKENS: [&str; 2] = ["<wb>", "<blank>"];

/// Convert a neural network that recognises phones in recordings without a text.
///
/// lipz does not include a network. Get the Python package `hama` (version 1.7.0), read its licence, and unpack it. Its folder
/// `hama/assets` has the files asr_waveform.hama and g2p_vocab.json.
///
/// `recogniser` in [sync] of lipz.toml names the file that this command writes.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import recogniser hama/assets -o phones.lipznet
  lipz import recogniser hama/assets/asr_waveform.hama -o phones.lipznet")]
pub(crate) struct RecogniserArguments {
    /// asr_waveform.hama, with g2p_vocab.json next to it, or their folder
    #[arg(value_name = "FILE")]
    source: PathBuf,

    /// File to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for RecogniserArguments {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let network = if self.source.is_dir() { self.source.join(NETWORK) } else { self.source.clone() };
        let names = network.with_file_name(TOKENS);
        output_file::refuse_source(&self.output, reporter)?;
        let files = [("the network", network.as_path()), ("the tokens", &names), ("the output", &self.output)];
        output_file::refuse_same(&files, reporter)?;
        let hama = read(&network, reporter)?;
        let tokens = tokens(&read(&names, reporter)?).ok_or_else(|| {
            let message = "the names of the tokens cannot be used: the list `decoder` of strings is missing";
            reporter.fail(unusable(&names, message))
        })?;
        let bytes = Recogniser::convert(&hama, &tokens);
        let bytes = bytes.and_then(|bytes| Recogniser::from_bytes(&bytes).map(|_| bytes)).map_err(|error| {
            let why = match error {
                RecogniserError::OtherFile => "it is not a network of `hama`".to_owned(),
                error => error.to_string(),
            };
            reporter.fail(unusable(&network, format!("the network cannot be used: {why}")))
        })?;
        output_file::write(&self.output, &bytes, reporter)?;
        if !self.quiet.is_set() {
            let place = console::path(&self.output);
            reporter.summary(&format!("recogniser of {} tokens written to {place}\n", tokens.len()))?;
        }
        Ok(Outcome::Clean)
    }
}

/// Reads a file, up to the maximum size of a network.
fn read(path: &Path, reporter: &mut Reporter) -> Result<Vec<u8>, Abort> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(Recogniser::LONGEST_FILE).read_to_end(&mut bytes));
    read.map_err(|error| reporter.fail(unreadable(path, &error)))?;
    Ok(bytes)
}

/// Returns the names of all tokens.
fn tokens(vocabulary: &[u8]) -> Option<Vec<String>> {
    let vocabulary: Value = serde_json::from_slice(vocabulary).ok()?;
    let names = vocabulary.get("decoder")?.as_array()?.iter().map(|name| name.as_str().map(str::to_owned));
    names.chain(OWN_TOKENS.map(|name| Some(name.to_owned()))).collect()
}

fn unusable(path: &Path, message: impl Into<String>) -> Report {
    let help = "get version 1.7.0 of the Python package `hama` again";
    Report::failure(escape::text(&path.to_string_lossy()).into_owned(), Code::UnusableModel, message, help)
}
