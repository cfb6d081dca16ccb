//! The cursor: where a clip is while it is played.

use super::state::{self, Characters};
use super::{CharacterState, ConsonantHold, DueSegments, Lead};
use crate::babble::Weight;
use crate::event::NameKey;
use crate::{Clip, EventName, Segment, Time, Viseme, VisemeType, segment};
use lipz_types::StoredFps;

/// Where a clip is while it is played.
///
/// Call [`Cursor::advance_to`] once per picture with the position of the sound, and draw what the other
/// methods return. The unit of the cursor is the frame: what happens within one is simultaneous.
///
/// A cursor is a few numbers. It borrows nothing, so a game keeps it beside the bank, with the id of its
/// clip, and looks the clip up again for each picture:
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
///             println!("{event}"); // wave, glance: what lasts is also in `cursor.state`
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
/// The clip may come from a newer version of the bank: the cursor continues at the same time, and fires the segments behind
/// those that it has fired, by their numbers. If the new clip is divided into different segments, [`seek`](Cursor::seek) to
/// the time of the audio. With a clip of a different ID the cursor does the same, so start a new one for a new line.
///
/// `docs/guides/playback.md` has a table of what happens when time goes on, stands still, jumps, loops and ends.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Cursor {
    /// For clips that have none: looked up again, a clip does not know what it was given.
    fps: StoredFps,
    viseme_type: Option<VisemeType>,
    lead: Lead,
    hold: ConsonantHold,
    speaker: Option<NameKey>,
    /// The frame at the position of the sound; [`OVER`] from the end on, `None` before the start.
    frame: Option<u32>,
    /// The same, for the mouth, which is ahead of the sound.
    mouth_frame: Option<u32>,
    /// The first segment whose events have not fired.
    next_segment: u32,
    /// Whether `next_segment` is the one behind those that have begun at `frame`: then the same frame fires nothing.
    is_fired: bool,
    /// Whether all events of the clip had fired before those up to `next_segment`.
    has_looped: bool,
}

/// In place of a frame, from the end of the clip on. No frame has this number: a clip has fewer.
const OVER: u32 = u32::MAX;

/// In place of a frame, before the start: among the words of a cursor only.
const WAITING: u32 = u32::MAX - 1;

impl Cursor {
    /// A cursor that waits for the sound of `clip` to begin; `None` without a frame rate: give the clip one with
    /// [`Clip::or_fps`].
    ///
    /// The cursor keeps the frame rate and the viseme type that the clip was given, and uses them for clips
    /// that have none.
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

    /// Shows mouth shapes so much ahead of the sound. Segments and events stay with the sound.
    #[must_use]
    pub fn with_lead(mut self, lead: Lead) -> Self {
        self.lead = lead;
        self
    }

    /// Holds consonants at least so long.
    #[must_use]
    pub fn with_hold(mut self, hold: ConsonantHold) -> Self {
        self.hold = hold;
        self
    }

    /// Sets who speaks: the character of events that name none. A name that no event mentions is
    /// not in the bank, and `None` does as well.
    ///
    /// A name counts for clips of its own bank only. Set it again when the bank was replaced.
    #[must_use]
    pub fn with_speaker(mut self, speaker: Option<EventName<'_>>) -> Self {
        self.speaker = speaker.map(EventName::key);
        self
    }

    /// Where the cursor is, as numbers: what moves with it, and not what it was given with `new` and `with_…`. To keep
    /// it where no cursor can be: in a saved game, or in a struct of another language.
    ///
    /// The frames at the positions of sound and mouth ([`u32::MAX`] from the end on, one less before the start); the
    /// first segment whose events have not fired; and a bit each for whether those before it have just fired, and
    /// whether the clip has looped.
    pub fn to_words(&self) -> [u32; 4] {
        let flags = u32::from(self.is_fired) | u32::from(self.has_looped) << 1;
        [self.frame.unwrap_or(WAITING), self.mouth_frame.unwrap_or(WAITING), self.next_segment, flags]
    }

    /// The cursor where [`to_words`](Cursor::to_words) said that it was. Any numbers are taken; those of another clip
    /// do what its cursor would do.
    #[must_use]
    pub fn with_words(mut self, [frame, mouth_frame, next_segment, flags]: [u32; 4]) -> Self {
        self.frame = Some(frame).filter(|&frame| frame != WAITING);
        self.mouth_frame = Some(mouth_frame).filter(|&frame| frame != WAITING);
        self.next_segment = next_segment;
        self.is_fired = flags & 1 != 0;
        self.has_looped = flags & 2 != 0;
        self
    }

    /// The sound has reached `time`: returns the segments that have begun since the last call, in order,
    /// each once, however long ago that was. Segments of no frames are among them.
    ///
    /// A time before that of the last call fires nothing, and nothing fires again until the sound
    /// is past the point that it had reached: clocks of audio engines jitter. To play something again,
    /// [`seek`](Cursor::seek).
    #[must_use = "the events of these segments do not fire again"]
    pub fn advance_to<'a, T: Time>(&mut self, clip: &Clip<'a>, time: T) -> DueSegments<'a> {
        let (before, first) = (self.frame, self.next_segment);
        self.show(clip, time);
        // A display shows most frames more than once.
        if self.frame != before || !self.is_fired {
            self.next_segment = first.max(self.segments_begun(clip));
            self.is_fired = true;
        }
        DueSegments::new(self, clip, first..self.next_segment, 0)
    }

    /// The sound has jumped from its end to its start, and has reached `time` since: returns the segments
    /// that were left, then those from the start on. Call it once per round.
    ///
    /// What characters feel, stare and point at outlasts the end of a round.
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
    /// Afterwards, [`characters`](Cursor::characters) says what everybody feels, stares and points at: as if the
    /// clip had been played once from its start to here.
    pub fn seek<T: Time>(&mut self, clip: &Clip<'_>, time: T) {
        self.show(clip, time);
        // From the end on, that is the last frame.
        let before = self.frame.and_then(|frame| frame.min(clip.frame_count()).checked_sub(1));
        self.next_segment = before.map_or(0, |frame| segments_begun_by(clip, frame));
        self.is_fired = false;
        self.has_looped = false;
    }

    /// Ends the clip before the sound does, as when a player skips it: returns the segments that
    /// were left.
    #[must_use = "the events of these segments do not fire again"]
    pub fn finish<'a>(&mut self, clip: &Clip<'a>) -> DueSegments<'a> {
        self.frame = Some(OVER);
        self.mouth_frame = self.frame;
        let first = self.next_segment;
        self.next_segment = clip.segment_count();
        self.is_fired = true;
        DueSegments::new(self, clip, first..self.next_segment, 0)
    }

    /// The mouth shape to draw, with lead and hold; rest before the start and from the end on.
    #[inline]
    pub fn viseme(&self, clip: &Clip<'_>) -> Viseme {
        match self.mouth_frame {
            Some(frame) => clip.viseme(self.hold.frame(clip, self.viseme_type, frame)),
            None => Viseme::REST,
        }
    }

    /// How far the mouth to draw is open, with lead and hold; `None` if the clip has no frames, or if neither it nor the cursor
    /// has a viseme type: let the mouth [babble](crate::babble).
    pub fn openness(&self, clip: &Clip<'_>) -> Option<Weight> {
        let viseme_type = clip.viseme_type().or(self.viseme_type)?;
        if clip.frame_count() > 0 { Some(self.viseme(clip).openness(viseme_type)) } else { None }
    }

    /// The segment whose subtitle to show; `None` before the start and from the end on.
    pub fn segment<'a>(&self, clip: &Clip<'a>) -> Option<Segment<'a>> {
        clip.segment_of_frame(self.frame?)
    }

    /// The frame at the position of the sound; `None` before the start and from the end on.
    pub fn frame(&self) -> Option<u32> {
        self.frame.filter(|&frame| frame != OVER)
    }

    /// Whether the sound is past the last frame. Then all events have fired.
    pub fn is_over(&self) -> bool {
        self.frame == Some(OVER)
    }

    /// What `character` feels, stares and points at, after the events that have fired or were jumped
    /// over; `None` stands for the speaker.
    ///
    /// Read from the events anew with each call, in a time that grows with their number.
    pub fn state<'a>(&self, clip: &Clip<'a>, character: Option<EventName<'_>>) -> CharacterState<'a> {
        state::after(self.past(clip), character)
    }

    /// Every character that an event of the clip is about, also one to come, with its
    /// [state](Cursor::state): what to set after a jump. The speaker without a name comes first as `None`.
    pub fn characters<'a>(
        &self,
        clip: &Clip<'a>,
    ) -> impl Iterator<Item = (Option<EventName<'a>>, CharacterState<'a>)> + Clone {
        Characters::new(DueSegments::new(self, clip, 0..u32::MAX, 0), self.past(clip))
    }

    /// Whose events name no character.
    pub(super) fn speaker(&self) -> Option<NameKey> {
        self.speaker
    }

    /// All segments whose events have fired or were jumped over, from the start of the last round but one.
    fn past<'a>(&self, clip: &Clip<'a>) -> DueSegments<'a> {
        let last_round = if self.has_looped { u32::MAX } else { 0 };
        DueSegments::new(self, clip, 0..last_round, self.next_segment)
    }

    /// Moves sound and mouth to `time`.
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

    /// How many segments have begun at the position of the sound.
    fn segments_begun(&self, clip: &Clip<'_>) -> u32 {
        match self.frame {
            None => 0,
            Some(OVER) => clip.segment_count(),
            Some(frame) => segments_begun_by(clip, frame),
        }
    }
}

/// How many segments start at or before `frame`, which is one of the clip.
fn segments_begun_by(clip: &Clip<'_>, frame: u32) -> u32 {
    let last = segment::index_of_frame(clip, frame);
    last.map_or(0, |last| last.saturating_add(1)).min(clip.segment_count())
}
