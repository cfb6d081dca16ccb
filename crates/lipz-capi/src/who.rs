//! The character whose face and emotions are queried.

use crate::pointer::text;
use crate::status::Status;
use crate::string::String;

/// A character of a clip. `mara feels fear` and `mara nods` in its events set curves whose names start with `mara`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Who {
    /// The name as spelled in events: data and length.
    pub name: String,
    /// 1 for the speaker, for whom curves without a name also count. If two curves have the same purpose, the value
    /// farther from neutral counts. 0 for other characters.
    pub is_speaker: u32,
}

/// Returns the caller's character. Null stands for the speaker with curves without a name only.
///
/// # Safety
/// The contract of the crate: the name is null or leads to as many bytes as its length.
pub(crate) unsafe fn to_reader<'name>(who: Option<&Who>) -> Result<lipz_bank::face::Who<'name>, Status> {
    let who = match who {
        Some(who) => who,
        None => return Ok(lipz_bank::face::Who::Speaker),
    };
    // SAFETY: the same contract.
    let name = unsafe { text(who.name.data, who.name.length_bytes) }?;
    Ok(if who.is_speaker == 0 { lipz_bank::face::Who::Other(name) } else { lipz_bank::face::Who::SpeakerNamed(name) })
}
