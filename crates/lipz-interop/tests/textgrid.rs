//! TextGrids: round trips through Praat, and segments placed by the times of words.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_file::Document;
use lipz_file::format::{Style, format};
use lipz_interop::textgrid::TierChoice;
use lipz_interop::{ExportOptions, Format, ImportOptions, MergeOptions, export, formats, import, to_utf8};
use proptest::prelude::*;

fn textgrid() -> &'static Format {
    formats::find("textgrid").unwrap()
}

fn document(file: &str) -> Document<'_> {
    lipz_file::parse(file.as_bytes()).document.unwrap()
}

fn exported(file: &str) -> (Vec<u8>, Vec<&'static str>) {
    let exported = export(textgrid(), &document(file), &ExportOptions::new());
    assert!(exported.diagnostics.is_empty(), "{:?}", exported.diagnostics);
    (exported.bytes.unwrap(), exported.left_out)
}

#[test]
fn a_clip_is_a_tier_for_each_of_its_elements() {
    let clip = r#"{ "visemes": "--MMA|EO--", "text_en-us": "{loud} \"Ma!\"|Eh?", "text_de-de": " |Was? ", "events": "|points door",
                    "viseme_type": "blair", "fps": 4, "note": 1 }"#;
    let (file, left_out) = exported(clip);
    assert_eq!(left_out, ["unknown elements"]);
    let text = String::from_utf8(file.clone()).unwrap();
    assert!(text.contains("text = \"{loud} \"\"Ma!\"\"\" \n") && text.contains("xmax = 2.25 \n"), "{text}");
    let options = ImportOptions::new().rate(lipz_file::rate::parse("4"));
    let imported = import(textgrid(), &file, &options);
    assert_eq!(imported.diagnostics, []);
    let back = format(&imported.clips.first().unwrap().document, Style::default());
    assert_eq!(back, format(&document(&clip.replace(", \"note\": 1", "")), Style::default()));
}

#[test]
fn segments_without_frames_are_told() {
    let clip = document(r#"{ "visemes": "MA||EO", "text_en-us": "a|b|c", "viseme_type": "blair", "fps": 4 }"#);
    let exported = export(textgrid(), &clip, &ExportOptions::new());
    let messages: Vec<&str> = exported.diagnostics.iter().map(|diagnostic| diagnostic.message.as_str()).collect();
    assert_eq!(messages, ["1 segment has no frames and cannot be stored in a TextGrid"]);
}

proptest! {
    #[test]
    fn clips_return(
        segments in prop::collection::vec(("[-A-G]{1,12}", "[a-zäé\"{} ]{0,8}", "[a-z]{0,4}"), 1..6),
        fps in prop::sample::select(vec!["24", "25", "29.97", "30", "12.5", "60"]),
        viseme_type in prop::sample::select(vec!["toonboom", "rms", "blair"]),
    ) {
        let code = |c: char| match (viseme_type, c) {
            ("toonboom", c) | (_, c @ '-') => c,
            ("rms", c) => char::from_digit(u32::from(c) % 10, 10).unwrap(),
            (_, c) => if matches!(c, 'A' | 'E' | 'F') { c } else { 'M' },
        };
        let joined = |part: &dyn Fn(&(String, String, String)) -> String| segments.iter().map(part).collect::<Vec<_>>().join("|");
        let visemes = joined(&|segment| segment.0.chars().map(code).collect());
        let text = lipz_file::literal(&joined(&|segment| segment.1.trim().to_owned()));
        let events = joined(&|segment| segment.2.clone());
        let clip = format!("{{ \"visemes\": \"{visemes}\", \"text_en-us\": {text}, \"events\": \"{events}\", \"viseme_type\": \"{viseme_type}\", \"fps\": {fps} }}");
        let (file, _) = exported(&clip);
        let imported = import(textgrid(), &file, &ImportOptions::new().rate(lipz_file::rate::parse(fps)));
        prop_assert!(imported.diagnostics.is_empty(), "{:?}", imported.diagnostics);
        let (before, back) = (document(&clip), &imported.clips.first().unwrap().document);
        for name in ["visemes", "text_en-us", "events", "viseme_type"] {
            prop_assert_eq!(back.string(name), before.string(name), "{}", name);
        }
    }
}

#[test]
fn words_say_where_the_segments_of_a_clip_start() {
    let file = include_bytes!("../../../fixtures/interop/textgrid/mayor.TextGrid");
    let clip = import(textgrid(), file, &ImportOptions::new()).clips.remove(0);
    let line = r#"{ "text_en-us": "Mayor, good|evening!", "text_de-de": "Herr Meister, guten|Abend!", "note": 1 }"#;
    let merged = clip.merge(&document(line), &MergeOptions::new().locale("en-us"));
    assert_eq!(merged.diagnostics, []);
    let visemes = merged.document.string("visemes").unwrap();
    assert_eq!(visemes.find('|'), Some(39), "the first frame of `evening`: {visemes}");
    assert!(merged.document.get("note").is_some());
}

#[test]
fn files_of_every_praat() {
    let file = include_str!("../../../fixtures/interop/textgrid/speakers.TextGrid");
    let utf16: Vec<u8> = format!("\u{feff}{file}").encode_utf16().flat_map(u16::to_be_bytes).collect();
    let mut diagnostics = Vec::new();
    let read = |bytes: &[u8]| import(textgrid(), bytes, &ImportOptions::new()).clips;
    assert_eq!(read(&to_utf8(&utf16, None, true, &mut diagnostics)), read(file.as_bytes()));
    assert_eq!(diagnostics, []);
    let names: Vec<_> = read(file.as_bytes()).into_iter().map(|clip| (clip.name, clip.remarks)).collect();
    let remark = |text: &str| vec![text.to_owned()];
    let noise = "labels without phones (`spn`) are shown as one shape";
    assert_eq!(
        names,
        [(Some("Mara".into()), remark("the tier `noise` is left out")), (Some("Tom".into()), remark(noise))]
    );
}

#[test]
fn phonemes_in_small_letters_are_the_same() {
    let file = include_str!("../../../fixtures/interop/textgrid/mayor.TextGrid");
    let (words, phones) = file.split_once("\"phones\"").unwrap();
    let small = format!("{words}\"Phone\"{}", phones.to_lowercase().replace("intervaltier", "IntervalTier"));
    let clip = |file: &str| import(textgrid(), file.as_bytes(), &ImportOptions::new()).clips.remove(0);
    assert_eq!((clip(&small).map, clip(&small).document), (clip(file).map, clip(file).document));
}

#[test]
fn tiers_without_shapes_are_named() {
    let file = include_str!("../../../fixtures/interop/textgrid/mayor.TextGrid").replace("\"phones\"", "\"sounds\"");
    let imported = import(textgrid(), file.as_bytes(), &ImportOptions::new());
    let codes: Vec<String> = imported.diagnostics.iter().map(|diagnostic| diagnostic.code.to_string()).collect();
    assert_eq!((codes, imported.clips.len()), (vec!["LZ1107".to_owned()], 0));
    assert_eq!(imported.diagnostics[0].notes, ["its tiers: `words`, `sounds`"]);
}

#[test]
fn tiers_are_chosen_by_name() {
    let file = include_str!("../../../fixtures/interop/textgrid/mayor.TextGrid");
    let clip = |file: &str, tiers: &[&str]| {
        let tiers: Vec<TierChoice> = tiers.iter().map(|tier| tier.parse().unwrap()).collect();
        let options = ImportOptions::new().tiers(&tiers);
        let imported = import(textgrid(), file.as_bytes(), &options);
        let found: Vec<String> = imported.diagnostics.iter().map(|diagnostic| diagnostic.message.clone()).collect();
        (imported.clips.into_iter().map(|clip| (clip.document, clip.remarks)).collect::<Vec<_>>(), found)
    };
    let expected = clip(file, &[]);
    let renamed = file.replace("\"phones\"", "\"sounds\"").replace("\"words\"", "\"spelling\"");
    assert_eq!(clip(&renamed, &["Sounds", "words=spelling"]), expected);
    // The tiers of WebMAUS are known.
    let maus = file.replace("\"phones\"", "\"MAU\"").replace("\"words\"", "\"ORT-MAU\"");
    assert_eq!(clip(&maus, &[]), expected);
    // A chosen tier replaces the one that is known by its name.
    let twice = renamed.replace("\"spelling\"", "\"phones\"");
    assert_eq!(clip(&twice, &["sounds"]).0[0].0, expected.0[0].0);
    let missing = clip(&renamed, &["sound"]);
    assert_eq!(missing, (Vec::new(), vec!["the file has no tier called `sound`".to_owned()]));
}

/// A label that is in no table turned all phones of a file into errors of a different alphabet.
#[test]
fn unknown_labels_do_not_change_the_alphabet() {
    let file = |name: &str| {
        std::fs::read(
            std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/interop/textgrid").join(name),
        )
    };
    let messages = |name: &str| {
        let found = import(textgrid(), &file(name).unwrap(), &ImportOptions::new()).diagnostics;
        found.into_iter().map(|diagnostic| diagnostic.message).collect::<Vec<_>>()
    };
    assert_eq!(messages("unknown.TextGrid"), ["`zzz` is not in the mapping table `cmu`"]);
    assert_eq!(messages("noises.TextGrid"), [] as [&str; 0]);
}
