//! What is heard in a recording without knowing its text: where it is silent, and where it is loud.

use crate::Facts;
use crate::condition::Condition;
use crate::facts::{content_hash, extension, no_sound, unreadable};
use crate::recordings::shown;
use lipz_compiler::replace_file;
use lipz_diagnostics::{Code, Report};
use lipz_speech::{RmsRules, Sound, rms};
use lipz_types::Fps;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Of a second, so many parts are told apart.
const PARTS_PER_SECOND: u16 = 100;
/// Digits of loudness from which on somebody certainly speaks.
const LOUD: u8 = b'4';
/// What a cache begins with; another version has another line.
const HEAD: &str = "lipz audio cache 4\n";
/// What a cache of any version begins with.
const MAGIC: &[u8] = b"lipz audio cache ";

/// How loud a stretch of a recording is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Voice {
    /// Silent all the time.
    Silent,
    /// As loud as a voice, most of the time.
    Loud,
    /// Something else.
    Unsure,
}

/// A recording as it is heard.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Heard {
    length_us: u64,
    /// What is wrong with it.
    pub(crate) condition: Condition,
    /// For each hundredth of a second: `-` silent, `+` loud, `.` in between.
    parts: String,
}

impl Heard {
    fn from_sound(sound: &Sound) -> Heard {
        // The mouth is compared where it is heard: without a lead.
        let mut rules = RmsRules::default();
        rules.lead_us = 0;
        let level = |code: char| match code {
            '-' => '-',
            digit if u8::try_from(digit).is_ok_and(|digit| digit >= LOUD) => '+',
            _ => '.',
        };
        let parts = rms(sound, Fps::whole(PARTS_PER_SECOND), &rules).frames.chars().map(level).collect();
        Heard { length_us: sound.duration_us(), condition: Condition::of(sound), parts }
    }

    /// How loud it is between these times.
    pub(crate) fn voice(&self, start_us: u64, end_us: u64) -> Voice {
        let part = |us: u64| usize::try_from(us * u64::from(PARTS_PER_SECOND) / 1_000_000).unwrap_or(usize::MAX);
        let parts = self.parts.as_bytes();
        let end = part(end_us).max(part(start_us).saturating_add(1)).min(parts.len());
        let Some(parts) = parts.get(part(start_us)..end).filter(|parts| !parts.is_empty()) else {
            return Voice::Unsure;
        };
        let count = |level: u8| parts.iter().filter(|part| **part == level).count();
        match (count(b'-'), count(b'+')) {
            (silent, _) if silent == parts.len() => Voice::Silent,
            (0, loud) if loud * 2 >= parts.len() => Voice::Loud,
            _ => Voice::Unsure,
        }
    }

    /// What a cache says of it: length, condition, and the parts as lengths of runs: `70000 0,0,0,0,0,-,0,0,0 -12 +3`.
    fn line(&self) -> String {
        let mut runs = format!("{} {}", self.length_us, self.condition.word());
        let mut rest = self.parts.as_str();
        while let Some(level) = rest.chars().next() {
            let behind = rest.trim_start_matches(level);
            runs += &format!(" {level}{}", rest.len() - behind.len());
            rest = behind;
        }
        runs
    }

    fn parse(line: &str) -> Option<(u64, Heard)> {
        let mut words = line.split(' ');
        let hash = u64::from_str_radix(words.next()?, 16).ok()?;
        let length_us: u64 = words.next()?.parse().ok()?;
        let condition = Condition::parse(words.next()?)?;
        let most = usize::try_from(length_us / 10_000).ok()?.checked_add(2)?;
        let mut parts = String::new();
        for run in words {
            let level = run.chars().next().filter(|level| "-+.".contains(*level))?;
            let length: usize = run.get(1..)?.parse().ok()?;
            // Nobody makes us allocate more than a recording of this length takes.
            if parts.len().checked_add(length)? > most {
                return None;
            }
            parts.extend(std::iter::repeat_n(level, length));
        }
        Some((hash, Heard { length_us, condition, parts }))
    }
}

/// What was heard, by the hash of the contents: in memory, and in a file if the project names one.
#[derive(Default)]
pub(crate) struct Ear {
    path: Option<PathBuf>,
    before: BTreeMap<u64, Heard>,
    now: Mutex<BTreeMap<u64, Heard>>,
}

impl Ear {
    /// With the cache at `path`. One that is damaged or of another version is ignored, and replaced.
    ///
    /// # Errors
    /// If there is something else at `path`, or it cannot be read.
    pub(crate) fn open(path: Option<&Path>) -> Result<Ear, Report> {
        let mut ear = Ear { path: path.map(Path::to_owned), ..Ear::default() };
        let Some(path) = path else { return Ok(ear) };
        match fs::read(path) {
            Ok(bytes) if bytes.is_empty() || bytes.starts_with(MAGIC) => {
                let text = String::from_utf8(bytes).unwrap_or_default();
                let lines = text.strip_prefix(HEAD).unwrap_or_default().lines();
                ear.before = lines.filter_map(Heard::parse).collect();
                Ok(ear)
            }
            Ok(_) => {
                let message = format!("`{}` is not a cache of recordings, and is left alone", shown(path));
                Err(Report::failure(shown(path), Code::OutputFailed, message, "name another file: `cache` of [audio]"))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(ear),
            Err(error) => Err(unreadable(path, &error)),
        }
    }

    /// Listens to a recording, unless one with the same contents was heard before.
    pub(crate) fn listen(&self, path: &Path) -> Result<(Facts, Heard), Report> {
        let open = || File::open(path).map_err(|error| unreadable(path, &error));
        let content_hash = content_hash(open()?).map_err(|error| unreadable(path, &error))?;
        let heard = match self.before.get(&content_hash) {
            Some(heard) => heard.clone(),
            None => {
                let sound =
                    Sound::read(BufReader::new(open()?), extension(path)).map_err(|error| no_sound(path, &error))?;
                Heard::from_sound(&sound)
            }
        };
        let facts = Facts { length_us: heard.length_us, content_hash };
        self.now.lock().unwrap_or_else(PoisonError::into_inner).insert(content_hash, heard.clone());
        Ok((facts, heard))
    }

    /// Writes the cache, if there is one: what this run has heard.
    pub(crate) fn remember(self) -> Result<(), Report> {
        let Some(path) = self.path else { return Ok(()) };
        let now = self.now.into_inner().unwrap_or_else(PoisonError::into_inner);
        if now == self.before {
            return Ok(());
        }
        let line = |(hash, heard): (&u64, &Heard)| format!("{hash:016x} {}\n", heard.line());
        let lines = now.iter().map(line);
        replace_file(&path, (HEAD.to_owned() + &lines.collect::<String>()).as_bytes())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn what_was_heard_is_written_and_read_back() {
        let heard = Heard { length_us: 70_000, condition: Condition::default(), parts: "--+++.-".to_owned() };
        let line = format!("{:016x} {}", 7, heard.line());
        assert_eq!(line, "0000000000000007 70000 0,0,0,0,0,-,0,0,0 -2 +3 .1 -1");
        assert_eq!(Heard::parse(&line), Some((7, heard)));
        for bad in ["", "7", "x 1", "7 70000", "7 70000 -3"] {
            assert_eq!(Heard::parse(bad), None, "{bad}");
        }
        for bad in ["*3", "-x", "+18446744073709551615", "-9 -9", "é"] {
            assert_eq!(Heard::parse(&format!("7 70000 0,0,0,0,0,-,0,0,0 {bad}")), None, "{bad}");
        }
    }

    #[test]
    fn stretches_are_silent_loud_or_neither() {
        let parts = "----+++.-+".to_owned();
        let heard = Heard { length_us: 100_000, condition: Condition::default(), parts };
        let voice = |start: u64, end: u64| heard.voice(start * 10_000, end * 10_000);
        assert_eq!(
            [voice(0, 4), voice(4, 8), voice(3, 5), voice(7, 8)],
            [Voice::Silent, Voice::Loud, Voice::Unsure, Voice::Unsure]
        );
        assert_eq!([voice(10, 12), voice(5, 5)], [Voice::Unsure, Voice::Loud]);
    }

    #[test]
    fn a_cache_is_used_and_other_files_are_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let (cache, sound) = (folder.path().join("a.cache"), folder.path().join("a.wav"));
        fs::write(&sound, "no sound at all").unwrap();
        let hash = content_hash(File::open(&sound).unwrap()).unwrap();
        fs::write(
            &cache,
            format!(
                "{HEAD}{hash:016x} 20000 0,0,0,0,0,-,0,0,0 +2\n0000000000000001 10000 0,0,0,0,0,-,0,0,0 -1\nnonsense\n"
            ),
        )
        .unwrap();
        let ear = Ear::open(Some(&cache)).unwrap();
        let (facts, heard) = ear.listen(&sound).unwrap();
        assert_eq!((facts.length_us, heard.parts.as_str()), (20_000, "++"));
        ear.remember().unwrap();
        assert_eq!(
            fs::read_to_string(&cache).unwrap(),
            format!("{HEAD}{hash:016x} 20000 0,0,0,0,0,-,0,0,0 +2\n"),
            "only what is still there"
        );
        // Whatever happened to the cache, it is no more than a cache.
        let whole = fs::read(&cache).unwrap();
        for length in 0..whole.len() {
            fs::write(&cache, &whole[..length]).unwrap();
            assert_eq!(Ear::open(Some(&cache)).is_ok(), length == 0 || length >= MAGIC.len(), "{length}");
        }
        assert!(Ear::open(Some(&sound)).is_err());
        assert!(Ear::open(None).unwrap().listen(&sound).is_err());
    }
}
