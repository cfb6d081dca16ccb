//! The line that a player plays: its clip, its cursor and its subtitle.

use crate::clock::ClockReading;
use crate::playback::Triggers;
use crate::player::Request;
use crate::{LipzBank, LipzError, LipzMouth, LipzPlayer};
use bevy::asset::AssetId;
use lipz_bank::playback::{ConsonantHold, DueSegments, Lead};
use lipz_bank::{Bank, Clip, ClipId, Cursor, Fps, Locale};
use std::time::Duration;

/// The frame rate of clips that do not specify one.
const DEFAULT_FPS: Fps = Fps::whole(24);

/// A line: the request for it, and its progress.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    bank: AssetId<LipzBank>,
    /// The key that the player asked for. In a voice, the clip can be a dub with a different key.
    key: String,
    /// The version of the bank.
    checksum: u64,
    progress: Progress,
}

#[derive(Clone, Debug)]
enum Progress {
    Playing(Playing),
    Over,
    /// The bank does not contain the clip. A new version may contain it.
    Missing,
}

#[derive(Clone, Debug)]
struct Playing {
    clip: ClipId,
    cursor: Cursor,
    time: Duration,
    /// Whether the clock stands still or has not started, so that the mouth rests.
    is_resting: bool,
    tag: String,
    locale: Option<Locale>,
    /// The segment of the subtitle.
    segment: Option<u32>,
    subtitle: String,
}

impl Line {
    /// Starts the line that `player` asks for.
    pub(crate) fn start(player: &LipzPlayer, bank: &Bank<'_>, triggers: &mut Triggers) -> Line {
        let clip = find(bank, &player.clip, &player.voice);
        let cursor = clip.as_ref().and_then(|clip| Some((clip, Cursor::new(clip)?)));
        let progress = match cursor {
            Some((clip, cursor)) => Progress::Playing(Playing::new(clip, cursor, player, bank)),
            None => {
                triggers.fail(LipzError::NoClip { key: player.clip.clone() });
                Progress::Missing
            }
        };
        let line = Line { bank: player.bank.id(), key: player.clip.clone(), checksum: bank.checksum(), progress };
        line.report_locale(bank, triggers);
        line
    }

    /// Whether the player asks for a different line, or can now play this one.
    pub(crate) fn is_outdated(&self, player: &LipzPlayer, bank: &Bank<'_>) -> bool {
        let is_found = matches!(self.progress, Progress::Missing) && self.checksum != bank.checksum();
        is_found || !self.is_wanted(player)
    }

    /// Whether the player asks for this line.
    pub(crate) fn is_wanted(&self, player: &LipzPlayer) -> bool {
        self.is_from(player.bank.id()) && self.key == player.clip
    }

    /// Whether the line is from this bank.
    pub(crate) fn is_from(&self, bank: AssetId<LipzBank>) -> bool {
        self.bank == bank
    }

    /// Moves the line to the next rendered frame. Returns the mouth to draw.
    pub(crate) fn advance(
        &mut self,
        (bank, reading): (&Bank<'_>, ClockReading),
        request: Option<Request>,
        speaker: &str,
        triggers: &mut Triggers,
    ) -> LipzMouth {
        if request == Some(Request::Skip) {
            self.skip(bank, speaker, triggers);
            return LipzMouth::REST;
        }
        self.renew(bank, speaker, triggers);
        let Progress::Playing(playing) = &mut self.progress else { return LipzMouth::REST };
        let Some(clip) = bank.clip(playing.clip).map(|clip| clip.or_fps(DEFAULT_FPS)) else { return LipzMouth::REST };
        match request {
            Some(Request::Stop) => {
                self.end(triggers);
                return LipzMouth::REST;
            }
            Some(Request::Seek { to }) => playing.seek(&clip, to),
            // At its start, a line waits for its clock.
            Some(Request::Start { at }) if !at.is_zero() => playing.seek(&clip, at),
            Some(Request::Start { .. } | Request::Skip) | None => {}
        }
        playing.is_resting = playing.follow(&clip, reading, |due| triggers.segments(due, speaker));
        if playing.cursor.is_over() {
            self.end(triggers);
            triggers.finish();
            return LipzMouth::REST;
        }
        playing.show_subtitle(&clip, triggers);
        if playing.is_resting { LipzMouth::REST } else { playing.mouth(&clip) }
    }

    /// Ends the line, and triggers its remaining events.
    pub(crate) fn skip(&mut self, bank: &Bank<'_>, speaker: &str, triggers: &mut Triggers) {
        self.renew(bank, speaker, triggers);
        let Progress::Playing(playing) = &mut self.progress else { return };
        let Some(clip) = bank.clip(playing.clip).map(|clip| clip.or_fps(DEFAULT_FPS)) else { return };
        triggers.segments(playing.cursor.finish(&clip), speaker);
        self.end(triggers);
        triggers.finish();
    }

    /// Continues in a new version of the bank.
    fn renew(&mut self, bank: &Bank<'_>, speaker: &str, triggers: &mut Triggers) {
        if self.checksum == bank.checksum() {
            return;
        }
        self.checksum = bank.checksum();
        let Progress::Playing(playing) = &mut self.progress else { return };
        if bank.clip(playing.clip).is_none() {
            triggers.fail(LipzError::NoClip { key: self.key.clone() });
            self.end(triggers);
            return;
        }
        playing.cursor = playing.cursor.with_speaker(bank.event_name(speaker));
        playing.locale = locale(bank, &playing.tag);
        playing.segment = None;
    }

    /// Shows subtitles in this language from now on.
    pub(crate) fn speak(&mut self, tag: &str, bank: &Bank<'_>, triggers: &mut Triggers) {
        let Progress::Playing(playing) = &mut self.progress else { return };
        if playing.tag == tag {
            return;
        }
        tag.clone_into(&mut playing.tag);
        playing.locale = locale(bank, tag);
        playing.segment = None;
        self.report_locale(bank, triggers);
    }

    fn report_locale(&self, bank: &Bank<'_>, triggers: &mut Triggers) {
        let Progress::Playing(Playing { tag, .. }) = &self.progress else { return };
        if !tag.is_empty() && bank.locale(tag).is_none() {
            let known = bank.locales().map(|locale| bank.locale_tag(locale).to_owned()).collect();
            triggers.fail(LipzError::NoLocale { tag: tag.clone(), known });
        }
    }

    /// Ends the line and its subtitle.
    pub(crate) fn end(&mut self, triggers: &mut Triggers) {
        if !self.subtitle().is_empty() {
            triggers.subtitle("", false);
        }
        self.progress = Progress::Over;
    }

    pub(crate) fn time(&self) -> Option<Duration> {
        self.playing().map(|playing| playing.time)
    }

    pub(crate) fn cursor(&self) -> Option<&Cursor> {
        self.playing().map(|playing| &playing.cursor)
    }

    pub(crate) fn subtitle(&self) -> &str {
        self.playing().map_or("", |playing| &playing.subtitle)
    }

    /// Returns the clip and the time that a face shows; `None` if it rests.
    #[cfg(feature = "face")]
    pub(crate) fn pose<'a>(&self, bank: &'a Bank<'_>) -> Option<(Clip<'a>, Duration)> {
        let playing = self.playing().filter(|playing| !playing.is_resting)?;
        Some((bank.clip(playing.clip)?.or_fps(DEFAULT_FPS), playing.time))
    }

    fn playing(&self) -> Option<&Playing> {
        match &self.progress {
            Progress::Playing(playing) => Some(playing),
            Progress::Over | Progress::Missing => None,
        }
    }
}

impl Playing {
    fn new(clip: &Clip<'_>, cursor: Cursor, player: &LipzPlayer, bank: &Bank<'_>) -> Playing {
        let fps = clip.fps().unwrap_or(DEFAULT_FPS);
        let hold = if player.holds_consonants { ConsonantHold::readable(fps) } else { ConsonantHold::NONE };
        let lead = Lead::micros(Lead::one_frame(fps).us().saturating_mul(player.lead_frames.into()));
        Playing {
            clip: clip.id(),
            cursor: cursor.with_hold(hold).with_lead(lead).with_speaker(bank.event_name(&player.speaker)),
            time: Duration::ZERO,
            is_resting: true,
            tag: player.locale.clone(),
            locale: locale(bank, &player.locale),
            segment: None,
            subtitle: String::new(),
        }
    }

    fn seek(&mut self, clip: &Clip<'_>, time: Duration) {
        self.time = time;
        self.cursor.seek(clip, time);
    }

    /// Follows the clock, and passes the segments that have become due to `see`. Returns whether the clock stands still.
    fn follow(&mut self, clip: &Clip<'_>, reading: ClockReading, see: impl FnOnce(DueSegments<'_>)) -> bool {
        let is_resting = match reading {
            ClockReading::Waiting => return true,
            ClockReading::Later(later) => {
                self.time = self.time.saturating_add(later);
                false
            }
            ClockReading::At { time, is_paused } => {
                self.time = time;
                is_paused
            }
            ClockReading::Ended => {
                see(self.cursor.finish(clip));
                return true;
            }
        };
        see(self.cursor.advance_to(clip, self.time));
        is_resting
    }

    /// Triggers the subtitle, if it has changed.
    fn show_subtitle(&mut self, clip: &Clip<'_>, triggers: &mut Triggers) {
        let segment = self.cursor.segment(clip);
        let index = segment.as_ref().map(lipz_bank::Segment::index);
        if index == self.segment {
            return;
        }
        self.segment = index;
        let text = segment.zip(self.locale).and_then(|(segment, locale)| segment.text(locale));
        let (shown, is_fallback) = text.map_or(("", false), |text| (text.as_str(), text.is_fallback()));
        if shown != self.subtitle {
            shown.clone_into(&mut self.subtitle);
            triggers.subtitle(shown, is_fallback);
        }
    }

    fn mouth(&self, clip: &Clip<'_>) -> LipzMouth {
        let openness = self.cursor.openness(clip).map(lipz_bank::babble::Weight::to_f32);
        LipzMouth { viseme: self.cursor.viseme(clip).to_char(), openness }
    }
}

/// Returns the clip that is played for a line in a voice.
fn find<'a>(bank: &'a Bank<'_>, key: &str, voice: &str) -> Option<Clip<'a>> {
    let clip = bank.clip_by_key(key)?;
    let clip = bank.voice(voice).map_or(clip, |voice| clip.in_voice(voice).clip);
    Some(clip.or_fps(DEFAULT_FPS))
}

/// Returns the language of subtitles: that of the player, or the default one of the bank, or its first.
fn locale(bank: &Bank<'_>, tag: &str) -> Option<Locale> {
    bank.locale(tag).or_else(|| bank.default_locale()).or_else(|| bank.locales().next())
}
