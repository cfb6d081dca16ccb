//! Banks forged with knowledge of the format: whole sections, changed fields, correct checksums.

use crate::exercise::{Effort, provoke};
use crate::forge;
use crate::golden::{directory, put, reseal, section, u32_at};
use crate::tools::is_used;
use arbitrary::{Arbitrary, Unstructured};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input, Voices};
use lipz_layout::{ClipRecord, Header, KeyRecord, Tag, fingerprint};
use std::mem::offset_of;
use std::sync::LazyLock;
use zerocopy::FromBytes;

/// The changes to a bank.
#[derive(Arbitrary, Debug)]
pub(super) struct Forgery {
    base: u8,
    contents: Vec<(u8, Edit)>,
    keeps_fingerprint: bool,
    places: Vec<Overwrite>,
}

/// A change of a section. Afterwards, the sections of the file still follow each other.
#[derive(Arbitrary, Debug)]
enum Edit {
    Byte { at: u16, value: u8 },
    Half { at: u16, value: Number },
    Word { at: u16, value: Number },
    Copy { from: u16, to: u16 },
    Swap { one: u16, other: u16 },
    Insert { at: u16 },
    Remove { at: u16 },
}

/// The change of a number.
#[derive(Arbitrary, Debug)]
enum Number {
    Set(u32),
    Add(i8),
    Flip(u8),
}

/// A change of the header or the directory.
#[derive(Arbitrary, Debug)]
struct Overwrite {
    word: u8,
    value: Number,
}

/// The settings of a project with generated motion of faces.
const FACES: &str = "[face]\nkeys = \"words\"\nblink = 5\n[face.amy]\nblink-fear = 1\nglances = 0\n";

/// The settings of a project with articulation profiles and rigs.
const ARTICULATION: &str =
    "[articulation]\ngain = 90\n[articulation.amy]\nlead = -5\n[rig]\nvrm = true\n[rig.own]\nA = \"0.5 jaw*closure\"\n";

/// Small banks, so that changes are likely to hit something: all kinds of clips, with and without sources.
static BASES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let far = format!(r#"{{ "visemes": "{}", "text_en-us": "{}x" }}"#, "A|".repeat(11) + "B", "a|".repeat(11));
    let sets: [&[(&str, &str)]; 4] = [
        &[(
            "a",
            r#"{ "fps": 24, "viseme_type": "blair", "visemes": "MA|EO-", "text_en-us": "Mayor!|No", "events": "|amy points door" }"#,
        )],
        &[
            ("act1/far", &far),
            ("act1/none", r#"{ "text_de-de": "Ja", "curves": { "anger": "0:0 9:2.2", "tail": "0:40 70000:-40" } }"#),
            (
                "act2/sad",
                r#"{ "visemes": "A|-", "text_de-de": "ä|ö", "events": "feels sad, stops staring|else",
                    "curves": { "anger": "0:1 2:0" } }"#,
            ),
        ],
        &[],
        &[
            ("aye", r#"{ "visemes": "MA|EO-", "text_en-us": "Aye!|No" }"#),
            ("de/aye", r#"{ "visemes": "AAA|EO-", "text_de-de": "Ja|ja" }"#),
            ("fr/aye", r#"{ "visemes": "O|O", "text_en-us": "Aye!|No" }"#),
        ],
    ];
    // Profiles; emotions and gestures in texts and events.
    let face: &[(&str, &str)] = &[(
        "face",
        r#"{ "fps": 4, "visemes": "MAEO|EO--", "text_en-us": "{anger 2} Yes, sure!|{calm} No.",
            "events": "|amy feels fear 3, looks away" }"#,
    )];
    // Phones with short and long times.
    let late = format!(r#"{{ "fps": 1, "visemes": "{}", "phones": "guessed f@70000 s@70100" }}"#, "-".repeat(72));
    let phones: &[(&str, &str)] = &[
        ("b", r#"{ "fps": 24, "visemes": "MAMA--", "phones": "-18dB sil@0 M@20 AY@80 m@120 ø@170 pf@200" }"#),
        ("late", &late),
    ];
    let voices = Voices::new("en-us")
        .expect("a voice")
        .dub("de-de", "de/{key}")
        .expect("a voice")
        .dub("fr-fr", "fr/{key}")
        .expect("a voice");
    let bank = |set: &[(&str, &str)], settings: &str, strip| {
        let inputs: Vec<Input> = set.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect();
        let settings = Settings::parse(settings, "lipz.toml", "").expect("settings without errors");
        let options = settings.options.strip(strip).default_locale("en-us").expect("a locale").voices(voices.clone());
        Compiler::new(options.clone()).compile(&inputs).bank.expect("files without errors")
    };
    let sets = sets.iter().map(|set| (*set, "")).chain([(face, FACES), (phones, ARTICULATION)]);
    sets.flat_map(|(set, settings)| [bank(set, settings, false), bank(set, settings, true)]).collect()
});

/// Makes the changes encoded in the bytes, and every query. A bank that passes `verify` must be consistent, and no tool
/// may panic on it.
pub fn forged_bank(bytes: &[u8]) {
    let Ok(forgery) = Forgery::arbitrary_take_rest(Unstructured::new(bytes)) else { return };
    let base = &BASES[usize::from(forgery.base) % BASES.len()];
    let forged = forgery.apply_to(base);
    if provoke(&forged, Effort::Few) {
        assert!(is_used(&forged, base));
    }
}

impl Forgery {
    pub(super) fn apply_to(&self, base: &[u8]) -> Vec<u8> {
        let mut sections: Vec<(Tag, u16, Vec<u8>)> = directory(base)
            .iter()
            .map(|entry| (Tag(entry.tag), entry.entry_bytes.get(), base[section(base, Tag(entry.tag))].to_vec()))
            .collect();
        for (section, edit) in &self.contents {
            let index = usize::from(*section) % sections.len();
            let (_, entry_bytes, contents) = &mut sections[index];
            edit.apply(contents, usize::from(*entry_bytes));
        }
        let (old, _) = Header::read_from_prefix(base).expect("a header");
        let contents =
            |tag| sections.iter().find(|(found, ..)| *found == tag).map_or(&[][..], |(.., contents)| contents);
        let keys = <[KeyRecord]>::ref_from_bytes(contents(Tag::KEYS));
        let clips = <[ClipRecord]>::ref_from_bytes(contents(Tag::CLIPS));
        let sum = match (keys, clips) {
            (Ok(keys), Ok(clips)) if !self.keeps_fingerprint => fingerprint(keys, clips),
            _ => old.fingerprint.get(),
        };
        let sections: Vec<(Tag, u16, &[u8])> =
            sections.iter().map(|(tag, entry, contents)| (*tag, *entry, contents.as_slice())).collect();
        let mut bytes = forge::file(&sections, sum, old.index_seed.get());
        let words = (size_of::<Header>() + size_of_val(directory(base)) - offset_of!(Header, file_length_bytes)) / 4;
        for Overwrite { word, value } in &self.places {
            let at = offset_of!(Header, file_length_bytes) + usize::from(*word) % words * 4;
            let new = value.apply_to(u32_at(&bytes, at));
            put(&mut bytes, at, new.to_le_bytes());
        }
        reseal(&mut bytes);
        bytes
    }
}

impl Edit {
    /// Offsets are taken modulo the length. Changes without a valid offset are skipped.
    fn apply(&self, contents: &mut Vec<u8>, entry_bytes: usize) {
        let entries = contents.len() / entry_bytes.max(1);
        let entry = |at: u16| (entries > 0).then(|| usize::from(at) % entries * entry_bytes);
        let number = |at: u16, bytes: usize| {
            let numbers = contents.len() / bytes;
            (numbers > 0).then(|| usize::from(at) % numbers * bytes)
        };
        match self {
            Edit::Byte { at, value } => {
                if let Some(at) = number(*at, 1) {
                    contents[at] = *value;
                }
            }
            Edit::Half { at, value } => {
                if let Some(at) = number(*at, 2) {
                    let old = u16::from_le_bytes([contents[at], contents[at + 1]]);
                    put(contents, at, (value.apply_to(old.into()) as u16).to_le_bytes());
                }
            }
            Edit::Word { at, value } => {
                if let Some(at) = number(*at, 4) {
                    let new = value.apply_to(u32_at(contents, at));
                    put(contents, at, new.to_le_bytes());
                }
            }
            Edit::Copy { from, to } => {
                if let (Some(from), Some(to)) = (entry(*from), entry(*to)) {
                    contents.copy_within(from..from + entry_bytes, to);
                }
            }
            Edit::Swap { one, other } => {
                if let (Some(one), Some(other)) = (entry(*one), entry(*other)) {
                    (0..entry_bytes).for_each(|byte| contents.swap(one + byte, other + byte));
                }
            }
            Edit::Insert { at } => {
                let at = entry(*at).unwrap_or(0);
                contents.splice(at..at, std::iter::repeat_n(0, entry_bytes));
            }
            Edit::Remove { at } => {
                if let Some(at) = entry(*at) {
                    contents.drain(at..at + entry_bytes);
                }
            }
        }
    }
}

impl Number {
    fn apply_to(&self, old: u32) -> u32 {
        match self {
            Number::Set(value) => *value,
            Number::Add(difference) => old.wrapping_add_signed(i32::from(*difference)),
            Number::Flip(bit) => old ^ (1 << (bit % 32)),
        }
    }
}
