//! Arbitrary files as Lipz files.

use lipz_compiler::{Compiler, Input, Options};
use lipz_diagnostics::{Code, Diagnostic, Report, Severity, Span};
use lipz_file::format::{LineEnding, Style, format};

/// Parses and checks any bytes: every diagnostic has its positions in the file, and without errors there is a bank.
pub fn parse(bytes: &[u8]) {
    let parsed = lipz_file::parse(bytes);
    let text = Report::from_bytes("", bytes, Vec::new()).source.text;
    parsed.diagnostics.iter().for_each(|found| is_about(found, &text));
    let has_errors = |found: &[Diagnostic]| found.iter().any(|found| found.severity == Severity::Error);
    assert!(parsed.document.is_some() || has_errors(&parsed.diagnostics), "no document, and no reason");
    assert!(parsed.document.is_none() || parsed.fragment.is_none(), "a whole and a part of it");
    for element in parsed.fragment.iter().flat_map(|fragment| &fragment.document.elements) {
        let spans = [element.name.span(), element.value.span()];
        assert!(spans.iter().all(|span| text.get(span.range()).is_some()), "outside of the text: {element:?}");
    }

    let compiled = Compiler::default().compile(&[Input::from_bytes("clip", bytes)]);
    for report in &compiled.reports {
        report.diagnostics.iter().for_each(|found| is_about(found, &report.source.text));
    }
    assert_eq!(compiled.bank.is_none(), compiled.reports.iter().any(|report| has_errors(&report.diagnostics)));
    if parsed.document.is_some() {
        the_long_way_is_the_same(bytes);
    }
}

/// A name with an escape has the same meaning, but only the full parser reads it. The fast path for clean files must
/// make the same bank.
fn the_long_way_is_the_same(bytes: &[u8]) {
    let Some(start) = bytes.iter().position(|byte| *byte == b'"').map(|quote| quote + 1) else { return };
    let Some((first, rest)) = bytes[start..].split_first().filter(|(first, _)| first.is_ascii_alphanumeric()) else {
        return;
    };
    let escaped = [&bytes[..start], format!("\\u00{first:02x}").as_bytes(), rest].concat();
    // Texts are clean in locales that were used before.
    let before = r#"{"text_en-us":"Aye.","text_de-de":"Nun.","text_fr-fr":"Oui."}"#;
    let bank = |bytes: &[u8]| {
        let inputs = [Input::from_bytes("a", before), Input::from_bytes("clip", bytes)];
        Compiler::new(Options::new().threads(1).default_locale("en-us").expect("a locale")).compile(&inputs).bank
    };
    assert!(bank(bytes) == bank(&escaped), "the short way makes another bank");
}

/// Checks that the marked positions of a diagnostic are ranges of the text.
pub(super) fn is_about(found: &Diagnostic, text: &str) {
    let labels = found.primary.iter().chain(&found.labels).map(|label| label.span);
    let spans: Vec<Span> = labels.chain(found.fixes().map(|fix| fix.span)).collect();
    assert!(spans.iter().all(|span| text.get(span.range()).is_some()), "outside of the text: {found:?}");
    assert!(!found.message.is_empty());
}

/// A written document is parsed to an equal one. Formatting or fixing it again changes nothing. Both preserve the bank,
/// for any lowered levels.
pub fn rewrite(bytes: &[u8]) {
    let banks = banks(bytes);
    if let Some(fixed) = Compiler::default().fix(bytes) {
        assert_same(&banks, fixed.text.as_bytes());
        let again = Compiler::default().fix(fixed.text.as_bytes());
        // One run fixes a hundred errors.
        assert!(again.is_none() || fixed.counts.values().sum::<usize>() >= 100, "{}", fixed.text);
    }
    let Some(document) = lipz_file::parse(bytes).document else { return };
    let written = lipz_file::write(&document);
    assert_eq!(lipz_file::parse(written.as_bytes()).document.as_ref(), Some(&document), "{written}");
    for line_ending in [LineEnding::Lf, LineEnding::CrLf] {
        let style = Style { default_locale: Some("en-us"), line_ending };
        let once = format(&document, style);
        let reread = lipz_file::parse(once.as_bytes()).document.expect("what was formatted is read");
        assert_eq!(format(&reread, style), once);
        assert_same(&banks, once.as_bytes());
    }
}

/// Returns the banks that projects make of a file, without source records; `None` if it has errors.
fn banks(bytes: &[u8]) -> [Option<Vec<u8>>; 2] {
    let lowered = || Options::new().strip(true).levels([(Code::SegmentCount, Some(Severity::Warning))]);
    [lowered(), lowered().default_locale("en-us").expect("a locale")]
        .map(|options| Compiler::new(options).compile(&[Input::from_bytes("clip", bytes)]).bank)
}

/// Checks that each existing bank is still the same.
fn assert_same(before: &[Option<Vec<u8>>; 2], after: &[u8]) {
    for (before, after) in before.iter().zip(banks(after)) {
        assert!(before.is_none() || *before == after, "another bank");
    }
}
