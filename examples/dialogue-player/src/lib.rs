//! A player of dialogue for a game without an operating system: no `std`, no allocation, no files.
//!
//! `build.rs` packs the Lipz files in `voices` into [`BANK`] and generates a constant for each of them.

#![no_std]
#![forbid(unsafe_code)]

use lipz_bank::playback::{DueSegments, Lead};
use lipz_bank::{ClipId, Cursor, Dialogue, Event, Locale, Micros, Viseme};

/// The bank: here part of the program, otherwise a file in memory or a part of ROM.
pub static BANK: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/dialogue.lipzbank"));

/// The clips and locales of [`BANK`]. A misspelt name does not compile:
///
/// ```compile_fail,E0425
/// dialogue_player::dialogue::act1::MARA_GOOD_EVENIGN;
/// ```
pub mod dialogue {
    include!(concat!(env!("OUT_DIR"), "/dialogue.rs"));
}

/// A dialogue and the clip that is playing, which a game keeps between rendered frames.
#[derive(Debug)]
pub struct Player<'a> {
    dialogue: Dialogue<'a>,
    locale: Locale,
    playing: Option<(ClipId, Cursor)>,
}

impl<'a> Player<'a> {
    /// Returns a player of the clips of `dialogue`, with subtitles in `locale`, one of [`dialogue::locales`]; `None` if
    /// the dialogue has no such locale.
    pub fn new(dialogue: Dialogue<'a>, locale: &str) -> Option<Self> {
        Some(Player { locale: dialogue.locale(locale)?, dialogue, playing: None })
    }

    /// Starts a clip, and returns whether the dialogue has it, with a frame rate.
    ///
    /// Visemes are a frame ahead of the audio, because a mouth takes its shape before the sound.
    pub fn start(&mut self, id: ClipId) -> bool {
        let cursor = self.dialogue.clip(id).and_then(|clip| {
            let lead = Lead::one_frame(clip.fps()?);
            Some(Cursor::new(&clip)?.with_lead(lead))
        });
        self.playing = cursor.map(|cursor| (id, cursor));
        self.playing.is_some()
    }

    /// Moves the clip to the audio position `audio`. Returns the events that have become due, each once, even after a
    /// long rendered frame.
    #[must_use = "the events are not returned again"]
    pub fn advance_to(&mut self, audio: Micros) -> impl Iterator<Item = Event<'_>> {
        let Player { dialogue, playing, .. } = self;
        let due = playing.as_mut().and_then(|(id, cursor)| {
            let clip = dialogue.clip(*id)?;
            Some(cursor.advance_to(&clip, audio))
        });
        due.into_iter().flat_map(DueSegments::events)
    }

    /// Returns the viseme to draw now, or rest if no clip is playing.
    pub fn viseme(&self) -> Viseme {
        let viseme = self.playing.and_then(|(id, cursor)| Some(cursor.viseme(&self.dialogue.clip(id)?)));
        viseme.unwrap_or(Viseme::REST)
    }

    /// Returns the subtitle to show now; empty if no clip is playing.
    pub fn subtitle(&self) -> &str {
        let segment = self.playing.and_then(|(id, cursor)| cursor.segment(&self.dialogue.clip(id)?));
        segment.and_then(|segment| segment.text(self.locale)).map_or("", |text| text.as_str())
    }

    /// Whether no clip is playing: none was started, or the audio is past the last frame.
    pub fn is_over(&self) -> bool {
        self.playing.is_none_or(|(_, cursor)| cursor.is_over())
    }
}
