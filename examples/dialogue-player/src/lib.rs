//! A player of dialogue for a game without an operating system: no `std`, no allocation, no files.
//!
//! `build.rs` packs the Lipz files in `voices` into [`BANK`] and makes a constant for each of them.

#![no_std]
#![forbid(unsafe_code)]

use lipz_bank::{Bank, ClipId, Event, Lead, Locale, Micros, Playback, Viseme};

/// The bank: here part of the program, elsewhere a mapped file or a piece of ROM.
pub static BANK: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/dialogue.lipzbank"));

/// The clips and locales of [`BANK`]. A misspelt one does not compile:
///
/// ```compile_fail,E0425
/// dialogue_player::dialogue::act1::MARA_GOOD_EVENIGN;
/// ```
pub mod dialogue {
    include!(concat!(env!("OUT_DIR"), "/dialogue.rs"));
}

/// One clip while it is played.
#[derive(Debug)]
pub struct Player<'data, 'bank> {
    playback: Playback<'data, 'bank>,
    locale: Locale<'data>,
}

impl<'data, 'bank> Player<'data, 'bank> {
    /// Starts the clip with subtitles in `locale`, one of [`dialogue::locales`]; `None` if the bank
    /// has no such clip or locale, or the clip has no frame rate.
    ///
    /// Mouths are a frame ahead of the sound: a sound is made with the mouth in its shape already.
    pub fn start(bank: &'bank Bank<'data>, clip: ClipId, locale: &str) -> Option<Self> {
        let clip = bank.clip(clip)?;
        let lead = Lead::one_frame(clip.fps()?);
        Some(Player { playback: Playback::new(clip)?.with_lead(lead), locale: bank.locale(locale)? })
    }

    /// The audio engine has played the clip up to `sound`: gives the events that have become due, each
    /// once, however long a picture took. They do not come again.
    #[must_use = "the events do not come again"]
    pub fn advance_to(&mut self, sound: Micros) -> impl Iterator<Item = Event<'data>> + use<'data, 'bank> {
        self.playback.advance_to(sound).events()
    }

    /// The mouth shape to draw now; rest when the clip is over.
    pub fn mouth(&self) -> Viseme {
        self.playback.viseme()
    }

    /// The subtitle to show now; empty when nobody speaks.
    pub fn subtitle(&self) -> &'data str {
        let text = self.playback.segment().and_then(|segment| segment.text(self.locale));
        text.map_or("", |text| text.as_str())
    }

    /// Whether the sound is past the last frame.
    pub fn is_over(&self) -> bool {
        self.playback.is_over()
    }
}
