//! Layers: a stack returns the answers of the bank of all sources, and merging produces that bank.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::cast_possible_truncation, reason = "tests")]

use lipz_bank::{Bank, ClipId, Recording};
use lipz_compiler::diagnostics::Code;
use lipz_compiler::{Compiler, Input, Options, SplitBank, Stack, StackBelow};
use lipz_layout::{LayerRecord, Tag};
use lipz_testkit::dialogues::{assert_same, with as with_dialogue};
use lipz_testkit::{golden, stacked};
use proptest::prelude::*;
use std::collections::BTreeMap;
use zerocopy::FromBytes;

/// A version of a project: Lipz files by key.
type Project = BTreeMap<String, String>;

fn inputs(project: &Project) -> Vec<Input> {
    project.iter().map(|(key, file)| Input::from_bytes(key.as_str(), file.clone())).collect()
}

fn open(bytes: &[u8]) -> Bank<'_> {
    Bank::open(bytes).unwrap().verify().unwrap()
}

fn stack_of(files: &[Vec<u8>]) -> Stack {
    let named: Vec<(String, &[u8])> =
        files.iter().enumerate().map(|(at, bytes)| (at.to_string(), bytes.as_slice())).collect();
    Stack::open(named.iter().map(|(name, bytes)| (name.as_str(), *bytes))).unwrap()
}

/// Checks that these files return the answers of the whole bank.
fn assert_stack(files: &[Vec<u8>], whole: &[u8]) {
    let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    with_dialogue(&files, |dialogue| assert_same(dialogue, &open(whole)));
}

/// Packs versions of a project on top of each other. After each, the stack must return the answers of the version's
/// bank, and merge into it.
fn check(versions: &[(Project, Compiler<'_>)]) {
    let (first, compiler) = &versions[0];
    let mut files = vec![compiler.compile(&inputs(first)).into_bank().unwrap()];
    for (project, compiler) in &versions[1..] {
        let whole = compiler.compile(&inputs(project)).into_bank().unwrap();
        let over = StackBelow::new(stack_of(&files));
        let compiled = compiler.compile_over(&inputs(project), &over);
        match compiled.bank {
            Some(layer) => files.push(layer),
            None => assert_eq!(compiled.reports.last().unwrap().diagnostics[0].code, Code::LayerWithoutChange),
        }
        assert_stack(&files, &whole);
        assert!(stack_of(&files).into_bank() == whole, "the merged bank differs");
    }
}

/// Generates a Lipz file of some parts, each of which is optional.
fn file() -> impl Strategy<Value = String> {
    let texts = prop::collection::btree_map(
        prop::sample::select(vec!["de-at", "de-de", "de-de-x-few", "en-us", "en-us-x-few", "fr-fr"]),
        prop::sample::select(vec!["Ja.|Nein.", "Aye.|Nay.", "|", "Ja.|  {low} Nein. "]),
        0..4,
    );
    let visemes = prop::option::of(prop::sample::select(vec!["MA|EO-", "-|-", "|", "MAMA|EO"]));
    let events = prop::option::of(prop::sample::select(vec!["amy feels sad|", "|sees door, does wave", "x|y"]));
    let curves =
        prop::option::of(prop::sample::select(vec![r#"{ "joy": "0:0 1:2" }"#, r#"{ "anger": "0:1", "joy": "1:3" }"#]));
    let fps = prop::option::of(prop::sample::select(vec!["24", "23.976", "30.0"]));
    (texts, visemes, events, curves, fps).prop_map(|(texts, visemes, events, curves, fps)| {
        let mut elements: Vec<String> = texts.iter().map(|(tag, text)| format!("\"text_{tag}\": \"{text}\"")).collect();
        elements
            .extend(visemes.iter().map(|visemes| format!("\"viseme_type\": \"blair\", \"visemes\": \"{visemes}\"")));
        elements.extend(events.map(|events| format!("\"events\": \"{events}\"")));
        // No key is after the last frame.
        let curves = curves.filter(|_| visemes.is_none_or(|visemes| visemes != "|"));
        elements.extend(curves.map(|curves| format!("\"curves\": {curves}")));
        elements.extend(fps.map(|fps| format!("\"fps\": {fps}")));
        format!("{{ {} }}", elements.join(", "))
    })
}

/// Generates a version: some of a few clips.
fn project() -> impl Strategy<Value = Project> {
    let keys = prop::sample::select(vec!["a", "act1/aye", "act1/nay", "b", "z/z"]);
    prop::collection::btree_map(keys.prop_map(str::to_owned), file(), 0..5)
}

/// Generates later versions: most clips stay unchanged.
fn versions() -> impl Strategy<Value = Vec<Project>> {
    (project(), prop::collection::vec((project(), any::<[bool; 5]>()), 1..4)).prop_map(|(first, later)| {
        let mut versions = vec![first];
        for (changes, keeps) in later {
            let last = versions.last().unwrap();
            let mut keeps = keeps.into_iter().cycle();
            let mut next: Project = last.clone().into_iter().filter(|_| keeps.next() != Some(false)).collect();
            next.extend(changes.into_iter().filter(|_| keeps.next() != Some(false)));
            versions.push(next);
        }
        versions
    })
}

fn compiler(strip: bool, default: Option<&str>) -> Compiler<'static> {
    let options = Options::new().strip(strip).threads(1);
    Compiler::new(match default {
        Some(tag) => options.default_locale(tag).unwrap(),
        None => options,
    })
}

#[test]
#[should_panic(expected = "Nay.")]
fn a_stack_that_answers_otherwise_is_noticed() {
    let compiler = compiler(true, Some("en-us"));
    let pack = |text: &str| inputs(&one("a", &format!(r#"{{ "text_en-us": "{text}" }}"#)));
    let base = compiler.compile(&pack("Aye.")).into_bank().unwrap();
    let over = StackBelow::new(stack_of(std::slice::from_ref(&base)));
    let patch = compiler.compile_over(&pack("Nay."), &over).into_bank().unwrap();
    assert_stack(&[base.clone(), patch], &base);
}

/// If a layer removes a locale and a later one adds it again, it is a different locale: only the new one is a stand-in
/// for a third locale.
#[test]
fn a_locale_that_came_back_stands_in_for_none_below() {
    let events = r#"{ "events": "amy feels sad|" }"#;
    let versions = [
        vec![("z/z", r#"{ "text_de-at": "Ja.|Nein." }"#)],
        vec![("a", "{  }"), ("z/z", events)],
        vec![("act1/aye", r#"{ "text_de-at": "Ja.|Nein." }"#), ("act1/nay", "{  }"), ("z/z", events)],
        vec![
            ("a", r#"{ "text_de-de": "Ja.|Nein." }"#),
            ("act1/aye", r#"{ "text_de-at": "Ja.|Nein." }"#),
            ("z/z", events),
        ],
    ];
    let project = |files: Vec<(&str, &str)>| files.into_iter().map(|(key, file)| (key.into(), file.into())).collect();
    let versions: Vec<(Project, Compiler<'_>)> =
        versions.into_iter().map(|files| (project(files), compiler(false, None))).collect();
    check(&versions);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn a_stack_answers_as_the_bank_of_its_sources_and_becomes_it(
        versions in versions(),
        strip in any::<bool>(),
        default in prop::sample::select(vec![None, Some("en-us"), Some("de-de")]),
    ) {
        let versions: Vec<_> = versions.into_iter().map(|project| (project, compiler(strip, default))).collect();
        check(&versions);
    }

    #[test]
    fn a_mod_changes_its_own_clips_only(base in project(), addition in project(), strip in any::<bool>()) {
        let default = compiler(strip, Some("en-us"));
        let below = default.compile(&inputs(&base)).into_bank().unwrap();
        let over = StackBelow::new(stack_of(std::slice::from_ref(&below))).keep_others(true);
        // The maker of a mod does not have the settings of the game, but the bank contains its default locale, if there
        // is one.
        let known = open(&below).default_locale().map_or(Some("en-us"), |_| None);
        let compiled = compiler(strip, known).compile_over(&inputs(&addition), &over);
        let Some(layer) = compiled.bank else { return Ok(()) };
        let mut all = base.clone();
        all.extend(addition);
        let whole = default.compile(&inputs(&all)).into_bank().unwrap();
        let files = [below, layer];
        assert_stack(&files, &whole);
        prop_assert!(stack_of(&files).into_bank() == whole);
    }
}

fn one(key: &str, file: &str) -> Project {
    Project::from([(key.to_owned(), file.to_owned())])
}

fn with(project: &Project, key: &str, file: &str) -> Project {
    let mut project = project.clone();
    project.insert(key.to_owned(), file.to_owned());
    project
}

#[test]
fn settings_that_change_come_with_a_layer() {
    let project = with(&one("a", r#"{ "text_en-us": "Aye." }"#), "b", r#"{ "text_de-de": "Ja.", "visemes": "MA" }"#);
    let settings = |text: &str| {
        let settings = lipz_compiler::settings::Settings::parse(text, "", "").unwrap();
        Compiler::new(settings.options)
    };
    let recorded = |number| Compiler::new(Options::new().recordings([("a", Recording::new(1_500_000, number))]));
    check(&[
        (project.clone(), settings("")),
        (project.clone(), settings("[babble]\nrate = 12\n")),
        (project.clone(), settings("[babble]\nrate = 12\n")),
        (project.clone(), settings("default-locale = \"en-us\"\n")),
        (project.clone(), settings("default-locale = \"de-de\"\ndefault-fps = 12\n")),
        (project.clone(), settings("")),
        (project.clone(), recorded(7)),
        (project.clone(), recorded(8)),
    ]);
    check(&[
        (project.clone(), settings("[face]\nhead = 1\n")),
        (project.clone(), settings("[face]\nhead = 2\n[face.robot]\nblink = 0\n")),
        (project.clone(), settings("[babble]\nrate = 12\n")),
    ]);
    check(&[(project.clone(), recorded(8)), (project, settings(""))]);
}

#[test]
fn a_locale_that_is_added_removed_and_added_again() {
    let en = one("a", r#"{ "text_en-us": "Aye." }"#);
    let en = with(&en, "b", r#"{ "text_en-us": "Nay." }"#);
    let de = with(&en, "b", r#"{ "text_en-us": "Nay.", "text_de-de": "Nein." }"#);
    let no_en = one("a", r#"{ "text_de-de": "Ja." }"#);
    let compiler = || compiler(false, Some("en-us"));
    let versions = [&en, &de, &en, &de, &no_en, &en];
    check(&versions.map(|project| (project.clone(), compiler())));
}

/// Returns the length in bytes of the layer that turns one project into another.
fn layer_bytes(old: &Project, new: &Project) -> usize {
    let compiler = compiler(true, Some("en-us"));
    let base = compiler.compile(&inputs(old)).into_bank().unwrap();
    compiler.compile_over(&inputs(new), &StackBelow::new(stack_of(&[base]))).into_bank().unwrap().len()
}

#[test]
fn a_layer_is_as_long_as_its_change() {
    let clip = |number: usize, text: &str| {
        format!(
            r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "{}", "text_en-us": "{text} {number}" }}"#,
            "MAEO".repeat(30)
        )
    };
    let old: Project = (0..1000).map(|number| (format!("clip-{number}"), clip(number, "Aye."))).collect();
    let one = with(&old, "clip-7", &clip(7, "Nay."));
    let ten =
        (0..10).fold(old.clone(), |project, number| with(&project, &format!("clip-{number}"), &clip(number, "Nay.")));
    let mut fewer = old.clone();
    fewer.remove("clip-7");
    // In a locale that one clip has, all others show the default one.
    let german = with(&old, "clip-7", &clip(7, "Aye.").replace(" }", r#", "text_de-de": "Ja." }"#));
    assert!(layer_bytes(&old, &one) < 2200);
    assert!(layer_bytes(&old, &ten) < 4000);
    assert!(layer_bytes(&old, &fewer) < 1800);
    assert!(layer_bytes(&old, &german) < 2300);
}

#[test]
fn layers_that_do_not_fit_are_refused() {
    let compiler = compiler(false, None);
    let pack = |text: &str| compiler.compile(&inputs(&one("a", text))).into_bank().unwrap();
    let (base, other) = (pack(r#"{ "text_en-us": "Aye." }"#), pack(r#"{ "text_en-us": "Nay." }"#));
    let next = inputs(&one("a", r#"{ "text_en-us": "Yes." }"#));
    let patch =
        compiler.compile_over(&next, &StackBelow::new(stack_of(std::slice::from_ref(&base)))).into_bank().unwrap();
    let code = |files: &[&Vec<u8>]| {
        let named = files.iter().map(|file| ("x", file.as_slice()));
        Stack::open(named).err().map(|report| report.diagnostics[0].code)
    };
    assert_eq!(code(&[&base, &patch]), None);
    for files in [&[&other, &patch][..], &[&patch], &[&patch, &base], &[&base, &other], &[], &[&patch, &patch]] {
        assert_eq!(code(files), Some(Code::LayerMisfit), "{}", files.len());
    }
    assert_eq!(code(&[&base, &patch, &patch]), None, "a layer over itself changes nothing");
    // Another layer between them makes no difference.
    let more = with(&one("a", r#"{ "text_en-us": "Aye." }"#), "b", r#"{ "text_en-us": "More." }"#);
    let addition = compiler
        .compile_over(&inputs(&more), &StackBelow::new(stack_of(std::slice::from_ref(&base))))
        .into_bank()
        .unwrap();
    assert_eq!(code(&[&base, &addition, &patch]), None);
    with_dialogue(&[&base, &addition, &patch], |dialogue| {
        assert!(dialogue.clip(ClipId::from_key("b")).is_some());
        let clip = dialogue.clip(ClipId::from_key("a")).unwrap();
        let text = clip.segment(0).unwrap().text(dialogue.locale("en-us").unwrap());
        assert_eq!(text.unwrap().as_str(), "Yes.");
    });
}

#[test]
fn a_layer_over_a_stripped_bank_is_stripped_and_says_so() {
    let base = compiler(true, None).compile(&inputs(&one("a", r#"{ "text_en-us": "Aye." }"#))).into_bank().unwrap();
    let over = StackBelow::new(stack_of(&[base]));
    let compiled = compiler(false, None).compile_over(&inputs(&one("a", r#"{ "text_en-us": "Nay." }"#)), &over);
    let codes: Vec<Code> =
        compiled.reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code).collect();
    assert_eq!(codes, [Code::LayerStripped]);
    assert!(open(&compiled.bank.unwrap()).sections().all(|(tag, _)| tag != *b"SRCE"));
}

#[test]
fn text_banks_serve_in_a_stack() {
    let compiler = compiler(true, Some("en-us"));
    let base = compiler.compile(&inputs(&one("a", r#"{ "text_en-us": "Aye." }"#))).into_bank().unwrap();
    let more = with(&one("a", r#"{ "text_en-us": "Aye." }"#), "b", r#"{ "text_en-us": "Nay." }"#);
    let patch = compiler
        .compile_over(&inputs(&more), &StackBelow::new(stack_of(std::slice::from_ref(&base))))
        .into_bank()
        .unwrap();
    // The German of the base comes as a download.
    let german = compiler.compile(&inputs(&one("a", r#"{ "text_de-de": "Ja." }"#))).into_bank().unwrap();
    let german = SplitBank::from_bytes(&german).unwrap().texts.remove(0).1;
    with_dialogue(&[&base, &patch], |dialogue| assert_eq!(dialogue.locale("de-de"), None));
    with_dialogue(&[&base, &patch, &german], |dialogue| {
        let german = dialogue.locale("de-de").unwrap();
        let text = |key: &str| {
            let clip = dialogue.clip_by_key(key).unwrap();
            clip.segment(0).unwrap().text(german).map(|text| text.as_str().to_owned())
        };
        assert_eq!([text("a"), text("b")], [Some("Ja.".to_owned()), None]);
        // The merged bank has all of them.
        let whole = Stack::of("base", dialogue).unwrap().into_bank();
        assert_same(dialogue, &open(&whole));
    });
}

/// Golden layers, with which readers and writers in other languages are tested.
#[test]
fn the_golden_layers_give_the_answers_beside_them() {
    gives("small", "patch", "patched.dump");
    gives("dubbed", "redub", "redubbed.dump");
}

fn gives(base: &str, patch: &str, dump: &str) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/banks/v1");
    let [base, patch] = [base, patch].map(|name| std::fs::read(folder.join(name).with_extension("lipzbank")).unwrap());
    let whole = stack_of(&[base.clone(), patch.clone()]).into_bank();
    assert_stack(&[base, patch], &whole);
    let found = golden::dump(&open(&whole));
    let path = folder.join(dump);
    if std::env::var_os("LIPZ_BLESS").is_some() {
        std::fs::write(&path, &found).unwrap();
    }
    assert_eq!(std::fs::read_to_string(path).unwrap(), found);
}

/// Returns a patch with a change in its layer section.
fn forged(patch: &[u8], at: usize, change: u8) -> Vec<u8> {
    golden::changed(patch, |bytes| bytes[at] ^= change)
}

#[test]
fn every_changed_byte_of_a_layer_is_refused_or_harmless() {
    let old = with(&one("a", r#"{ "text_en-us": "Aye." }"#), "b", r#"{ "visemes": "MA", "text_de-de": "Ja." }"#);
    let new = with(&one("a", r#"{ "text_en-us": "Nay." }"#), "c", r#"{ "visemes": "MA", "text_fr-fr": "Oui." }"#);
    let compiler = compiler(true, Some("en-us"));
    let base = compiler.compile(&inputs(&old)).into_bank().unwrap();
    let over = StackBelow::new(stack_of(std::slice::from_ref(&base)));
    let patch = compiler.compile_over(&inputs(&new), &over).into_bank().unwrap();
    let section = golden::section(&patch, Tag::LAYER);
    let mut refused = 0;
    for at in section.clone() {
        for change in [1, 2, 0x80, 0xFF] {
            let bytes = forged(&patch, at, change);
            let fits = stacked::every_query_verified(&[&base, &bytes]);
            assert!(stacked::every_query(&[&base, &bytes]) == fits, "the stack verifies exactly what fits");
            refused += usize::from(!fits);
            // The tools accept whatever the reader accepts.
            let stack = Stack::open([("base", base.as_slice()), ("patch", bytes.as_slice())]);
            assert_eq!(stack.is_ok(), fits, "byte {at} ^ {change}");
        }
    }
    // An additional bit in the filter of ids only costs a search.
    let record = LayerRecord::ref_from_prefix(&patch[section.clone()]).unwrap().0;
    let length = section.len() - record.filter_count.get() as usize * size_of::<u64>();
    assert!(refused > 3 * length, "{refused} of {} changes", 4 * length);
    // Truncated after each of its bytes.
    for length in 0..section.len() {
        // It is the last section of the file.
        let cut = golden::changed(&patch, |bytes| {
            bytes.truncate(section.start + length);
            let entry = golden::entry_of(&patch, Tag::LAYER);
            golden::put(bytes, entry + 8, (length as u32).to_le_bytes());
            let length_bytes = bytes.len() as u32;
            golden::put(bytes, 16, length_bytes.to_le_bytes());
        });
        assert!(!stacked::every_query(&[&base, &cut]), "{length}");
    }
}

/// A locale added by a layer shows the texts of its stand-in, including those of clips from another layer.
#[test]
fn a_new_locale_shows_what_a_layer_below_brought() {
    let first = one("b", r#"{ "text_en-us": "Ja.|Nein." }"#);
    let second = with(&first, "act1/aye", r#"{ "text_de-de": "Ja.|Nein." }"#);
    let third = with(&second, "act1/nay", r#"{ "text_de-at": "Ja.|Nein." }"#);
    check(&[first, second, third].map(|project| (project, compiler(false, Some("en-us")))));
}
