//! Layers: those that the compiler makes from the versions of a project, and those forged with knowledge of the format.

use super::forged_bank::Forgery;
use crate::dialogues::{assert_same, places};
use crate::stacked::{every_query, every_query_verified};
use arbitrary::{Arbitrary, Unstructured};
use lipz_bank::{Bank, Dialogue, Locale};
use lipz_compiler::{Compiler, Input, Options, Stack, StackBelow, Voices};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A base, and a layer that changes a text, visemes and a default, removes a clip and a locale, and adds both.
static FILES: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    let inputs = |files: &[(&str, &str)]| -> Vec<Input> {
        files.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect()
    };
    let old = inputs(&[
        ("a", r#"{ "fps": 24, "visemes": "MA|EO", "text_en-us": "Aye.|No", "events": "|amy points door" }"#),
        ("b", r#"{ "visemes": "A-", "text_en-us": "Aye." }"#),
        ("c", r#"{ "text_de-de": "Ja.", "text_en-us": "Yes." }"#),
    ]);
    let new = inputs(&[
        ("a", r#"{ "fps": 24, "visemes": "MA|EO", "text_en-us": "Nay.|No", "events": "|amy points door" }"#),
        ("b", r#"{ "visemes": "AA", "text_en-us": "Aye." }"#),
        ("d", r#"{ "text_fr-fr": "Oui.", "text_en-us": "Yes.", "curves": { "joy": "0:1" } }"#),
    ]);
    let compiler =
        |locale: &str| Compiler::new(Options::new().strip(true).default_locale(locale).expect("a locale").threads(1));
    let base = compiler("en-us").compile(&old).into_bank().expect("files without errors");
    let over = StackBelow::new(Stack::open([("base", &base)]).expect("a bank"));
    let layer = compiler("fr-fr").compile_over(&new, &over).into_bank().expect("a change");
    [base, layer]
});

/// Makes every query of stacks. They must always return the same answers as the bank into which they are merged.
pub fn layers(bytes: &[u8]) {
    let Some((first, rest)) = bytes.split_first() else { return };
    let unstructured = Unstructured::new(rest);
    if first % 2 == 0 {
        Forgery::arbitrary_take_rest(unstructured).iter().for_each(forged);
    } else {
        History::arbitrary_take_rest(unstructured).iter().for_each(History::check);
    }
}

/// Makes the changes in the layer. The tools must accept the same files as the reader.
fn forged(forgery: &Forgery) {
    let [base, layer] = &*FILES;
    let forged = forgery.apply_to(layer);
    let (base, layer) = (base.as_slice(), forged.as_slice());
    if Bank::open(layer).is_err() {
        return;
    }
    for stack in [&[base, layer][..], &[layer, base], &[layer, layer], &[base, layer, layer]] {
        every_query(stack);
    }
    if Bank::open(layer).and_then(Bank::verify).is_err() {
        return;
    }
    let fits = every_query_verified(&[base, layer]);
    let stack = Stack::open([("base", base), ("layer", &forged)]);
    assert_eq!(stack.is_ok(), fits, "reader and tools differ about what fits");
    let mut files = places(2);
    if let (Ok(stack), Ok(dialogue)) = (stack, Dialogue::open(&mut files, [base, layer]))
        && dialogue.locales().all(|locale| has_texts(&dialogue, locale))
    {
        let merged = stack.into_bank();
        assert_same(&dialogue, &Bank::open(&merged).and_then(Bank::verify).expect("a whole bank"));
    }
}

/// Whether any clip has its own text in a locale. A layer of the compiler removes other locales, as merging does; a
/// forged one may leave them.
fn has_texts(dialogue: &Dialogue<'_>, locale: Locale) -> bool {
    dialogue.clips().any(|clip| clip.segments().any(|segment| segment.has_own_text(locale)))
}

/// The maximal number of versions of a project.
const MOST: usize = 6;

const KEYS: [&str; 5] = ["a", "act1/b", "de/a", "de/act1/b", "z"];
const TEXTS: [&str; 4] = ["Ja.|Nein.", "Aye.|Nay.", "|", "Ja.|  {low} Nein. "];
const TAGS: [&str; 4] = ["de-at", "de-de", "en-us", "fr-fr"];
const VISEMES: [&str; 4] = ["MA|EO-", "-|-", "MAMA|EO", "MA|EO"];
const EVENTS: [&str; 4] = ["amy feels sad|", "|sees door, amy stares door", "x|y", "amy points amy|amy stops pointing"];
const CURVES: [&str; 3] = [r#"{ "joy": "0:0 1:2" }"#, r#"{ "anger": "0:1", "joy": "1:3" }"#, r#"{ "blink": "0:1" }"#];
const RATES: [&str; 3] = ["24", "23.976", "30.0"];

/// Versions of a project, each packed over those before it.
#[derive(Arbitrary, Debug)]
struct History {
    strip: bool,
    versions: Vec<Version>,
}

/// The changes to the clips of the previous version, and to the settings.
#[derive(Arbitrary, Debug)]
struct Version {
    default_locale: u8,
    has_voices: bool,
    changes: Vec<(u8, Option<Contents>)>,
}

/// A Lipz file: numbers select its parts from a few, if any.
#[derive(Arbitrary, Debug)]
struct Contents {
    texts: [u8; TAGS.len()],
    visemes: u8,
    events: u8,
    curves: u8,
    fps: u8,
}

impl History {
    /// At each version, the stack has to return the same answers as the bank of that version, and be mergeable into it.
    fn check(&self) {
        let mut project: BTreeMap<&str, String> = BTreeMap::new();
        let mut files: Vec<Vec<u8>> = Vec::new();
        for version in self.versions.iter().take(MOST) {
            for (key, contents) in &version.changes {
                let key = KEYS[usize::from(*key) % KEYS.len()];
                match contents {
                    Some(contents) => project.insert(key, contents.file()),
                    None => project.remove(key),
                };
            }
            let inputs: Vec<Input> = project.iter().map(|(key, file)| Input::from_bytes(*key, file.clone())).collect();
            let compiler = Compiler::new(version.options(self.strip));
            // Dubs that do not match their originals are errors.
            let Ok(whole) = compiler.compile(&inputs).into_bank() else { continue };
            let stack = |files: &[Vec<u8>]| Stack::open(files.iter().map(|file| ("", file.as_slice())));
            match stack(&files) {
                Ok(below) => files.extend(compiler.compile_over(&inputs, &StackBelow::new(below)).bank),
                Err(_) => files.push(whole.clone()),
            }
            let mut places = places(MOST);
            let dialogue = Dialogue::open(&mut places, files.iter().map(Vec::as_slice));
            let dialogue = dialogue.expect("they were made for each other");
            assert_same(&dialogue, &Bank::open(&whole).expect("a bank"));
            assert!(stack(&files).expect("banks").into_bank() == whole, "the merged bank is another one");
        }
    }
}

impl Version {
    fn options(&self, strip: bool) -> Options {
        let options = Options::new().strip(strip).threads(1);
        let options = match chosen(&TAGS, self.default_locale) {
            Some(tag) => options.default_locale(tag).expect("a locale"),
            None => options,
        };
        let voices = Voices::new("en-us").expect("a voice").dub("de-de", "de/{key}").expect("a voice");
        if self.has_voices { options.voices(voices) } else { options }
    }
}

impl Contents {
    fn file(&self) -> String {
        let texts = TAGS.iter().zip(self.texts).filter_map(|(tag, text)| Some((tag, chosen(&TEXTS, text)?)));
        let mut elements: Vec<String> = texts.map(|(tag, text)| format!("\"text_{tag}\": \"{text}\"")).collect();
        let visemes = chosen(&VISEMES, self.visemes);
        elements.extend(visemes.map(|visemes| format!("\"viseme_type\": \"blair\", \"visemes\": \"{visemes}\"")));
        elements.extend(chosen(&EVENTS, self.events).map(|events| format!("\"events\": \"{events}\"")));
        elements.extend(chosen(&CURVES, self.curves).map(|curves| format!("\"curves\": {curves}")));
        elements.extend(chosen(&RATES, self.fps).map(|fps| format!("\"fps\": {fps}")));
        format!("{{ {} }}", elements.join(", "))
    }
}

/// Selects an item, or none.
fn chosen<T>(all: &[T], number: u8) -> Option<&T> {
    all.get(usize::from(number) % (all.len() + 1))
}
