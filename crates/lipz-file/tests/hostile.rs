//! Malicious files are parsed in linear time, without deep recursion.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use lipz_diagnostics::{Code, Severity};
use lipz_file::parse;

/// Time and memory are not measured here, because a timed test proves nothing on a shared machine. With anything
/// quadratic, or one stack frame per level, these tests would not end.
fn errors(text: &str) -> Vec<Code> {
    let parsed = parse(text.as_bytes());
    parsed.diagnostics.iter().filter(|found| found.severity == Severity::Error).map(|found| found.code).collect()
}

#[test]
fn deep_nesting() {
    let levels = 2_000_000;
    let closed = format!("{{\"x\":{}{}}}", "[".repeat(levels), "]".repeat(levels));
    assert_eq!(errors(&closed), []);
    assert_eq!(errors(&format!("{{\"x\":{}", "[{\"a\":".repeat(levels))), [Code::UnfinishedFile]);
    assert_eq!(errors(&"[".repeat(levels)), [Code::RootNotObject]);
    assert_eq!(errors(&"{\"a\":".repeat(levels)), [Code::UnfinishedFile]);
}

#[test]
fn long_strings() {
    let plain = "x".repeat(10_000_000);
    assert_eq!(errors(&format!("{{\"text_en-us\":\"{plain}\"}}")), []);
    let escaped = "\\u00e9".repeat(2_000_000);
    assert_eq!(errors(&format!("{{\"text_en-us\":\"{escaped}\"}}")), []);
    assert_eq!(errors(&format!("{{\"text_en-us\":\"{escaped}\\uD800\"}}")), [Code::BadEscape]);
    assert_eq!(errors(&format!("{{\"text_en-us\":\"{plain}")), [Code::UnfinishedFile]);
    assert_eq!(errors(&"\n".repeat(10_000_000)), [Code::EmptyFile]);
    assert_eq!(errors(&format!("{}{{,}}", "\n".repeat(10_000_000))), [Code::JsonSyntax]);
}

#[test]
fn many_elements() {
    let unknown: Vec<String> = (0..100_000).map(|number| format!("\"key-{number}\": {number}")).collect();
    let text = format!("{{{}}}", unknown.join(","));
    assert_eq!(parse(text.as_bytes()).document.unwrap().elements.len(), 100_000);
    let twice = format!("{{{},{}}}", unknown.join(","), unknown.join(","));
    let parsed = parse(twice.as_bytes());
    assert_eq!(parsed.diagnostics.iter().map(lipz_diagnostics::Diagnostic::count).sum::<usize>(), 100_000);
    assert_eq!(parsed.diagnostics.len(), 1_001);
}

/// All on one line: nothing searches for its end more than once.
#[test]
fn many_mistakes() {
    let all = |element: &str| format!("{{{}}}", vec![element; 200_000].join(","));
    for element in [
        "'x':1",
        "x:1",
        "\"x\"=1",
        "\"x\":024",
        "\"x\":1 fps",
        "\"x\":“y”",
        "\"x\":[1,]",
        "\"x\":\"\\d\"",
        "",
        "\"x\":1,/**/",
    ] {
        let parsed = parse(all(element).as_bytes()).diagnostics;
        assert!(parsed.iter().map(lipz_diagnostics::Diagnostic::count).sum::<usize>() >= 199_998, "{element}");
    }
    for lost in ["\"x\":\"y\"z\"", "\"x\":' y", "\"x\":y z", "{"] {
        assert!(parse(all(lost).as_bytes()).diagnostics.len() < 50, "{lost}");
    }
}
