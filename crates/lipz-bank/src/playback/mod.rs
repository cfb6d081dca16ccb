//! Playing a clip: a cursor that follows the sound, and fires each event once.

mod crossed;
mod hold;
mod lead;
mod state;

pub use crossed::Crossed;
pub use hold::Hold;
pub use lead::Lead;
pub use state::{CharacterState, Characters};

use crate::{Clip, EventName, Fps, Segment, Time, Viseme, segment};
use core::fmt;

/// A clip while it is played: a cursor that is told where the sound is.
///
/// Call [`Playback::advance_to`] once per picture with the position of the sound, and draw what the
/// other methods say. The unit of the cursor is the frame: what happens within one is simultaneous. It owns no memory,
/// is cheap to copy, and can be thrown away: a new one that [seeks](Playback::seek) knows as much.
///
/// `docs/PLAYBACK.md` tells in a table what happens when time goes on, stands still, jumps, loops and ends.
///
/// ```
/// use lipz_bank::{Bank, Lead, Micros, Playback};
///
/// # let bytes: &[u8] = include_bytes!("../../../../fixtures/banks/v1/drama.lipzbank");
/// let bank = Bank::open(bytes)?.verify()?;
/// let clip = bank.clip_by_key("act1/mara-good-evening");
/// # let mut fired = 0;
/// if let Some(mut playback) = clip.and_then(Playback::new) {
///     playback = playback.with_speaker(bank.event_name("mara"));
///     for now in (0..).step_by(16_667).map(Micros) {
///         for event in playback.advance_to(now).events() {
///             println!("{event}"); // wave, glance: what lasts is also in `playback.state`
///             # fired += 1;
///         }
///         println!("{}", playback.viseme());
///         if playback.is_over() {
///             break;
///         }
///     }
/// }
/// # assert!(fired > 0);
/// # Ok::<(), lipz_bank::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Playback<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    fps: Fps,
    lead: Lead,
    hold: Hold,
    speaker: Option<EventName<'data>>,
    /// The frame at the position of the sound; the number of frames from the end on, `None` before the start.
    frame: Option<u32>,
    /// The same, for the mouth, which is ahead of the sound.
    mouth_frame: Option<u32>,
    /// The first segment whose events have not fired.
    next_segment: u32,
    /// Whether all events of the clip had fired before those up to `next_segment`.
    has_looped: bool,
}

impl<'data, 'bank> Playback<'data, 'bank> {
    /// A playback that waits for the sound to begin; `None` without a frame rate: give the clip one with
    /// [`Clip::or_fps`].
    pub fn new(clip: Clip<'data, 'bank>) -> Option<Self> {
        Some(Playback {
            clip,
            fps: clip.fps()?,
            lead: Lead::NONE,
            hold: Hold::NONE,
            speaker: None,
            frame: None,
            mouth_frame: None,
            next_segment: 0,
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
    pub fn with_hold(mut self, hold: Hold) -> Self {
        self.hold = hold;
        self
    }

    /// Says whose clip it is: the character of events that name none. A name that no event mentions is
    /// not in the bank, and `None` does as well.
    #[must_use]
    pub fn with_speaker(mut self, speaker: Option<EventName<'data>>) -> Self {
        self.speaker = speaker;
        self
    }

    /// The clip that is played.
    pub const fn clip(&self) -> &Clip<'data, 'bank> {
        &self.clip
    }

    /// The sound has reached `time`: gives the segments that have begun since the last call, in order,
    /// each once, however long ago that was. Segments of no frames are among them.
    ///
    /// A time before that of the last call fires nothing, and nothing fires again until the sound
    /// is past the point that it had reached: clocks of audio engines jitter. To play something again,
    /// [`seek`](Playback::seek).
    #[must_use = "the events of these segments do not fire again"]
    pub fn advance_to<T: Time>(&mut self, time: T) -> Crossed<'data, 'bank> {
        self.show(time);
        let first = self.next_segment;
        self.next_segment = first.max(self.segments_begun());
        Crossed::new(self, first, self.next_segment)
    }

    /// The sound has jumped from its end to its start, and has reached `time` since: gives the segments
    /// that were left, then those from the start on. Call it once per round.
    ///
    /// What characters feel, stare and point at outlasts the end of a round.
    #[must_use = "the events of these segments do not fire again"]
    pub fn loop_to<T: Time>(&mut self, time: T) -> Crossed<'data, 'bank> {
        self.show(time);
        let first = self.next_segment;
        self.next_segment = self.segments_begun();
        self.has_looped = true;
        Crossed::around(self, first, self.next_segment)
    }

    /// Jumps to `time`, forward or back. Nothing fires; the next [`advance_to`](Playback::advance_to) starts with the segments
    /// that begin in the frame of `time`.
    ///
    /// Afterwards, [`characters`](Playback::characters) tells what everybody feels, stares and points at: as if the clip had been
    /// played once from its start to here.
    pub fn seek<T: Time>(&mut self, time: T) {
        self.show(time);
        let before = self.frame.and_then(|frame| frame.checked_sub(1));
        self.next_segment = before.map_or(0, |frame| self.segments_begun_by(frame));
        self.has_looped = false;
    }

    /// Ends the playback before the sound does, as when a player skips a clip: gives the segments that
    /// were left.
    #[must_use = "the events of these segments do not fire again"]
    pub fn finish(&mut self) -> Crossed<'data, 'bank> {
        self.frame = Some(self.clip.frame_count());
        self.mouth_frame = self.frame;
        let first = self.next_segment;
        self.next_segment = self.clip.segment_count();
        Crossed::new(self, first, self.next_segment)
    }

    /// The mouth shape to draw, with lead and hold; rest before the start and from the end on.
    pub fn viseme(&self) -> Viseme {
        let shown = self.mouth_frame.map(|frame| self.hold.frame(&self.clip, frame));
        shown.map_or(Viseme::REST, |frame| self.clip.viseme(frame))
    }

    /// The segment whose subtitle to show; `None` before the start and from the end on.
    pub fn segment(&self) -> Option<Segment<'data, 'bank>> {
        self.clip.segment_of_frame(self.frame?)
    }

    /// The frame at the position of the sound; `None` before the start and from the end on.
    pub fn frame(&self) -> Option<u32> {
        self.frame.filter(|&frame| frame < self.clip.frame_count())
    }

    /// Whether the sound is past the last frame. Then all events have fired.
    pub fn is_over(&self) -> bool {
        self.frame.map_or(false, |frame| frame >= self.clip.frame_count())
    }

    /// What `character` feels, stares and points at, after the events that have fired or were jumped
    /// over; `None` stands for the speaker.
    ///
    /// Read from the events anew with each call, in a time that grows with their number.
    pub fn state(&self, character: Option<EventName<'data>>) -> CharacterState<'data> {
        state::after(self.past(), character.or(self.speaker))
    }

    /// Every character that an event of the clip is about, also one to come, with its
    /// [state](Playback::state): what to set after a jump. The speaker without a name comes first as `None`.
    pub fn characters(&self) -> Characters<'data, 'bank> {
        Characters::new(self)
    }

    /// All segments whose events have fired or were jumped over, from the start of the last round but one.
    fn past(&self) -> Crossed<'data, 'bank> {
        if self.has_looped {
            Crossed::around(self, 0, self.next_segment)
        } else {
            Crossed::new(self, 0, self.next_segment)
        }
    }

    /// Moves sound and mouth to `time`.
    fn show<T: Time>(&mut self, time: T) {
        self.frame = self.frame_at(time);
        self.mouth_frame = self.frame_at(time.later(self.lead.us()));
    }

    fn frame_at<T: Time>(&self, time: T) -> Option<u32> {
        match time.frame(self.fps, self.clip.frame_count()) {
            None if time.has_begun() => Some(self.clip.frame_count()),
            frame => frame,
        }
    }

    /// How many segments have begun at the position of the sound.
    fn segments_begun(&self) -> u32 {
        match self.frame {
            None => 0,
            Some(frame) if frame < self.clip.frame_count() => self.segments_begun_by(frame),
            Some(_) => self.clip.segment_count(),
        }
    }

    /// How many segments start at or before `frame`, which is one of the clip.
    fn segments_begun_by(&self, frame: u32) -> u32 {
        let last = segment::index_of_frame(&self.clip, frame);
        last.map_or(0, |last| last.saturating_add(1)).min(self.clip.segment_count())
    }
}

/// The clip and the place in it.
impl fmt::Debug for Playback<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Playback")
            .field("clip", &self.clip)
            .field("frame", &self.frame)
            .field("next_segment", &self.next_segment)
            .finish_non_exhaustive()
    }
}
