//! Whose face and emotions of a clip.

use crate::pointer::text;
use crate::status::Status;
use crate::string::String;

/// A character of a clip: `mara feels fear` and `mara nods` in its events are about mara, and in curves with this name in front.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Who {
    /// The name as events have it: data and length.
    pub name: String,
    /// 1 for the speaker: then curves without a name are about them, too. Of two for the same, that one counts which is farther
    /// from neutral. 0 for other characters.
    pub is_speaker: u32,
}

/// The character that the caller means; null is the speaker, by curves without a name alone.
///
/// # Safety
/// The contract of the crate: the name is null or leads to so many bytes.
pub(crate) unsafe fn to_reader<'name>(who: Option<&Who>) -> Result<lipz_bank::face::Who<'name>, Status> {
    let who = match who {
        Some(who) => who,
        None => return Ok(lipz_bank::face::Who::Speaker),
    };
    // SAFETY: the same contract.
    let name = unsafe { text(who.name.data, who.name.length_bytes) }?;
    Ok(if who.is_speaker == 0 { lipz_bank::face::Who::Other(name) } else { lipz_bank::face::Who::SpeakerNamed(name) })
}
