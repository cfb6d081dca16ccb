//! What a project asks of the texts of a bank as a whole.

use crate::check::locales::in_no_list;
use crate::{MinCoverage, Options, coverage, pseudo, shortfalls};
use lipz_bank::Bank;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::locale;

/// Whether as much is translated as the project asks for.
pub(super) fn enough_texts(bank: &[u8], options: &Options) -> Result<(), Report> {
    if options.min_coverage == MinCoverage::default() {
        return Ok(());
    }
    // A damaged bank is found by who verifies it.
    let Ok(bank) = Bank::open(bank) else { return Ok(()) };
    let shortfalls = shortfalls(&coverage(&bank), &options.min_coverage);
    if shortfalls.is_empty() { Ok(()) } else { Err(Report::all_about("", shortfalls)) }
}

/// A diagnostic for each locale that the project packs and the bank does not have, at the project's level.
pub(super) fn locales_without_texts(bank: &[u8], options: &Options) -> Report {
    let (Some(packed), Ok(bank)) = (&options.locales, Bank::open(bank)) else { return Report::default() };
    let is_absent = |tag: &&String| bank.locale(tag).is_none() && !pseudo::is_pseudo(tag);
    let mut diagnostics = packed.iter().filter(is_absent).map(|tag| without_texts(tag)).collect();
    options.levels.apply(&mut diagnostics);
    Report::all_about("", diagnostics)
}

fn without_texts(tag: &str) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(Code::LocaleWithoutTexts, format!("`{tag}` is to be packed, but no clip has a text in it"));
    match Some(tag).filter(|tag| locale::has_lipz_shape(tag)).and_then(in_no_list) {
        Some(what) => diagnostic.note(what).help("is it misspelt?"),
        None => diagnostic.help("is it misspelt? if not, leave it out until there are texts"),
    }
}
