//! Options of a project for texts: limits of screens and reading speed, literal braces.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::Bank;
use lipz_compiler::{Compiler, Input, Options, TextLimits};
use lipz_diagnostics::Code;

/// Returns codes and marked characters of the diagnostics in one file.
fn diagnostics(file: &str, options: &Options) -> Vec<(Code, String, String)> {
    let compiled = Compiler::new(options.clone()).compile(&[Input::from_bytes("clip", file)]);
    let found = compiled.reports.iter().flat_map(|report| report.diagnostics.iter().map(move |found| (report, found)));
    found
        .map(|(report, found)| {
            let span = found.primary.as_ref().unwrap().span;
            (found.code, report.source.text[span.range()].to_owned(), found.message.clone())
        })
        .collect()
}

fn limits(text_limits: TextLimits) -> Options {
    Options::new().text_limits(text_limits)
}

#[test]
fn lines_are_measured_in_columns() {
    let options = limits(TextLimits::new().line_columns(8));
    let file = r#"{ "text_en-us": "{aside} 12345678\nabc | 123456789 |x", "text_ja-jp": "いいえ。|いいえいえ|e\u0301e\u0301e\u0301e\u0301e\u0301" }"#;
    let found = diagnostics(file, &options);
    let marked: Vec<_> = found.iter().map(|(code, marked, _)| (*code, marked.as_str())).collect();
    assert_eq!(marked, [(Code::TextTooWide, "123456789"), (Code::TextTooWide, "いいえいえ")]);
    assert_eq!(found[1].2, "a line of this text has 10 columns, but the limit is 8");
}

#[test]
fn lines_are_counted() {
    let options = limits(TextLimits::new().lines(2));
    let found = diagnostics(r#"{ "text_en-us": " a\nb | a\nb\nc " }"#, &options);
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].0, found[0].1.as_str()), (Code::TooManyLines, r"a\nb\nc"));
}

#[test]
fn reading_takes_the_time_of_the_segment() {
    let options = limits(TextLimits::new().characters_per_second(10.0));
    // Half a second, one second, no time. Five characters can be read in half a second.
    let file = r#"{ "fps": 4, "visemes": "AA|AAAA||", "text_en-us": "12345|1234567890!|in no time|" }"#;
    let found = diagnostics(file, &options);
    let marked: Vec<_> = found.iter().map(|(code, marked, _)| (*code, marked.as_str())).collect();
    assert_eq!(marked, [(Code::ReadsTooFast, "1234567890!"), (Code::ReadsTooFast, "in no time")]);
    assert_eq!(found[0].2, "11 characters in 1.00 s are 11.0 per second, but the limit is 10");
    // Without a frame rate or visemes, the time is unknown.
    assert!(diagnostics(r#"{ "visemes": "A", "text_en-us": "1234567890!" }"#, &options).is_empty());
    assert!(diagnostics(r#"{ "fps": 4, "text_en-us": "1234567890!" }"#, &options).is_empty());
}

/// Published guides have 20 characters a second for English, 12 for Korean, 9 for Chinese and 4 for Japanese.
#[test]
fn a_language_has_its_own_limits() {
    let english = TextLimits::new().characters_per_second(20.0).line_columns(42);
    let options = limits(english).locale_limits("ja", TextLimits::new().characters_per_second(4.0)).unwrap();
    let options = options.locale_limits("zh-tw", TextLimits::new().lines(1)).unwrap();
    let file = r#"{ "fps": 4, "visemes": "AAAA", "text_en-us": "1234567890", "text_ja-jp": "いいえいえ", "text_zh-tw": "a\nb" }"#;
    let found = diagnostics(file, &options);
    let messages: Vec<&str> = found.iter().map(|(_, _, message)| message.as_str()).collect();
    let japanese = "5 characters in 1.00 s are 5.0 per second, but the limit is 4";
    assert_eq!(messages, [japanese, "this text has 2 lines, but the limit is 1"]);
    let japanese = options.get_text_limits_of("ja-jp");
    assert_eq!((japanese.get_line_columns(), japanese.get_characters_per_second()), (Some(42), Some(4.0)));
}

#[test]
fn a_segment_is_shown_for_a_minimum_of_time() {
    let options = limits(TextLimits::new().shortest_seconds(0.8));
    let found = diagnostics(r#"{ "fps": 4, "visemes": "AAA|AAAA|A", "text_en-us": "Hi|you|" }"#, &options);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(
        (found[0].0, found[0].2.as_str()),
        (Code::ReadsTooFast, "this text is shown for 0.75 s, but the minimum is 0.8 s")
    );
}

/// A shorter text is shown for as short a time, so only the help for fast texts suggests one.
#[test]
fn the_help_depends_on_the_limit() {
    let help = |text_limits: TextLimits| {
        let file = r#"{ "fps": 4, "visemes": "AAA|AAAA", "text_en-us": "Hi|" }"#;
        let compiled = Compiler::new(limits(text_limits)).compile(&[Input::from_bytes("clip", file)]);
        compiled.reports.iter().flat_map(|report| &report.diagnostics).find_map(|found| found.help.clone()).unwrap()
    };
    assert!(help(TextLimits::new().characters_per_second(2.0)).starts_with("shorten the text, or move"));
    assert!(help(TextLimits::new().shortest_seconds(0.8)).starts_with("move the `|`"));
}

#[test]
fn many_diagnostics_are_counted() {
    let options = limits(TextLimits::new().line_columns(1));
    assert_eq!(diagnostics(r#"{ "text_en-us": "aa|aa|aa|aa|aa" }"#, &options).len(), 3);
}

#[test]
fn literal_braces_are_displayed() {
    let file = r#"{ "text_en-us": " Take {0} of {max} | } odd { " }"#;
    let options = Options::new().literal_braces(true);
    assert!(diagnostics(file, &options).is_empty());
    let bytes = Compiler::new(options.clone()).compile(&[Input::from_bytes("clip", file)]).bank.unwrap();
    let bank = Bank::open(&bytes).unwrap();
    let clip = bank.clip_by_key("clip").unwrap();
    let english = bank.locale("en-us").unwrap();
    let texts: Vec<_> = clip.segments().map(|segment| segment.text(english).unwrap().as_str()).collect();
    assert_eq!(texts, ["Take {0} of {max}", "} odd {"]);
    assert_eq!(diagnostics(file, &Options::default()).len(), 2);
}

/// A clip has at most 65,535 segments, and each segment a text with as many bytes. All texts of a clip can have more.
#[test]
fn what_belongs_to_one_clip_has_limits() {
    let texts = |parts: &[usize]| parts.iter().map(|&length| "x".repeat(length)).collect::<Vec<_>>().join("|");
    let compiled = |text: &str| {
        let file = format!(r#"{{ "text_en-us": "{text}" }}"#);
        Compiler::default().compile(&[Input::from_bytes("clip", file)])
    };
    let bank = compiled(&texts(&[0, 0xFFFF, 0, 0xFFFF, 3])).bank.unwrap();
    let bank = Bank::open(&bank).and_then(Bank::verify).unwrap();
    let (locale, clip) = (bank.locale("en-us").unwrap(), bank.clip_by_key("clip").unwrap());
    let lengths: Vec<_> = clip.segments().map(|segment| segment.text(locale).unwrap().len()).collect();
    assert_eq!(lengths, [0, 0xFFFF, 0, 0xFFFF, 3]);
    assert!(compiled(&texts(&[1; 0xFFFF])).bank.is_some());

    let message = |text: &str| compiled(text).reports.pop().and_then(|mut report| report.diagnostics.pop()).unwrap();
    let long = message(&texts(&[1, 0x1_0000]));
    assert_eq!(long.code, Code::BankTooLarge);
    assert_eq!(long.message, "the text of a segment has 65536 bytes, but a bank stores at most 65535");
    let many = message(&texts(&[1; 0x1_0000]));
    assert_eq!(many.code, Code::BankTooLarge);
    assert_eq!(many.message, "the clip has 65536 segments, but a bank stores at most 65535");
}
