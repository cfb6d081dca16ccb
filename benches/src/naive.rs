//! The rival of the specification: JSON parsed once, and its own `getCurrentViseme`.

#![allow(clippy::cast_possible_truncation, reason = "frame numbers are small")]

use serde_json::Value;
use std::collections::HashMap;

/// Clips as parsed JSON, by key.
pub struct Naive {
    clips: HashMap<String, Value>,
}

impl Naive {
    /// Parses all files.
    ///
    /// # Errors
    /// If one is not JSON.
    pub fn parse<'f>(files: impl IntoIterator<Item = (&'f str, &'f str)>) -> Result<Naive, serde_json::Error> {
        let parsed = files.into_iter().map(|(key, json)| Ok((key.to_owned(), serde_json::from_str(json)?)));
        Ok(Naive { clips: parsed.collect::<Result<_, _>>()? })
    }

    /// Returns the clip with this key.
    pub fn clip(&self, key: &str) -> Option<&Value> {
        self.clips.get(key)
    }
}

/// The specification's function, line by line ("Knowing which Viseme to Show"), except for its check of the end, which
/// counts the delimiters.
pub fn current_viseme(clip: &Value, play_position_seconds: f64) -> char {
    let visemes = clip["visemes"].as_str().unwrap_or_default();
    let fps = clip["fps"].as_f64().unwrap_or_default();
    let unsegmented = visemes.replace('|', "");
    let frame = (play_position_seconds * fps).floor();
    if frame < 0.0 || frame >= unsegmented.len() as f64 {
        return '-';
    }
    // In range: checked above.
    unsegmented.chars().nth(frame as usize).unwrap_or('-')
}

/// Returns the text of the segment at a time, found as the specification suggests.
pub fn current_text<'c>(clip: &'c Value, locale: &str, play_position_seconds: f64) -> Option<&'c str> {
    current_part(clip, &format!("text_{locale}"), play_position_seconds)
}

/// Returns the event string of the segment at a time; `None` also without events.
pub fn current_event(clip: &Value, play_position_seconds: f64) -> Option<&str> {
    current_part(clip, "events", play_position_seconds)
}

fn current_part<'c>(clip: &'c Value, element: &str, play_position_seconds: f64) -> Option<&'c str> {
    let fps = clip["fps"].as_f64()?;
    let frame = (play_position_seconds * fps).floor() as usize;
    let mut end = 0;
    let segment = clip["visemes"].as_str()?.split('|').position(|segment| {
        end += segment.len();
        frame < end
    })?;
    clip[element].as_str()?.split('|').nth(segment).map(str::trim)
}
