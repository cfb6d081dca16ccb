//! Dialogues of several files: patches, text banks, sets, and a patch on top of a set.
#![allow(clippy::unwrap_used, clippy::incompatible_msrv)]

use lipz_bank::{ClipId, ErrorKind};
use lipz_compiler::shard::{Link, Shard, shard_of};
use lipz_compiler::{Compiler, Input, SplitBank, Stack, StackBelow};
use lipz_host::{Dialogue, Source};
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

fn replace(path: &Path, bytes: &[u8]) {
    let new = path.with_extension("new");
    fs::write(&new, bytes).unwrap();
    fs::rename(&new, path).unwrap();
}

/// Returns a base with this text, and a patch that replaces it.
fn stack(text: &str, patched: &str) -> [Vec<u8>; 2] {
    let input = |text: &str| Input::from_bytes("line", format!(r#"{{ "text_en-us": "{text}" }}"#).as_bytes());
    let base = Compiler::default().compile(&[input(text)]).into_bank().unwrap();
    let patch = patch(&base, &input(patched));
    [base, patch]
}

/// Returns the patch that replaces the clip of a base with this input.
fn patch(base: &[u8], input: &Input) -> Vec<u8> {
    let over = StackBelow::new(Stack::open([("base", base)]).unwrap());
    Compiler::default().compile_over(std::slice::from_ref(input), &over).into_bank().unwrap()
}

fn text(dialogue: &Dialogue, key: &str, tag: &str) -> String {
    let segment = dialogue.clip_by_key(key).unwrap().segment(0).unwrap();
    segment.text(dialogue.locale(tag).unwrap()).unwrap().as_str().to_owned()
}

#[test]
fn a_stack_follows_its_files_once_they_fit() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["base", "patch"].map(|name| folder.path().join(name));
    let [old, new] = [stack("Aye.", "Nay."), stack("Yes.", "No.")];
    paths.iter().zip(&old).for_each(|(path, bytes)| replace(path, bytes));
    let mut dialogue = Dialogue::open(&paths).unwrap();
    assert!(dialogue.files().eq(paths.iter().map(PathBuf::as_path)));
    let kept = dialogue.clone();
    assert!(dialogue.refresh().unwrap().is_empty());
    assert_eq!(text(&kept, "line", "en-us"), "Nay.");
    // Only the base is new, so the patch does not match it.
    replace(&paths[0], &new[0]);
    let error = dialogue.refresh().unwrap_err();
    assert_eq!((error.path(), text(&dialogue, "line", "en-us").as_str()), (paths[1].as_path(), "Nay."));
    assert!(error.to_string().contains("bank error 37") && error.to_string().contains("pack it again"), "{error}");
    replace(&paths[1], &new[1]);
    assert_eq!(dialogue.refresh().unwrap().files().count(), 2);
    assert!(dialogue.refresh().unwrap().is_empty());
    assert_eq!([&dialogue, &kept].map(|version| text(version, "line", "en-us")), ["No.", "Nay."]);
    fs::remove_file(&paths[1]).unwrap();
    assert!(dialogue.refresh().is_err() && dialogue.refresh().is_err());
    assert_eq!(text(&dialogue, "line", "en-us"), "No.");
}

#[test]
fn files_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [base, patch] = stack("Aye.", "Nay.");
    let named = |name: &str, bytes: &[u8]| Source::bytes(name, bytes.to_vec());
    let refusal = |sources: Vec<Source>| {
        let error = Dialogue::open(sources).unwrap_err();
        (error.path().display().to_string(), error.bank_error().unwrap().kind())
    };
    let german = fs::read("../../fixtures/banks/v1/split.de-de.lipztexts").unwrap();
    let cases = [
        (vec![named("patch", &patch), named("base", &base)], "patch", ErrorKind::OtherBase),
        (vec![named("base", &base), named("again", &base)], "again", ErrorKind::NotALayer),
        (vec![named("base", &base), named("german", &german)], "german", ErrorKind::OtherClips),
        (vec![named("german", &german)], "german", ErrorKind::TextsOnly),
        (vec![named("base", &base), named("cut", &patch[..patch.len() - 1])], "cut", ErrorKind::WrongLength),
    ];
    for (sources, name, kind) in cases {
        assert_eq!(refusal(sources), (name.to_owned(), kind));
    }
    assert!(Dialogue::open([folder.path().join("nowhere")]).unwrap_err().io_error().is_some());
}

/// A game adds and removes the texts of a language at run time.
#[test]
fn files_are_added_and_removed() {
    let [base, patch] = stack("Aye.", "Nay.");
    let mut dialogue = Dialogue::open([Source::bytes("base", base)]).unwrap();
    let first = dialogue.locale("en-us").unwrap();
    assert!(dialogue.add(Source::bytes("patch", patch.clone())).unwrap().files().eq([Path::new("patch")]));
    assert_eq!(text(&dialogue, "line", "en-us"), "Nay.");
    assert_eq!(dialogue.locale_tag(first), "", "another version");
    assert!(dialogue.add(Source::bytes("other", stack("Other.", "No.")[1].clone())).is_err());
    assert!(dialogue.remove("base").is_err(), "the patch is over it");
    assert_eq!(text(&dialogue, "line", "en-us"), "Nay.");
    assert!(dialogue.remove("patch").unwrap().files().eq([Path::new("patch")]));
    assert_eq!((text(&dialogue, "line", "en-us").as_str(), dialogue.locale_tag(first)), ("Aye.", "en-us"));
    assert!(dialogue.remove("patch").unwrap().is_empty());
    let again = Source::bytes("base", stack("Aye.", "Nay.")[0].clone());
    assert_eq!(
        dialogue.add(again).unwrap_err().bank_error().unwrap().kind(),
        ErrorKind::NotALayer,
        "the same once more"
    );
    assert_eq!(text(&dialogue, "line", "en-us"), "Aye.");
}

#[test]
fn a_base_that_stays_is_not_verified_again() {
    let [base, patch] = stack("Aye.", "Nay.");
    let mut dialogue = Dialogue::open([Source::bytes("base", base)]).unwrap();
    let before = dialogue.clone();
    dialogue.add(Source::bytes("patch", patch)).unwrap();
    let base_of = |dialogue: &Dialogue| std::ptr::from_ref(dialogue.view().file(0).unwrap()).cast::<()>();
    assert_eq!(base_of(&dialogue), base_of(&before), "the same opened file");
}

/// Like `rsync --times`: the index has an old time, and its banks arrive later.
#[test]
fn the_banks_of_a_new_set_may_come_after_its_index() {
    let [old, new] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (path, next) = (link(old.path(), 3, "Aye."), link(new.path(), 2, "Nay."));
    let age = |path: &Path| {
        let file = fs::File::options().write(true).open(path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(60)).unwrap();
    };
    age(&path);
    age(&next);
    let mut dialogue = Dialogue::open([&path]).unwrap();
    dialogue.files().for_each(age);
    assert!(dialogue.refresh().unwrap().is_empty());
    fs::rename(&next, &path).unwrap();
    for _ in 0..3 {
        assert!(dialogue.refresh().unwrap_err().io_error().is_some(), "a missing bank is refused every time");
    }
    for file in fs::read_dir(new.path()).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), old.path().join(file.file_name())).unwrap();
    }
    assert!(!dialogue.refresh().unwrap().is_empty());
    assert_eq!(texts(&dialogue), KEYS.map(|_| "Nay."));
}

/// A language is added after the bank. Its text bank is made from the next version, and matches the clips of this one.
#[test]
fn text_banks_are_followed() {
    let folder = tempfile::tempdir().unwrap();
    let [base, german, mouth] =
        ["base.lipzbank", "base.de-de.lipztexts", "mouth.lipzbank"].map(|name| folder.path().join(name));
    let packed = |texts: &str| {
        let file = format!(r#"{{ "visemes": "MA", {texts} }}"#);
        Compiler::default().compile(&[Input::from_bytes("line", file.as_bytes())]).into_bank().unwrap()
    };
    let write_german = |text: &str| {
        let whole = packed(&format!(r#""text_en-us": "Aye.", "text_de-de": "{text}""#));
        let split = SplitBank::from_bytes(&whole).unwrap();
        let (_, texts) = split.texts.iter().find(|(locale, _)| locale == "de-de").unwrap();
        replace(&german, texts);
    };
    fs::write(&base, packed(r#""text_en-us": "Aye.""#)).unwrap();
    write_german("Ja.");
    let mut dialogue = Dialogue::open([&base, &german]).unwrap();
    assert_eq!(text(&dialogue, "line", "de-de"), "Ja.");
    assert_eq!(text(&dialogue, "line", "en-us"), "Aye.");
    write_german("Jawohl.");
    assert!(dialogue.refresh().unwrap().files().eq([german.as_path()]));
    assert_eq!(text(&dialogue, "line", "de-de"), "Jawohl.");
    // A patch of the visemes alone has no texts, so the base's remain.
    let input = Input::from_bytes("line", r#"{ "visemes": "AM", "text_en-us": "Aye." }"#.as_bytes());
    fs::write(&mouth, patch(&fs::read(&base).unwrap(), &input)).unwrap();
    for sources in [[&base, &mouth, &german], [&base, &german, &mouth]] {
        let stack = Dialogue::open(sources).unwrap();
        assert_eq!(
            (text(&stack, "line", "de-de").as_str(), text(&stack, "line", "en-us").as_str()),
            ("Jawohl.", "Aye.")
        );
        assert_eq!(stack.clip_by_key("line").unwrap().frames(), b"AM");
    }
    // Texts for other clips are rejected, and the old ones remain.
    fs::copy("../../fixtures/banks/v1/split.de-de.lipztexts", &german).unwrap();
    assert_eq!(dialogue.refresh().unwrap_err().path(), german);
    assert_eq!(text(&dialogue, "line", "de-de"), "Jawohl.");
}

const KEYS: [&str; 6] = ["a", "b", "c", "d", "e", "f"];

/// Links a set with this number of banks, in which all clips have this text.
fn link(folder: &Path, shards: u16, text: &str) -> PathBuf {
    let (compiler, count) = (Compiler::default(), NonZero::new(shards).unwrap());
    let object = |shard: u16| {
        let own = KEYS.into_iter().filter(|key| shard_of(ClipId::from_key(key), count) == shard);
        let file = format!(r#"{{ "text_en-us": "{text}" }}"#);
        let own: Vec<Input> = own.map(|key| Input::from_bytes(key, file.as_bytes())).collect();
        let path = folder.join(format!("{shard}-of-{shards}.lipzobj"));
        fs::write(&path, compiler.object(&own, &Shard::new(shard, shards)).bank.unwrap()).unwrap();
        path
    };
    let objects: Vec<_> = (0..shards).map(object).collect();
    let index = folder.join("d.lipzset");
    let linked = compiler.link_to_set(&Link::open(&objects).unwrap(), &index);
    assert!(linked.files.is_some(), "{:?}", linked.reports);
    index
}

fn texts(dialogue: &Dialogue) -> [String; KEYS.len()] {
    KEYS.map(|key| text(dialogue, key, "en-us"))
}

#[test]
#[allow(unsafe_code, reason = "no process changes the banks")]
fn a_set_is_read_or_mapped_and_outlives_its_successor() {
    let folder = tempfile::tempdir().unwrap();
    let path = link(folder.path(), 3, "Aye.");
    let mut read = Dialogue::open([&path]).unwrap();
    // SAFETY: no process writes to the banks, because those of a new set have other names.
    let mapped = unsafe { Dialogue::open_mapped([&path]) }.unwrap();
    assert_eq!((read.files().count(), read.clip_count()), (4, KEYS.len()));
    let old = read.clone();
    link(folder.path(), 2, "Nay.");
    for set in [&old, &mapped] {
        assert_eq!(texts(set), KEYS.map(|_| "Aye."));
        set.open_all().unwrap();
    }
    assert!(!read.refresh().unwrap().is_empty() && read.refresh().unwrap().is_empty());
    assert_eq!((texts(&read), read.files().count()), (KEYS.map(|_| "Nay.".to_owned()), 3));
    // The same from an archive.
    let bytes = |path: &Path| Source::bytes(path.file_name().unwrap(), fs::read(path).unwrap());
    let archive: Vec<Source> = read.files().map(bytes).collect();
    assert_eq!(texts(&Dialogue::open(archive.clone()).unwrap()), KEYS.map(|_| "Nay."));
    assert!(Dialogue::open(archive[..2].to_vec()).unwrap_err().io_error().is_some(), "a bank is missing");
}

#[test]
fn the_bank_of_a_set_is_verified_before_its_first_answer() {
    let folder = tempfile::tempdir().unwrap();
    let path = link(folder.path(), 3, "Aye.");
    let banks: Vec<PathBuf> = Dialogue::open([&path]).unwrap().files().skip(1).map(Path::to_owned).collect();
    let whole: Vec<Vec<u8>> = banks.iter().map(|bank| fs::read(bank).unwrap()).collect();
    let mut damaged = whole[1].clone();
    *damaged.last_mut().unwrap() ^= 1;
    for (bytes, kind) in [(&damaged, ErrorKind::Checksum), (&whole[2], ErrorKind::OtherBank)] {
        fs::write(&banks[1], bytes).unwrap();
        let dialogue = Dialogue::open([&path]).unwrap();
        let missing = KEYS.iter().filter(|key| dialogue.clip_by_key(key).is_none()).count();
        assert!(missing > 0 && missing < KEYS.len());
        let failures: Vec<_> = dialogue.failures().collect();
        assert_eq!((failures.len(), failures[0].path()), (1, banks[1].as_path()));
        assert_eq!(failures[0].bank_error().unwrap().kind(), kind);
        assert_eq!(dialogue.open_all().unwrap_err().bank_error().unwrap().kind(), kind);
    }
    fs::remove_file(&banks[1]).unwrap();
    let error = Dialogue::open([&path]).unwrap_err();
    assert!(error.io_error().is_some() && error.path() == banks[1], "{error}");
    let error = Dialogue::open([&banks[0], &path]).unwrap_err();
    assert_eq!((error.path(), error.bank_error().unwrap().kind()), (path.as_path(), ErrorKind::NotALayer));
}
