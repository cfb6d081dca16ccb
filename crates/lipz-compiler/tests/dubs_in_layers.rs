//! Dubs in layers: in each voice, a stack returns the answers of the bank of all sources, and merging produces that
//! bank.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "tests")]

use lipz_bank::{Bank, VoiceSource};
use lipz_compiler::diagnostics::Code;
use lipz_compiler::{Compiler, Input, Options, Stack, StackBelow, VoiceBanks, Voices};
use lipz_testkit::dialogues::{assert_same, with};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// Lipz files by key.
type Project = BTreeMap<&'static str, String>;

/// The voices of a project, with that of the originals first.
const VOICES: [&[(&str, &str)]; 5] = [
    &[],
    &[("en-us", "{key}"), ("de-de", "de/{key}")],
    &[("en-us", "{key}"), ("de-at", "at/{key}"), ("de-de", "de/{key}"), ("fr-fr", "fr/{key}")],
    &[("en-us", "{key}"), ("de-at", "at/{key}")],
    &[("fr-fr", "{key}"), ("de-de", "de/{key}")],
];

fn compiler(voices: usize, strip: bool) -> Compiler<'static> {
    let options = Options::new().strip(strip).threads(1).default_locale("en-us").unwrap();
    let Some((original, _)) = VOICES[voices].first() else { return Compiler::new(options) };
    let all = VOICES[voices]
        .iter()
        .fold(Voices::new(original).unwrap(), |all, (tag, pattern)| all.dub(tag, *pattern).unwrap());
    Compiler::new(options.voices(all))
}

fn inputs(project: &Project) -> Vec<Input> {
    project.iter().map(|(key, file)| Input::from_bytes(*key, file.clone())).collect()
}

fn open(bytes: &[u8]) -> Bank<'_> {
    Bank::open(bytes).unwrap().verify().unwrap()
}

fn stack_of(files: &[Vec<u8>]) -> Stack {
    Stack::open(files.iter().map(|bytes| ("bank", bytes.as_slice()))).unwrap()
}

/// Checks that the stack of these files returns the answers of the whole bank, and merges into it.
fn check(files: &[Vec<u8>], whole: &[u8]) {
    let named: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    with(&named, |dialogue| assert_same(dialogue, &open(whole)));
    assert!(stack_of(files).into_bank() == whole, "the merged bank differs");
}

/// Generates a Lipz file of two segments.
fn file() -> impl Strategy<Value = String> {
    let texts = prop::collection::btree_map(
        prop::sample::select(vec!["de-at", "de-de", "en-us"]),
        prop::sample::select(vec!["Ja.|Nein.", "Aye.|Nay.", "|", "Ja.|  {low} Nein. "]),
        0..3,
    );
    (texts, prop::sample::select(vec!["MA|EO-", "-|-", "MAMA|EO"])).prop_map(|(texts, visemes)| {
        let texts: String = texts.iter().map(|(tag, text)| format!(", \"text_{tag}\": \"{text}\"")).collect();
        format!(r#"{{ "viseme_type": "blair", "visemes": "{visemes}"{texts} }}"#)
    })
}

const KEYS: [&str; 6] = ["a", "at/a", "b", "de/a", "de/b", "fr/a"];

/// Returns the files without dubs whose originals are missing.
fn whole(mut project: Project) -> Project {
    let has = |key: &str| ["a", "b"].map(|original| key.ends_with(original) && key != original);
    let missing = ["a", "b"].map(|original| !project.contains_key(original));
    project.retain(|key, _| !std::iter::zip(has(key), missing).any(|(is_dub, is_missing)| is_dub && is_missing));
    project
}

fn project() -> impl Strategy<Value = Project> {
    prop::collection::btree_map(prop::sample::select(KEYS.to_vec()), file(), 2..7)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn patches_add_change_and_remove_dubs(
        first in project(),
        later in prop::collection::vec((project(), prop::collection::vec(any::<bool>(), 6), 0..VOICES.len()), 1..4),
        voices in 0..VOICES.len(),
        strip in any::<bool>(),
    ) {
        let mut project = first;
        let mut files = vec![compiler(voices, strip).compile(&inputs(&whole(project.clone()))).into_bank().unwrap()];
        for (changes, keeps, voices) in later {
            let is_kept = |key: &str| KEYS.iter().zip(&keeps).any(|(other, keeps)| *other == key && *keeps);
            project.retain(|key, _| is_kept(key));
            project.extend(changes.into_iter().filter(|(key, _)| !is_kept(key)));
            let (inputs, compiler) = (inputs(&whole(project.clone())), compiler(voices, strip));
            let next = compiler.compile(&inputs).into_bank().unwrap();
            files.extend(compiler.compile_over(&inputs, &StackBelow::new(stack_of(&files))).bank);
            check(&files, &next);
        }
    }

    #[test]
    fn banks_of_voices_are_the_whole_bank(project in project(), voices in 0..VOICES.len(), strip in any::<bool>()) {
        let bank = compiler(voices, strip).compile(&inputs(&whole(project))).into_bank().unwrap();
        let split = VoiceBanks::from_bytes(&bank).unwrap();
        prop_assert!(open(&split.base).voices().next().is_none());
        let all: Vec<Vec<u8>> = [split.base.clone()].into_iter().chain(split.voices.iter().map(|(_, bank)| bank.clone())).collect();
        check(&all, &bank);
        let reversed: Vec<Vec<u8>> = [split.base.clone()].into_iter().chain(all[1..].iter().rev().cloned()).collect();
        check(&reversed, &bank);
        // Each bank alone adds its own dubs.
        for (tag, voice) in &split.voices {
            with(&[&split.base, voice], |dialogue| {
                let whole = open(&bank);
                for clip in whole.clips().filter(|clip| clip.original().is_none()) {
                    let expected = clip.in_voice(whole.voice(tag).unwrap());
                    let expected = if expected.spoken == VoiceSource::Dub { expected.clip.key() } else { clip.key() };
                    let voiced = dialogue.clip(clip.id()).unwrap().in_voice(dialogue.voice(tag).unwrap());
                    assert_eq!(voiced.clip.key(), expected);
                }
            });
        }
    }

    #[test]
    fn an_addition_brings_and_changes_dubs(
        base in project(),
        addition in project(),
        voices in 1..VOICES.len(),
        strip in any::<bool>(),
    ) {
        let base = whole(base);
        let mut all = base.clone();
        let compiler = compiler(voices, strip);
        let mut files = vec![compiler.compile(&inputs(&all)).into_bank().unwrap()];
        all.extend(addition);
        let all = whole(all);
        let added: Project = all.iter().filter(|(key, file)| base.get(*key) != Some(*file)).map(|(key, file)| (*key, file.clone())).collect();
        let over = StackBelow::new(stack_of(&files)).keep_others(true);
        files.extend(compiler.compile_over(&inputs(&added), &over).bank);
        check(&files, &compiler.compile(&inputs(&all)).into_bank().unwrap());
    }
}

/// Returns a project with a dub of one of its lines.
fn dubbed() -> Project {
    let file = |code: &str, text: &str| format!(r#"{{ "viseme_type": "blair", "visemes": "{code}|O"{text} }}"#);
    Project::from([
        ("a", file("M", r#", "text_en-us": "Aye.|Nay.""#)),
        ("b", file("E", r#", "text_en-us": "No.|No.""#)),
        ("de/a", file("A", "")),
    ])
}

#[test]
fn an_addition_that_knows_no_voices_keeps_them() {
    let base = compiler(1, false).compile(&inputs(&dubbed())).into_bank().unwrap();
    let over = StackBelow::new(stack_of(std::slice::from_ref(&base))).keep_others(true);
    let mut all = dubbed();
    all.insert("a", all["a"].replace("Aye.", "Yes."));
    let own = Project::from([("a", all["a"].clone())]);
    let addition = compiler(0, false).compile_over(&inputs(&own), &over).into_bank().unwrap();
    check(&[base, addition], &compiler(1, false).compile(&inputs(&all)).into_bank().unwrap());
}

#[test]
fn additions_that_do_not_fit_the_dubs_below_are_told() {
    let base = compiler(1, false).compile(&inputs(&dubbed())).into_bank().unwrap();
    let over = StackBelow::new(stack_of(std::slice::from_ref(&base))).keep_others(true);
    let codes = |voices: usize, key: &'static str| {
        let own = Project::from([(key, r#"{ "viseme_type": "blair", "visemes": "M" }"#.to_owned())]);
        let compiled = compiler(voices, false).compile_over(&inputs(&own), &over);
        assert_eq!(compiled.bank.is_none(), key != "de/c", "only a dub without original is a lint");
        compiled.reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code).collect::<Vec<_>>()
    };
    assert_eq!(codes(0, "a"), [Code::DubSegments], "its dub has two");
    assert_eq!(codes(0, "de/a"), [Code::DubSegments]);
    assert_eq!(codes(1, "de/b"), [Code::DubSegments], "its original is below");
    assert!(codes(1, "de/c").contains(&Code::DubWithoutOriginal));
    assert_eq!(codes(4, "c"), [Code::OtherOriginal], "other originals");
}

#[test]
fn a_patch_of_dubs_is_as_long_as_its_change() {
    let numbered = |first: &str, number: usize| format!("{first}{number}");
    let file = |text: &str| format!(r#"{{ "viseme_type": "blair", "visemes": "{}"{text} }}"#, "MAEO".repeat(30));
    let text = format!(r#", "text_en-us": "{}""#, "Aye. ".repeat(40));
    let pack = |extra: &[(&str, String)], over: Option<&[u8]>| {
        let all = (0..500).flat_map(|at| [(numbered("line-", at), file(&text)), (numbered("de/line-", at), file(""))]);
        let mut all: BTreeMap<String, String> = all.collect();
        all.extend(extra.iter().map(|(key, file)| ((*key).to_owned(), file.clone())));
        let inputs: Vec<Input> = all.into_iter().map(|(key, file)| Input::from_bytes(key, file)).collect();
        match over {
            None => compiler(1, true).compile(&inputs).into_bank().unwrap(),
            Some(base) => compiler(1, true)
                .compile_over(&inputs, &StackBelow::new(stack_of(&[base.to_vec()])))
                .into_bank()
                .unwrap(),
        }
    };
    let base = pack(&[], None);
    // Visemes of a dub. Its texts remain those of its original.
    let mouth = pack(&[("de/line-7", file("").replace('E', "O"))], Some(&base));
    assert!(mouth.len() < 1900, "{}", mouth.len());
    // A text of an original, which its dub also shows. It is stored once.
    let changed = pack(&[("line-7", file(&text.replacen("Aye", "Yes", 1)))], Some(&base));
    assert!(changed.len() < 2100, "{}", changed.len());
}
