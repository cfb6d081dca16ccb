//! The component that plays a clip.

use crate::clock::ClockReading;
use crate::line::Line;
use crate::{LipzBank, LipzClock, LipzMouth};
use bevy::asset::{AssetId, Handle};
use bevy::ecs::component::Component;
use bevy::ecs::reflect::ReflectComponent;
use bevy::reflect::Reflect;
use lipz_bank::Cursor;
use std::time::Duration;

/// Plays a clip of a bank as soon as the bank is loaded: sets the [`LipzMouth`] of its entity, and triggers
/// [`LipzSubtitle`](crate::LipzSubtitle), [`LipzEvent`](crate::LipzEvent) and [`LipzFinished`](crate::LipzFinished).
///
/// For the next line, call [`play`](LipzPlayer::play), or spawn a new entity. If you remove the player, the mouth
/// rests, and the subtitle ends.
///
/// When a new version of the bank is loaded, the line continues at the same time.
#[derive(Component, Reflect, Clone, Debug)]
#[reflect(Component)]
#[require(LipzMouth)]
pub struct LipzPlayer {
    /// The bank.
    pub bank: Handle<LipzBank>,
    /// The key of the clip. Another key starts that clip.
    pub clip: String,
    /// The character who speaks, to whom events without a name belong. May be empty.
    pub speaker: String,
    /// The language of subtitles, such as `de-de`; empty for the default language of the bank. May change while the
    /// line plays.
    pub locale: String,
    /// The voice, such as `de-de`; empty for the voice of the originals. It selects the dub when the next line starts.
    pub voice: String,
    /// The source of the time.
    pub clock: LipzClock,
    /// Whether the line stands still. The mouth rests, and the subtitle stays.
    pub is_paused: bool,
    /// By how many frames of the clip visemes are ahead of the audio. Counts from the start of the next line.
    pub lead_frames: u8,
    /// Whether consonants are shown until viewers can read them. Counts from the start of the next line.
    pub holds_consonants: bool,
    /// The progress of the line, for the methods. Public so that `LipzPlayer { .., ..default() }` is possible.
    #[doc(hidden)]
    #[reflect(ignore)]
    pub state: PlayerState,
}

/// The progress of a player.
#[derive(Clone, Debug, Default)]
pub struct PlayerState {
    /// The speaker of the line that plays, if it is skipped before the request.
    pub(crate) skipped: Option<String>,
    pub(crate) request: Option<Request>,
    pub(crate) set_time: Option<Duration>,
    #[cfg(feature = "audio")]
    pub(crate) recording: Recording,
    pub(crate) line: Option<Line>,
    /// The bank whose error has been reported.
    pub(crate) reported: Option<AssetId<LipzBank>>,
}

/// An order of the program for the next rendered frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Request {
    Start {
        at: Duration,
    },
    Seek {
        to: Duration,
    },
    /// Starts and ends a line.
    Skip,
    Stop,
}

/// The recording that a player follows.
#[cfg(feature = "audio")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recording {
    reading: ClockReading,
    has_sink: bool,
}

#[cfg(feature = "audio")]
impl Default for Recording {
    fn default() -> Self {
        Recording { reading: ClockReading::Waiting, has_sink: false }
    }
}

impl Default for LipzPlayer {
    fn default() -> Self {
        LipzPlayer {
            bank: Handle::default(),
            clip: String::new(),
            speaker: String::new(),
            locale: String::new(),
            voice: String::new(),
            clock: LipzClock::default(),
            is_paused: false,
            lead_frames: 0,
            holds_consonants: true,
            state: PlayerState::default(),
        }
    }
}

impl LipzPlayer {
    /// Returns a player of this clip: `LipzPlayer::new(assets.load("dialogue.lipzbank"), "act1/mara-good-evening")`.
    #[must_use]
    pub fn new(bank: Handle<LipzBank>, clip: impl Into<String>) -> LipzPlayer {
        LipzPlayer { bank, clip: clip.into(), ..LipzPlayer::default() }
    }

    /// Sets the [`speaker`](LipzPlayer::speaker).
    #[must_use]
    pub fn with_speaker(mut self, speaker: impl Into<String>) -> Self {
        self.speaker = speaker.into();
        self
    }

    /// Sets the [language](LipzPlayer::locale) of subtitles.
    #[must_use]
    pub fn with_locale(mut self, tag: impl Into<String>) -> Self {
        self.locale = tag.into();
        self
    }

    /// Sets the [`voice`](LipzPlayer::voice).
    #[must_use]
    pub fn with_voice(mut self, tag: impl Into<String>) -> Self {
        self.voice = tag.into();
        self
    }

    /// Sets the [`clock`](LipzPlayer::clock).
    #[must_use]
    pub fn with_clock(mut self, clock: LipzClock) -> Self {
        self.clock = clock;
        self
    }

    /// Starts a clip from its beginning, also if it is the one that plays. The line before ends without its remaining
    /// events, unless you call [`skip`](LipzPlayer::skip) first.
    pub fn play(&mut self, clip: impl Into<String>) {
        self.clip = clip.into();
        self.state.request = Some(Request::Start { at: Duration::ZERO });
    }

    /// Jumps to a time of the line, forward or back. Events before it are not triggered. Does nothing after the end.
    pub fn seek(&mut self, time: Duration) {
        self.state.set_time = self.state.set_time.and(Some(time));
        self.state.request = match self.state.request {
            Some(Request::Start { .. }) => Some(Request::Start { at: time }),
            _ => Some(Request::Seek { to: time }),
        };
    }

    /// Ends the line in the next rendered frame, and triggers its remaining events, so that lasting emotions take
    /// effect. If you then call [`play`](LipzPlayer::play), these events come before those of the next line.
    pub fn skip(&mut self) {
        let has_started = self.state.line.as_ref().is_some_and(|line| line.is_wanted(self));
        if has_started && !matches!(self.state.request, Some(Request::Start { .. } | Request::Skip)) {
            self.state.skipped = Some(self.speaker.clone());
            self.state.request = None;
        } else {
            self.state.request = Some(Request::Skip);
        }
    }

    /// Ends the line without its remaining events.
    pub fn stop(&mut self) {
        self.state.request = Some(Request::Stop);
    }

    /// Sets the time of [`LipzClock::Manual`]. The line starts with the first call.
    pub fn set_time(&mut self, time: Duration) {
        self.state.set_time = Some(time);
    }

    /// Returns the time of the line; 0 before it and after it.
    pub fn time(&self) -> Duration {
        self.state.line.as_ref().and_then(Line::time).unwrap_or_default()
    }

    /// Whether a line has started and not ended. True while it is paused.
    pub fn is_playing(&self) -> bool {
        self.state.line.as_ref().is_some_and(|line| line.time().is_some())
    }

    /// Returns the subtitle to show, which may be empty.
    pub fn subtitle(&self) -> &str {
        self.state.line.as_ref().map_or("", Line::subtitle)
    }

    /// Returns the cursor of the line, for queries about the [state](Cursor::state) of characters; `None` before the
    /// line and after it.
    pub fn cursor(&self) -> Option<&Cursor> {
        self.state.line.as_ref().and_then(Line::cursor)
    }

    /// Returns the reading of the player's clock.
    pub(crate) fn clock_reading(&self, later: Duration) -> ClockReading {
        match self.clock {
            LipzClock::Game => ClockReading::Later(later),
            LipzClock::Manual => {
                self.state.set_time.map_or(ClockReading::Waiting, |time| ClockReading::At { time, is_paused: false })
            }
            #[cfg(feature = "audio")]
            LipzClock::Recording => self.state.recording.reading,
        }
    }
}

#[cfg(feature = "audio")]
impl LipzPlayer {
    /// Takes the reading of the recording; `None` without a sink.
    pub(crate) fn hear(&mut self, reading: Option<ClockReading>) {
        let had_sink = self.state.recording.has_sink;
        let without = if had_sink { ClockReading::Ended } else { ClockReading::Waiting };
        self.state.recording =
            Recording { reading: reading.unwrap_or(without), has_sink: had_sink || reading.is_some() };
    }

    /// Forgets the recording of the line before.
    pub(crate) fn forget_recording(&mut self) {
        if self.state.recording.reading == ClockReading::Ended {
            self.state.recording = Recording::default();
        }
    }
}
