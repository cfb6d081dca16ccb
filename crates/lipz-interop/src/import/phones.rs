//! The element `phones` of an imported clip.

use crate::{Map, Shape, StartedPhone, Time, Track};
use lipz_file::phones;
use lipz_types::Phone;

const MILLISECONDS: u32 = 1000;

/// Returns the phones of a track: its own, or those that its shapes stand for.
pub(super) fn phones_of(track: &Track, map: &Map) -> Vec<StartedPhone> {
    let phone = |shape: &Shape| Some(StartedPhone { start: shape.start, phone: map.phone(&shape.symbol)? });
    match track.phones.is_empty() {
        true => track.shapes.iter().filter_map(phone).collect(),
        false => track.phones.clone(),
    }
}

/// Returns the value of the element for a clip that ends at `end`; `None` without phones.
pub(super) fn spelled(mut phones: Vec<StartedPhone>, end: Time) -> Option<String> {
    if phones.iter().all(|phone| phone.phone == Phone::SILENCE) {
        return None;
    }
    phones.sort_by_key(|phone| phone.start);
    let silence = StartedPhone { start: Time::ZERO, phone: Phone::SILENCE };
    let is_late = phones.first().is_some_and(|first| first.start > Time::ZERO);
    let mut timed: Vec<(Phone, u32)> = Vec::with_capacity(phones.len() + 1);
    for StartedPhone { start, phone } in is_late.then_some(silence).into_iter().chain(phones) {
        let start_ms = u32::try_from(start.in_units(MILLISECONDS)).unwrap_or(u32::MAX);
        match timed.last_mut() {
            // A clip ends at the nearest frame, which can be before the last phone.
            _ if start >= end => {}
            // A phone of less than a millisecond has no time in the file.
            Some(last) if last.1 == start_ms => last.0 = phone,
            Some(last) if last.0 == phone && phone == Phone::SILENCE => {}
            _ => timed.push((phone, start_ms)),
        }
    }
    Some(phones::write(false, None, timed))
}
