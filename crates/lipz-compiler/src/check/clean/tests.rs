//! Clean files become the same clips as with the full parser and the check. All other files are refused.

use super::CleanFiles;
use crate::check::{self, ClipSpeech};
use crate::clip::{ClipData, Locales, source_record};
use crate::project::Options;
use crate::project::options::{EmotionCurves, GestureKeys, TextLimits};
use lipz_bank::{Fps, VisemeType};
use lipz_diagnostics::{Code, Diagnostic};
use proptest::prelude::*;
use std::path::Path;

/// Describes all data of a clip, texts with their tags.
fn shape(clip: &ClipData, locales: &Locales) -> String {
    let texts = clip.texts.iter().map(|text| (locales.tag(text.locale), clip.whole_run(text), text.hash));
    let texts: Vec<_> = texts.collect();
    let events: Vec<&str> = clip.events.iter().collect();
    let curves: Vec<_> = clip.curves.iter().collect();
    let flags = (clip.has_visemes, clip.has_events, clip.has_joined);
    let head = (clip.fps, clip.viseme_type, flags, &clip.frames, &clip.starts);
    format!("{head:?} {texts:?} {events:?} {curves:?} {:?}", clip.source)
}

/// Describes the clip that the full parser and the check produce from a file.
///
/// # Errors
/// The codes of the diagnostics.
fn fully(bytes: &[u8], options: &Options, locales: &mut Locales) -> Result<String, Vec<Code>> {
    let codes = |diagnostics: &[Diagnostic]| diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
    let parsed = lipz_file::parse(bytes);
    let Some(document) = parsed.document else { return Err(codes(&parsed.diagnostics)) };
    let mut diagnostics = parsed.diagnostics;
    let mut clip = ClipData::default();
    check::check(&document, options, ClipSpeech::default(), locales, &mut clip, &mut diagnostics);
    if let Some(packed) = &options.locales {
        clip.keep_texts(packed, locales, options);
    }
    if !options.strip {
        source_record::encode(&document, options, locales, &mut clip);
    }
    if diagnostics.is_empty() { Ok(shape(&clip, locales)) } else { Err(codes(&diagnostics)) }
}

/// Reads files in both ways, one after the other. Unless the clean pass refuses a file, both clips must be equal.
/// Returns for each file whether the clean pass accepted it.
fn are_clean<const N: usize>(files: [&[u8]; N], options: &Options) -> [bool; N] {
    let mut locales = Locales::default();
    for tag in ["en-us", "de-de", "fr-fr"] {
        locales.number(tag, true);
    }
    let (mut clean_files, mut clip) = (CleanFiles::new(options), ClipData::default());
    files.map(|bytes| {
        let is_clean = clean_files.clip(bytes, &locales, &mut clip);
        let full = fully(bytes, options, &mut locales);
        if is_clean {
            let file = String::from_utf8_lossy(bytes);
            match full {
                Ok(full) => assert_eq!(full, shape(&clip, &locales), "{file}"),
                Err(codes) => panic!(
                    "a check reports {codes:?}, and check/clean took the file. The trigger of the check must name such \
                     files: {file}"
                ),
            }
        }
        is_clean
    })
}

/// Whether a file is clean. It is read twice, the second time with the remembered strings.
fn is_clean(bytes: &[u8], options: &Options) -> bool {
    let [is_clean, is_again] = are_clean([bytes; 2], options);
    assert!(is_again || !is_clean, "{}", String::from_utf8_lossy(bytes));
    is_clean
}

/// Options of every kind that affects whether a file is clean.
fn all_options() -> Vec<Options> {
    let usual = Options::new();
    let mut of_values = Options::new();
    of_values.emotions.curves = EmotionCurves::Values;
    let mut with_gestures = Options::new().default_locale("en-us").unwrap();
    with_gestures.gestures.keys = GestureKeys::Words;
    vec![
        with_gestures,
        usual.clone().default_locale("en-us").unwrap(),
        usual.clone().strip(true),
        usual.clone().literal_braces(true),
        Options { locales: Some(["de-de", "en-us"].map(str::to_owned).into()), ..usual.clone() },
        Options {
            default_fps: Fps::new(24, 1),
            default_viseme_type: Some(VisemeType::Blair),
            viseme_type: Some(VisemeType::Blair),
            ..usual.clone()
        },
        Options { default_viseme_type: Some(VisemeType::Rms), ..usual.clone() },
        Options { text_limits: TextLimits::new().line_columns(8), ..usual.clone() },
        usual.clone().default_locale("en-us").unwrap().pseudo(true),
        of_values,
        usual,
    ]
}

#[test]
fn usual_files_are_clean() {
    let files = [
        r#"{"fps":24,"viseme_type":"blair","visemes":"MA|E-","text_en-us":"Hi| there ","text_de-de":"Na|und","events":"feels sad|"}"#,
        r#"{"events":"feels joy 3, amy feels sad + anger 2 over 1s|feels calm","fps":24,"visemes":"MAAAA|E-"}"#,
        r#"{"events":"feels joy 3","visemes":"MAAAA"}"#,
        r#"{"events":"feels joy 3"}"#,
        "{\n\t\"text_en-us\" : \"Hi, {to amy} you\",\r\n  \"fps\": 23.976 }\n",
        r#" {"visemes":"|","text_de-de":"ü|","text_en-us":"|x"} "#,
        r#"{"events":"amy sees door, feels sad|bell(3)"}"#,
        r#"{"text_en-us":"One||two","text_de-de":"Eins| |zwei"}"#,
        r#"{"text_en-us":" {a} One {b} | {c}{d}|two {e} {f}","text_de-de":"Eins| |zwei"}"#,
    ];
    for file in files {
        assert!(is_clean(file.as_bytes(), &Options::new()), "{file}");
    }
}

#[test]
fn what_stood_in_the_file_before_changes_nothing() {
    let file = "{\n  \"fps\": 24,\n  \"text_en-us\": \"A {b} c|d\",\n  \"text_de-de\": \"a|\"\n}";
    let changes = [
        ("24", " 24", true),
        ("\"A", "\"|A", false),
        ("|d", "d", false),
        ("24", "\"24\"", false),
        ("\n}", "", false),
        ("\n}", "\n} x", false),
        ("de-de", "en-us", false),
        (",\n  \"text_de-de\": \"a|\"", "", true),
        ("\"fps\": 24,\n  ", "", true),
        ("  \"text_de-de\"", "\t\"text_de-de\"", true),
        ("{b}", "{anger 2}", false),
        ("{b}", "{b}{c}", true),
        ("{b}", "}b{", false),
        ("{b}", "{b\n", false),
    ];
    for (from, to, expected) in changes {
        let changed = file.replacen(from, to, 1);
        let files = [file.as_bytes(), changed.as_bytes(), file.as_bytes(), changed.as_bytes()];
        assert_eq!(are_clean(files, &Options::new()), [true, expected, true, expected], "{changed}");
    }
}

#[test]
fn whatever_could_be_reported_is_refused() {
    let files = [
        "",
        "{}",
        "{\"fps\":24,}",
        "{\"fps\":24} x",
        "{\"fps\":24\u{1}}",
        "{\"fps\":024}",
        "{\"fps\":-24}",
        "{\"fps\":2.4e1}",
        "{\"fps\":24.}",
        "{\"fps\":0.5}",
        "{\"fps\":24,\"fps\":24}",
        "{\"fps\":\"24\"}",
        "{\"visemes\":24}",
        "{\"visemes\":\"M A\",\"viseme_type\":\"blair\"}",
        "{\"visemes\":\"MAZ\",\"viseme_type\":\"blair\"}",
        "{\"visemes\":\"--\",\"text_en-us\":\"Said\"}",
        "{\"viseme_type\":\"Blair\"}",
        "{\"text_en-us\":\"a|b\",\"visemes\":\"M\"}",
        "{\"text_en-us\":\"\"}",
        "{\"text_en-us\":\"{meta}\"}",
        "{\"text_en-us\":\"a {b\"}",
        "{\"text_en-us\":\"a {b {c}}\"}",
        "{\"text_en-us\":\"a\nb\"}",
        "{\"text_en-us\":\"a\\nb\"}",
        "{\"text_en-us\":\"{anger 2} No!\",\"fps\":24,\"visemes\":\"MA\"}",
        "{\"events\":\"feels joy 13\",\"fps\":24,\"visemes\":\"MA\"}",
        "{\"events\":\"feels joy 6 + anger 6\",\"fps\":24,\"visemes\":\"MA\"}",
        "{\"events\":\"feels neutral 3\",\"fps\":24,\"visemes\":\"MA\"}",
        "{\"events\":\"|feels joy\",\"fps\":24,\"visemes\":\"MA|\"}",
        "{\"text_en-us\":\"Hi {anger 2,2} you\"}",
        "{\"events\":\"feels hapy\"}",
        "{\"text_en-us\":\"a|b\",\"text_de-de\":\"a|\"}",
        "{\"text_it-it\":\"a\"}",
        "{\"text_en_us\":\"a\"}",
        "{\"note\":\"a\"}",
        "\u{feff}{\"fps\":24}",
    ];
    for file in files {
        assert!(!is_clean(file.as_bytes(), &Options::new().default_locale("en-us").unwrap()), "{file}");
    }
}

#[test]
fn fixtures_are_read_alike() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let inputs = crate::sources::discover(&[fixtures], None).unwrap();
    let (mut count, mut clean_count) = (0, 0);
    for input in inputs {
        let crate::sources::Content::File(path) = input.content else { continue };
        let Ok(bytes) = std::fs::read(path) else { continue };
        for options in all_options() {
            count += 1;
            clean_count += usize::from(is_clean(&bytes, &options));
        }
    }
    assert!(count > 1000 && clean_count > 100, "{clean_count} of {count}");
}

/// Strings as people write them, and sometimes a part that is not clean.
fn string() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        8 => "[a-zA-Zü ,.]{0,20}",
        1 => Just("feels sad".to_owned()),
        1 => Just("{to amy} hello".to_owned()),
        1 => Just("{anger 2} hello".to_owned()),
        1 => "[-MAEO]{0,6}",
        1 => r#"[{}\\"\t|]{1,2}"#,
    ];
    prop::collection::vec(part, 1..4).prop_map(|parts| parts.join("|"))
}

fn member() -> impl Strategy<Value = String> {
    let text = |tag: &str| {
        let tag = tag.to_owned();
        string().prop_map(move |string| format!("\"text_{tag}\": \"{string}\""))
    };
    prop_oneof![
        prop::sample::select(vec!["24", "30", "29.97", "0", "1e2", "07", "\"24\""])
            .prop_map(|fps| format!("\"fps\": {fps}")),
        prop::sample::select(vec!["blair", "rms", "toonboom", "Blair"])
            .prop_map(|name| format!("\"viseme_type\":\"{name}\"")),
        "[-MAEO|]{0,12}|[-0-9|]{0,9}| ".prop_map(|codes| format!("\"visemes\" :\t\"{codes}\"")),
        string().prop_map(|events| format!("\"events\": \"{events}\"")),
        text("en-us"),
        text("de-de"),
        text("it-it"),
    ]
}

proptest! {
    #[test]
    fn both_ways_agree(members in prop::collection::vec(member(), 0..7), blanks in "[ \n\r\t]{0,3}", change in any::<(u16, u8)>()) {
        let bytes = format!("{blanks}{{{}}}{blanks}", members.join(&format!(",{blanks}"))).into_bytes();
        for options in all_options() {
            is_clean(&bytes, &options);
        }
        let (at, byte) = change;
        let mut changed = bytes.clone();
        changed[usize::from(at) % bytes.len()] = byte;
        are_clean([&bytes, &changed, &bytes], &Options::new().default_locale("en-us").unwrap());
    }
}
