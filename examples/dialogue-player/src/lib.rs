//! A player of dialogue for a game without an operating system: no `std`, no allocation, no files.
//!
//! `build.rs` packs the Lipz files in `voices` into [`BANK`] and makes a constant for each of them.

#![no_std]
#![forbid(unsafe_code)]

use lipz_bank::{Bank, Clip, ClipId, Locale, Micros, Viseme};

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
    clip: Clip<'data, 'bank>,
    locale: Locale<'data>,
    now: Micros,
    /// The first segment whose event has not been taken.
    next_segment: u32,
}

impl<'data, 'bank> Player<'data, 'bank> {
    /// Starts the clip with subtitles in `locale`, one of [`dialogue::locales`]; `None` if the bank
    /// has no such clip or locale.
    pub fn start(bank: &'bank Bank<'data>, clip: ClipId, locale: &str) -> Option<Self> {
        Some(Player { clip: bank.clip(clip)?, locale: bank.locale(locale)?, now: Micros(0), next_segment: 0 })
    }

    /// Lets time pass: the time of one picture of the game, or what its audio engine has played.
    pub fn advance(&mut self, elapsed_us: i64) {
        self.now = Micros(self.now.0.saturating_add(elapsed_us));
    }

    /// The mouth shape to draw now; rest when the clip is over.
    pub fn mouth(&self) -> Viseme {
        self.clip.viseme_at(self.now)
    }

    /// The subtitle to show now; empty when nobody speaks.
    pub fn subtitle(&self) -> &'data str {
        let text = self.clip.segment_at(self.now).and_then(|segment| segment.text(self.locale));
        text.map_or("", |text| text.as_str())
    }

    /// The next event that is due. Ask until there is none: no event is lost when a picture takes
    /// longer than a segment.
    pub fn next_event(&mut self) -> Option<&'data str> {
        loop {
            let segment = self.clip.segment(self.next_segment)?;
            if segment.start_us()? > u64::try_from(self.now.0).ok()? {
                return None;
            }
            self.next_segment += 1;
            if let Some(event) = segment.event().filter(|event| !event.is_empty()) {
                return Some(event);
            }
        }
    }

    /// Whether all frames have been shown.
    pub fn is_over(&self) -> bool {
        self.clip.frame_at(self.now).is_none()
    }
}
