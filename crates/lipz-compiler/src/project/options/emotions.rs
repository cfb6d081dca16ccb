//! The conversion of emotions in texts and events to curves.

use lipz_bank::face::Emotion;
use lipz_file::emotion::{self, Blend};
use std::collections::BTreeMap;

/// The conversion of emotions in texts and events to curves (docs/guides/faces.md).
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct EmotionOptions {
    /// The clips that get curves.
    pub curves: EmotionCurves,
    /// The value of an attribute without one, in thousandths.
    pub usual_thousandths: i32,
    /// The duration of a change of a face, in milliseconds; 0 for a step.
    pub over_ms: u32,
    /// Words that the project adds or redefines: attributes, each with its value in thousandths, or `None` for the
    /// usual value.
    pub presets: BTreeMap<String, Vec<(Emotion, Option<i32>)>>,
}

/// The clips that get curves from their emotions.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum EmotionCurves {
    /// Those with emotions: `{anger 2.2}`, `feels sad`.
    #[default]
    All,
    /// Those in which an emotion has a value: `{anger 2.2}`. For projects that read `feels sad` directly from the
    /// events.
    Values,
    /// None.
    Off,
}

impl Default for EmotionOptions {
    fn default() -> EmotionOptions {
        EmotionOptions { curves: EmotionCurves::All, usual_thousandths: 5000, over_ms: 400, presets: BTreeMap::new() }
    }
}

/// Values of all attributes, in thousandths.
pub(crate) type Face = [i32; Emotion::ALL.len()];

impl EmotionOptions {
    /// Whether a name is that of an attribute or of a preset.
    pub(crate) fn knows(&self, name: &str) -> bool {
        Emotion::from_name(name).is_some() || emotion::preset(name).is_some() || self.presets.contains_key(name)
    }

    /// Returns all accepted names, with those of the attributes first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let presets = emotion::PRESETS.iter().map(|(name, _)| *name);
        Emotion::ALL.iter().map(|emotion| emotion.name()).chain(presets).chain(self.presets.keys().map(String::as_str))
    }

    /// Returns the attributes of a name without a value, in thousandths; none for a calm face or an unknown name.
    pub fn attributes(&self, name: &str) -> Vec<(Emotion, i32)> {
        self.feeling(name, None)
    }

    /// Whether a name stands for at least one attribute.
    pub(crate) fn has_attributes(&self, name: &str) -> bool {
        !self.feeling(name, None).is_empty()
    }

    /// Returns the face of a blend. Unknown names have no effect.
    pub(crate) fn face(&self, blend: &Blend<'_>) -> Face {
        let mut face = Face::default();
        for term in &blend.terms {
            for (emotion, value) in self.feeling(term.name.text, term.thousandths) {
                face[emotion as usize] = face[emotion as usize].saturating_add(value);
            }
        }
        face
    }

    /// Returns the attributes of a name. A value applies to the strongest of them, and changes the others in
    /// proportion.
    fn feeling(&self, name: &str, thousandths: Option<i32>) -> Vec<(Emotion, i32)> {
        let usual = |(emotion, value): &(Emotion, Option<i32>)| (*emotion, value.unwrap_or(self.usual_thousandths));
        let preset = || self.presets.get(name).map(Vec::as_slice).or_else(|| emotion::preset(name));
        let feeling: Vec<(Emotion, i32)> = match (self.presets.get(name), Emotion::from_name(name)) {
            (None, Some(emotion)) => vec![(emotion, self.usual_thousandths)],
            _ => preset().unwrap_or_default().iter().map(usual).collect(),
        };
        let strongest = feeling.iter().map(|(_, value)| i64::from(*value)).max().unwrap_or(0);
        let scaled = |value: i32| match thousandths {
            Some(wanted) if strongest > 0 => (i64::from(value) * i64::from(wanted) / strongest) as i32,
            _ => value,
        };
        feeling.into_iter().map(|(emotion, value)| (emotion, scaled(value))).collect()
    }
}
