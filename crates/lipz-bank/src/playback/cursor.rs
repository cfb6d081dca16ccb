//! The cursor: the position in a clip during playback.

use super::state::{self, Characters};
use super::{CharacterState, ConsonantHold, DueSegments, Lead};
use crate::babble::Weight;
use crate::event::NameKey;
use crate::{Clip, EventName, Segment, Time, Viseme, VisemeType, segment};
use lipz_types::StoredFps;

/// The position in a clip during playback.
///
/// Call [`Cursor::advance_to`] once per rendered frame with the position of the audio, and draw what the other methods
/// return. The unit of the cursor is the frame: events in the same frame are simultaneous.
///
/// A cursor is a few numbers and borrows nothing. A game keeps it next to the bank, with the id of its clip, and looks
/// the clip up again for each rendered frame:
///
/// ```
/// use lipz_bank::{Bank, ClipId, Cursor, Micros};
///
/// struct Game {
///     bank: Bank<'static>, // or a `Dialogue`, of this crate or of `lipz_host`
///     playing: Option<(ClipId, Cursor)>,
/// }
///
/// impl Game {
///     fn start(&mut self, id: ClipId) {
///         let cursor = self.bank.clip(id).and_then(|clip| Cursor::new(&clip));
///         self.playing = cursor.map(|cursor| (id, cursor.with_speaker(self.bank.event_name("mara"))));
///     }
///
///     fn draw(&mut self, sound: Micros) {
///         let Some((id, cursor)) = &mut self.playing else { return };
///         let Some(clip) = self.bank.clip(*id) else { return };
///         for event in cursor.advance_to(&clip, sound).events() {
///             println!("{event}"); // wave, glance: lasting effects are also in `cursor.state`
///         }
///         println!("{}", cursor.viseme(&clip));
///         if cursor.is_over() {
///             self.playing = None;
///         }
///     }
/// }
///
/// # let bytes: &'static [u8] = include_bytes!("../../examples/act1.lipzbank");
/// let mut game = Game { bank: Bank::open(bytes)?.verify()?, playing: None };
/// game.start(ClipId::from_key("act1/mara-good-evening"));
/// # assert!(game.playing.is_some());
/// for picture in 0..1000 {
///     game.draw(Micros(picture * 16_667));
/// }
/// # assert!(game.playing.is_none());
/// # Ok::<(), lipz_bank::Error>(())
/// ```
///
/// The clip may come from a newer version of the bank. The cursor then continues at the same time, and fires the
/// segments after those that it has fired, by number. If the new clip has different segments, [`seek`](Cursor::seek) to
/// the time of the audio. The cursor does the same with a clip of a different id, so start a new one for a new line.
///
/// `docs/guides/playback.md` has a table of the results when the time advances, stands still, jumps, loops and ends.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Cursor {
    /// The frame rate for clips without one, because a clip that is looked up again has lost its [`Clip::or_fps`].
    fps: StoredFps,
    viseme_type: Option<VisemeType>,
    lead: Lead,
    hold: ConsonantHold,
    speaker: Option<NameKey>,
    /// The frame at the position of the audio; [`OVER`] from the end on, `None` before the start.
    frame: Option<u32>,
    /// The same for the mouth, which is ahead of the audio.
    mouth_frame: Option<u32>,
    /// The first segment whose events have not fired.
    next_segment: u32,
    /// Whether `next_segment` follows the segments that have begun at `frame`. The same frame then fires nothing.
    is_fired: bool,
    /// Whether all events of the clip had fired before those up to `next_segment`.
    has_looped: bool,
}

/// Stands for the frame from the end of the clip on. No frame has this number, because clips are shorter.
const OVER: u32 = u32::MAX;

/// Stands for the frame before the start, but only in the words of a cursor.
const WAITING: u32 = u32::MAX - 1;

impl Cursor {
    /// Returns a cursor that waits for the audio of `clip` to start; `None` without a frame rate: set one with
    /// [`Clip::or_fps`].
    ///
    /// The cursor stores the frame rate and the viseme type that were set on the clip, and uses them for clips without
    /// their own.
    pub fn new(clip: &Clip<'_>) -> Option<Cursor> {
        Some(Cursor {
            fps: clip.stored_fps()?,
            viseme_type: clip.viseme_type(),
            lead: Lead::NONE,
            hold: ConsonantHold::NONE,
            speaker: None,
            frame: None,
            mouth_frame: None,
            next_segment: 0,
            is_fired: false,
            has_looped: false,
        })
    }

    /// Shows visemes this much ahead of the audio. Segments and events stay with the audio.
    #[must_use]
    pub fn with_lead(mut self, lead: Lead) -> Self {
        self.lead = lead;
        self
    }

    /// Sets the minimal duration of consonants.
    #[must_use]
    pub fn with_hold(mut self, hold: ConsonantHold) -> Self {
        self.hold = hold;
        self
    }

    /// Sets the speaker, who is the character of events without a name. A name that is in no event is not in the bank
    /// either; pass `None` for it.
    ///
    /// A name is valid only for clips of its own bank. Set it again when the bank is replaced.
    #[must_use]
    pub fn with_speaker(mut self, speaker: Option<EventName<'_>>) -> Self {
        self.speaker = speaker.map(EventName::key);
        self
    }

    /// Returns the position of the cursor as numbers, without the settings of `new` and `with_…`. Use it to store the
    /// cursor in a saved game, or in a struct of another language.
    ///
    /// The numbers are the frames at the positions of audio and mouth ([`u32::MAX`] from the end on, one less before
    /// the start), the first segment whose events have not fired, and two bits: whether the segments before it have
    /// just fired, and whether the clip has looped.
    pub fn to_words(&self) -> [u32; 4] {
        let flags = u32::from(self.is_fired) | u32::from(self.has_looped) << 1;
        [self.frame.unwrap_or(WAITING), self.mouth_frame.unwrap_or(WAITING), self.next_segment, flags]
    }

    /// Restores the position from [`to_words`](Cursor::to_words). Any numbers are accepted; those of another clip act
    /// as on its cursor.
    #[must_use]
    pub fn with_words(mut self, [frame, mouth_frame, next_segment, flags]: [u32; 4]) -> Self {
        self.frame = Some(frame).filter(|&frame| frame != WAITING);
        self.mouth_frame = Some(mouth_frame).filter(|&frame| frame != WAITING);
        self.next_segment = next_segment;
        self.is_fired = flags & 1 != 0;
        self.has_looped = flags & 2 != 0;
        self
    }

    /// Moves the cursor to the audio position `time`. Returns the segments that have begun since the last call, in
    /// order and each once, even after a long time. Empty segments are included.
    ///
    /// A time before that of the last call fires nothing, and nothing fires again until the audio is past the point
    /// that it had reached, because clocks of audio engines jitter. To play something again, [`seek`](Cursor::seek).
    #[must_use = "the events of these segments do not fire again"]
    pub fn advance_to<'a, T: Time>(&mut self, clip: &Clip<'a>, time: T) -> DueSegments<'a> {
        let (before, first) = (self.frame, self.next_segment);
        self.show(clip, time);
        // A display shows most frames several times.
        if self.frame != before || !self.is_fired {
            self.next_segment = first.max(self.segments_begun(clip));
            self.is_fired = true;
        }
        DueSegments::new(self, clip, first..self.next_segment, 0)
    }

    /// Moves the cursor after the audio has jumped from its end to its start, and then reached `time`. Returns the
    /// remaining segments, then those from the start on. Call it once per loop.
    ///
    /// Emotions, stares and pointing last beyond the end of the clip.
    #[must_use = "the events of these segments do not fire again"]
    pub fn loop_to<'a, T: Time>(&mut self, clip: &Clip<'a>, time: T) -> DueSegments<'a> {
        self.show(clip, time);
        let first = self.next_segment;
        self.next_segment = self.segments_begun(clip);
        self.is_fired = true;
        self.has_looped = true;
        DueSegments::new(self, clip, first..u32::MAX, self.next_segment)
    }

    /// Jumps to `time`, forward or back. Nothing fires; the next [`advance_to`](Cursor::advance_to) starts with the
    /// segments that begin in the frame of `time`.
    ///
    /// Afterwards, [`characters`](Cursor::characters) returns the state of all characters, as if the clip had been
    /// played once from its start to here.
    pub fn seek<T: Time>(&mut self, clip: &Clip<'_>, time: T) {
        self.show(clip, time);
        // From the end on, that is the last frame.
        let before = self.frame.and_then(|frame| frame.min(clip.frame_count()).checked_sub(1));
        self.next_segment = before.map_or(0, |frame| segments_begun_by(clip, frame));
        self.is_fired = false;
        self.has_looped = false;
    }

    /// Ends the clip before the audio ends, as when a player skips it. Returns the remaining segments.
    #[must_use = "the events of these segments do not fire again"]
    pub fn finish<'a>(&mut self, clip: &Clip<'a>) -> DueSegments<'a> {
        self.frame = Some(OVER);
        self.mouth_frame = self.frame;
        let first = self.next_segment;
        self.next_segment = clip.segment_count();
        self.is_fired = true;
        DueSegments::new(self, clip, first..self.next_segment, 0)
    }

    /// Returns the viseme to draw, with lead and hold, or rest before the start and from the end on.
    #[inline]
    pub fn viseme(&self, clip: &Clip<'_>) -> Viseme {
        match self.mouth_frame {
            Some(frame) => clip.viseme(self.hold.frame(clip, self.viseme_type, frame)),
            None => Viseme::REST,
        }
    }

    /// Returns how far the mouth to draw is open, with lead and hold. `None` if the clip has no frames, or if neither
    /// it nor the cursor has a viseme type: let the mouth [babble](crate::babble).
    pub fn openness(&self, clip: &Clip<'_>) -> Option<Weight> {
        let viseme_type = clip.viseme_type().or(self.viseme_type)?;
        if clip.frame_count() > 0 { Some(self.viseme(clip).openness(viseme_type)) } else { None }
    }

    /// Returns the segment of the subtitle to show; `None` before the start and from the end on.
    pub fn segment<'a>(&self, clip: &Clip<'a>) -> Option<Segment<'a>> {
        clip.segment_of_frame(self.frame?)
    }

    /// Returns the frame at the position of the audio; `None` before the start and from the end on.
    pub fn frame(&self) -> Option<u32> {
        self.frame.filter(|&frame| frame != OVER)
    }

    /// Whether the audio is past the last frame. Then all events have fired.
    pub fn is_over(&self) -> bool {
        self.frame == Some(OVER)
    }

    /// Returns the emotion of `character`, and the targets of staring and pointing, after the events that have fired or
    /// were jumped over; `None` stands for the speaker.
    ///
    /// Each call evaluates the events again, in a time that grows with their number.
    pub fn state<'a>(&self, clip: &Clip<'a>, character: Option<EventName<'_>>) -> CharacterState<'a> {
        state::after(self.past(clip), character)
    }

    /// Returns every character in the events of the clip, including future events, with their [state](Cursor::state) to
    /// apply after a jump. The speaker without a name comes first as `None`.
    pub fn characters<'a>(
        &self,
        clip: &Clip<'a>,
    ) -> impl Iterator<Item = (Option<EventName<'a>>, CharacterState<'a>)> + Clone {
        Characters::new(DueSegments::new(self, clip, 0..u32::MAX, 0), self.past(clip))
    }

    /// Returns the character of events without a name.
    pub(super) fn speaker(&self) -> Option<NameKey> {
        self.speaker
    }

    /// Returns all segments whose events have fired or were jumped over, from the start of the previous loop.
    fn past<'a>(&self, clip: &Clip<'a>) -> DueSegments<'a> {
        let last_round = if self.has_looped { u32::MAX } else { 0 };
        DueSegments::new(self, clip, 0..last_round, self.next_segment)
    }

    /// Moves audio and mouth to `time`.
    fn show<T: Time>(&mut self, clip: &Clip<'_>, time: T) {
        self.frame = self.frame_at(clip, time);
        self.mouth_frame =
            if self.lead == Lead::NONE { self.frame } else { self.frame_at(clip, time.later(self.lead.us())) };
    }

    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // long code, needed twice
    #[cfg_attr(target_pointer_width = "64", inline)]
    fn frame_at<T: Time>(&self, clip: &Clip<'_>, time: T) -> Option<u32> {
        match time.frame(clip.stored_fps().unwrap_or(self.fps), clip.frame_count()) {
            None if time.has_begun() => Some(OVER),
            frame => frame,
        }
    }

    /// Returns the number of segments that have begun at the position of the audio.
    fn segments_begun(&self, clip: &Clip<'_>) -> u32 {
        match self.frame {
            None => 0,
            Some(OVER) => clip.segment_count(),
            Some(frame) => segments_begun_by(clip, frame),
        }
    }
}

/// Returns the number of segments that start at or before `frame`, which must be in the clip.
fn segments_begun_by(clip: &Clip<'_>, frame: u32) -> u32 {
    let last = segment::index_of_frame(clip, frame);
    last.map_or(0, |last| last.saturating_add(1)).min(clip.segment_count())
}
