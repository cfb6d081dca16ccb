//! The characters in the events of a clip.

use lipz_bank::{Clip, EventName};
use std::collections::BTreeSet;

/// Returns the characters that the events of a clip name.
pub(crate) fn in_events<'data>(clip: &Clip<'data>) -> BTreeSet<&'data str> {
    let of_segment = |segment: lipz_bank::Segment<'data>| segment.events().collect::<Vec<_>>();
    clip.segments().flat_map(of_segment).filter_map(|event| event.character.map(EventName::as_str)).collect()
}
