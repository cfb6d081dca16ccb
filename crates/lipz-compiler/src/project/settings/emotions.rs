//! `[emotions]`: the conversion of emotions to curves, and the project's own words for them.

use super::reading::SettingsReader;
use super::value::{NamedValue, is_word, span};
use crate::project::EmotionCurves;
use lipz_bank::face::Emotion;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use lipz_file::emotion::Blend;

/// The values that select the clips with curves.
const CURVES: [(&str, EmotionCurves); 3] =
    [("all", EmotionCurves::All), ("values", EmotionCurves::Values), ("off", EmotionCurves::Off)];

/// The longest duration of a change, in seconds.
const MOST_SECONDS: f64 = 60.0;

impl SettingsReader<'_> {
    /// Reads an entry of `[emotions]`: a setting, or a preset of the project.
    pub(super) fn emotions(&mut self, name: &str, value: &NamedValue<'_>) {
        match name {
            "curves" => {
                let Some(text) = value.text(&mut self.diagnostics) else { return };
                match CURVES.iter().find(|(known, _)| *known == text) {
                    Some((_, curves)) => self.settings.options.emotions.curves = *curves,
                    None => {
                        let near = suggest::nearest(text, CURVES.map(|(known, _)| known));
                        let (what, otherwise) = ("is not a value of `curves`", "write \"all\", \"values\" or \"off\"");
                        value.refuse_unknown::<()>(what, near, otherwise, &mut self.diagnostics);
                    }
                }
            }
            "value" => {
                if let Some(number) = self.within(value, 10.0) {
                    self.settings.options.emotions.usual_thousandths = (number * 1000.0).round() as i32;
                }
            }
            "over" => {
                if let Some(seconds) = self.within(value, MOST_SECONDS) {
                    self.settings.options.emotions.over_ms = (seconds * 1000.0).round() as u32;
                }
            }
            _ => self.preset(name, value),
        }
    }

    /// Returns a number from 0 to `most`.
    pub(super) fn within(&mut self, value: &NamedValue<'_>, most: f64) -> Option<f64> {
        let number: f64 = value.decimal(&mut self.diagnostics)?.parse().ok()?;
        if (0.0..=most).contains(&number) {
            return Some(number);
        }
        self.refuse(value, &format!("is not a number from 0 to {most}"), "write a number such as 0.4");
        None
    }

    /// Reads a word of the project: `smug = "joy 2 + disgust 1"`.
    fn preset(&mut self, name: &str, value: &NamedValue<'_>) {
        if !is_word(name) || !name.starts_with(char::is_alphabetic) {
            let message = format!("{} cannot be the name of an emotion", escape::quoted(name));
            let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
            return self
                .diagnostics
                .push(diagnostic.help("write one word without spaces: smug = \"joy 2 + disgust 1\""));
        }
        let Some(text) = value.text(&mut self.diagnostics) else { return };
        let mut feeling = Vec::new();
        let blend = Blend::parse(text, 0).filter(|blend| blend.over_ms.is_none());
        for term in blend.iter().flat_map(|blend| &blend.terms) {
            match Emotion::from_name(term.name.text) {
                Some(emotion) if term.thousandths.is_none_or(|value| (0..=10_000).contains(&value)) => {
                    feeling.push((emotion, term.thousandths));
                }
                Some(_) => {
                    return self.refuse(
                        value,
                        "has a value outside 0 to 10",
                        "write values from 0 to 10, as in joy 2 + disgust 1",
                    );
                }
                None => {
                    let near = suggest::nearest(term.name.text, Emotion::ALL.map(Emotion::name));
                    let help = match near {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => format!("use the attributes {}", Emotion::ALL.map(Emotion::name).join(", ")),
                    };
                    let what = format!(
                        "contains {}, which is not one of the twelve attributes",
                        escape::quoted(term.name.text)
                    );
                    return self.refuse(value, &what, &help);
                }
            }
        }
        if blend.is_none() && !text.is_empty() {
            return self.refuse(
                value,
                "is not a blend of emotions",
                "write attributes with values, as in joy 2 + disgust 1",
            );
        }
        self.settings.options.known_names.emotions.insert(name.to_owned());
        self.settings.options.emotions.presets.insert(name.to_owned(), feeling);
    }
}
