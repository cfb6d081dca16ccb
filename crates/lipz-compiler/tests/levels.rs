//! Levels of lints in a project, applied in every part of a run.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::Bank;
use lipz_compiler::{Compiled, Compiler, Input, Options};
use lipz_diagnostics::{Code, Levels, Severity};

const CLIP: &[u8] = br#"{ "text_en-us": "Aye." }"#;

fn run(files: &[(&str, &[u8])], levels: &[(Code, Option<Severity>)]) -> Compiled {
    let inputs: Vec<Input> = files.iter().map(|(key, bytes)| Input::from_bytes(*key, *bytes)).collect();
    Compiler::new(Options::new().levels(levels.iter().copied().collect::<Levels>())).compile(&inputs)
}

fn found(compiled: &Compiled) -> Vec<(Code, Severity)> {
    let diagnostics = compiled.reports.iter().flat_map(|report| &report.diagnostics);
    diagnostics.map(|diagnostic| (diagnostic.code, diagnostic.severity)).collect()
}

#[test]
fn a_warning_of_the_parser_becomes_an_error() {
    let marked = [b"\xEF\xBB\xBF", CLIP].concat();
    let denied = run(&[("aye", &marked)], &[(Code::ByteOrderMark, Some(Severity::Error))]);
    assert_eq!(found(&denied), [(Code::ByteOrderMark, Severity::Error)]);
    assert!(denied.bank.is_none());
    // Even if there is no document to check.
    let broken = run(&[("aye", b"\xEF\xBB\xBF{")], &[(Code::ByteOrderMark, None)]);
    assert_eq!(found(&broken), [(Code::UnfinishedFile, Severity::Error)]);
}

#[test]
fn keys_that_clash_elsewhere_can_be_packed() {
    let files = [("aye", CLIP), ("Aye", CLIP)];
    assert!(run(&files, &[]).bank.is_none());
    let warned = run(&files, &[(Code::KeyClash, Some(Severity::Warning))]);
    assert_eq!(found(&warned), [(Code::KeyClash, Severity::Warning)]);
    let bytes = warned.bank.unwrap();
    assert_eq!(Bank::open(&bytes).unwrap().verify().unwrap().clip_count(), 2);
}

#[test]
fn errors_without_another_meaning_stay_errors() {
    let foreign = br#"{ "viseme_type": "blair", "visemes": "AXA" }"#;
    let compiled = run(&[("aye", foreign)], &[(Code::ForeignCode, None)]);
    assert_eq!(found(&compiled), [(Code::ForeignCode, Severity::Error)]);
    assert!(compiled.bank.is_none());
}

#[test]
fn a_text_without_locale_is_kept_for_unpacking_only() {
    let file = br#"{ "text": "Aye.", "text_de-de": "Ja." }"#;
    let bytes = run(&[("aye", file)], &[(Code::TextWithoutLocale, None)]).bank.unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let tags: Vec<&str> = bank.locales().map(|locale| bank.locale_tag(locale)).collect();
    assert_eq!(tags, ["de-de"]);
}
