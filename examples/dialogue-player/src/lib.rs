//! A player of dialogue for a game without an operating system: no `std`, no allocation, no files.
//!
//! `build.rs` packs the Lipz files in `voices` into [`BANK`] and makes a constant for each of them.

#![no_std]
#![forbid(unsafe_code)]

use lipz_bank::playback::{DueSegments, Lead};
use lipz_bank::{ClipId, Cursor, Dialogue, Event, Locale, Micros, Viseme};

/// The bank: here part of the program, elsewhere a file in memory or a piece of ROM.
pub static BANK: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/dialogue.lipzbank"));

/// The clips and locales of [`BANK`]. A misspelt one does not compile:
///
/// ```compile_fail,E0425
/// dialogue_player::dialogue::act1::MARA_GOOD_EVENIGN;
/// ```
pub mod dialogue {
    include!(concat!(env!("OUT_DIR"), "/dialogue.rs"));
}

/// A dialogue and the clip that is playing: what a game keeps from one rendered frame to the next.
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

    /// The audio engine has played the clip up to `audio`: returns the events that have become due, each
    /// once, however long a rendered frame took. They are not returned again.
    #[must_use = "the events are not returned again"]
    pub fn advance_to(&mut self, audio: Micros) -> impl Iterator<Item = Event<'_>> {
        let Player { dialogue, playing, .. } = self;
        let due = playing.as_mut().and_then(|(id, cursor)| {
            let clip = dialogue.clip(*id)?;
            Some(cursor.advance_to(&clip, audio))
        });
        due.into_iter().flat_map(DueSegments::events)
    }

    /// The viseme to draw now; rest when no clip plays.
    pub fn viseme(&self) -> Viseme {
        let viseme = self.playing.and_then(|(id, cursor)| Some(cursor.viseme(&self.dialogue.clip(id)?)));
        viseme.unwrap_or(Viseme::REST)
    }

    /// The subtitle to show now; empty when no clip plays.
    pub fn subtitle(&self) -> &str {
        let segment = self.playing.and_then(|(id, cursor)| cursor.segment(&self.dialogue.clip(id)?));
        segment.and_then(|segment| segment.text(self.locale)).map_or("", |text| text.as_str())
    }

    /// Whether no clip plays: none was started, or the audio is past the last frame.
    pub fn is_over(&self) -> bool {
        self.playing.is_none_or(|(_, cursor)| cursor.is_over())
    }
}
