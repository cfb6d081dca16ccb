//! A player of dialogue for a game without an operating system: no `std`, no allocation, no files.
//!
//! `build.rs` packs the Lipz files in `voices` into [`BANK`] and makes a constant for each of them.

#![no_std]
#![forbid(unsafe_code)]

use lipz_bank::{Bank, ClipId, Cursor, Event, Lead, Locale, Micros, Viseme};

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

/// A bank and the clip that is playing: what a game keeps from one picture to the next.
#[derive(Debug)]
pub struct Player<'data> {
    bank: Bank<'data>,
    locale: Locale<'data>,
    playing: Option<(ClipId, Cursor)>,
}

impl<'data> Player<'data> {
    /// A player of the clips of `bank`, with subtitles in `locale`, one of [`dialogue::locales`]; `None` if the
    /// bank has no such locale.
    pub fn new(bank: Bank<'data>, locale: &str) -> Option<Self> {
        Some(Player { bank, locale: bank.locale(locale)?, playing: None })
    }

    /// Starts a clip: whether the bank has it, with a frame rate.
    ///
    /// Mouths are a frame ahead of the sound: a sound is made with the mouth in its shape already.
    pub fn start(&mut self, id: ClipId) -> bool {
        let cursor = self.bank.clip(id).and_then(|clip| {
            let lead = Lead::one_frame(clip.fps()?);
            Some(Cursor::new(&clip)?.with_lead(lead))
        });
        self.playing = cursor.map(|cursor| (id, cursor));
        self.playing.is_some()
    }

    /// The audio engine has played the clip up to `sound`: returns the events that have become due, each
    /// once, however long a picture took. They do not come again.
    #[must_use = "the events do not come again"]
    pub fn advance_to(&mut self, sound: Micros) -> impl Iterator<Item = Event<'data>> {
        let due = self.playing.as_mut().and_then(|(id, cursor)| {
            let clip = self.bank.clip(*id)?;
            Some(cursor.advance_to(&clip, sound))
        });
        due.into_iter().flat_map(lipz_bank::DueSegments::events)
    }

    /// The mouth shape to draw now; rest when nobody speaks.
    pub fn mouth(&self) -> Viseme {
        let shape = self.playing.and_then(|(id, cursor)| Some(cursor.viseme(&self.bank.clip(id)?)));
        shape.unwrap_or(Viseme::REST)
    }

    /// The subtitle to show now; empty when nobody speaks.
    pub fn subtitle(&self) -> &'data str {
        let segment = self.playing.and_then(|(id, cursor)| cursor.segment(&self.bank.clip(id)?));
        segment.and_then(|segment| segment.text(self.locale)).map_or("", |text| text.as_str())
    }

    /// Whether nothing is playing: no clip was started, or the sound is past its last frame.
    pub fn is_over(&self) -> bool {
        self.playing.is_none_or(|(_, cursor)| cursor.is_over())
    }
}
