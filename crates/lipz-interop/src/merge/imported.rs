//! Merging of an imported clip into an existing clip: its lip-sync track, texts and elements.

use super::place::speech;
use super::{MergeOptions, MergedClip, merge, set, string};
use crate::import::element;
use crate::segments::{parts_by_shares, parts_by_words};
use crate::subtitles::bounds;
use crate::text_element::text_in;
use crate::{ImportedClip, Text, Time};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::locale::text_name;
use lipz_file::text::{DELIMITER, display, segment_count, segments, trim};
use lipz_file::{Document, Element, Value, curve, phones};

impl ImportedClip {
    /// Returns `clip` with the lip-sync track of this clip, as [`merge`] does, with the curves of a recorded face, and
    /// with texts in locales and elements that are only in this clip. Where both have a text or an element, the value in
    /// `clip` stays, and a diagnostic reports it.
    pub fn merge<'s>(&self, clip: &Document<'s>, options: &MergeOptions<'_>) -> MergedClip<'s> {
        let is_divided = |element: &Element<'_>| match element.name.text.as_ref() {
            "events" => true,
            "visemes" => string(element).is_some_and(|visemes| visemes.contains(DELIMITER)),
            name => text_name(name).is_some(),
        };
        let gets_phones = options.phones || clip.get("visemes").is_none() || clip.get(phones::ELEMENT).is_some();
        let mouth = self.mouth.clone().phones(self.mouth.phones.clone().filter(|_| gets_phones));
        let mut merged = merge(clip, &mouth, options);
        if !clip.elements.iter().any(is_divided) {
            self.set_own_segments(&mut merged);
            return merged;
        }
        for text in &self.texts {
            self.add_text(text, options.default_locale, &mut merged);
        }
        self.add_elements(&mut merged);
        merged
    }

    /// Gives a merged clip that only had a lip-sync track the segments, texts and other elements of this clip.
    fn set_own_segments(&self, merged: &mut MergedClip<'_>) {
        for element in &self.document.elements {
            let name = element.name.text.as_ref();
            if name == "visemes" || text_name(name).is_some() {
                set(&mut merged.document, name, element.clone());
            }
        }
        self.add_elements(merged);
    }

    /// Adds a text in a locale that the clip lacks.
    fn add_text(&self, text: &Text, default_locale: Option<&str>, merged: &mut MergedClip<'_>) {
        let rate = self.mouth.rate;
        let time = |frame: &u64| Time::of_frame(*frame, rate);
        let locale = text.locale.as_deref().or(default_locale).unwrap_or_default();
        let of_locale = text_in(&merged.document, locale, default_locale);
        let is_blank = |own: &&Element<'_>| string(own).is_some_and(|own| trim(own).is_empty());
        if let Some(own) = of_locale.filter(|own| !is_blank(own)) {
            if !string(own).is_some_and(|own| says_the_same(own, &text.text)) {
                let message =
                    format!("{} is kept, but the import has a different text", escape::quoted(&own.name.text));
                merged.diagnostics.push(
                    Diagnostic::at(Code::ImportKept, own.value.span(), message)
                        .note(format!("the text of the import: {}", escape::quoted(&text.text)))
                        .help("change the text of the clip if the recording has the text of the import"),
                );
            }
            return;
        }
        let name = of_locale.map_or_else(|| format!("text_{locale}"), |own| own.name.text.to_string());
        let bounds = bounds(merged.document.string("visemes").unwrap_or_default());
        let starts: Vec<Time> = bounds.get(1..bounds.len() - 1).unwrap_or_default().iter().map(time).collect();
        let count = starts.len() + 1;
        let parts = if segment_count(&text.text) == count {
            text.text.split(DELIMITER).map(|part| trim(part).to_owned()).collect()
        } else {
            let whole = text.text.replace(DELIMITER, " ");
            parts_by_words(&whole, &starts, &self.mouth.words).unwrap_or_else(|| {
                merged.diagnostics.push(
                    Diagnostic::new(
                        Code::SegmentGuessed,
                        format!("the {count} segments of {} are guessed", escape::quoted(&name)),
                    )
                    .note("they are divided between words, with the same time for each letter")
                    .help("move each `|` of the text to its position in the other texts"),
                );
                parts_by_shares(&whole, &starts, &speech(&self.mouth.codes, rate))
            })
        };
        let new = element(&name, parts.join("|"));
        set(&mut merged.document, &name, new);
    }

    /// Adds the elements that the clip lacks.
    fn add_elements(&self, merged: &mut MergedClip<'_>) {
        let is_of_mouth =
            |name: &str| matches!(name, "visemes" | "viseme_type" | "fps" | "phones") || text_name(name).is_some();
        for element in self.document.elements.iter().filter(|element| !is_of_mouth(&element.name.text)) {
            let name = element.name.text.as_ref();
            if name == curve::ELEMENT && set_curves(&mut merged.document, &element.value) {
                continue;
            }
            let counts = |of: Option<&str>| of.map_or(1, segment_count);
            let message = match merged.document.get(name) {
                Some(own) if own.value == element.value => continue,
                Some(_) => format!("{} is kept, but the import has a different value", escape::quoted(name)),
                None if name == "events" && counts(string(element)) != counts(merged.document.string("visemes")) => {
                    "the events of the import are left out because their segments differ from those of the clip"
                        .to_owned()
                }
                None => {
                    merged.document.elements.push(element.clone());
                    continue;
                }
            };
            merged.diagnostics.push(Diagnostic::new(Code::ImportKept, message));
        }
    }
}

/// Replaces the curves of a recorded face in a clip, and keeps its other curves. Returns `false` if curves are not
/// valid.
fn set_curves(document: &mut Document<'_>, recorded: &Value<'_>) -> bool {
    let Value::Other(recorded) = recorded else { return false };
    let mut diagnostics = Vec::new();
    let (Some(recorded), []) = (curve::parse(recorded, &mut diagnostics), diagnostics.as_slice()) else { return false };
    let added = recorded.iter().map(|curve| (curve.name.text.as_ref(), curve.frames_and_values())).collect();
    curve::change(document, |_| false, added)
}

/// Whether two texts are displayed with the same words, however they are divided.
fn says_the_same(one: &str, other: &str) -> bool {
    let shown = |text: &str| {
        let parts = segments(text).map(|range| display(text.get(range).unwrap_or_default()).text.into_owned());
        parts.collect::<Vec<_>>().join(" ")
    };
    shown(one).split_whitespace().eq(shown(other).split_whitespace())
}
