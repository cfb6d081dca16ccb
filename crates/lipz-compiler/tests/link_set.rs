//! A set linked from objects returns the same answers as the single bank linked from them.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]
#![cfg(feature = "shards")]

mod support;

use lipz_bank::files::SetIndex;
use lipz_bank::{Bank, ClipId, Dialogue, ErrorKind};
use lipz_compiler::diff::diff;
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::shard::{Link, LinkedSet};
use lipz_compiler::{
    Compiler, Documents, Input, MinCoverage, Options, Stack, StackBelow, Voices, coverage, voice_coverage,
};
use lipz_file::write;
use lipz_testkit::dialogues::{self, with};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use support::shards::{drama, objects, project, variants};

/// Returns the names of the files in a folder.
fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap()).collect()
}

fn linked(compiler: &Compiler<'_>, inputs: &[Input], shards: u16, turn: usize, index: &Path) -> LinkedSet {
    let folder = tempfile::tempdir().unwrap();
    let mut paths = objects(compiler, inputs, shards, folder.path());
    let turn = turn % paths.len();
    paths.rotate_left(turn);
    compiler.link_to_set(&Link::open(&paths).unwrap(), index)
}

/// Compares each bank of a set, without the others, with the bank of all clips.
fn assert_alone(index: &[u8], files: &[Vec<u8>], whole: &Bank<'_>) {
    for number in 0..files.len() {
        let others = files.iter().enumerate().map(|(other, file)| if other == number { file.as_slice() } else { &[] });
        let contents: Vec<&[u8]> = [index].into_iter().chain(others).collect();
        with(&contents, |alone| {
            for clip in whole.clips().filter(|clip| alone.set_index().unwrap().bank_of(clip.id()) == number) {
                let found = alone.clip(clip.id()).unwrap();
                for voice in alone.voices() {
                    let same = whole.voice(alone.voice_tag(voice)).unwrap();
                    assert_eq!(found.in_voice(voice).clip.key(), clip.in_voice(same).clip.key());
                }
            }
            assert_eq!(alone.default_babble().name(), whole.default_babble().name());
            assert_eq!(alone.face_profiles().count(), whole.face_profiles().count());
            let default = |tag: Option<&str>| tag.map(str::to_owned);
            let of_alone = default(alone.default_locale().map(|locale| alone.locale_tag(locale)));
            assert_eq!(of_alone, default(whole.default_locale().map(|locale| whole.locale_tag(locale))));
        });
    }
}

/// Returns index and banks of the set at this path, as a program reads them.
fn read(index: &Path) -> (Vec<u8>, Vec<Vec<u8>>) {
    let bytes = fs::read(index).unwrap();
    let banks = SetIndex::open(&bytes).unwrap().verify().unwrap();
    let banks = banks.banks().map(|bank| fs::read(index.with_file_name(bank.file_name)).unwrap()).collect();
    (bytes, banks)
}

/// Compares the set at `index` with the bank of all clips, and the results of tools on both.
fn assert_answers(index: &Path, whole: &[u8]) {
    let (index_bytes, files) = read(index);
    let contents: Vec<&[u8]> = [&index_bytes].into_iter().chain(&files).map(Vec::as_slice).collect();
    with(&contents, |set| {
        let bank = Bank::open(whole).unwrap().verify().unwrap();
        dialogues::assert_same(set, &bank);
        assert_alone(&index_bytes, &files, &bank);
        let index = set.set_index().unwrap();
        assert_eq!((set.clip_count(), index.clip_count()), (bank.clip_count(), bank.clip_count() as u64));
        for clip in bank.clips() {
            let number = index.bank_of(clip.id());
            assert_eq!(set.clip(clip.id()).unwrap().file() as usize, number + 1);
        }
        let tags: Vec<&str> = bank.locales().map(|locale| bank.locale_tag(locale)).collect();
        for number in 1..set.file_count() {
            let own = set.bank(number).unwrap();
            let has_all = own.locales().map(|locale| own.locale_tag(locale)).eq(tags.iter().copied());
            assert!(has_all, "each bank has all locales");
        }
        assert!(Stack::of("set", set).unwrap().bank() == whole, "the merged set differs");
        with(&[whole], |whole| {
            assert_eq!(coverage(set), coverage(whole));
            assert_eq!(voice_coverage(set), voice_coverage(whole));
            assert!(diff(set, whole).is_empty() && diff(whole, set).is_empty());
            assert_eq!(generate(set, Language::Json, None), generate(whole, Language::Json, None));
            let documents = |dialogue: &Dialogue<'_>| {
                let documents = Documents::from_dialogue(dialogue).unwrap();
                let files = documents.iter().map(|document| write(&document.unwrap().1));
                (documents.is_exact(), files.collect::<Vec<String>>())
            };
            assert_eq!(documents(set), documents(whole));
        });
    });
}

fn assert_same(compiler: &Compiler<'_>, inputs: &[Input], shards: u16, turn: usize) {
    let folder = tempfile::tempdir().unwrap();
    let index = folder.path().join("d.lipzset");
    let packed = compiler.compile(inputs);
    let linked = linked(compiler, inputs, shards, turn, &index);
    assert_eq!(packed.reports, linked.reports, "{shards} shards");
    assert_eq!(packed.bank.is_some(), linked.files.is_some());
    let expected = linked.files.map_or(0, |files| files.banks.len() + 1);
    assert_eq!(names(folder.path()).len(), expected, "nothing is left");
    let Some(whole) = packed.bank else { return };
    if shards == 1 {
        assert!(read(&index).1 == [whole.clone()], "the only bank of a set equals the whole bank");
    }
    assert_answers(&index, &whole);
}

#[test]
fn the_drama_in_any_number_of_shards() {
    for options in variants() {
        for (turn, shards) in [1, 2, 7, 64].into_iter().enumerate() {
            assert_same(&Compiler::new(options.clone()), &drama(), shards, turn * 3);
        }
    }
}

#[test]
fn what_all_shards_decide_together() {
    let line = |key: &str, texts: &str| Input::from_bytes(key, format!("{{ {texts} }}"));
    // One of 20 clips is translated: some shards have no German text at all, and some lack the text in the other
    // script.
    let lines: Vec<Input> = (0..20)
        .map(|number| match number {
            3 => line("line-3", r#""text_en-us": "Aye.", "text_de-de": "Ja.", "text_zh-cn": "是""#),
            4 => line("line-4", r#""text_en-us": "Aye.", "text_zh-tw": "是""#),
            _ => line(&format!("line-{number}"), r#""text_en-us": "Aye.""#),
        })
        .collect();
    let english = || Options::new().default_locale("en-us").unwrap();
    let coverage = |percent| english().min_coverage(MinCoverage::new().all(percent));
    let variants = [
        english(),
        coverage(5.0),
        coverage(5.1),
        english().locales(["en-us", "it-it"]).unwrap(),
        english().voices(Voices::new("en-us").unwrap().dub("it-it", "it/{key}").unwrap()),
    ];
    for options in variants {
        assert_same(&Compiler::new(options), &lines, 8, 3);
    }
    // The locale of no voice has texts. They are reported in the same order.
    let foreign = [line("line", r#""text_it-it": "Ciao.""#), line("de/line", ""), line("fr/line", "")];
    let voices = Voices::new("en-us").unwrap().dub("de-de", "de/{key}").unwrap().dub("fr-fr", "fr/{key}").unwrap();
    assert_same(&Compiler::new(english().voices(voices)), &foreign, 3, 1);
    let clash = [line("A/hello", r#""text_en-us": "Hello.""#), line("a/hello", r#""text_en-us": "Hello.""#)];
    assert_same(&Compiler::new(english()), &clash, 64, 0);
}

#[test]
fn a_new_set_takes_the_place_of_the_old_one_and_a_failed_one_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let index = folder.path().join("d.lipzset");
    for other in ["d.lipzbank", "d.de-de.lipzbank", "e.0-of-4.0123456789abcdef.lipzbank"] {
        fs::write(folder.path().join(other), "another").unwrap();
    }
    let compiler = Compiler::new(Options::new().default_locale("en-us").unwrap());
    let old = linked(&compiler, &drama(), 4, 0, &index).files.unwrap();
    assert!(old.index.is_new && old.removed.is_empty() && old.banks.iter().all(|bank| bank.is_new));
    let again = linked(&compiler, &drama(), 4, 1, &index).files.unwrap();
    assert!(!again.index.is_new && again.banks.iter().all(|bank| !bank.is_new), "nothing is written twice");
    let before = names(folder.path());
    // Left by a killed run.
    let orphan = folder.path().join("d.0-of-2.0123456789abcdef.lipzbank");
    fs::write(&orphan, "half a ba").unwrap();
    let mut clash = drama();
    clash.extend(["A/hello", "a/hello"].map(|key| Input::from_bytes(key, r#"{ "text_en-us": "Hello." }"#)));
    let failed = linked(&compiler, &clash, 4, 0, &index);
    assert!(failed.files.is_none() && !failed.reports.is_empty());
    assert!(orphan.exists() && names(folder.path()).len() == before.len() + 1, "the old set is complete");
    let changed = [&drama()[1..], &[Input::from_bytes("z", r#"{ "text_en-us": "Hello." }"#)]].concat();
    let new = linked(&compiler, &changed, 4, 0, &index).files.unwrap();
    let gone: Vec<PathBuf> = new.removed.clone();
    assert!(gone.contains(&orphan) && gone.len() > 1, "{gone:?}");
    assert_eq!(names(folder.path()).len(), before.len(), "an index, four banks, and three unrelated files");
    let whole = compiler.compile(&changed).bank.unwrap();
    assert_answers(&index, &whole);
}

/// A second link waits for the first one, which has written banks but no index yet. It would remove these banks, because
/// no index names them.
#[test]
fn of_two_links_to_one_set_one_comes_after_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let [first_objects, second_objects] = ["1", "2"].map(|name| folder.path().join(name));
    let index = folder.path().join("out/d.lipzset");
    let (first, second) = (drama(), drama().split_off(1));
    let options = || Options::new().default_locale("en-us").unwrap().threads(1);
    let objects = |inputs: &[Input], to: &Path| {
        fs::create_dir(to).unwrap();
        Link::open(&objects(&Compiler::new(options()), inputs, 4, to)).unwrap()
    };
    let (first_link, second_link) = (objects(&first, &first_objects), objects(&second, &second_objects));
    let started = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let meanwhile = |_| {
            if !started.swap(true, Ordering::SeqCst) {
                let other = scope.spawn(|| Compiler::new(options()).link_to_set(&second_link, &index));
                // Long enough to finish if nothing blocked it.
                let end = Instant::now() + Duration::from_secs(1);
                while !other.is_finished() && Instant::now() < end {
                    std::thread::sleep(Duration::from_millis(10));
                }
            }
        };
        let linked = Compiler::new(options()).progress(meanwhile).link_to_set(&first_link, &index);
        assert!(linked.files.is_some(), "{:?}", linked.reports);
    });
    let whole = Compiler::new(options()).compile(&second).bank.unwrap();
    assert_answers(&index, &whole);
    assert_eq!(names(&folder.path().join("out")).len(), 5, "an index and its banks");
}

/// A bank whose header claims the checksum of a different one.
#[test]
fn a_set_takes_no_bank_for_another() {
    let folder = tempfile::tempdir().unwrap();
    let index = folder.path().join("d.lipzset");
    let compiler = Compiler::new(Options::new().default_locale("en-us").unwrap());
    linked(&compiler, &drama(), 2, 0, &index).files.unwrap();
    let (bytes, mut files) = read(&index);
    let expected = files[0][8..16].to_vec();
    files[0] = compiler.compile(&drama()[..2]).bank.unwrap();
    files[0][8..16].copy_from_slice(&expected);
    let refused = |files: &[Vec<u8>]| {
        let mut places = dialogues::places(files.len() + 1);
        let contents = [&bytes].into_iter().chain(files).map(Vec::as_slice);
        let error = Dialogue::open_unverified(&mut places, contents).unwrap_err();
        (error.file(), error.error().kind())
    };
    assert_eq!(refused(&files), (1, ErrorKind::OtherBank));
    files.swap(0, 1);
    assert_eq!(refused(&files), (1, ErrorKind::OtherBank), "in a different order");
    assert_eq!(refused(&files[..1]), (0, ErrorKind::OtherBank), "a bank is missing, so the index is named");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_set_answers_as_one_bank((options, inputs) in project(), shards in 1..=20_u16, turn in 0..20_usize) {
        assert_same(&Compiler::new(options), &inputs, shards, turn);
    }
}

/// Without any of its banks, a set with a patch names the bank to load, unless the patch removes the clip.
#[test]
fn a_removed_clip_is_in_no_missing_bank() {
    let folder = tempfile::tempdir().unwrap();
    let index = folder.path().join("d.lipzset");
    let compiler = Compiler::new(Options::new().default_locale("en-us").unwrap());
    let inputs = drama();
    linked(&compiler, &inputs, 4, 0, &index).files.unwrap();
    let (index, banks) = read(&index);
    let set = [&index].into_iter().chain(&banks).map(|bytes| ("set", bytes));
    let patch = compiler.compile_over(&inputs[1..], &StackBelow::new(Stack::open(set).unwrap())).bank.unwrap();
    let contents: Vec<&[u8]> = [index.as_slice(), &[], &[], &[], &[], &patch].into();
    with(&contents, |dialogue| {
        let missing = |input: &Input| dialogue.missing_bank(ClipId::from_key(&input.key));
        assert!(!dialogue.has_bank(), "a patch is not a base");
        assert_eq!(missing(&inputs[0]), None, "the patch removes it");
        for input in &inputs[1..] {
            let number = dialogue.set_index().unwrap().bank_of(ClipId::from_key(&input.key)) + 1;
            assert_eq!(missing(input), Some(number));
        }
    });
}
