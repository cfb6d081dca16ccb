//! One clip: its current file, and other data about it.

use super::placed_diagnostic::{PlacedDiagnostic, placed};
use super::project_file;
use super::version::Version;
use crate::console;
use lipz_compiler::WordTime;
use lipz_file::{Value, parse};
use lipz_sync::PhoneTime;
use serde::Serialize;

/// A clip, as it is sent to the page.
#[derive(Serialize)]
pub(super) struct ClipPage {
    key: String,
    /// The path of its file; `None` in a bank.
    path: Option<String>,
    /// The file as it was read. Changes refer to it.
    source: Option<String>,
    /// The elements with strings, in file order.
    elements: Vec<(String, String)>,
    words: Vec<RecordedWord>,
    /// The element with the text that has these words.
    spoken: Option<String>,
    /// Only on a page without a server from which it could fetch them.
    #[serde(skip_serializing_if = "Option::is_none")]
    phones: Option<Vec<Phone>>,
    has_sound: bool,
    /// The name of the images that show its mouth; `None` for the drawn face.
    sprites: Option<String>,
    diagnostics: Vec<PlacedDiagnostic>,
}

/// A word that the lip sync found in the recording.
#[derive(Serialize)]
struct RecordedWord {
    text: String,
    /// Its position in the element, in UTF-16 code units, as scripts of pages count.
    at: usize,
    start_ms: u32,
    end_ms: u32,
    is_doubtful: bool,
}

/// A phone that the lip sync found in the recording.
#[derive(Serialize)]
pub(super) struct Phone {
    phone: String,
    start_ms: u32,
    end_ms: u32,
}

/// Returns phones as they are sent to the page.
pub(super) fn phones(heard: &[PhoneTime]) -> Vec<Phone> {
    let phone =
        |heard: &PhoneTime| Phone { phone: heard.phone.clone(), start_ms: heard.start_ms, end_ms: heard.end_ms };
    heard.iter().map(phone).collect()
}

impl ClipPage {
    /// Returns the clip with this key from its current file, or `None` if the project has no such clip.
    pub(super) fn new(version: &Version, key: &str) -> Option<ClipPage> {
        let Some(path) = version.files.get(key) else {
            let has_clip = lipz_bank::Bank::open(&version.bank).is_ok_and(|bank| bank.clip_by_key(key).is_some());
            return has_clip.then(|| ClipPage::of_bank(version, key));
        };
        let source = project_file::read(path).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        let document = source.as_ref().and_then(|source| parse(source.as_bytes()).document);
        let strings =
            document.iter().flat_map(|document| &document.elements).filter_map(|element| match &element.value {
                Value::String(string) => Some((element.name.text.to_string(), string.text.to_string())),
                Value::Number(_) | Value::Other(_) => None,
            });
        let elements: Vec<(String, String)> = strings.collect();
        let (spoken, words) = words(version, key, &elements).unzip();
        Some(ClipPage {
            key: key.to_owned(),
            path: Some(console::path(path)),
            words: words.unwrap_or_default(),
            spoken,
            phones: None,
            // A file that cannot be read completely cannot be edited.
            source: document.is_some().then(|| source.clone()).flatten(),
            has_sound: version.recordings.find(key).is_some(),
            sprites: version.sprites.of(version.characters().get(key)).map(str::to_owned),
            diagnostics: placed(&version.reports_of(key)),
            elements,
        })
    }

    /// Returns the clip for a page without a server.
    pub(super) fn alone(self, heard: &[PhoneTime], has_sound: bool) -> ClipPage {
        ClipPage { source: None, phones: Some(phones(heard)), has_sound, ..self }
    }

    fn of_bank(version: &Version, key: &str) -> ClipPage {
        ClipPage {
            key: key.to_owned(),
            path: None,
            source: None,
            elements: Vec::new(),
            words: Vec::new(),
            spoken: None,
            phones: None,
            has_sound: version.recordings.find(key).is_some(),
            sprites: None,
            diagnostics: Vec::new(),
        }
    }
}

/// Returns the element with the spoken text, and its words with times: the text that has most of the words which the lip
/// sync found.
fn words(version: &Version, key: &str, elements: &[(String, String)]) -> Option<(String, Vec<RecordedWord>)> {
    let times = version.words.get(key)?;
    let of_text = |text: &String| {
        let (mut at, mut units) = (0, 0);
        let word = |word: WordTime| {
            let WordTime { start_ms, end_ms, is_doubtful, range } = word;
            units += text.get(at..range.start)?.encode_utf16().count();
            at = range.start;
            Some(RecordedWord { text: text.get(range)?.to_owned(), at: units, start_ms, end_ms, is_doubtful })
        };
        times.of_text(text).into_iter().filter_map(word).collect::<Vec<_>>()
    };
    let texts = elements.iter().filter(|(name, _)| lipz_file::locale::text_name(name).is_some());
    // Of equal ones, the first.
    let all = texts.map(|(name, text)| (name.clone(), of_text(text))).rev();
    all.max_by_key(|(_, words)| words.len()).filter(|(_, words)| !words.is_empty())
}
