//! Reading the tiers of a TextGrid: phones and words with their times.

use super::MICROSECONDS;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_interop::Time;
use lipz_interop::textgrid::{TextGrid, Tier, is_silence};
use lipz_speech::{AlignedPhone, AlignedWord, Phone, Script, phones_of_label};

/// Returns the first tier with this name, possibly after that of a speaker: `Mara - phones`.
pub(super) fn tier<'g>(grid: &'g TextGrid, name: &str) -> Option<&'g Tier> {
    let own = |tier: &&Tier| tier.name.rsplit(" - ").next().is_some_and(|own| own.trim().eq_ignore_ascii_case(name));
    grid.tiers.iter().filter(|tier| !tier.has_points).find(own)
}

pub(super) fn us(time: Time) -> u64 {
    time.in_units(MICROSECONDS)
}

/// Returns the phones of a tier, from 0 to the end without gaps. Reports a label that is not a phone.
pub(super) fn read_phones(
    tier: &Tier,
    start: u64,
    end: u64,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<AlignedPhone>> {
    let mut phones: Vec<AlignedPhone> = Vec::with_capacity(tier.intervals.len());
    let mut done = 0;
    let mut add = |phone: Phone, from: u64, to: u64| {
        if from < to {
            phones.push(AlignedPhone { phone, start_us: from, end_us: to, word: None, fit: 0.0 });
        }
    };
    let labels = tier
        .intervals
        .iter()
        .map(|interval| interval.label.trim())
        .filter(|label| !is_silence(label) && *label != "spn");
    // Only labels of the CMU Pronouncing Dictionary are capitalised. Some corpora write them in lower case.
    let is_capital = |label: &str| label.starts_with(|c: char| c.is_ascii_uppercase());
    let is_arpabet = labels.clone().any(is_capital) || labels.clone().all(|label| label.parse::<Phone>().is_ok());
    for interval in &tier.intervals {
        let label = interval.label.trim();
        let found = if is_silence(label) { Some(vec![Phone::Sil]) } else { phones_of_label(label, is_arpabet) };
        let Some(found) = found.filter(|found| !found.is_empty()) else {
            let message = format!("{} is not a phone, so the TextGrid is not used", escape::quoted(label));
            let help = "write all phones as in the CMU Pronouncing Dictionary (`AH`, `NG`), or all in IPA";
            let span = interval.span.unwrap_or(Span::new(0, 0));
            diagnostics.push(Diagnostic::at(Code::Pronunciation, span, message).help(help));
            return None;
        };
        let (from, to) = (us(interval.start).saturating_sub(start).max(done), us(interval.end).saturating_sub(start));
        add(Phone::Sil, done, from);
        let parts = found.len() as u64;
        let length = to.saturating_sub(from);
        // This order avoids an overflow, because a TextGrid may have any length.
        let share = |number: u64| from + length / parts * number + length % parts * number / parts;
        for (number, phone) in (0..).zip(found) {
            add(phone, share(number), share(number + 1));
        }
        done = done.max(to);
    }
    add(Phone::Sil, done, end.saturating_sub(start));
    Some(phones)
}

/// Returns the times of a script's words from a tier of words. Reports a word that is not in the script.
pub(super) fn read_words(
    tier: Option<&Tier>,
    script: &Script,
    start: u64,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<AlignedWord>> {
    let mut words: Vec<AlignedWord> = Vec::with_capacity(script.words.len());
    let mut now = 0;
    let unsaid = |now: u64| AlignedWord { start_us: now, end_us: now, pronunciation: None, confidence: 0.0 };
    let intervals = tier.map_or(&[][..], |tier| &tier.intervals);
    for interval in intervals.iter().filter(|interval| !is_silence(interval.label.trim())) {
        let label = interval.label.trim().to_lowercase();
        let rest = script.words.get(words.len()..).unwrap_or_default();
        let Some(skipped) = rest.iter().position(|word| word.text.trim().to_lowercase() == label) else {
            let message =
                format!("the word {} is not in the text, so the TextGrid is not used", escape::quoted(&label));
            let span = interval.span.unwrap_or(Span::new(0, 0));
            let help = "remove the file so that lipz writes it again for the changed text";
            diagnostics.push(Diagnostic::at(Code::TextMismatch, span, message).help(help));
            return None;
        };
        words.extend(std::iter::repeat_n(unsaid(now), skipped));
        let (start_us, end_us) = (us(interval.start).saturating_sub(start), us(interval.end).saturating_sub(start));
        words.push(AlignedWord { start_us, end_us, pronunciation: Some(0), confidence: 1.0 });
        now = end_us;
    }
    words.resize(script.words.len(), unsaid(now));
    Some(words)
}
