//! Ids as JSON, for tools that generate their own code.

use lipz_bank::Clip;
use serde_json::{Value, json};

/// Returns `{ "clips": { KEY: ID, … }, "locales": [ … ] }`. Ids are strings, because many readers of JSON lose digits
/// of large numbers.
pub(super) fn object(clips: &[Clip<'_>], locales: &[&str]) -> String {
    let ids = clips.iter().map(|clip| (clip.key().to_owned(), Value::from(clip.id().to_string())));
    let clips = Value::Object(ids.collect());
    format!("{:#}\n", json!({ "clips": clips, "locales": locales }))
}
