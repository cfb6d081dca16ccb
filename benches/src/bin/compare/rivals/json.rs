//! The Lipz files themselves, as one JSON document: parsed once, or queried with the specification's own algorithm.

use crate::Failure;
use crate::corpus::{Clips, Corpus, display};
use crate::rival::{File, Reader, Rival};
use crate::rivals::loaded::Loaded;
use foldhash::HashMap;
use lipz_benches::naive;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Parsed into structures when opened.
pub(crate) struct ParsedOnce;

impl Rival for ParsedOnce {
    const NAME: &'static str = "serde_json, parsed once";
    type Reader = Loaded;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        build(corpus, path)
    }

    fn open(file: &'static File) -> Result<Loaded, Failure> {
        let files: BTreeMap<String, _> = serde_json::from_slice(&file.map)?;
        Ok(Loaded::new(Clips::from_files(files.into_iter().collect())))
    }

    fn open_validated(file: &'static File) -> Result<Loaded, Failure> {
        Self::open(file)
    }
}

fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
    let files: Vec<String> = corpus.files.iter().map(|(key, json)| format!("\"{key}\":{}", json.trim_end())).collect();
    Ok(std::fs::write(path, format!("{{{}}}", files.join(",")))?)
}

/// Stored as JSON values, with the function of the specification.
pub(crate) struct AsSpecified {
    clips: Vec<Value>,
    numbers: HashMap<String, u32>,
}

impl Rival for AsSpecified {
    const NAME: &'static str = "serde_json + the specification's function";
    type Reader = AsSpecified;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        build(corpus, path)
    }

    fn open(file: &'static File) -> Result<AsSpecified, Failure> {
        let files: BTreeMap<String, Value> = serde_json::from_slice(&file.map)?;
        let numbers = files.keys().cloned().zip(0..).collect();
        Ok(AsSpecified { clips: files.into_values().collect(), numbers })
    }

    fn open_validated(file: &'static File) -> Result<AsSpecified, Failure> {
        Self::open(file)
    }
}

impl Reader for AsSpecified {
    type Clip<'r> = &'r Value;
    type Locale<'r> = &'static str;

    fn locale(&self, tag: &str) -> Option<&'static str> {
        lipz_benches::locale_tags(lipz_benches::MAX_LOCALES).find(|known| *known == tag)
    }

    fn find(&self, key: &str) -> Option<u32> {
        self.numbers.get(key).copied()
    }

    fn clip(&self, number: u32) -> Option<&Value> {
        self.clips.get(number as usize)
    }

    fn viseme(&self, clip: &Value, time_us: u32) -> u8 {
        naive::current_viseme(clip, f64::from(time_us) / 1e6) as u8
    }

    fn text<T>(&self, clip: &Value, locale: &str, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        naive::current_text(clip, locale, f64::from(time_us) / 1e6).map(|text| then(display(text)))
    }

    fn event<T>(&self, clip: &Value, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(naive::current_event(clip, f64::from(time_us) / 1e6).unwrap_or("")))
    }
}
