//! The answers of a bank to every query, as text that does not depend on its layout.
//!
//! Only uses `core`, because the firmware and the wasm module of `firmware/` include this file. They must return the
//! same answers as the machine that wrote the dumps.

use core::fmt::{self, Debug, Display, Write};
use lipz_bank::articulation::ArticulationProfile;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotion, FaceProfile, LookAt, Who};
use lipz_bank::{Bank, Clip, Fps, Micros, Segment, Text, Viseme, VoiceSource};

/// The length in bytes from which strings are shown by their length, their hash and their start.
const LONGEST_BYTES: usize = 400;

/// The number of characters of a longer string that are shown.
const START_CHARACTERS: usize = 40;

/// Writes all answers of `bank`, one fact per line, ordered by key and tag.
///
/// # Errors
/// Those of `out`.
pub fn write_answers(bank: &Bank<'_>, out: &mut impl Write) -> fmt::Result {
    let (major, _) = bank.format_version();
    writeln!(out, "format {major}, {} clips", bank.clip_count())?;
    for locale in bank.locales() {
        let is_default = bank.default_locale() == Some(locale);
        writeln!(out, "locale {}{}", bank.locale_tag(locale), if is_default { " default" } else { "" })?;
    }
    for voice in bank.voices() {
        writeln!(out, "voice {}{}", bank.voice_tag(voice), if voice.is_original() { " original" } else { "" })?;
    }
    bank.face_profiles().try_for_each(|profile| write_profile(out, &profile))?;
    bank.clips().try_for_each(|clip| write_clip(out, bank, &clip))
}

/// Writes the contents of a face profile.
pub(crate) fn write_profile(out: &mut impl Write, profile: &FaceProfile<'_>) -> fmt::Result {
    write!(out, "face {}, blinks {}", QuotedText(profile.name()), profile.blink_interval_ms(None))?;
    for emotion in Emotion::ALL {
        write!(out, " {}", profile.blink_interval_ms(Some(emotion)))?;
    }
    write!(out, " ms, each {}, {} % double", profile.blink_length_ms(), profile.double_blink_percent())?;
    let (motion, follows) = (profile.head_motion_thousandths(), profile.head_follows_thousandths());
    write!(out, ", head {motion} {follows}, pose {} ms", profile.pose_ms())?;
    writeln!(out, ", glances {} %, fixation {} ms", profile.glance_percent(), profile.fixation_ms())
}

fn write_clip(out: &mut impl Write, bank: &Bank<'_>, clip: &Clip<'_>) -> fmt::Result {
    write_mouth(out, clip)?;
    if let Some(original) = clip.original() {
        writeln!(out, "  dub of {} in {}", original.key(), clip.voice().map_or("", |voice| bank.voice_tag(voice)))?;
    }
    for voice in bank.voices().filter(|_| clip.original().is_none()) {
        let voiced = clip.in_voice(voice);
        if voiced.spoken != VoiceSource::Original {
            writeln!(out, "  in {} {} ({:?})", bank.voice_tag(voice), voiced.clip.key(), voiced.spoken)?;
        }
    }
    write_curves(out, clip)?;
    // Only for banks with face profiles, because every clip has a face.
    for profile in bank.face_profiles() {
        write_faces(out, clip, &profile)?;
    }
    // Only for banks with articulation profiles, because every clip has an articulation.
    for profile in bank.articulations() {
        write_articulation(out, bank, clip, &profile)?;
    }
    clip.segments().try_for_each(|segment| write_segment(out, bank, &segment))
}

/// Writes the visemes of a clip.
pub(crate) fn write_mouth(out: &mut impl Write, clip: &Clip<'_>) -> fmt::Result {
    writeln!(out, "\nclip {} {}", clip.key(), clip.id())?;
    writeln!(out, "  rate {}, type {}", OrUnknown(clip.fps()), OrUnknown(clip.viseme_type()))?;
    writeln!(out, "  visemes {}, events {}", clip.has_visemes(), clip.has_events())?;
    write!(out, "  {} frames ", clip.frame_count())?;
    for frame in 0..clip.frame_count() {
        out.write_char(clip.viseme(frame).to_char())?;
    }
    writeln!(out, ", {:?} us", clip.duration_us())?;
    out.write_str("  at 24 fps, each 50 ms: ")?;
    write_sampled(out, &clip.or_fps(Fps::whole(24)))?;
    out.write_str("\n")
}

/// Writes the recording and the curves of a clip.
pub(crate) fn write_curves(out: &mut impl Write, clip: &Clip<'_>) -> fmt::Result {
    if let Some(recording) = clip.recording() {
        writeln!(out, "  recording {} us, content {:016x}", recording.length_us(), recording.content_hash())?;
    }
    for curve in clip.curves() {
        write!(out, "  curve {} {curve}, each 50 ms:", QuotedText(curve.name().as_str()))?;
        let curve = clip.or_fps(Fps::whole(24)).curve(curve.name()).unwrap_or(curve);
        for value in (0..20).filter_map(|step| curve.value_at(Micros(step * 50_000))) {
            write!(out, " {value}")?;
        }
        out.write_str("\n")?;
    }
    Ok(())
}

/// Writes the face every 150 ms, for ten seconds: lids; pitch, yaw and roll of the head; pitch and yaw of the eyes;
/// brows, shrug and breath.
pub(crate) fn write_faces(out: &mut impl Write, clip: &Clip<'_>, profile: &FaceProfile<'_>) -> fmt::Result {
    write!(out, "  face {}, each 150 ms", QuotedText(profile.name()))?;
    for step in 0..67 {
        let face = clip.face_at(Micros(step * 150_000), Who::Speaker, profile, LookAt::AHEAD);
        write!(out, ": {} {} {} {}", face.blink, face.head_pitch, face.head_yaw, face.head_roll)?;
        write!(out, " {} {} {} {} {}", face.eye_pitch, face.eye_yaw, face.brows, face.shrug, face.breath)?;
    }
    out.write_str("\n")
}

/// Writes the phones, and articulation and weights every 50 ms, for one second.
fn write_articulation(
    out: &mut impl Write,
    bank: &Bank<'_>,
    clip: &Clip<'_>,
    profile: &ArticulationProfile<'_>,
) -> fmt::Result {
    let phones = clip.phones();
    writeln!(out, "  phones {phones}, certain {}, {:?} dB", phones.are_certain(), phones.level_db())?;
    write!(out, "  articulation {}, each 50 ms", QuotedText(profile.name()))?;
    for step in 0..20 {
        let mouth = clip.articulation_at(Micros(step * 50_000), profile);
        for (index, value) in mouth.values().iter().enumerate() {
            write!(out, "{}{value}", if index == 0 { ": " } else { " " })?;
        }
    }
    out.write_str("\n")?;
    for rig in bank.rigs() {
        write!(out, "  rig {}", QuotedText(rig.name()))?;
        let time = Micros(500_000);
        let face = clip.face_at(time, Who::Speaker, &bank.default_face_profile(), LookAt::AHEAD);
        let mut weights = [CurveValue::default(); 64];
        let emotions = clip.emotions_at(time, Who::Speaker);
        rig.weights(&clip.articulation_at(time, profile), &emotions, &face, &mut weights);
        for (name, weight) in rig.weight_names().zip(weights) {
            write!(out, " {name} {weight}")?;
        }
        out.write_str("\n")?;
    }
    Ok(())
}

fn write_segment(out: &mut impl Write, bank: &Bank<'_>, segment: &Segment<'_>) -> fmt::Result {
    write_events(out, segment)?;
    bank.locales().try_for_each(|locale| write_text(out, bank.locale_tag(locale), segment.text(locale)))
}

/// Writes the frames and events of a segment.
pub(crate) fn write_events(out: &mut impl Write, segment: &Segment<'_>) -> fmt::Result {
    let (start, end) = (segment.start_frame(), segment.end_frame());
    write!(out, "  segment {} frames {start}..{end}", segment.index())?;
    writeln!(out, " us {:?}..{:?}", segment.start_us(), segment.end_us())?;
    if let Some(event) = segment.event() {
        writeln!(out, "    event {}", QuotedText(event))?;
    }
    for event in segment.events() {
        out.write_str("    typed \"")?;
        write!(EscapingWriter(out), "{event}")?;
        out.write_str("\"\n")?;
    }
    Ok(())
}

/// Writes the text of a segment, if it has one.
pub(crate) fn write_text(out: &mut impl Write, tag: &str, text: Option<Text<'_>>) -> fmt::Result {
    let Some(text) = text else { return Ok(()) };
    let origin = if text.is_fallback() { " (fallback)" } else { "" };
    writeln!(out, "    {tag} {}{origin}", QuotedText(text.as_str()))
}

/// Writes the viseme and the segment every 50 ms, at most 200 times.
fn write_sampled(out: &mut impl Write, clip: &Clip<'_>) -> fmt::Result {
    let mut before = None;
    for time_us in (0..200).map(|step| step * 50_000) {
        let segment = clip.segment_at(Micros(time_us)).map(|segment| segment.index());
        if segment != before {
            match segment {
                Some(index) => write!(out, "[{index}]")?,
                None => out.write_str("[end]")?,
            }
            before = segment;
        }
        if segment.is_none() {
            assert_eq!(clip.viseme_at(Micros(time_us)), Viseme::REST);
            break;
        }
        out.write_char(clip.viseme_at(Micros(time_us)).to_char())?;
    }
    Ok(())
}

struct OrUnknown<T>(Option<T>);

impl<T: Debug> Display for OrUnknown<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Some(value) => write!(f, "{value:?}"),
            None => f.write_str("unspecified"),
        }
    }
}

struct QuotedText<'a>(&'a str);

impl Display for QuotedText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.0;
        f.write_str("\"")?;
        if text.len() <= LONGEST_BYTES {
            EscapingWriter(&mut *f).write_str(text)?;
            return f.write_str("\"");
        }
        text.chars().take(START_CHARACTERS).try_for_each(|c| EscapingWriter(&mut *f).write_char(c))?;
        // FNV-1a (draft-eastlake-fnv), written out, so that the dump does not change with a hash of the library.
        let hash = text
            .bytes()
            .fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3));
        write!(f, "\"... {} bytes, fnv {hash:016x}", text.len())
    }
}

/// Escapes quotes, backslashes, control characters and spaces other than U+0020, and passes on the rest.
struct EscapingWriter<'a, W>(&'a mut W);

impl<W: Write> Write for EscapingWriter<'_, W> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.chars().try_for_each(|c| {
            if c.is_control() || "\"\\\u{A0}\u{200B}\u{202F}".contains(c) {
                write!(self.0, "{}", c.escape_unicode())
            } else {
                self.0.write_char(c)
            }
        })
    }
}
