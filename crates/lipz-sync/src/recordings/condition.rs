//! The condition of a recording: damaged, silent, clipped.

use crate::recordings::paths::shown;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_speech::Sound;
use std::path::Path;

/// The problems of a recording that are independent of its text.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Condition {
    /// Whether it ends in the middle of its data.
    truncated: bool,
    /// Whether its samples do not match its checksum.
    altered: bool,
    /// The number of places with missing data in the middle.
    damaged: u64,
    /// The start of the first of them, in microseconds.
    damaged_us: u64,
    /// Their total length in microseconds, as far as it can be determined.
    missing_us: u64,
    /// For a silent recording, the level of its loud parts in decibels below full scale.
    silent_db: Option<u32>,
    /// Whether it is audible, but not speech.
    no_speech: bool,
    /// The number of places that are clipped at full scale.
    clipped: u64,
    /// The start of the first of them, in microseconds.
    clipped_us: u64,
}

impl Condition {
    pub(crate) fn of(sound: &Sound) -> Condition {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "decibels have few digits")]
        let below = || -sound.level_db().round() as u32;
        let damage = sound.damage();
        Condition {
            truncated: sound.is_truncated(),
            altered: sound.is_altered(),
            damaged: damage.places,
            damaged_us: damage.start_us,
            missing_us: damage.missing_us,
            silent_db: sound.is_silent().then(below),
            no_speech: sound.is_no_speech(),
            clipped: sound.clipping().len() as u64,
            clipped_us: sound.clipping().first().map_or(0, |first| first.start_us),
        }
    }

    /// Returns the condition of a recording in which a text was found: it is speech, whatever its spectrum looks like.
    pub(crate) fn with_speech(self) -> Condition {
        Condition { no_speech: false, ..self }
    }

    /// Whether the recording is silent.
    pub(crate) fn is_silent(&self) -> bool {
        self.silent_db.is_some()
    }

    /// Returns the diagnostics about the recording at `path`, if there are any.
    pub(crate) fn report(&self, path: &Path) -> Option<Report> {
        let mut found = Vec::new();
        let damage = self.damage().into_iter();
        found.extend(
            damage.map(|what| Diagnostic::new(Code::DamagedSound, what).help("export or copy the recording again")),
        );
        if let Some(below) = self.silent_db {
            let diagnostic = Diagnostic::new(Code::SilentRecording, "the recording is silent");
            let level = format!("its loud parts are {below} decibels below full scale");
            found.push(
                diagnostic.note(level).help("check whether the right channel was exported, or record the line again"),
            );
        }
        if self.no_speech {
            let diagnostic = Diagnostic::new(Code::NoSpeech, "the recording contains no speech");
            let note = "it contains only noise, a tone or music, or these are as loud as the voice";
            found.push(diagnostic.note(note).help("record the voice alone, and mix it with other audio in the game"));
        }
        if self.clipped > 0 {
            let others = others(self.clipped - 1);
            let at = self.clipped_us as f64 / 1e6;
            let message = format!("the recording is clipped at full scale at {at:.2} s{others}");
            let help = "record the line at a lower level; clipped audio is distorted, and its visemes may be wrong";
            found.push(Diagnostic::new(Code::ClippedRecording, message).help(help));
        }
        (!found.is_empty()).then(|| Report::all_about(shown(path), found))
    }

    /// Returns descriptions of the damage.
    fn damage(&self) -> Vec<String> {
        let mut said = Vec::new();
        if self.damaged > 0 {
            let missing = match self.missing_us {
                0 => "a part may be missing".to_owned(),
                missing_us => {
                    let s = missing_us as f64 / 1e6;
                    format!("{s:.2} s are missing, in which the mouth rests")
                }
            };
            let at = self.damaged_us as f64 / 1e6;
            said.push(format!("the recording is damaged at {at:.2} s{}: {missing}", others(self.damaged - 1)));
        }
        if self.truncated {
            said.push("the recording ends in the middle of its data".to_owned());
        }
        if self.altered && said.is_empty() {
            said.push("the samples do not match the checksum of the recording".to_owned());
        }
        said
    }

    /// Returns the form in a cache, one word: `0,0,0,0,0,-,2,1500000,0`.
    pub(crate) fn word(&self) -> String {
        let silent = self.silent_db.map_or_else(|| "-".to_owned(), |below| below.to_string());
        let Condition { damaged, damaged_us, missing_us, clipped, clipped_us, .. } = self;
        let [truncated, altered, no_speech] = [self.truncated, self.altered, self.no_speech].map(u8::from);
        format!("{truncated},{altered},{damaged},{damaged_us},{missing_us},{silent},{clipped},{clipped_us},{no_speech}")
    }

    pub(crate) fn parse(word: &str) -> Option<Condition> {
        let mut parts = word.split(',');
        let mut next = || parts.next();
        let condition = Condition {
            truncated: next()? == "1",
            altered: next()? == "1",
            damaged: next()?.parse().ok()?,
            damaged_us: next()?.parse().ok()?,
            missing_us: next()?.parse().ok()?,
            silent_db: Some(next()?).filter(|part| *part != "-").map(str::parse).transpose().ok()?,
            clipped: next()?.parse().ok()?,
            clipped_us: next()?.parse().ok()?,
            no_speech: next()? == "1",
        };
        parts.next().is_none().then_some(condition)
    }
}

/// Returns a phrase for the number of other places.
fn others(count: u64) -> String {
    match count {
        0 => String::new(),
        1 => ", and at another time".to_owned(),
        more => format!(", and at {more} more times"),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn told(condition: Condition) -> Vec<String> {
        let report = condition.report(Path::new("a.wav"));
        report.iter().flat_map(|report| &report.diagnostics).map(|found| found.message.clone()).collect()
    }

    #[test]
    fn every_fault_is_told_and_survives_the_cache() {
        let fine = Condition::default();
        assert_eq!((told(fine), fine.word()), (Vec::new(), "0,0,0,0,0,-,0,0,0".to_owned()));
        let bad = Condition {
            truncated: true,
            altered: true,
            damaged: 3,
            damaged_us: 250_000,
            missing_us: 1_700_000,
            silent_db: Some(90),
            no_speech: true,
            clipped: 3,
            clipped_us: 1_500_000,
        };
        let all = [
            "the recording is damaged at 0.25 s, and at 2 more times: 1.70 s are missing, in which the mouth rests",
            "the recording ends in the middle of its data",
            "the recording is silent",
            "the recording contains no speech",
            "the recording is clipped at full scale at 1.50 s, and at 2 more times",
        ];
        assert_eq!(told(bad), all);
        let altered = Condition { altered: true, ..fine };
        let checksum = "the samples do not match the checksum of the recording";
        assert_eq!(told(altered), [checksum]);
        let somewhere = Condition { damaged: 1, ..fine };
        assert_eq!(told(somewhere), ["the recording is damaged at 0.00 s: a part may be missing"]);
        for condition in [fine, bad, altered] {
            assert_eq!(Condition::parse(&condition.word()), Some(condition));
        }
        for word in ["", "0", "0,0,0,0,0,x,0,0,0", "0,0,0,0,0,-,0,0", "0,0,0,0,0,-,0,0,0,0", "0,0,-1,0,0,-,0,0,0"] {
            assert_eq!(Condition::parse(word), None, "{word}");
        }
    }
}
