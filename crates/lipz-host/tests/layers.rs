//! A stack follows its files, and is never a mixture of versions that do not belong together.
#![allow(clippy::unwrap_used, clippy::incompatible_msrv)]

use lipz_compiler::{Compiler, Input, Over, SplitBank, Stack};
use lipz_host::{LiveLayers, OwnedLayers};
use std::fs;
use std::path::PathBuf;

/// A base with this text, and a patch that replaces it.
fn stack(text: &str, patched: &str) -> [Vec<u8>; 2] {
    let input = |text: &str| Input::from_bytes("line", format!(r#"{{ "text_en-us": "{text}" }}"#));
    let base = Compiler::default().compile(&[input(text)]).into_bank().unwrap();
    let patch = patch(&base, input(patched));
    [base, patch]
}

/// The patch that makes this of the clip of a base.
fn patch(base: &[u8], input: Input) -> Vec<u8> {
    let over = Over::new(Stack::open([("base", base)]).unwrap());
    Compiler::default().compile_over(&[input], &over).into_bank().unwrap()
}

fn text(layers: &OwnedLayers) -> String {
    let layers = layers.layers();
    let english = layers.locale("en-us").unwrap();
    layers.clip_by_key("line").unwrap().text(0, &english).unwrap().as_str().to_owned()
}

#[test]
fn a_stack_follows_its_files_once_they_fit() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["base", "patch"].map(|name| folder.path().join(name));
    let write = |path: &PathBuf, bytes: &[u8]| {
        let new = path.with_extension("new");
        fs::write(&new, bytes).unwrap();
        fs::rename(&new, path).unwrap();
    };
    let [old, new] = [stack("Aye.", "Nay."), stack("Yes.", "No.")];
    paths.iter().zip(&old).for_each(|(path, bytes)| write(path, bytes));
    let live = LiveLayers::open(&paths).unwrap();
    assert!(live.paths().eq(paths.iter().map(PathBuf::as_path)));
    let kept = live.current();
    assert_eq!((text(&kept).as_str(), live.refresh().unwrap()), ("Nay.", false));
    // Only the base is new: the patch does not fit it.
    write(&paths[0], &new[0]);
    let error = live.refresh().unwrap_err();
    assert_eq!((error.path(), text(&live.current()).as_str()), (paths[1].as_path(), "Nay."));
    assert!(error.to_string().contains("bank error 37"), "{error}");
    write(&paths[1], &new[1]);
    assert!(live.refresh().unwrap() && !live.refresh().unwrap());
    assert_eq!((text(&live.current()).as_str(), text(&kept).as_str()), ("No.", "Nay."));
    fs::remove_file(&paths[1]).unwrap();
    assert!(live.refresh().is_err() && live.refresh().is_err());
    assert_eq!(text(&live.current()), "No.");
}

#[test]
fn files_that_make_no_stack_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let none: [PathBuf; 0] = [];
    assert!(OwnedLayers::open(none).is_err());
    let missing = OwnedLayers::open([folder.path().join("nowhere")]).unwrap_err();
    assert!(matches!(missing.error(), lipz_host::OpenError::File(_)));
    let [_, patch] = stack("Aye.", "Nay.");
    let path = folder.path().join("patch");
    fs::write(&path, &patch).unwrap();
    assert_eq!(OwnedLayers::open([&path]).unwrap_err().path(), path);
    fs::write(&path, &patch[..patch.len() - 1]).unwrap();
    assert!(OwnedLayers::open([&path]).is_err());
}

/// A language that came after the bank: its text bank is made from the next version, and fits the clips of this one.
#[test]
fn text_banks_are_followed_beside_the_stack() {
    let folder = tempfile::tempdir().unwrap();
    let [base, german] = ["base.lipzbank", "base.de-de.lipztexts"].map(|name| folder.path().join(name));
    let packed = |texts: &str| {
        let file = format!(r#"{{ "visemes": "MA", {texts} }}"#);
        Compiler::default().compile(&[Input::from_bytes("line", file)]).into_bank().unwrap()
    };
    let write_german = |text: &str| {
        let whole = packed(&format!(r#""text_en-us": "Aye.", "text_de-de": "{text}""#));
        let split = SplitBank::from_bytes(&whole).unwrap();
        let (_, texts) = split.texts.iter().find(|(locale, _)| locale == "de-de").unwrap();
        let new = german.with_extension("new");
        fs::write(&new, texts).unwrap();
        fs::rename(&new, &german).unwrap();
    };
    fs::write(&base, packed(r#""text_en-us": "Aye.""#)).unwrap();
    write_german("Ja.");
    let live = LiveLayers::open_with_texts([&base], [&german]).unwrap();
    let text = || {
        let current = live.current();
        let german = current.locale("de-de").unwrap();
        current.layers().clip_by_key("line").unwrap().text(0, &german).unwrap().as_str().to_owned()
    };
    assert_eq!((text().as_str(), live.refresh().unwrap()), ("Ja.", false));
    write_german("Jawohl.");
    assert!(live.refresh().unwrap() && !live.refresh().unwrap());
    assert_eq!(text(), "Jawohl.");
    // A patch of the mouth alone has the clips of the base, and no texts: theirs are still those of the base.
    let mouth = folder.path().join("mouth.lipzbank");
    let input = Input::from_bytes("line", r#"{ "visemes": "AM", "text_en-us": "Aye." }"#);
    fs::write(&mouth, patch(&fs::read(&base).unwrap(), input)).unwrap();
    let stack = LiveLayers::open_with_texts([&base, &mouth], [&german]).unwrap();
    let current = stack.current();
    let clip = current.layers().clip_by_key("line").unwrap();
    assert_eq!(clip.text(0, &current.locale("de-de").unwrap()).unwrap().as_str(), "Jawohl.");
    assert!(!stack.refresh().unwrap());
    // Those of other clips are refused, and the old ones stay.
    fs::copy("../../fixtures/banks/v1/split.de-de.lipztexts", &german).unwrap();
    assert_eq!(live.refresh().unwrap_err().path(), german);
    assert_eq!(text(), "Jawohl.");
}
