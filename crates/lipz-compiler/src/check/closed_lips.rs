//! Lips that are closed in the phones of a file, but not in its visemes, or the other way round.

use super::trigger::{Check, CheckedClip, Run, Trigger};
use super::visemes::are_legal;
use lipz_bank::VisemeType;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::phones::{self, TimedPhone};

/// The phones that close the lips.
const CLOSED: [&str; 4] = ["P", "B", "M", "ʙ"];
/// Shorter phones need not be seen.
const SHORTEST_MS: u64 = 50;
/// How far closed lips may be from their phone: the lead of visemes, a frame, and the time that neighbours take.
const NEAR_MS: u64 = 120;

/// The check for clips with phones and visemes.
pub(super) const CHECKS: &[Check] = &[Check { trigger: Trigger::Unclean, run: Run::Clip(closed_lips) }];

/// A stretch of time in milliseconds.
#[derive(Clone, Copy)]
struct Stretch {
    start_ms: u64,
    end_ms: u64,
}

impl Stretch {
    /// Whether one of some stretches, which are in the order of their times, is near.
    fn is_near(self, stretches: &[Stretch]) -> bool {
        let first = stretches.partition_point(|other| other.end_ms + NEAR_MS < self.start_ms);
        stretches.get(first).is_some_and(|other| other.start_ms <= self.end_ms + NEAR_MS)
    }
}

fn closed_lips(file: &CheckedClip<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let (Some(string), Some(visemes), clip) = (file.roles.phones, file.roles.visemes, file.clip) else { return };
    let closed_code = match clip.viseme_type {
        Some(VisemeType::Blair) => b'M',
        Some(VisemeType::ToonBoom) => b'A',
        _ => return,
    };
    // Guessed phones and wrong codes are no evidence.
    let (Some(fps), false, true) = (clip.fps, clip.phones.is_guessed, are_legal(clip)) else { return };
    let start_of_frame = |frame: usize| fps.start_of_frame_us(frame as u32) / 1000;
    let track = phones::parse(string, &mut Vec::new());
    let end_ms = start_of_frame(clip.frames.len());
    let ends = track.phones.iter().skip(1).map(|next| u64::from(next.start_ms)).chain([end_ms]);
    let closed: Vec<(&TimedPhone, Stretch)> = track
        .phones
        .iter()
        .zip(ends)
        .map(|(phone, end_ms)| (phone, Stretch { start_ms: phone.start_ms.into(), end_ms }))
        .filter(|(phone, _)| CLOSED.contains(&phone.phone.name()))
        .collect();
    let mut frame = 0;
    let mut runs = Vec::new();
    for run in clip.frames.chunk_by(|a, b| a == b) {
        if run.first() == Some(&closed_code) {
            runs.push(Stretch { start_ms: start_of_frame(frame), end_ms: start_of_frame(frame + run.len()) });
        }
        frame += run.len();
    }
    let is_long = |phone: Stretch| phone.end_ms.saturating_sub(phone.start_ms) >= SHORTEST_MS;
    let unseen: Vec<_> = closed.iter().filter(|(_, phone)| is_long(*phone) && !phone.is_near(&runs)).collect();
    let mut found = None;
    if let Some((phone, _)) = unseen.first() {
        let message = format!(
            "the phone {} at {} ms closes the lips, but the visemes keep them open",
            escape::quoted(phone.phone.name()),
            phone.start_ms
        );
        let diagnostic = Diagnostic::at(Code::PhonesContradict, phone.span, message);
        found = Some((diagnostic, unseen.len(), "phones close the lips without a viseme"));
    } else {
        let phones: Vec<Stretch> = closed.iter().map(|(_, phone)| *phone).collect();
        let silent: Vec<&Stretch> = runs.iter().filter(|run| !run.is_near(&phones)).collect();
        if let Some(first) = silent.first() {
            let message = format!(
                "the viseme `{}` at {} ms closes the lips, but the phones keep them open",
                char::from(closed_code),
                first.start_ms
            );
            let diagnostic = Diagnostic::at(Code::PhonesContradict, visemes.span(), message);
            found = Some((diagnostic, silent.len(), "visemes close the lips without a phone"));
        }
    }
    if let Some((diagnostic, count, what)) = found {
        let diagnostic = if count > 1 { diagnostic.note(format!("{count} {what}")) } else { diagnostic };
        diagnostics.push(diagnostic.help("run `lipz sync` to make both from the recording, or correct the wrong one"));
    }
}
