//! The cursor: where a clip is while it is played.

use crate::bank::{Bank, opened};
use crate::clip::{Clip, Viseme};
use crate::event::{Event, LIPZ_NO_NAME, name_of};
use crate::pointer::answer;
use crate::segment::Segment;
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, LIPZ_OTHER_VERSION, Status};
use core::mem::{MaybeUninit, size_of};
use lipz_bank::{ClipId, ConsonantHold, Fps, Lead, VisemeType};

/// In place of a frame: the sound is past the last one. All events of the clip have been due.
pub const LIPZ_OVER: u32 = 0xFFFF_FFFF;
/// In place of a frame: the sound has not begun.
pub const LIPZ_WAITING: u32 = 0xFFFF_FFFE;

/// Where a clip is while it is played: a plain struct of numbers, which a program keeps beside its bank. Once per
/// picture, move it to the position of the sound, take the events that are due, and draw what it shows.
///
/// It remains right when a newer bank replaces the old one: it goes on at the same time. For another line, start
/// another cursor. docs/PLAYBACK.md has a table of what happens when time goes on, stands still, jumps and loops.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Cursor {
    /// Size of this struct where it was started; each function looks at it.
    pub size_bytes: u32,
    /// The frame at the position of the sound; `LIPZ_WAITING` before it begins, `LIPZ_OVER` from its end on.
    pub frame: u32,
    /// The clip.
    pub clip_id: u64,
    /// Frames in `fps_denominator` seconds, if the bank does not say.
    pub fps_numerator: u32,
    /// Seconds in which `fps_numerator` frames pass, if the bank does not say.
    pub fps_denominator: u32,
    /// The viseme type, if the bank does not say; 0 for none.
    pub viseme_type: u32,
    /// Set it: how many microseconds mouth shapes are ahead of the sound. Segments and events stay with the sound.
    pub lead_us: u32,
    /// Set it: how many frames a consonant shows at least; at most 255.
    pub hold_frames: u32,
    /// Set it: who speaks, so whose events name no character: the `id` of a `lipz_name`.
    pub speaker_id: u32,
    /// Set it: the `bank` of that name. The names of another bank are nobody's: set both again when it is replaced.
    pub speaker_bank: u32,
    /// The frame that the mouth shows, which is ahead of the sound.
    pub mouth_frame: u32,
    /// The first segment whose events have not been due.
    pub next_segment: u32,
    /// 1 if those before `next_segment` were due at `frame`; 2 if the clip has looped.
    pub flags: u32,
    /// The segment whose events are due next, of those that the last move has made due.
    pub due_segment: u32,
    /// The first segment that is not due.
    pub due_end: u32,
    /// The same, from the start on after a loop.
    pub due_around_to: u32,
    /// The event of `due_segment` that is due next.
    pub due_event: u32,
}

/// Size of a cursor: some dozens of bytes.
#[allow(clippy::cast_possible_truncation)]
const SIZE_BYTES: u32 = size_of::<Cursor>() as u32;

/// How a cursor is moved.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Move {
    /// On, or to the end: what has begun meanwhile is due.
    On,
    /// Around: the rest is due, and what has begun since.
    Around,
    /// Elsewhere: nothing is due.
    Away,
}

impl Cursor {
    /// The clip of the cursor, with what the cursor remembers of it, and the reader's cursor.
    fn find<'data, 'bank>(
        &self,
        bank: &'bank lipz_bank::Bank<'data>,
    ) -> Result<(lipz_bank::Clip<'data, 'bank>, lipz_bank::Cursor), Status> {
        if self.size_bytes != SIZE_BYTES {
            return Err(LIPZ_OTHER_VERSION);
        }
        let clip = bank.clip(ClipId::from_u64(self.clip_id)).ok_or(LIPZ_NONE)?;
        let (clip, cursor) = started(clip, self.fps_numerator, self.fps_denominator, self.viseme_type)?;
        let speaker = name_of(bank, self.speaker_id, self.speaker_bank);
        let hold = ConsonantHold::frames(u8::try_from(self.hold_frames).unwrap_or(u8::MAX));
        let words = [self.frame, self.mouth_frame, self.next_segment, self.flags];
        let cursor = cursor.with_lead(Lead::micros(self.lead_us)).with_hold(hold).with_speaker(speaker);
        Ok((clip, cursor.with_words(words)))
    }

    /// The index of the segment that is due next.
    fn due(&mut self) -> Option<u32> {
        if self.due_segment >= self.due_end {
            self.due_segment = 0;
            self.due_event = 0;
            self.due_end = core::mem::take(&mut self.due_around_to);
        }
        if self.due_segment < self.due_end { Some(self.due_segment) } else { None }
    }

    /// Goes to the segment behind `index`.
    fn pass(&mut self, index: u32) {
        self.due_segment = index.saturating_add(1);
        self.due_event = 0;
    }
}

/// The clip with this frame rate and viseme type where it has none, and a cursor at its start.
fn started<'data, 'bank>(
    clip: lipz_bank::Clip<'data, 'bank>,
    fps_numerator: u32,
    fps_denominator: u32,
    viseme_type: u32,
) -> Result<(lipz_bank::Clip<'data, 'bank>, lipz_bank::Cursor), Status> {
    let given = u8::try_from(viseme_type).ok().and_then(VisemeType::from_number);
    let clip = given.map_or(clip, |given| clip.or_viseme_type(given));
    if let Some(cursor) = lipz_bank::Cursor::new(&clip) {
        return Ok((clip, cursor));
    }
    let clip = clip.or_fps(Fps::new(fps_numerator, fps_denominator).ok_or(LIPZ_NONE)?);
    Ok((clip, lipz_bank::Cursor::new(&clip).ok_or(LIPZ_NONE)?))
}

/// Starts a cursor that waits for the sound of `clip` to begin. `size_bytes` is `sizeof(lipz_cursor)`: unless that is the
/// size in the library that runs, the status is `LIPZ_OTHER_VERSION`, and nothing is written.
///
/// `LIPZ_NONE` if there is no such clip, and if it has no frame rate: give it one in `clip`. The cursor remembers frame
/// rate and viseme type of `clip`, and takes them where the bank has none.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_new(
    bank: Option<&Bank>,
    clip: Option<&Clip>,
    size_bytes: usize,
    cursor: Option<&mut MaybeUninit<Cursor>>,
) -> Status {
    if size_bytes != size_of::<Cursor>() {
        return LIPZ_OTHER_VERSION;
    }
    answer(cursor, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let bank = unsafe { opened(bank) }?;
        let asked = clip.ok_or(LIPZ_NULL_POINTER)?;
        let found = bank.clip(ClipId::from_u64(asked.id)).ok_or(LIPZ_NONE)?;
        let (given, cursor) = started(found, asked.fps_numerator, asked.fps_denominator, asked.viseme_type)?;
        let [frame, mouth_frame, next_segment, flags] = cursor.to_words();
        Ok(Cursor {
            size_bytes: SIZE_BYTES,
            frame,
            clip_id: asked.id,
            fps_numerator: given.fps().map_or(0, Fps::numerator),
            fps_denominator: given.fps().map_or(0, Fps::denominator),
            viseme_type: given.viseme_type().map_or(0, |kind| kind as u32),
            speaker_id: LIPZ_NO_NAME,
            mouth_frame,
            next_segment,
            flags,
            ..Cursor::default()
        })
    })
}

/// Moves a cursor. Unless that succeeds, it stays where it was.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn moved(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    how: Move,
    to: impl FnOnce(&mut lipz_bank::Cursor, &lipz_bank::Clip<'_, '_>),
) -> Status {
    let cursor = match cursor {
        Some(cursor) => cursor,
        None => return LIPZ_NULL_POINTER,
    };
    // SAFETY: the same contract.
    let bank = match unsafe { opened(bank) } {
        Ok(bank) => bank,
        Err(status) => return status,
    };
    let (clip, mut inner) = match cursor.find(&bank) {
        Ok(found) => found,
        Err(status) => return status,
    };
    let before = cursor.next_segment;
    to(&mut inner, &clip);
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

/// Ends the clip before the sound does, as when a player skips it: what is left becomes due, so that lasting states take
/// effect.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_finish(bank: Option<&Bank>, cursor: Option<&mut Cursor>) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        moved(bank, cursor, Move::On, |cursor, clip| {
            let _ = cursor.finish(clip);
        })
    }
}

/// Takes the next event that is due: of the segments that have begun since the move before the last one, in order, each
/// once, also of segments without frames. Events that name no character are the speaker's. Call it after each move until
/// `LIPZ_NONE`: what is not taken before the next move does not come again.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_take_event(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    event: Option<&mut MaybeUninit<Event>>,
) -> Status {
    answer(event, || {
        let (bank, cursor) = (bank.ok_or(LIPZ_NULL_POINTER)?, cursor.ok_or(LIPZ_NULL_POINTER)?);
        // Mostly nothing is due, and then the bank need not be looked at.
        if cursor.size_bytes == SIZE_BYTES && cursor.due().is_none() {
            return Err(LIPZ_NONE);
        }
        // SAFETY: the contract of the crate, which the caller keeps.
        let bank = unsafe { opened(Some(bank)) }?;
        let (clip, _) = cursor.find(&bank)?;
        while let Some(index) = cursor.due() {
            // Of a clip with fewer segments than it had, no more is due.
            let segment = match clip.segment(index) {
                Some(segment) => segment,
                None => {
                    cursor.due_segment = cursor.due_end;
                    continue;
                }
            };
            if let Some(event) = segment.events().nth(cursor.due_event as usize) {
                cursor.due_event = cursor.due_event.saturating_add(1);
                let speaker = name_of(&bank, cursor.speaker_id, cursor.speaker_bank);
                let mut event = event;
                event.character = event.character.or(speaker);
                return Ok(Event::from_reader(&bank, event));
            }
            cursor.pass(index);
        }
        Err(LIPZ_NONE)
    })
}

/// Takes the next segment that is due, with all its events: for event strings in another syntax than that of
/// `lipz_cursor_take_event`. `LIPZ_NONE` when all are taken.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_take_segment(
    bank: Option<&Bank>,
    cursor: Option<&mut Cursor>,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    answer(segment, || {
        let (bank, cursor) = (bank.ok_or(LIPZ_NULL_POINTER)?, cursor.ok_or(LIPZ_NULL_POINTER)?);
        // Mostly nothing is due, and then the bank need not be looked at.
        if cursor.size_bytes == SIZE_BYTES && cursor.due().is_none() {
            return Err(LIPZ_NONE);
        }
        // SAFETY: the contract of the crate, which the caller keeps.
        let bank = unsafe { opened(Some(bank)) }?;
        let (clip, _) = cursor.find(&bank)?;
        while let Some(index) = cursor.due() {
            let found = clip.segment(index);
            if found.is_some() {
                cursor.pass(index);
                return Segment::from_found(found);
            }
            cursor.due_segment = cursor.due_end;
        }
        Err(LIPZ_NONE)
    })
}

/// The mouth shape to draw, with lead and hold; rest before the start and from the end on.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_viseme(
    bank: Option<&Bank>,
    cursor: Option<&Cursor>,
    viseme: Option<&mut MaybeUninit<Viseme>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_cursor(bank, cursor, viseme, |_, clip, cursor| Ok(Viseme::from_reader(cursor.viseme(clip)))) }
}

/// How far that mouth is open, in ten-thousandths; `LIPZ_NONE` if the clip has no frames or no viseme type: let the mouth
/// babble.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_openness(
    bank: Option<&Bank>,
    cursor: Option<&Cursor>,
    ten_thousandths: Option<&mut MaybeUninit<u32>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(bank, cursor, ten_thousandths, |_, clip, cursor| match clip.viseme_type() {
            Some(kind) if clip.frame_count() > 0 => Ok(cursor.viseme(clip).openness(kind).ten_thousandths().into()),
            _ => Err(LIPZ_NONE),
        })
    }
}

/// The segment whose subtitle to show; `LIPZ_NONE` before the start and from the end on.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_segment(
    bank: Option<&Bank>,
    cursor: Option<&Cursor>,
    segment: Option<&mut MaybeUninit<Segment>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_cursor(bank, cursor, segment, |_, clip, cursor| Segment::from_found(cursor.segment(clip))) }
}

/// Answers a query about a cursor.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn of_cursor<T: Default>(
    bank: Option<&Bank>,
    cursor: Option<&Cursor>,
    out: Option<&mut MaybeUninit<T>>,
    query: impl FnOnce(&lipz_bank::Bank<'_>, &lipz_bank::Clip<'_, '_>, &lipz_bank::Cursor) -> Result<T, Status>,
) -> Status {
    answer(out, || {
        // SAFETY: the same contract.
        let bank = unsafe { opened(bank) }?;
        let (clip, cursor) = cursor.ok_or(LIPZ_NULL_POINTER)?.find(&bank)?;
        query(&bank, &clip, &cursor)
    })
}
