//! The clips that every rival stores, as plain structures, and the queries about them.

use crate::Failure;
use lipz_benches::{DEFAULT_SEED, Random};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The queries of each kind: enough that their data in a large bank exceeds all caches.
pub(crate) const QUESTIONS: usize = 1 << 16;

/// All clips, ordered by key.
pub(crate) struct Corpus {
    /// Keys and Lipz files.
    pub(crate) files: Vec<(String, String)>,
    /// The contents of the files.
    pub(crate) bank: Clips,
}

/// The data of the files that a program needs.
#[derive(Serialize, Deserialize, bincode::Encode, bincode::Decode, rkyv::Archive, rkyv::Serialize)]
pub(crate) struct Clips {
    pub(crate) locales: Vec<String>,
    pub(crate) clips: Vec<Clip>,
}

/// The data of a clip that a program needs.
#[derive(Serialize, Deserialize, bincode::Encode, bincode::Decode, rkyv::Archive, rkyv::Serialize)]
pub(crate) struct Clip {
    pub(crate) key: String,
    pub(crate) fps: u32,
    pub(crate) viseme_type: u8,
    /// The viseme codes, without delimiters.
    pub(crate) visemes: String,
    /// The first frame of each segment.
    pub(crate) starts: Vec<u32>,
    /// For each locale, the display text of each segment.
    pub(crate) texts: Vec<Vec<String>>,
    /// For each segment, its event string; empty without events.
    pub(crate) events: Vec<String>,
}

/// A Lipz file, as parsed by serde.
#[derive(Deserialize)]
pub(crate) struct LipzFile {
    fps: u32,
    viseme_type: String,
    visemes: String,
    #[serde(default)]
    events: String,
    /// The elements `text_…`.
    #[serde(flatten)]
    texts: BTreeMap<String, String>,
}

impl Corpus {
    /// Returns the first `count` clips of the published measurements.
    pub(crate) fn new(count: usize, locales: usize) -> Result<Corpus, Failure> {
        let files = lipz_benches::files(count, locales);
        let parsed = files.iter().map(|(key, json)| Ok((key.clone(), serde_json::from_str(json)?)));
        let bank = Clips::from_files(parsed.collect::<Result<_, serde_json::Error>>()?);
        Ok(Corpus { files, bank })
    }
}

impl Clips {
    /// Returns the clips of these files, which must all have the same locales.
    pub(crate) fn from_files(files: Vec<(String, LipzFile)>) -> Clips {
        let tags = files.iter().flat_map(|(_, file)| file.texts.keys().map(|name| name.replace("text_", "")));
        let mut locales: Vec<String> = tags.collect();
        locales.sort_unstable();
        locales.dedup();
        Clips { locales, clips: files.into_iter().map(|(key, file)| Clip::from_file(key, &file)).collect() }
    }
}

impl Clip {
    fn from_file(key: String, file: &LipzFile) -> Clip {
        let starts = file.visemes.split('|').scan(0, |end, segment| {
            let start = *end;
            *end += segment.len() as u32;
            Some(start)
        });
        let types = [("blair", 1), ("toonboom", 2), ("rms", 3)];
        Clip {
            key,
            fps: file.fps,
            viseme_type: types.iter().find(|(name, _)| *name == file.viseme_type).map_or(0, |(_, number)| *number),
            starts: starts.collect(),
            visemes: file.visemes.replace('|', ""),
            texts: file
                .texts
                .values()
                .map(|text| text.split('|').map(|text| display(text).to_owned()).collect())
                .collect(),
            events: match file.events.as_str() {
                "" => Vec::new(),
                events => events.split('|').map(str::to_owned).collect(),
            },
        }
    }
}

/// Returns a text as players see it. In the generated clips, meta is only at the start.
pub(crate) fn display(text: &str) -> &str {
    match text.split_once('}') {
        Some((_, text)) => text.trim(),
        None => text.trim(),
    }
}

/// Returns the frame at a time. The rates of the generated clips are whole numbers.
#[inline]
pub(crate) fn frame_at(fps: u32, time_us: u32) -> usize {
    (u64::from(time_us) * u64::from(fps) / 1_000_000) as usize
}

/// The queries: random clips, which repeat only by chance.
#[derive(bincode::Encode, bincode::Decode)]
pub(crate) struct Questions {
    /// The keys, one after the other, so that reading the queries takes little time.
    pool: String,
    /// The end of each key.
    ends: Vec<u32>,
    /// The clip of each key.
    pub(crate) clips: Vec<u32>,
    /// A time in that clip, in microseconds.
    pub(crate) times_us: Vec<u32>,
}

impl Questions {
    /// Returns the first `count` queries about `clips`.
    pub(crate) fn about(clips: &[Clip], count: usize) -> Questions {
        let mut random = Random::new(DEFAULT_SEED, 0);
        let mut questions =
            Questions { pool: String::new(), ends: Vec::new(), clips: Vec::new(), times_us: Vec::new() };
        for _ in 0..count {
            let number = random.between(0, clips.len() - 1);
            let clip = &clips[number];
            questions.pool.push_str(&clip.key);
            questions.ends.push(questions.pool.len() as u32);
            questions.clips.push(number as u32);
            // No frame begins at an odd microsecond, so floating point cannot round to a different frame.
            let frame_count = clip.visemes.len();
            let last_us = (frame_count * 1_000_000 - 1) / clip.fps as usize;
            questions.times_us.push(random.between(0, last_us - 1) as u32 | 1);
        }
        questions
    }

    /// Returns the number of queries.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Key number `index`.
    #[inline]
    pub(crate) fn key(&self, index: usize) -> &str {
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.pool[start as usize..self.ends[index] as usize]
    }

    /// Returns the queries with keys that no clip has: the last letter is changed.
    pub(crate) fn misses(&self) -> Questions {
        let mut pool = self.pool.clone().into_bytes();
        for &end in &self.ends {
            pool[end as usize - 1] = b'x';
        }
        Questions {
            pool: String::from_utf8(pool).unwrap_or_default(),
            ends: self.ends.clone(),
            clips: self.clips.clone(),
            times_us: self.times_us.clone(),
        }
    }
}
