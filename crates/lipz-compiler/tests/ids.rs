//! Generated ids: the output for keys that are hard to convert to identifiers, and that compilers accept it.
//!
//! `fixtures/ids` contains the expected files; `LIPZ_BLESS=1` writes them again. The Rust file is compiled into this
//! test. Languages without an installed compiler are skipped.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_bank::ClipId;
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::{Compiler, Input, Options};
use lipz_testkit::dialogue;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Keys with all kinds of problems for languages, and texts that could end comments.
const HARD: [(&str, &str); 22] = [
    ("hello", "Hello."),
    ("act1/mara-good-evening", "Good evening, Otto. | You are late,"),
    ("act1/mara", "*/ \\u202E not the end of the comment /*"),
    ("act1/mara/aye", "`Aye`, said <b>Mara</b> & [Otto]."),
    (
        "act1/2nd take (final)",
        "A text that is so long that nobody wants to read all of it in a comment, as long as this.",
    ),
    ("act1/take-1-12", ""),
    ("act1/take-11-2", ""),
    ("act1/act1", "Act one."),
    ("Act1/OttoAyeAye", "Aye, aye!"),
    ("Ärger/straße", "Ärger"),
    ("日本/はい、船長", "はい。"),
    ("हिन्दी/नमस्ते", "नमस्ते"),
    ("🎉/!!!", "\\n\\u0007"),
    ("type/self/match", "match"),
    ("class/new", "new"),
    ("locales/en-us", "A folder named locales."),
    ("locale/en-us", "A folder named locale."),
    ("clips/equals", "Equal."),
    ("to-string", "As a string."),
    ("ids/h", "The guard."),
    ("ok", "A constant of lipz.h."),
    ("clip/key", "Another one."),
];

/// The expected Rust file, compiled.
mod generated {
    include!("../../../fixtures/ids/ids.rs");
}

fn bank(files: &[(&str, &str)]) -> Vec<u8> {
    let json = |text: &str| {
        let german = "Hallo.".to_owned() + &"|".repeat(text.matches('|').count());
        format!(r#"{{ "text_en-us": "{text}", "text_de-de": "{german}" }}"#)
    };
    let inputs: Vec<Input> = files.iter().map(|(key, text)| Input::from_bytes(*key, json(text))).collect();
    let options = Options::new().default_locale("en-us").unwrap();
    let compiled = Compiler::new(options.clone()).compile(&inputs);
    compiled.bank.unwrap_or_else(|| panic!("{:?}", compiled.reports))
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/ids")
}

fn file(language: Language) -> PathBuf {
    fixtures().join(match language {
        Language::Rust => "ids.rs",
        Language::C => "ids.h",
        Language::CSharp => "Ids.cs",
        Language::TypeScript => "ids.ts",
        _ => "ids.json",
    })
}

#[test]
fn hard_keys_give_the_expected_files() {
    let bytes = bank(&HARD);
    dialogue!(bank = &bytes);
    for language in Language::ALL {
        let actual = generate(&bank, language, None).unwrap_or_else(|clashes| panic!("{language:?}: {clashes:?}"));
        let path = file(language);
        if std::env::var_os("LIPZ_BLESS").is_some_and(|value| value == "1") {
            fs::write(&path, actual).unwrap();
            continue;
        }
        let expected = fs::read_to_string(&path).unwrap();
        assert!(expected == actual, "{language:?} differs from {}; it is now\n{actual}", path.display());
    }
}

#[test]
fn constants_of_rust_are_the_ids_of_the_keys() {
    use generated::{act1, ids, locales, type_, ärger};
    for (constant, key) in [
        (generated::HELLO, "hello"),
        (act1::MARA_GOOD_EVENING, "act1/mara-good-evening"),
        (act1::mara::AYE, "act1/mara/aye"),
        (act1::_2ND_TAKE_FINAL, "act1/2nd take (final)"),
        (act1::OTTO_AYE_AYE, "Act1/OttoAyeAye"),
        (ärger::STRASSE, "Ärger/straße"),
        (generated::日本::はい_船長, "日本/はい、船長"),
        (generated::u1f389::U0021U0021U0021, "🎉/!!!"),
        (type_::self_::MATCH, "type/self/match"),
        (generated::locales_::EN_US, "locales/en-us"),
        (ids::H, "ids/h"),
    ] {
        assert_eq!(constant, ClipId::from_key(key), "{key}");
    }
    assert_eq!([locales::DE_DE, locales::EN_US], ["de-de", "en-us"]);
}

#[test]
fn json_has_the_id_of_every_key() {
    let json: serde_json::Value = serde_json::from_str(&fs::read_to_string(file(Language::Json)).unwrap()).unwrap();
    assert_eq!(json["clips"].as_object().unwrap().len(), HARD.len());
    for (key, _) in HARD {
        assert_eq!(json["clips"][key], ClipId::from_key(key).to_string(), "{key}");
    }
}

#[test]
fn a_prefix_replaces_that_of_the_language() {
    let bytes = bank(&HARD);
    dialogue!(bank = &bytes);
    assert!(generate(&bank, Language::C, Some("GAME_")).unwrap().contains("#define GAME_HELLO UINT64_C("));
    assert!(generate(&bank, Language::CSharp, Some("Game.Talk")).unwrap().contains("\nnamespace Game.Talk\n"));
    assert!(!Language::C.accepts_prefix("LIPZ_") && Language::CSharp.accepts_prefix("LIPZ_"));
    for prefix in ["", "1x", "a-b", "x;", "é", "a..b", ".a"] {
        assert!(Language::ALL.iter().all(|language| !language.accepts_prefix(prefix)), "{prefix:?}");
    }
}

#[test]
fn clashes_name_both_keys() {
    let clashes = |files: &[(&str, &str)], language| {
        let bytes = bank(files);
        dialogue!(bank = &bytes);
        let clashes = generate(&bank, language, None).err().unwrap_or_default();
        clashes.into_iter().map(|found| found.message).collect::<Vec<_>>()
    };
    let files = [("a/mara-aye", ""), ("a/mara_aye", ""), ("a/MaraAye", ""), ("a-mara/aye", "")];
    let headlines = clashes(&files, Language::Rust);
    assert_eq!(headlines.len(), 2, "{headlines:?}");
    assert_eq!(headlines[1], "the keys `a/MaraAye` and `a/mara_aye` have the same identifier `MARA_AYE` in Rust");
    assert_eq!(clashes(&files, Language::C).len(), 3, "C has no folders");
    assert_eq!(clashes(&files, Language::Json), [""; 0]);
}

/// Runs a tool with `arguments`; prints a message and returns `None` if it is not installed.
fn tool(name: &str, arguments: &[&str]) -> Option<Output> {
    let output = Command::new(name).args(arguments).current_dir(fixtures()).output();
    if output.is_err() {
        eprintln!("skipped: `{name}` is not on this machine");
    }
    output.ok()
}

fn assert_success(output: Option<Output>) {
    if let Some(output) = output {
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// A program that fails to compile or run if the header is wrong.
const C_PROGRAM: &str = r#"
#include "ids.h"
#include "ids.h"
#include "lipz.h"
#include <string.h>
#if LIPZ_ID_HELLO == LIPZ_ID_TO_STRING || LIPZ_ID_OK == LIPZ_ID_CLIP_KEY || LIPZ_OK != 0
#error "ids differ"
#endif
int main(void) {
    const uint64_t id = LIPZ_ID_ACT1_MARA_GOOD_EVENING;
    switch (id) {
        case LIPZ_ID_ARGER_STRASSE: return 1;
        case LIPZ_ID_ACT1_MARA_GOOD_EVENING: return id != EXPECTED || strcmp(LIPZ_ID_LOCALE_EN_US, "en-us");
        default: return 1;
    }
}
"#;

#[test]
fn c_and_cpp_compile_the_header() {
    let folder = tempfile::tempdir().unwrap();
    let (include, program) = (format!("-I{}", fixtures().display()), folder.path().join("program"));
    let header = format!("-I{}", Path::new(env!("CARGO_MANIFEST_DIR")).join("../lipz-capi/include").display());
    let expected = format!("-DEXPECTED=UINT64_C(0x{})", ClipId::from_key("act1/mara-good-evening"));
    for (compiler, standard, name) in [("cc", "-std=c99", "program.c"), ("c++", "-std=c++11", "program.cpp")] {
        let source = folder.path().join(name);
        fs::write(&source, C_PROGRAM).unwrap();
        let (source, program) = (source.to_str().unwrap(), program.to_str().unwrap());
        let warnings = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];
        let arguments = [&[standard, &include, &header, &expected, source, "-o", program][..], &warnings].concat();
        let Some(output) = tool(compiler, &arguments) else { continue };
        assert_success(Some(output));
        assert_success(tool(program, &[]));
    }
}

#[test]
fn node_reads_the_typescript() {
    let folder = tempfile::tempdir().unwrap();
    // JavaScript is TypeScript without the types.
    let typescript = fs::read_to_string(file(Language::TypeScript)).unwrap();
    let (constants, types) = typescript.split_once("/** The keys of the clips. */").unwrap();
    assert!(types.contains("| \"act1/mara-good-evening\""), "{types}");
    fs::write(folder.path().join("ids.mjs"), constants.replace(" as const", "")).unwrap();
    let program = format!(
        "import {{ act1, class_, hello, locales, locales_ }} from './ids.mjs';
         if (act1.maraGoodEvening !== 0x{}n || hello !== 0x{}n) throw new Error('ids');
         if (act1.mara_ === undefined || act1.mara.aye === undefined) throw new Error('a folder and a clip');
         if (class_.new === undefined || locales_.enUs === undefined) throw new Error('reserved words');
         if (locales.enUs !== 'en-us') throw new Error('locales');",
        ClipId::from_key("act1/mara-good-evening"),
        ClipId::from_key("hello")
    );
    let program_path = folder.path().join("program.mjs");
    fs::write(&program_path, program).unwrap();
    assert_success(tool("node", &[program_path.to_str().unwrap()]));
}
