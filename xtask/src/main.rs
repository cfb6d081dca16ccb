//! Tasks of this workspace: `cargo xtask <task>`. Without a task it lists them.

mod accessibility;
mod bless;
mod capi;
mod cargo;
mod ci;
mod deny;
mod dist;
mod edges;
mod editors;
mod features;
mod forward;
mod fuzz;
mod mouth_score;
mod msrv;
mod packages;
mod page;
mod paths;
mod ports;
mod recogniser;
mod site;
mod size;
mod speech_dictionary;
mod speech_model;
mod speech_net;
mod speech_numbers;
mod speech_score;
mod speech_units;
mod targets;
mod toolchain;
mod tools;
mod web;
mod wheel;
mod windows;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

/// Why a task failed, printed as its last line.
type Failure = String;

/// Tasks of the lipz workspace.
#[derive(Parser, Debug)]
#[command(name = "xtask", bin_name = "cargo xtask", max_term_width = 100, disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    task: Option<Task>,
}

#[derive(Subcommand, Debug)]
enum Task {
    /// Run the checks of CI that are not tests: the everyday ones, or those named
    Ci(ci::Settings),
    /// Build the libraries for C in target/capi, and run programs in C and C++ with them
    Capi,
    /// Build the npm package for browsers and node in target/web, and test it in both
    Web,
    /// Test the npm package with bundlers and engines, which npm fetches into target/web-engines
    WebEngines,
    /// Test the readers in C#, Lua, Python and other languages, each with its own script
    Ports(ports::Settings),
    /// Draw the images in docs/pictures with the face of the npm package
    Pictures,
    /// Test the plugin for Neovim, and test and pack the extension for Visual Studio Code
    Editors,
    /// Check the page of `lipz preview` with axe in Chromium
    Accessibility,
    /// Test the page of `lipz preview` in Firefox, with the tests for Chromium
    Firefox(page::FirefoxSettings),
    /// Measure how long `lipz preview` takes to show the first of 20,000 clips
    FirstPicture,
    /// Check the dependencies between crates, and between their files
    Edges(edges::Settings),
    /// Check the licences and sources of all dependencies
    Deny,
    /// Compile each feature alone, compare banks, and count the crates of a build script
    Features,
    /// Run the reader on other machines: bare metal, big-endian, 32-bit, wasm
    Targets(targets::Settings),
    /// Compile all crates for Windows
    Windows,
    /// Measure the reader's code on a Cortex-M, which must not panic or allocate, or the command
    Size(size::Settings),
    /// Build the published packages in target/dist-packages, and test them with --check
    Dist(dist::Settings),
    /// Build the documentation site in target/site/html, and check its links
    Site,
    /// Package every crate as for publishing, and check its contents
    Packages,
    /// Build and run the published reader with the oldest supported compiler
    Msrv,
    /// Make the acoustic model of lipz-speech from a package of CMU Sphinx
    SpeechModel,
    /// Write all generated files: rules, docs, headers, expected outputs
    Bless(bless::Settings),
    /// Make the English words and letter-to-sound rules of lipz-speech from a dictionary
    SpeechDictionary(speech_dictionary::Settings),
    /// Make lipz-speech's rules for numbers in words from those of CLDR
    SpeechNumbers,
    /// Make lipz-speech's names of units from those of CLDR
    SpeechUnits,
    /// Fetch and convert the neural network that recognises phones, into target/recogniser
    Recogniser,
    /// Make lipz-speech's own neural network that recognises phones, from synthetic speech
    SpeechNet,
    /// Measure lip sync on sentences of speech synthesisers, compared with PocketSphinx
    SpeechScore,
    /// Compare computed mouths with coils on jaw and lips, and with OpenFaceFX
    MouthScore,
    /// Search for inputs that violate a guarantee for arbitrary bytes
    Fuzz(fuzz::Settings),
}

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    // Before clap, which would interpret `--` and `--help` itself.
    if let Some(forwarded) = forward::command(&arguments) {
        return forwarded;
    }
    let matches = command().get_matches();
    let Some(task) = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit()).task else {
        return match command().print_help() {
            Ok(()) => ExitCode::SUCCESS,
            Err(_) => ExitCode::from(2),
        };
    };
    let result = match task {
        Task::Bless(settings) => bless::run(&settings),
        Task::Ci(settings) => ci::run(&settings),
        Task::Capi => capi::run(),
        Task::Web => web::run(),
        Task::WebEngines => web::engines(),
        Task::Ports(settings) => ports::run(&settings),
        Task::Pictures => web::pictures(),
        Task::Editors => editors::run(),
        Task::Accessibility => accessibility::run(),
        Task::Firefox(settings) => page::firefox(&settings),
        Task::FirstPicture => page::first_picture(),
        Task::Edges(settings) => edges::run(&settings),
        Task::Deny => deny::run(),
        Task::Features => features::run(),
        Task::Targets(settings) => targets::run(&settings),
        Task::Windows => windows::run(),
        Task::Size(settings) => size::run(&settings),
        Task::SpeechNumbers => speech_numbers::run(),
        Task::SpeechUnits => speech_units::run(),
        Task::Recogniser => recogniser::run(),
        Task::SpeechNet => speech_net::run(),
        Task::SpeechScore => speech_score::run(),
        Task::MouthScore => mouth_score::run(),
        Task::SpeechDictionary(settings) => speech_dictionary::run(&settings),
        Task::Dist(settings) => dist::run(&settings),
        Task::Site => site::run(),
        Task::Packages => packages::run(),
        Task::Msrv => msrv::run(),
        Task::SpeechModel => speech_model::run(),
        Task::Fuzz(settings) => fuzz::run(&settings),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// Returns the command line of this program. Its help includes the forwarded tasks.
fn command() -> clap::Command {
    Arguments::command().after_help(forward::help())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn every_task_is_listed_with_one_line() {
        for task in Arguments::command().get_subcommands() {
            let about = task.get_about().map(ToString::to_string).unwrap_or_default();
            assert!(!about.is_empty() && about.len() < 90 && !about.contains('\n'), "{}: {about}", task.get_name());
        }
    }
}
