//! The cursor: the position in a clip during playback.

use crate::clip::{Clip, Viseme, given};
use crate::dialogue::{Dialogue, reader};
use crate::event::Event;
use crate::handle::LIPZ_NO_NAME;
use crate::pointer::answer;
use crate::segment::Segment;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, LIPZ_OTHER_VERSION, Status};
use crate::time::Time;
use core::mem::{MaybeUninit, size_of};
use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{ClipId, Fps};

/// Stands for a frame: the audio is past the last one. All events of the clip have been due.
pub const LIPZ_OVER: u32 = 0xFFFF_FFFF;
/// Stands for a frame: the audio has not begun.
pub const LIPZ_WAITING: u32 = 0xFFFF_FFFE;

/// The position in a clip during playback: a plain struct of numbers, which a program keeps next to its dialogue. Once
/// per rendered frame, move it to the position of the audio, take the events that are due, and draw its viseme.
///
/// It remains valid when a new version of the dialogue replaces the old one: it continues at the same time. For another
/// line, start another cursor. docs/guides/playback.md has a table of the results when the time advances, stands still,
/// jumps and loops.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Cursor {
    /// The size of this struct in the program that started it. Each function checks it.
    pub size_bytes: u32,
    /// The frame at the position of the audio; `LIPZ_WAITING` before it begins, `LIPZ_OVER` from its end on.
    pub frame: u32,
    /// The clip.
    pub clip_id: u64,
    /// Frames per `fps_denominator` seconds, if the clip has no frame rate.
    pub fps_numerator: u32,
    /// Seconds in which `fps_numerator` frames pass, if the clip has no frame rate.
    pub fps_denominator: u32,
    /// The viseme type, if the clip has none; 0 if unspecified.
    pub viseme_type: u32,
    /// You can set it: how many microseconds the mouth is ahead of the audio. Segments and events stay with the audio.
    pub lead_us: u32,
    /// You can set it: the least number of frames for which a consonant shows, at most 255.
    pub hold_frames: u32,
    /// You can set it: the speaker, who is the character of events without a name. The `id` of a `lipz_name`.
    pub speaker_id: u32,
    /// You can set it: the `bank` of that name. Names of another version are ignored, so set both again after a
    /// refresh.
    pub speaker_bank: u32,
    /// The frame of the mouth, which is ahead of the audio.
    pub mouth_frame: u32,
    /// The first segment whose events have not been due.
    pub next_segment: u32,
    /// 1 if those before `next_segment` were due at `frame`; 2 if the clip has looped.
    pub flags: u32,
    /// The segment whose events are due next, among those that the last move made due.
    pub due_segment: u32,
    /// The first segment that is not due.
    pub due_end: u32,
    /// The same for the segments from the start on, after a loop.
    pub due_around_to: u32,
    /// The event of `due_segment` that is due next.
    pub due_event: u32,
}

/// The size of a cursor: some dozens of bytes.
#[allow(clippy::cast_possible_truncation)]
const SIZE_BYTES: u32 = size_of::<Cursor>() as u32;

/// The kinds of moves of a cursor.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Move {
    /// Forward, or to the end: segments that have begun since are due.
    On,
    /// In a loop: the rest is due, and the segments that have begun since.
    Around,
    /// To any time: nothing is due.
    Away,
}

impl Cursor {
    /// Returns the clip of the cursor, with the settings in the cursor, and the reader's cursor.
    fn find<'a>(
        &self,
        dialogue: &'a lipz_bank::Dialogue<'a>,
    ) -> Result<(lipz_bank::Clip<'a>, lipz_bank::Cursor), Status> {
        if self.size_bytes != SIZE_BYTES {
            return Err(LIPZ_OTHER_VERSION);
        }
        let clip = dialogue.clip(ClipId::from_u64(self.clip_id)).ok_or(LIPZ_NONE)?;
        let clip = given(clip, self.fps_numerator, self.fps_denominator, self.viseme_type);
        let cursor = lipz_bank::Cursor::new(&clip).ok_or(LIPZ_NONE)?;
        let hold = ConsonantHold::frames(u8::try_from(self.hold_frames).unwrap_or(u8::MAX));
        let cursor = cursor.with_lead(Lead::micros(self.lead_us)).with_hold(hold).with_speaker(self.speaker(dialogue));
        let words = [self.frame, self.mouth_frame, self.next_segment, self.flags];
        Ok((clip, cursor.with_words(words)))
    }

    /// Returns the name of the speaker, if it belongs to the dialogue.
    pub(crate) fn speaker<'a>(&self, dialogue: &'a lipz_bank::Dialogue<'a>) -> Option<lipz_bank::EventName<'a>> {
        if self.speaker_bank == LIPZ_NO_NAME {
            return None;
        }
        dialogue.event_name_of_words([self.speaker_bank, self.speaker_id])
    }

    /// Returns the index of the segment that is due next.
    fn due(&mut self) -> Option<u32> {
        if self.due_segment >= self.due_end {
            self.due_segment = 0;
            self.due_event = 0;
            self.due_end = core::mem::take(&mut self.due_around_to);
        }
        if self.due_segment < self.due_end { Some(self.due_segment) } else { None }
    }

    /// Moves to the segment after `index`.
    fn pass(&mut self, index: u32) {
        self.due_segment = index.saturating_add(1);
        self.due_event = 0;
    }
}

/// Starts a cursor that waits for the audio of `clip` to begin. `size_bytes` is `sizeof(lipz_cursor)`: if the size
/// differs in the running library, the status is `LIPZ_OTHER_VERSION`, and nothing is written.
///
/// `LIPZ_NONE` if there is no such clip, or if it has no frame rate: set one in `clip`. The cursor stores the frame
/// rate and the viseme type of `clip`, and uses them where the dialogue has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_new(
    dialogue: Option<&Dialogue>,
    clip: Option<&Clip>,
    size_bytes: usize,
    cursor: Option<&mut MaybeUninit<Cursor>>,
) -> Status {
    if size_bytes != size_of::<Cursor>() {
        return LIPZ_OTHER_VERSION;
    }
    answer(cursor, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let found = clip.ok_or(LIPZ_NULL_POINTER)?.find(unsafe { reader(dialogue) }?)?;
        let cursor = lipz_bank::Cursor::new(&found).ok_or(LIPZ_NONE)?;
        let [frame, mouth_frame, next_segment, flags] = cursor.to_words();
        Ok(Cursor {
            size_bytes: SIZE_BYTES,
            frame,
            clip_id: found.id().get(),
            fps_numerator: found.fps().map_or(0, Fps::numerator),
            fps_denominator: found.fps().map_or(0, Fps::denominator),
            viseme_type: found.viseme_type().map_or(0, |kind| kind as u32),
            mouth_frame,
            next_segment,
            flags,
            ..Cursor::default()
        })
    })
}

/// Moves a cursor, or leaves it unchanged on failure.
///
/// # Safety
/// The contract of the crate.
unsafe fn moved<'a, T>(
    dialogue: Option<&'a Dialogue>,
    cursor: Option<&mut Cursor>,
    how: Move,
    to: impl FnOnce(&mut lipz_bank::Cursor, &lipz_bank::Clip<'a>) -> T,
) -> Status {
    let cursor = match cursor {
        Some(cursor) => cursor,
        None => return LIPZ_NULL_POINTER,
    };
    // SAFETY: the same contract.
    let (clip, mut inner) = match unsafe { reader(dialogue) }.and_then(|dialogue| cursor.find(dialogue)) {
        Ok(found) => found,
        Err(status) => return status,
    };
    let before = cursor.next_segment;
    // The cursor records the segments that are due.
    let _ = to(&mut inner, &clip);
    [cursor.frame, cursor.mouth_frame, cursor.next_segment, cursor.flags] = inner.to_words();
    let count = clip.segment_count();
    let behind = cursor.next_segment.min(count);
    cursor.due_event = 0;
    [cursor.due_segment, cursor.due_end, cursor.due_around_to] = match how {
        Move::On => [before, behind, 0],
        Move::Around => [before, count, behind],
        Move::Away => [0; 3],
    };
    LIPZ_OK
}

/// Moves the cursor to the audio position `time`. The events of the segments that have begun since the last call are
/// due. A time before that of the last call makes nothing due, and nothing is due again until the audio is past the
/// point that it had reached, because clocks jitter.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_advance(
    dialogue: Option<&Dialogue>,
    cursor: Option<&mut Cursor>,
    time: Time,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(dialogue, cursor, Move::On, |cursor, clip| cursor.advance_to(clip, time.to_reader())) }
}

/// Moves the cursor after the audio has jumped from its end to its start, and then reached `time`. The remaining
/// segments are due, then those that have begun since. Call it once per loop. Emotions, stares and pointing last beyond
/// the end of the clip.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_loop(
    dialogue: Option<&Dialogue>,
    cursor: Option<&mut Cursor>,
    time: Time,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(dialogue, cursor, Move::Around, |cursor, clip| cursor.loop_to(clip, time.to_reader())) }
}

/// Jumps to `time`, forward or back. Nothing is due; the next advance starts with the segments that begin in the frame
/// of this time. States are as if the clip had been played once from its start to here.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_seek(
    dialogue: Option<&Dialogue>,
    cursor: Option<&mut Cursor>,
    time: Time,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(dialogue, cursor, Move::Away, |cursor, clip| cursor.seek(clip, time.to_reader())) }
}

/// Ends the clip before the audio ends, as when a player skips it. The remaining segments become due, so that lasting
/// states take effect.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_finish(dialogue: Option<&Dialogue>, cursor: Option<&mut Cursor>) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { moved(dialogue, cursor, Move::On, |cursor, clip| cursor.finish(clip)) }
}

/// Takes the next event that is due: those of the segments that have begun since the last move, in order, each once,
/// including empty segments. Events without a character are the speaker's. Call it after each move until `LIPZ_NONE`:
/// events that are not taken before the next move are lost.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_take_event(
    dialogue: Option<&Dialogue>,
    cursor: Option<&mut Cursor>,
    event: Option<&mut MaybeUninit<Event>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_due(dialogue, cursor, event, |dialogue, cursor, segment| {
            let mut event = segment.events().nth(cursor.due_event as usize)?;
            cursor.due_event = cursor.due_event.saturating_add(1);
            event.character = event.character.or_else(|| cursor.speaker(dialogue));
            Some(Event::from_reader(event))
        })
    }
}

/// Takes the next segment that is due, with all its events: for event strings in other syntaxes than that of
/// `lipz_cursor_take_event`. `LIPZ_NONE` when all are taken.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_take_segment(
    dialogue: Option<&Dialogue>,
    cursor: Option<&mut Cursor>,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_due(dialogue, cursor, segment, |dialogue, cursor, segment| {
            cursor.pass(segment.index());
            Segment::from_found(dialogue.version(), Some(segment)).ok()
        })
    }
}

/// Takes an item from the segments that are due, from the first that has items left.
///
/// # Safety
/// The contract of the crate.
unsafe fn of_due<'a, T: Default>(
    dialogue: Option<&'a Dialogue>,
    cursor: Option<&mut Cursor>,
    out: Option<&mut MaybeUninit<T>>,
    take: impl Fn(&'a lipz_bank::Dialogue<'a>, &mut Cursor, lipz_bank::Segment<'a>) -> Option<T>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let dialogue = unsafe { reader(dialogue) }?;
        let cursor = cursor.ok_or(LIPZ_NULL_POINTER)?;
        // Usually nothing is due, and then no clip needs to be found.
        if cursor.size_bytes == SIZE_BYTES && cursor.due().is_none() {
            return Err(LIPZ_NONE);
        }
        let (clip, _) = cursor.find(dialogue)?;
        while let Some(index) = cursor.due() {
            match clip.segment(index) {
                Some(segment) => match take(dialogue, cursor, segment) {
                    Some(taken) => return Ok(taken),
                    None => cursor.pass(index),
                },
                // The clip has fewer segments than before, so nothing else is due.
                None => cursor.due_segment = cursor.due_end,
            }
        }
        Err(LIPZ_NONE)
    })
}

/// Writes the viseme to draw, with lead and hold, or rest before the start and from the end on.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_viseme(
    dialogue: Option<&Dialogue>,
    cursor: Option<&Cursor>,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_cursor(dialogue, cursor, viseme, |_, clip, cursor| Ok(Viseme::from_reader(cursor.viseme(clip)))) }
}

/// Writes how far that mouth is open, in ten-thousandths. `LIPZ_NONE` if the clip has no frames or no viseme type: let
/// the mouth babble.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_openness(
    dialogue: Option<&Dialogue>,
    cursor: Option<&Cursor>,
    ten_thousandths: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(dialogue, cursor, ten_thousandths, |_, clip, cursor| {
            Ok(cursor.openness(clip).ok_or(LIPZ_NONE)?.ten_thousandths().into())
        })
    }
}

/// Writes the segment of the subtitle to show. `LIPZ_NONE` before the start and from the end on.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_segment(
    dialogue: Option<&Dialogue>,
    cursor: Option<&Cursor>,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(dialogue, cursor, segment, |dialogue, clip, cursor| {
            Segment::from_found(dialogue.version(), cursor.segment(clip))
        })
    }
}

/// Answers a query about a cursor.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn of_cursor<'a, T: Default>(
    dialogue: Option<&'a Dialogue>,
    cursor: Option<&Cursor>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(&'a lipz_bank::Dialogue<'a>, &lipz_bank::Clip<'a>, &lipz_bank::Cursor) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let dialogue = unsafe { reader(dialogue) }?;
        let (clip, cursor) = cursor.ok_or(LIPZ_NULL_POINTER)?.find(dialogue)?;
        query(dialogue, &clip, &cursor)
    })
}
