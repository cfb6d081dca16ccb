//! Differences as JSON, with a flag whether there are any.

use super::Difference;
use serde::ser::{Serialize, SerializeStruct, Serializer};

/// Adds the flag whether there are any differences, which is not a field.
impl Serialize for Difference<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut json = serializer.serialize_struct("Difference", 16)?;
        json.serialize_field("is_same", &self.is_empty())?;
        json.serialize_field("added_locales", &self.added_locales)?;
        json.serialize_field("removed_locales", &self.removed_locales)?;
        json.serialize_field("default_locale", &self.default_locale)?;
        json.serialize_field("fallbacks", &self.fallbacks)?;
        json.serialize_field("babble", &self.babble)?;
        json.serialize_field("voices", &self.voices)?;
        json.serialize_field("dubs", &self.dubs)?;
        json.serialize_field("faces", &self.faces)?;
        json.serialize_field("articulation", &self.articulation)?;
        json.serialize_field("rigs", &self.rigs)?;
        json.serialize_field("added", &self.added)?;
        json.serialize_field("removed", &self.removed)?;
        json.serialize_field("renamed", &self.renamed)?;
        json.serialize_field("changed", &self.changed)?;
        json.serialize_field("same", &self.same)?;
        json.end()
    }
}
