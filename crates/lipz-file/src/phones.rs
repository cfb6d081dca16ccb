//! The element `phones`: the sounds of a recording and when each starts, from which faces compute their mouths.
//!
//! ```json
//! "phones" : "-21dB sil@0 DH@191 AH@232 B@273 sil@410"
//! ```
//!
//! Times are in milliseconds from the start of the clip. A phone ends where the next one starts, and the last one ends
//! with the clip. Two optional words come first: `guessed`, if the phones were recognised without the text of the
//! recording, and the level of the speech in decibels relative to full scale.

use crate::JsonString;
use crate::text::is_white_space;
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_types::Phone;

/// The name of the element.
pub const ELEMENT: &str = "phones";

/// The word for phones that were recognised without a text.
const GUESSED: &str = "guessed";
/// The end of the word for the level.
const DECIBELS: &str = "dB";
/// The separator of a phone and its time.
const AT: char = '@';
/// The most words of one element that are reported. With more, the value is probably something else.
const REPORTED: usize = 5;

/// A phone in a file, with its position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TimedPhone {
    /// The phone.
    pub phone: Phone,
    /// The start in milliseconds.
    pub start_ms: u32,
    /// The position in the file.
    pub span: Span,
}

/// The phones of a clip, in the order of their times.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct PhoneTrack {
    /// Whether the phones were recognised without the text of the recording.
    pub is_guessed: bool,
    /// The level of the speech in decibels relative to full scale, from -127 to 0.
    pub level_db: Option<i8>,
    /// The phones.
    pub phones: Vec<TimedPhone>,
}

/// Returns the phones of an element with this value. Reports invalid words, and omits them.
///
/// ```
/// use lipz_file::{Value, phones};
/// let document = lipz_file::parse(br#"{ "phones": "sil@0 DH@191 AH@232" }"#).document.ok_or("a valid file")?;
/// let Value::String(string) = &document.elements[0].value else { return Err("a string") };
/// let mut diagnostics = Vec::new();
/// let track = phones::parse(string, &mut diagnostics);
/// assert_eq!((track.phones[1].phone.name(), track.phones[1].start_ms), ("DH", 191));
/// assert!(diagnostics.is_empty());
/// # Ok::<(), &str>(())
/// ```
pub fn parse(string: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> PhoneTrack {
    let mut track = PhoneTrack::default();
    let mut wrong = Vec::new();
    for word in words(&string.text) {
        let start = word.as_ptr() as usize - string.text.as_ptr() as usize;
        let place = |part: &str| {
            let start = start + (part.as_ptr() as usize - word.as_ptr() as usize);
            string.span_of(start..start + part.len())
        };
        if track.phones.is_empty() && heading(word, &mut track) {
            continue;
        }
        match timed_phone(word, &place).and_then(|phone| in_order(track.phones.last(), phone)) {
            Ok(phone) => track.phones.push(phone),
            Err(diagnostic) => wrong.push(*diagnostic),
        }
    }
    if track.phones.is_empty() && wrong.is_empty() {
        wrong.push(
            Diagnostic::at(Code::PhoneSyntax, string.span(), "the element `phones` has no phones")
                .help("write at least one phone as phone@milliseconds, such as \"sil@0\", or remove the element"),
        );
    }
    let hidden = wrong.len().saturating_sub(REPORTED);
    wrong.truncate(REPORTED);
    if let Some(last) = wrong.last_mut().filter(|_| hidden > 0) {
        last.notes.push(format!("{hidden} more invalid phones of this clip are not shown"));
    }
    diagnostics.append(&mut wrong);
    track
}

/// Returns the element's value in its canonical form: ARPAbet names where there are any, words separated by spaces.
///
/// ```
/// use lipz_file::phones;
/// use lipz_types::Phone;
/// let phones = [(Phone::SILENCE, 0), ("ð".parse()?, 191)];
/// assert_eq!(phones::write(false, Some(-21), phones), "-21dB sil@0 DH@191");
/// # Ok::<(), lipz_types::UnknownName>(())
/// ```
pub fn write(is_guessed: bool, level_db: Option<i8>, phones: impl IntoIterator<Item = (Phone, u32)>) -> String {
    let guessed = is_guessed.then(|| GUESSED.to_owned());
    let level = level_db.map(|level| format!("{level}{DECIBELS}"));
    let phones = phones.into_iter().map(|(phone, start_ms)| format!("{phone}{AT}{start_ms}"));
    guessed.into_iter().chain(level).chain(phones).collect::<Vec<_>>().join(" ")
}

/// Whether the phones of an element's value were recognised without the text of the recording.
pub fn are_guessed(value: &str) -> bool {
    words(value).next() == Some(GUESSED)
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(is_white_space).filter(|word| !word.is_empty())
}

/// Stores a word that comes before the phones. Returns whether it is one.
fn heading(word: &str, track: &mut PhoneTrack) -> bool {
    if word == GUESSED && !track.is_guessed && track.level_db.is_none() {
        track.is_guessed = true;
        return true;
    }
    let level = word.strip_suffix(DECIBELS).and_then(|level| level.parse().ok());
    match level {
        Some(level @ -127..=0) if track.level_db.is_none() => {
            track.level_db = Some(level);
            true
        }
        _ => false,
    }
}

/// Parses a word as a phone and its time.
fn timed_phone(word: &str, place: &impl Fn(&str) -> Span) -> Result<TimedPhone, Box<Diagnostic>> {
    let Some((name, start)) = word.split_once(AT) else {
        let message = format!("{} is not a phone with a time", escape::quoted(word));
        let help = match word {
            GUESSED => "write `guessed` before the level and the phones",
            _ if word.ends_with(DECIBELS) => "write the level once, before the phones, from -127dB to 0dB",
            _ => "write each phone as phone@milliseconds, such as AH@232, separated by spaces",
        };
        return Err(Diagnostic::at(Code::PhoneSyntax, place(word), message).help(help).into());
    };
    let start_ms = match start.parse() {
        Ok(number) if start.bytes().all(|byte| byte.is_ascii_digit()) => number,
        _ => {
            let message = format!("{} is not a time in milliseconds", escape::quoted(start));
            let marked = if start.is_empty() { word } else { start };
            return Err(Diagnostic::at(Code::PhoneSyntax, place(marked), message)
                .help("write a whole number of milliseconds from the start of the clip: AH@232")
                .into());
        }
    };
    let phone = name.parse().map_err(|_| unknown(name, place(if name.is_empty() { word } else { name })))?;
    Ok(TimedPhone { phone, start_ms, span: place(word) })
}

fn unknown(name: &str, span: Span) -> Box<Diagnostic> {
    let message = format!("{} is not a known phone", escape::quoted(name));
    // The digit of a stress, or lower case, is the most frequent difference.
    let plain = name.trim_end_matches(['0', '1', '2']).to_uppercase();
    let near = plain.parse::<Phone>().map(Phone::name).ok();
    let near = near.or_else(|| suggest::nearest(name, Phone::all().map(Phone::name)));
    let diagnostic = Diagnostic::at(Code::UnknownPhone, span, message);
    Box::new(match near {
        Some(near) => diagnostic.help(format!("did you mean {}?", escape::quoted(near))),
        None => diagnostic.help("write ARPAbet in capitals without stress, IPA, or `sil` for silence"),
    })
}

fn in_order(before: Option<&TimedPhone>, phone: TimedPhone) -> Result<TimedPhone, Box<Diagnostic>> {
    match before {
        Some(before) if before.start_ms >= phone.start_ms => {
            let message = match before.start_ms == phone.start_ms {
                true => format!("two phones start at {} ms", phone.start_ms),
                false => format!("the phone at {} ms comes after the phone at {} ms", phone.start_ms, before.start_ms),
            };
            Err(Diagnostic::at(Code::PhoneOrder, phone.span, message)
                .also(before.span, "the previous phone")
                .help("sort the phones by time, and give each phone its own millisecond")
                .into())
        }
        _ => Ok(phone),
    }
}
