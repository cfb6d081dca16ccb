//! Visemes that move during silence, or rest during speech.

use crate::recordings::clip::ClipMouth;
use crate::recordings::loudness::{Loudness, VoiceActivity};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::JsonString;
use lipz_file::text::{DELIMITER, is_white_space};
use std::ops::Range;

/// The longest allowed movement in silence, or rest during speech: half a second. Shorter ones may be a breath, the
/// lead of the lips, or a faint word.
const LONGEST_US: u64 = 500_000;

/// Reports the longest stretch of each kind.
pub(super) fn check(clip: &ClipMouth<'_>, heard: &Loudness) -> Vec<Diagnostic> {
    let (Some(visemes), Some(fps)) = (clip.visemes, clip.fps) else { return Vec::new() };
    let time = |frame: usize| fps.start_of_frame_us(u32::try_from(frame).unwrap_or(u32::MAX));
    let moving = |frame: usize| clip.codes.get(frame).is_some_and(|code| !matches!(code, b'-' | b'0'));
    let longest = |is_wrong: &dyn Fn(usize, VoiceActivity) -> bool| {
        let mut longest: Range<usize> = 0..0;
        let mut start = 0;
        for frame in 0..clip.codes.len() {
            if !is_wrong(frame, heard.voice(time(frame), time(frame + 1))) {
                start = frame + 1;
            } else if frame + 1 - start > longest.len() {
                longest = start..frame + 1;
            }
        }
        (time(longest.end) - time(longest.start) >= LONGEST_US).then_some(longest)
    };
    let mut found = Vec::new();
    let mut report = |code, frames: Option<Range<usize>>, what: &str, help: &str| {
        let Some(frames) = frames else { return };
        let seconds = |frame| format!("{:.2} s", time(frame) as f64 / 1e6);
        let message = format!("{what} from {} to {}", seconds(frames.start), seconds(frames.end));
        found.push(Diagnostic::at(code, visemes.span_of(place(visemes, &frames)), message).help(help));
    };
    let in_silence = longest(&|frame, voice| voice == VoiceActivity::Silent && moving(frame));
    let help = "make the visemes again, or check whether they belong to a different take";
    report(Code::MovingInSilence, in_silence, "the mouth moves, but the recording is silent", help);
    let in_speech = longest(&|frame, voice| voice == VoiceActivity::Loud && !moving(frame));
    let help = "make the visemes again, or allow the lint if another character speaks there";
    report(Code::RestingInSpeech, in_speech, "the mouth rests, but the recording is loud", help);
    found
}

/// Returns the bytes of `visemes` for these frames.
fn place(visemes: &JsonString<'_>, frames: &Range<usize>) -> Range<usize> {
    let is_code = |(_, code): &(usize, char)| *code != DELIMITER && !is_white_space(*code);
    let mut codes = visemes.text.char_indices().filter(is_code).skip(frames.start);
    let start = codes.next().map_or(0, |(at, _)| at);
    let last = codes.nth(frames.len().saturating_sub(2)).map_or(start, |(at, code)| at + code.len_utf8());
    start..last.max(start)
}
