//! A command that packs, verifies and inspects banks with the library.

use lipz_bank::Dialogue;
use lipz_compiler::diagnostics::Report;
use lipz_compiler::diagnostics::render::human;
use lipz_compiler::inspect::{BankSummary, Timeline};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, key};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "\
Usage: bank-tool pack SOURCE -o BANK
       bank-tool verify BANK
       bank-tool inspect BANK [KEY]

The command `lipz` has more: cargo run -p lipz -- --help";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["pack", source, "-o" | "--output", bank] => pack(Path::new(source), Path::new(bank)),
        ["verify", bank] => verify(bank),
        ["inspect", bank] => inspect(bank, None),
        ["inspect", bank, key] => inspect(bank, Some(key)),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Packs a folder with the settings of its `lipz.toml`, and returns whether a bank was written.
fn pack(source: &Path, bank: &Path) -> Result<bool, Box<dyn Error>> {
    let mut settings = match Settings::find_of(&[source.to_owned()]) {
        Some(file) => Settings::read(file).map_err(|report| report.to_string())?,
        None => Settings::default(),
    };
    settings.sources = vec![source.to_owned()];
    let (inputs, mut reports) = settings.discover_with_reports();
    key::check(&inputs, &mut reports);
    let compiler = Compiler::new(settings.options.clone().voices(settings.voices()));
    if reports.iter().any(Report::has_errors) {
        eprint!("{}", human(&reports));
        return Ok(false);
    }
    let packed = compiler.pack(&inputs, bank);
    reports.extend(packed.reports);
    eprint!("{}", human(&reports));
    let Some(file) = packed.bank else { return Ok(false) };
    println!("{} clips packed into {} ({} bytes)", inputs.len(), bank.display(), file.length_bytes);
    Ok(true)
}

/// Opens and verifies a bank.
fn open(bank: &str) -> Result<lipz_host::Dialogue, Box<dyn Error>> {
    Ok(lipz_host::Dialogue::open([bank])?)
}

fn verify(bank: &str) -> Result<bool, Box<dyn Error>> {
    let dialogue = open(bank)?;
    println!("{bank}: no fault ({} clips)", dialogue.clip_count());
    Ok(true)
}

/// Shows a clip as a timeline, or a summary of the bank.
fn inspect(bank: &str, key: Option<&str>) -> Result<bool, Box<dyn Error>> {
    let files = open(bank)?;
    let dialogue = files.view();
    let Some(key) = key else {
        let summary = BankSummary::from_dialogue(dialogue);
        println!("{bank}: {} clips, {} frames, {:.1} s", summary.clips, summary.frames, summary.seconds);
        dialogue.clips().for_each(|clip| println!("  {}", clip.key()));
        return Ok(true);
    };
    let clip = dialogue.clip_by_key(key).ok_or_else(|| format!("{bank} has no clip `{key}`"))?;
    let locales = default_first(dialogue);
    print!("{}", Timeline::default().render(dialogue, &clip, &locales));
    Ok(true)
}

/// Returns the locales, the default one first: a timeline shows its text below the visemes.
fn default_first(dialogue: &Dialogue<'_>) -> Vec<lipz_bank::Locale> {
    let mut locales: Vec<_> = dialogue.locales().collect();
    locales.sort_by_key(|locale| (dialogue.default_locale() != Some(*locale), dialogue.locale_tag(*locale)));
    locales
}
