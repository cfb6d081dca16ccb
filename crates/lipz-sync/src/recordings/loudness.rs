//! The silent and loud parts of a recording, which are found without its text.

use crate::recordings::FileFacts;
use crate::recordings::condition::Condition;
use crate::recordings::file_facts::{content_hash, extension, no_sound, unreadable};
use crate::recordings::paths::shown;
use lipz_compiler::replace_file;
use lipz_diagnostics::{Code, Report};
use lipz_speech::{RmsRules, Sound, rms};
use lipz_types::Fps;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The number of parts per second.
const PARTS_PER_SECOND: u16 = 100;
/// The least digit of loudness that is certainly speech.
const LOUD: u8 = b'4';
/// The first line of a cache, with its version.
const HEAD: &str = "lipz audio cache 4\n";
/// The start of a cache of any version.
const MAGIC: &[u8] = b"lipz audio cache ";

/// The loudness of a stretch of a recording.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum VoiceActivity {
    /// Silent throughout.
    Silent,
    /// As loud as a voice for most of the time.
    Loud,
    /// Anything else.
    Unsure,
}

/// The analysed loudness of a recording.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Loudness {
    length_us: u64,
    /// The problems of the recording.
    pub(crate) condition: Condition,
    /// For each hundredth of a second: `-` silent, `+` loud, `.` in between.
    parts: String,
}

impl Loudness {
    fn from_sound(sound: &Sound) -> Loudness {
        // Without a lead, because the visemes are compared with the audio.
        let mut rules = RmsRules::default();
        rules.lead_us = 0;
        let level = |code: char| match code {
            '-' => '-',
            digit if u8::try_from(digit).is_ok_and(|digit| digit >= LOUD) => '+',
            _ => '.',
        };
        let parts = rms(sound, Fps::whole(PARTS_PER_SECOND), &rules).frames.chars().map(level).collect();
        Loudness { length_us: sound.duration_us(), condition: Condition::of(sound), parts }
    }

    /// Returns the loudness between these times.
    pub(crate) fn voice(&self, start_us: u64, end_us: u64) -> VoiceActivity {
        let part = |us: u64| usize::try_from(us * u64::from(PARTS_PER_SECOND) / 1_000_000).unwrap_or(usize::MAX);
        let parts = self.parts.as_bytes();
        let end = part(end_us).max(part(start_us).saturating_add(1)).min(parts.len());
        let Some(parts) = parts.get(part(start_us)..end).filter(|parts| !parts.is_empty()) else {
            return VoiceActivity::Unsure;
        };
        let count = |level: u8| parts.iter().filter(|part| **part == level).count();
        match (count(b'-'), count(b'+')) {
            (silent, _) if silent == parts.len() => VoiceActivity::Silent,
            (0, loud) if loud * 2 >= parts.len() => VoiceActivity::Loud,
            _ => VoiceActivity::Unsure,
        }
    }

    /// Returns the line in a cache: length, condition, and the parts as lengths of runs: `70000 0,0,0,0,0,-,0,0,0 -12
    /// +3`.
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

    fn parse(line: &str) -> Option<(u64, Loudness)> {
        let mut words = line.split(' ');
        let hash = u64::from_str_radix(words.next()?, 16).ok()?;
        let length_us: u64 = words.next()?.parse().ok()?;
        let condition = Condition::parse(words.next()?)?;
        let most = usize::try_from(length_us / 10_000).ok()?.checked_add(2)?;
        let mut parts = String::new();
        for run in words {
            let level = run.chars().next().filter(|level| "-+.".contains(*level))?;
            let length: usize = run.get(1..)?.parse().ok()?;
            // A malicious file cannot cause a larger allocation than a recording of this length.
            if parts.len().checked_add(length)? > most {
                return None;
            }
            parts.extend(std::iter::repeat_n(level, length));
        }
        Some((hash, Loudness { length_us, condition, parts }))
    }
}

/// The loudness of recordings by content hash: in memory, and in a file if the project names one.
#[derive(Default)]
pub(crate) struct LoudnessCache {
    path: Option<PathBuf>,
    before: BTreeMap<u64, Loudness>,
    now: Mutex<BTreeMap<u64, Loudness>>,
}

impl LoudnessCache {
    /// Opens the cache at `path`. A damaged one, or one of a different version, is ignored and replaced.
    ///
    /// # Errors
    /// If there is a different kind of file at `path`, or it cannot be read.
    pub(crate) fn open(path: Option<&Path>) -> Result<LoudnessCache, Report> {
        let mut ear = LoudnessCache { path: path.map(Path::to_owned), ..LoudnessCache::default() };
        let Some(path) = path else { return Ok(ear) };
        match fs::read(path) {
            Ok(bytes) if bytes.is_empty() || bytes.starts_with(MAGIC) => {
                let text = String::from_utf8(bytes).unwrap_or_default();
                let lines = text.strip_prefix(HEAD).unwrap_or_default().lines();
                ear.before = lines.filter_map(Loudness::parse).collect();
                Ok(ear)
            }
            Ok(_) => {
                let message = format!("`{}` is not a cache of recordings and is not overwritten", shown(path));
                Err(Report::failure(
                    shown(path),
                    Code::OutputFailed,
                    message,
                    "name a different file in `cache` of [audio]",
                ))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(ear),
            Err(error) => Err(unreadable(path, &error)),
        }
    }

    /// Analyses a recording, unless one with the same content was analysed before.
    pub(crate) fn listen(&self, path: &Path) -> Result<(FileFacts, Loudness), Report> {
        let open = || File::open(path).map_err(|error| unreadable(path, &error));
        let content_hash = content_hash(open()?).map_err(|error| unreadable(path, &error))?;
        let heard = match self.before.get(&content_hash) {
            Some(heard) => heard.clone(),
            None => {
                let sound =
                    Sound::read(BufReader::new(open()?), extension(path)).map_err(|error| no_sound(path, &error))?;
                Loudness::from_sound(&sound)
            }
        };
        let facts = FileFacts { length_us: heard.length_us, content_hash };
        self.now.lock().unwrap_or_else(PoisonError::into_inner).insert(content_hash, heard.clone());
        Ok((facts, heard))
    }

    /// Writes the cache with the results of this run, if it has a file.
    pub(crate) fn remember(self) -> Result<(), Report> {
        let Some(path) = self.path else { return Ok(()) };
        let now = self.now.into_inner().unwrap_or_else(PoisonError::into_inner);
        if now == self.before {
            return Ok(());
        }
        let line = |(hash, heard): (&u64, &Loudness)| format!("{hash:016x} {}\n", heard.line());
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
        let heard = Loudness { length_us: 70_000, condition: Condition::default(), parts: "--+++.-".to_owned() };
        let line = format!("{:016x} {}", 7, heard.line());
        assert_eq!(line, "0000000000000007 70000 0,0,0,0,0,-,0,0,0 -2 +3 .1 -1");
        assert_eq!(Loudness::parse(&line), Some((7, heard)));
        for bad in ["", "7", "x 1", "7 70000", "7 70000 -3"] {
            assert_eq!(Loudness::parse(bad), None, "{bad}");
        }
        for bad in ["*3", "-x", "+18446744073709551615", "-9 -9", "é"] {
            assert_eq!(Loudness::parse(&format!("7 70000 0,0,0,0,0,-,0,0,0 {bad}")), None, "{bad}");
        }
    }

    #[test]
    fn stretches_are_silent_loud_or_neither() {
        let parts = "----+++.-+".to_owned();
        let heard = Loudness { length_us: 100_000, condition: Condition::default(), parts };
        let voice = |start: u64, end: u64| heard.voice(start * 10_000, end * 10_000);
        assert_eq!(
            [voice(0, 4), voice(4, 8), voice(3, 5), voice(7, 8)],
            [VoiceActivity::Silent, VoiceActivity::Loud, VoiceActivity::Unsure, VoiceActivity::Unsure]
        );
        assert_eq!([voice(10, 12), voice(5, 5)], [VoiceActivity::Unsure, VoiceActivity::Loud]);
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
        let ear = LoudnessCache::open(Some(&cache)).unwrap();
        let (facts, heard) = ear.listen(&sound).unwrap();
        assert_eq!((facts.length_us, heard.parts.as_str()), (20_000, "++"));
        ear.remember().unwrap();
        assert_eq!(
            fs::read_to_string(&cache).unwrap(),
            format!("{HEAD}{hash:016x} 20000 0,0,0,0,0,-,0,0,0 +2\n"),
            "only what is still there"
        );
        // A damaged cache never affects the results.
        let whole = fs::read(&cache).unwrap();
        for length in 0..whole.len() {
            fs::write(&cache, &whole[..length]).unwrap();
            assert_eq!(LoudnessCache::open(Some(&cache)).is_ok(), length == 0 || length >= MAGIC.len(), "{length}");
        }
        assert!(LoudnessCache::open(Some(&sound)).is_err());
        assert!(LoudnessCache::open(None).unwrap().listen(&sound).is_err());
    }
}
