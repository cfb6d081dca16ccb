//! Every query of the reader, on banks that may be damaged.

use crate::{said, stacked};
use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{
    Bank, Clip, ClipId, Cursor, Fps, Locale, Micros, Samples, Seconds, Segment, Time, VisemeType, Voice, VoiceSource,
};
use std::hint::black_box;
use std::time::Duration;

/// The number of times to test.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// One per unit, for tests with hundreds of thousands of banks.
    Few,
    /// All extremes.
    All,
}

/// Opens a bank and makes every query, before verification and, if it passes, after it. Returns whether it passes.
pub fn provoke(bytes: &[u8], effort: Effort) -> bool {
    let Ok(bank) = Bank::open(bytes) else { return false };
    assert!(!bank.is_verified());
    every_query(&bank, effort);
    // A whole bank is accepted as its own text bank.
    let mut opened = bank;
    opened.open_texts_unverified(bytes).expect("they have one fingerprint");
    stacked::every_query(&[bytes]);
    stacked::every_query(&[bytes, bytes]);
    if effort == Effort::All {
        every_text_query(&opened);
    }
    let tables = bank.verify_tables();
    match bank.verify() {
        Ok(bank) => {
            assert_eq!(tables, Ok(()));
            assert!(bank.is_verified() && bank.verify_lines().is_ok_and(|bank| bank.is_verified()));
            if effort == Effort::All {
                assert!(bank.verify_with(|bytes| std::str::from_utf8(bytes).ok()).is_ok());
            }
            every_query(&bank, effort);
            verified_is_whole(&bank);
            if effort == Effort::All {
                let mut opened = bank;
                assert!(opened.open_texts(bytes).is_ok() && every_text_query(&opened));
                assert!(stacked::every_query_verified(&[bytes]) || bank.layer().is_some());
            }
            true
        }
        Err(error) => {
            assert!(error.offset_bytes() as usize <= bytes.len(), "{error}");
            black_box((error.kind().number(), error.kind().message()));
            match bank.verify_lines() {
                // The damage is in an omitted section, whose queries may return anything.
                Ok(bank) => every_query(&bank, effort),
                Err(found) => assert_eq!(found, error),
            }
            false
        }
    }
}

/// Makes every query of a bank. Panics only if an iterator returns more items than possible.
pub fn every_query(bank: &Bank<'_>, effort: Effort) {
    // If every item is stored in the file, there cannot be more items than bytes.
    let limit = bank.length_bytes();
    black_box((bank.fingerprint(), bank.checksum(), bank.format_version(), bank.clip_count()));
    assert!(bank.sections().filter(|section| black_box(section).1.len() <= limit).count() <= limit);
    let locales: Vec<Locale> = bank.locales().take(limit + 1).collect();
    assert!(locales.len() <= limit);
    assert!(bank.locales().size_hint().1.is_some_and(|most| most >= locales.len()));
    for locale in &locales {
        black_box((bank.locale(bank.locale_tag(*locale)).is_some(), bank.default_locale() == Some(*locale)));
        assert_eq!(Locale::from_words(locale.to_words()), *locale);
        for key in said::VARIANTS {
            let variant = bank.variant(*locale, key);
            assert!(variant == *locale || bank.locale_tag(variant).contains("-x-"));
        }
    }
    said::of_babble(bank, limit);
    let voices = said::of_voices(bank, limit);
    let has_faces = said::of_faces(bank, limit);
    let has_articulation = said::of_articulations(bank, limit);
    for name in ["", "amy", "door", "zz"] {
        let found = bank.event_name(name);
        black_box(found.map(|name| (name == "amy", name.as_str(), name.to_words())));
    }
    black_box((bank.default_locale().is_some(), bank.locale("de-de").is_some()));
    for prefix in ["", "act1/", "zz"] {
        let clips = bank.clips_under(prefix);
        let most = clips.size_hint().1.unwrap_or(usize::MAX);
        assert!(clips.take(limit + 1).count() <= most.min(limit));
    }
    for id in [0, 1, u64::MAX, ClipId::from_key("act1/blair").get()] {
        black_box(bank.clip(ClipId::from_u64(id)).is_some());
    }
    let slots = bank.clip_count() as u32;
    for slot in (0..slots).chain([slots, u32::MAX]) {
        if let Some(clip) = bank.clip_at(slot) {
            black_box((bank.clip(clip.id()).is_some(), bank.clip_by_key(clip.key()).is_some()));
            every_clip_query(&clip, &locales, limit, effort);
            said::of_dubs(&clip, &voices);
            if has_faces || effort == Effort::All {
                said::of_face(&clip, &bank.default_face_profile(), Micros(41_000));
            }
            if has_articulation || effort == Effort::All {
                for time in [-1, 41_000, i64::MAX] {
                    said::of_articulation(bank, &clip, Micros(time), limit);
                }
            }
        }
    }
    assert!(bank.clip_at(slots).is_none() && bank.clip_at(u32::MAX).is_none());
}

fn every_clip_query(clip: &Clip<'_>, locales: &[Locale], limit: usize, effort: Effort) {
    black_box((clip.id(), clip.key(), clip.slot(), clip.viseme_type(), clip.has_visemes(), clip.has_events()));
    black_box((clip.fps().map(Fps::to_f64), clip.duration_us(), clip.or_viseme_type(VisemeType::Rms).viseme_type()));
    black_box(clip.recording());
    said::of_curves(clip, limit);
    assert!(clip.frames().len() <= limit);
    let frames = clip.frame_count();
    for frame in [0, frames / 2, frames.wrapping_sub(1), frames, u32::MAX] {
        black_box((clip.viseme(frame), clip.segment_of_frame(frame).is_some()));
    }
    said::of_clip(clip);
    every_time(clip, effort);
    every_time(&clip.or_fps(Fps::whole(24)), effort);
    play(clip, clip.fps().unwrap_or(Fps::whole(24)));
    let segments = clip.segments();
    assert_eq!(segments.size_hint().1, Some(clip.segment_count() as usize));
    let mut count = 0;
    for segment in segments.take(limit + 1) {
        every_segment_query(&segment, locales, limit);
        count += 1;
    }
    assert!(count <= limit && count == clip.segment_count() as usize);
    assert!(clip.segment(clip.segment_count()).is_none() && clip.segment(u32::MAX).is_none());
}

fn every_segment_query(segment: &Segment<'_>, locales: &[Locale], limit: usize) {
    black_box((segment.index(), segment.clip().slot(), segment.start_frame(), segment.end_frame()));
    black_box((segment.start_us(), segment.end_us(), segment.event()));
    assert!(segment.frames().len() <= limit);
    let events = segment.events();
    let most = events.size_hint().1.unwrap_or(usize::MAX);
    let strings: Vec<String> = events.take(limit + 1).map(|event| event.to_string()).collect();
    assert!(strings.len() <= most.min(limit));
    for locale in locales {
        let text = segment.text(*locale);
        let bytes = segment.text_bytes(*locale);
        black_box(segment.has_own_text(*locale));
        // The two differ only if the bytes are not UTF-8.
        if let Some(text) = text {
            assert_eq!(Some(text.as_str().as_bytes()), bytes);
            black_box(text.is_fallback());
        }
    }
}

fn every_time(clip: &Clip<'_>, effort: Effort) {
    said::of_mouth(clip, Micros(41_000));
    if effort == Effort::Few {
        at(clip, Micros(41_000));
        at(clip, Samples { position: 3_969, rate_hz: 44_100 });
        at(clip, Seconds(0.25_f64));
        return;
    }
    for time in [0, 1, -1, 41_666, 41_667, 3_600_000_000, i64::from(u32::MAX), i64::MAX, i64::MIN] {
        at(clip, Micros(time));
        for rate_hz in [0, 1, 8_000, 44_100, u32::MAX] {
            at(clip, Samples { position: time, rate_hz });
        }
        let duration = Duration::from_micros(time.unsigned_abs());
        at(clip, duration);
    }
    at(clip, Duration::MAX);
    for time in [0.0, -0.0, 1.0, -1.0, 1e300, 5e-324, f64::MIN_POSITIVE, f64::MAX, f64::MIN, f64::EPSILON] {
        at(clip, Seconds(time));
        at(clip, Seconds(time as f32));
    }
    for time in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        at(clip, Seconds(time));
        at(clip, Seconds(time as f32));
        assert_eq!(clip.frame_at(Seconds(time)), None);
    }
    for bits in [1, 0x007F_FFFF, 0x0080_0000, 0x7F7F_FFFF, 0x7F80_0001, 0x8000_0001, u32::MAX] {
        at(clip, Seconds(f32::from_bits(bits)));
    }
}

/// Plays the clip once, in a few jumps, with the lead and the hold for `fps`.
fn play(clip: &Clip<'_>, fps: Fps) {
    let given = clip.or_fps(fps).or_viseme_type(VisemeType::Blair);
    let Some(cursor) = Cursor::new(&given) else { return };
    let speaker = clip.segments().flat_map(|segment| segment.events()).find_map(|event| event.character);
    let cursor = cursor.with_lead(Lead::two_frames(fps)).with_hold(ConsonantHold::readable(fps));
    let mut cursor = cursor.with_speaker(speaker);
    let segments = clip.segment_count() as usize;
    let mut fired = 0;
    for time in [-1, 0, 41_667, 400_000, 0] {
        let due = cursor.advance_to(clip, Micros(time));
        fired += due.clone().count();
        said::of_events(due.events());
        black_box((cursor.viseme(clip), cursor.segment(clip).is_some(), cursor.frame()));
    }
    assert_eq!(cursor.with_words([0; 4]).with_words(cursor.to_words()), cursor);
    fired += cursor.finish(clip).count();
    assert!(fired <= segments && cursor.is_over());
    cursor.seek(clip, Micros(100_000));
    assert!(cursor.loop_to(clip, Micros(100_000)).count() <= 2 * segments);
    black_box((cursor.state(clip, None), cursor.characters(clip).take(2).count()));
}

fn at(clip: &Clip<'_>, time: impl Time) {
    let frame = clip.frame_at(time);
    assert!(frame.is_none_or(|frame| frame < clip.frame_count()));
    black_box((clip.viseme_at(time), clip.segment_at(time).is_some(), clip.openness_at(time)));
}

/// Checks the guarantee for every bank that passes `verify`: no query fails for stored data.
pub fn verified_is_whole(bank: &Bank<'_>) {
    assert_eq!(bank.clips().count(), bank.clip_count());
    let locales: Vec<Locale> = bank.locales().collect();
    assert!(locales.iter().all(|locale| bank.locale(bank.locale_tag(*locale)).is_some()));
    voices_are_whole(bank);
    for clip in bank.clips() {
        assert_eq!(bank.clip(clip.id()).map(|found| found.slot()), Some(clip.slot()));
        assert_eq!(bank.clip_by_key(clip.key()).map(|found| found.slot()), Some(clip.slot()));
        assert_eq!(clip.frames().len(), clip.frame_count() as usize);
        let mut end = 0;
        for segment in clip.segments() {
            assert_eq!(segment.start_frame(), end);
            end = segment.end_frame();
            assert!(end >= segment.start_frame());
            assert_eq!(segment.frames().len(), (end - segment.start_frame()) as usize);
            assert_eq!(segment.event().is_some(), clip.has_events());
            let events = segment.events();
            assert_eq!(events.size_hint().1, Some(events.clone().count()));
            for event in events {
                for name in [event.character, event.command.object()].into_iter().flatten() {
                    assert_eq!(bank.event_name(name.as_str()), Some(name));
                }
            }
        }
        assert_eq!(end, clip.frame_count());
        let curves = clip.curves();
        assert_eq!(curves.size_hint().1, Some(curves.clone().count()));
        for curve in curves {
            assert_eq!(clip.curve(curve.name().as_str()), Some(curve));
            let last = curve.key_count().checked_sub(1).and_then(|last| curve.key(last)).expect("a key");
            assert!(!clip.has_visemes() || last.frame <= clip.frame_count());
            assert_eq!((curve.value(last.frame), curve.value(u32::MAX)), (last.value, last.value));
        }
        for &locale in &locales {
            let texts = || clip.segments().map(|segment| segment.text(locale).is_some());
            assert!(texts().all(|some| some) || !texts().any(|some| some));
        }
    }
}

/// A dub leads to its original, and back; both have the same segments.
fn voices_are_whole(bank: &Bank<'_>) {
    let voices: Vec<Voice> = bank.voices().collect();
    assert!(voices.len() != 1 && voices.iter().all(|voice| bank.voice(bank.voice_tag(*voice)) == Some(*voice)));
    for clip in bank.clips().filter(|_| !voices.is_empty()) {
        let original = clip.original().unwrap_or(clip);
        assert!(original.original().is_none(), "a dub of a dub");
        for &voice in &voices {
            let voiced = clip.in_voice(voice);
            assert_eq!(voiced.clip.segment_count(), clip.segment_count());
            assert_eq!(voiced.clip.slot() == original.slot(), voiced.spoken == VoiceSource::Original);
            assert!(voiced.spoken != VoiceSource::Dub || voiced.clip.voice() == Some(voice));
        }
        assert_eq!(clip.voice().map(|voice| clip.in_voice(voice).clip.slot()), Some(clip.slot()));
    }
}

/// Queries all texts of all locales. Returns whether each clip has texts for all segments or for none.
pub fn every_text_query(bank: &Bank<'_>) -> bool {
    let mut is_whole = true;
    for locale in bank.locales() {
        black_box((bank.locale(bank.locale_tag(locale)).is_some(), bank.default_locale() == Some(locale)));
        for clip in bank.clips() {
            let count = clip.segments().filter(|segment| segment.text(locale).is_some()).count();
            is_whole &= count == 0 || count == clip.segment_count() as usize;
        }
    }
    is_whole
}
