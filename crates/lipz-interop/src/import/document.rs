//! The Lipz document of an imported clip.

use crate::frames::ShapeRun;
use crate::segments::Division;
use crate::{ImportOptions, Text, Time, TimedText, Track};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, trim};
use lipz_file::{Document, Element, JsonString, RawJson, Value};
use lipz_types::VisemeType;
use std::borrow::Cow;

/// Returns the texts of the clip with their locales. Reports texts without a locale.
pub(super) fn texts(track: &Track, options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Text> {
    let given = options.text.map(|text| vec![Text { locale: None, text: text.to_owned() }]);
    let mut texts = given.unwrap_or_else(|| track.texts.clone());
    for text in &mut texts {
        if text.locale.is_none() {
            text.locale = options.locale.map(str::to_owned);
        }
    }
    let before = texts.len();
    texts.retain(|text| text.locale.is_some());
    if texts.len() < before {
        diagnostics.push(
            Diagnostic::new(Code::TextLeftOut, "the text is left out because its locale is unknown")
                .help("name the locale of the text, or set default-locale = \"en-us\" in lipz.toml"),
        );
    }
    for (index, text) in texts.iter().enumerate() {
        let Some(locale) = &text.locale else { continue };
        if texts.iter().take(index).any(|before| before.locale == text.locale) {
            let message = format!("two texts have the locale {}", escape::quoted(locale));
            diagnostics.push(Diagnostic::new(Code::SameLocaleTwice, message).help("keep one of them"));
        }
    }
    texts
}

/// Shapes assigned to frames.
pub(super) struct OnFrames {
    /// The codes of all frames.
    pub(super) codes: String,
    /// The start of each shape, and its first frame.
    starts: Vec<(Time, usize)>,
    rate: Rate,
}

impl OnFrames {
    pub(super) fn new(runs: &[ShapeRun], lengths: &[usize], rate: Rate) -> OnFrames {
        let mut frames = OnFrames { codes: String::new(), starts: Vec::with_capacity(runs.len() + 1), rate };
        for (run, &length) in runs.iter().zip(lengths) {
            frames.starts.push((run.start, frames.codes.len()));
            frames.codes.extend(std::iter::repeat_n(char::from(run.code), length));
        }
        frames
    }

    /// Returns the frame for a time. The start of a shape becomes its first frame, wherever that was moved.
    fn frame(&self, time: Time) -> usize {
        match self.starts.binary_search_by(|(start, _)| start.cmp(&time)) {
            Ok(found) => self.starts.get(found).map_or(self.codes.len(), |(_, frame)| *frame),
            Err(_) => usize::try_from(time.nearest_frame(self.rate)).unwrap_or(self.codes.len()),
        }
    }

    /// Returns the codes with `|` where segments start.
    pub(super) fn divided(&self, division: &Division) -> String {
        let mut divided = String::with_capacity(self.codes.len() + division.starts.len());
        let mut done = 0;
        for start in &division.starts {
            let frame = self.frame(*start).clamp(done, self.codes.len());
            divided.push_str(self.codes.get(done..frame).unwrap_or_default());
            divided.push(DELIMITER);
            done = frame;
        }
        divided + self.codes.get(done..).unwrap_or_default()
    }

    /// Returns stretches of text that start on frames.
    pub(super) fn timed(&self, stretches: &[TimedText]) -> Vec<TimedText> {
        let on_frame = |timed: &TimedText| TimedText {
            start: Time::of_frame(self.frame(timed.start) as u64, self.rate),
            text: timed.text.clone(),
        };
        stretches.iter().map(on_frame).collect()
    }
}

pub(super) fn document(
    track: &Track,
    codes: String,
    texts: &[Text],
    division: &Division,
    viseme_type: VisemeType,
    rate: Rate,
) -> Document<'static> {
    let mut elements = vec![element("visemes", codes)];
    for (text, parts) in texts.iter().zip(&division.texts) {
        let trimmed: Vec<&str> = parts.iter().map(|part| trim(part)).collect();
        let name = format!("text_{}", text.locale.as_deref().unwrap_or_default());
        elements.push(element(&name, trimmed.join(&DELIMITER.to_string())));
    }
    elements.push(element("viseme_type", viseme_type.name().to_owned()));
    elements.push(fps(rate));
    elements.extend(track.elements.iter().cloned());
    Document { elements }
}

/// Returns an element with a string.
pub(crate) fn element(name: &str, value: String) -> Element<'static> {
    Element { name: string(name.to_owned()), value: Value::String(string(value)) }
}

/// Returns an element with an object, as JSON.
pub(super) fn object(name: &str, json: String) -> Element<'static> {
    Element { name: string(name.to_owned()), value: Value::Other(RawJson::new(json)) }
}

/// Returns the frame rate as an element.
pub(crate) fn fps(rate: Rate) -> Element<'static> {
    Element { name: string("fps".to_owned()), value: Value::Number(RawJson::new(spell(rate))) }
}

fn string(text: String) -> JsonString<'static> {
    Cow::<'static, str>::Owned(text).into()
}

/// Returns a rate in decimal digits.
pub(crate) fn spell(rate: Rate) -> String {
    (f64::from(rate.numerator) / f64::from(rate.denominator.max(1))).to_string()
}
