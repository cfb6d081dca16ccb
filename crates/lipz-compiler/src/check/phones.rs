//! Phones of a file, which must start inside the clip.

use crate::clip::{ClipData, ClipPhones};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::{JsonString, phones};

/// Gives the clip, whose frames are known, the phones of an element with this value.
pub(super) fn phones(string: &JsonString<'_>, clip: &mut ClipData, diagnostics: &mut Vec<Diagnostic>) {
    let track = phones::parse(string, diagnostics);
    diagnostics.extend(after_end(&track, clip));
    clip.phones = ClipPhones::of_track(&track);
}

/// Returns the diagnostic for the first phone that starts after the clip.
fn after_end(track: &phones::PhoneTrack, clip: &ClipData) -> Option<Diagnostic> {
    let fps = clip.fps.filter(|_| clip.has_visemes)?;
    let end_ms = fps.start_of_frame_us(u32::try_from(clip.frames.len()).ok()?) / 1000;
    let is_after = |phone: &&phones::TimedPhone| u64::from(phone.start_ms) > end_ms;
    let phone = track.phones.iter().find(is_after)?;
    let count = track.phones.iter().filter(is_after).count();
    let message = format!(
        "the phone {} starts at {} ms, but the clip ends at {end_ms} ms",
        escape::quoted(phone.phone.name()),
        phone.start_ms
    );
    let diagnostic = Diagnostic::at(Code::PhoneRange, phone.span, message);
    let diagnostic = match count {
        1 => diagnostic,
        _ => diagnostic.note(format!("{count} phones start after the end of the clip")),
    };
    Some(diagnostic.help("run `lipz sync` to align the phones with the recording again, or correct the time"))
}
