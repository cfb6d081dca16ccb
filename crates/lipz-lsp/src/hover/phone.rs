//! Descriptions of phones.

use lipz_diagnostics::Span;
use lipz_file::{JsonString, phones};
use lipz_types::Phone;

/// Returns a description of the phone around byte `at` of the element, and its word: ``**DH**, IPA `ð`: 0.191–0.232 s``.
pub(super) fn about(string: &JsonString<'_>, at: usize) -> Option<(String, Span)> {
    let track = phones::parse(string, &mut Vec::new());
    let place = string.span_of(at..at).range().start;
    let index = track.phones.iter().position(|phone| phone.span.range().contains(&place))?;
    let phone = track.phones.get(index)?;
    let name = match phone.phone {
        Phone::SILENCE => "silence".to_owned(),
        other => format!("**{}**, IPA `{}`", other.name(), other.ipa()),
    };
    let seconds = |ms: u32| f64::from(ms) / 1000.0;
    let time = match track.phones.get(index + 1) {
        Some(next) => format!("{:.3} s–{:.3} s", seconds(phone.start_ms), seconds(next.start_ms)),
        None => format!("{:.3} s to the end of the clip", seconds(phone.start_ms)),
    };
    Some((format!("{name}: {time}"), phone.span))
}
