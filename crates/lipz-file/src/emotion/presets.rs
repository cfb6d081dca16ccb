//! Presets: single words for blends of the twelve attributes.

use lipz_types::Emotion;

/// Attributes with their values in thousandths; `None` for the project's default value.
pub type Feeling = [(Emotion, Option<i32>)];

/// The emotion words of other sources: the eleven emotions of the Lipz specification, the three moods of Fallout's
/// talking heads, and `calm` and `lying`. The values are our choice, because the sources only name them.
/// `docs/guides/faces.md` shows the table.
pub const PRESETS: [(&str, &Feeling); 15] = [
    ("neutral", &[]),
    ("calm", &[]),
    ("amused", &[(Emotion::Joy, Some(3000))]),
    ("happy", &[(Emotion::Joy, None)]),
    ("sad", &[(Emotion::Sadness, None)]),
    ("irritated", &[(Emotion::Anger, Some(3000))]),
    ("angry", &[(Emotion::Anger, None)]),
    ("suspicious", &[(Emotion::Perplexed, Some(2000)), (Emotion::Anger, Some(1000))]),
    ("confused", &[(Emotion::Perplexed, None)]),
    ("afraid", &[(Emotion::Fear, None)]),
    ("thinking", &[(Emotion::Perplexed, Some(2000))]),
    ("evil", &[(Emotion::Anger, Some(5000)), (Emotion::Joy, Some(5000))]),
    ("lying", &[(Emotion::Perplexed, Some(1000))]),
    ("good", &[(Emotion::Joy, Some(3000))]),
    ("bad", &[(Emotion::Anger, Some(3000))]),
];

/// Returns the preset with this name.
pub fn preset(name: &str) -> Option<&'static Feeling> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, feeling)| *feeling)
}
