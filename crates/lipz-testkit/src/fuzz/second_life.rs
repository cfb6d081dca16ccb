//! Arbitrary files as the settings of a Second Life viewer.

use super::file::is_about;
use super::foreign::has_errors;
use lipz_bank::Fps;
use lipz_interop::second_life::lip_sync;

/// Diagnostics refer to positions in the file. Either there is a reason, or the result is a babble profile.
pub fn second_life(bytes: &[u8]) {
    let mut found = Vec::new();
    let settings = lip_sync(bytes, "settings.xml", &mut found);
    if let Ok(text) = std::str::from_utf8(lipz_file::without_byte_order_mark(bytes)) {
        found.iter().for_each(|found| is_about(found, text));
    }
    let Some(settings) = settings else { return assert!(has_errors(&found), "no settings, and no reason") };
    let strings = [settings.ooh, settings.aah, settings.ooh_power_transfer, settings.aah_power_transfer];
    for digits in strings.into_iter().flatten() {
        assert!(!digits.as_str().is_empty() && digits.as_str().bytes().all(|digit| digit.is_ascii_digit()));
    }
    let rate = settings.rate.map(|rate| Fps::new(rate.numerator, rate.denominator));
    assert_ne!(rate, Some(None), "a rate that a bank cannot hold");
}
