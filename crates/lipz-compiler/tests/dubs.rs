//! Dubs: the answers of a bank match its sources in each voice, also from a cache, and unpacking restores the sources.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use lipz_bank::{Bank, VoiceSource};
use lipz_compiler::{Compiler, Documents, Input, Options, SplitBank, Voices, discover};
use lipz_diagnostics::{Code, Severity};
use lipz_testkit::dialogue;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fs;

/// The voices with the patterns of their keys, with the original's first.
const VOICES: [(&str, &str); 4] =
    [("en-us", "{key}"), ("de-at", "at/{key}.ogg"), ("de-de", "de/{key}"), ("fr-fr", "{key}_fr")];
const LOCALES: [&str; 3] = ["de-de", "en-us", "fr-fr"];
const LINES: [&str; 3] = ["act1/mayor", "hello", "yes"];
/// Few texts, so that dubs and originals often have equal ones.
const TEXTS: [&str; 4] = ["", "Aye", " {loud} Aye ", "Mayor!"];

/// A clip: its text in each locale, by segment, and its frames.
#[derive(Clone, Debug)]
struct Source {
    texts: BTreeMap<&'static str, Vec<&'static str>>,
    codes: String,
}

impl Source {
    fn file(&self, segments: usize) -> String {
        let codes = vec![self.codes.as_str(); segments].join("|");
        let texts =
            self.texts.iter().map(|(tag, texts)| format!(",\n  \"text_{tag}\": \"{}\"", texts[..segments].join("|")));
        format!(
            "{{\n  \"fps\": 24,\n  \"viseme_type\": \"blair\",\n  \"visemes\": \"{codes}\"{}\n}}\n",
            texts.collect::<String>()
        )
    }
}

/// The versions of a line, and the number of segments of each.
#[derive(Clone, Debug)]
struct Line {
    segments: usize,
    /// In the order of [`VOICES`].
    versions: [Option<Source>; 4],
}

fn source() -> impl Strategy<Value = Source> {
    let texts = proptest::collection::btree_map(
        proptest::sample::select(&LOCALES[..]),
        proptest::collection::vec(proptest::sample::select(&TEXTS[..]), 3),
        0..4,
    );
    (texts, "[MAEO]{1,4}").prop_map(|(texts, codes)| Source { texts, codes })
}

fn project() -> impl Strategy<Value = Vec<Line>> {
    let versions = [(); 4].map(|()| proptest::option::weighted(0.7, source()));
    let line = (1..=3_usize, versions).prop_map(|(segments, versions)| Line { segments, versions });
    proptest::collection::vec(line, LINES.len())
}

fn key(line: &str, voice: usize) -> String {
    VOICES[voice].1.trim_end_matches(".ogg").replace("{key}", line)
}

/// Returns the Lipz files of a project by key.
fn files(project: &[Line]) -> BTreeMap<String, String> {
    let of_line = |(line, name): (&Line, &&str)| {
        let versions = line.versions.clone().into_iter().enumerate();
        let file = |(voice, source): (usize, Option<Source>)| Some((key(name, voice), source?.file(line.segments)));
        versions.filter_map(file).collect::<Vec<_>>()
    };
    project.iter().zip(&LINES).flat_map(of_line).collect()
}

fn options() -> Options {
    let voices =
        VOICES.iter().fold(Voices::new("en-us").unwrap(), |voices, (tag, pattern)| voices.dub(tag, *pattern).unwrap());
    Options::new().default_locale("en-us").unwrap().voices(voices)
}

fn inputs(project: &[Line]) -> Vec<Input> {
    files(project).into_iter().map(|(key, file)| Input::from_bytes(key, file)).collect()
}

/// Returns the text that a segment of a clip shows in a locale, and whether it belongs to another locale.
fn shown(own: &Source, original: Option<&Source>, tag: &str, segment: usize) -> Option<(String, bool)> {
    let text = |tag: &str| own.texts.get(tag).or_else(|| original?.texts.get(tag));
    let display = |texts: &Vec<&str>| texts[segment].replace("{loud}", "").trim().to_owned();
    let own = text(tag).map(|texts| (display(texts), false));
    own.or_else(|| Some((display(text("en-us")?), true)))
}

/// Returns the voice that is played for a line in a voice without a dub of it.
fn instead(line: &Line, voice: usize) -> usize {
    let near = [0, 2, 1, 0][voice];
    if line.versions[near].is_some() { near } else { 0 }
}

fn compare(project: &[Line], bytes: &[u8]) {
    let bank = Bank::open(bytes).unwrap().verify().unwrap();
    let is_dubbed = |line: &Line| line.versions[0].is_some() && line.versions[1..].iter().any(Option::is_some);
    let has_voices = project.iter().any(is_dubbed);
    assert_eq!(bank.sections().any(|(tag, _)| tag == *b"VOIC"), has_voices, "an empty section is omitted");
    assert_eq!(bank.voices().count(), if has_voices { 4 } else { 0 });
    for (line, name) in project.iter().zip(LINES) {
        for (number, source) in line.versions.iter().enumerate() {
            let Some(source) = source else { continue };
            let clip = bank.clip_by_key(&key(name, number)).unwrap();
            let original = line.versions[0].as_ref().filter(|_| number > 0);
            assert_eq!(clip.original().map(|clip| clip.key()), original.map(|_| name));
            for (tag, segment) in LOCALES.iter().flat_map(|tag| (0..line.segments).map(move |segment| (tag, segment))) {
                let Some(locale) = bank.locale(tag) else { continue };
                let text = clip.segments().nth(segment).unwrap().text(locale);
                let text = text.map(|text| (text.as_str().to_owned(), text.is_fallback()));
                assert_eq!(text, shown(source, original, tag, segment), "{} in {tag}", clip.key());
            }
            for (asked, (tag, _)) in VOICES.iter().enumerate() {
                let Some(voice) = bank.voice(tag) else { continue };
                assert_eq!((voice.is_original(), bank.voice_tag(voice)), (asked == 0, *tag));
                let voiced = clip.in_voice(voice);
                let (expected, spoken) = match &line.versions {
                    [None, ..] => (number, VoiceSource::Original), // nothing leads from one to the other
                    _ if asked == 0 => (0, VoiceSource::Original),
                    versions if versions[asked].is_some() => (asked, VoiceSource::Dub),
                    _ => match instead(line, asked) {
                        0 => (0, VoiceSource::Original),
                        other => (other, VoiceSource::OtherDub),
                    },
                };
                assert_eq!((voiced.clip.key(), voiced.spoken), (key(name, expected).as_str(), spoken), "in {tag}");
                let of_clip = if line.versions[0].is_some() { VOICES[number].0 } else { "en-us" };
                assert_eq!(clip.voice().map(|voice| bank.voice_tag(voice)), Some(of_clip));
            }
        }
    }
}

/// Returns the files of a bank by key.
fn unpacked(bytes: &[u8]) -> BTreeMap<String, String> {
    dialogue!(bank = bytes);
    let documents = Documents::from_dialogue(&bank).unwrap();
    let file = |(key, document): (&str, lipz_file::Document<'_>)| (key.to_owned(), lipz_file::write(&document));
    documents.iter().map(|document| file(document.unwrap())).collect()
}

/// Returns files in the layout of [`lipz_file::write`].
fn written(files: BTreeMap<String, String>) -> BTreeMap<String, String> {
    let again = |file: String| lipz_file::write(&lipz_file::parse(file.as_bytes()).document.unwrap());
    files.into_iter().map(|(key, file)| (key, again(file))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_bank_answers_as_its_sources(project in project()) {
        let compiled = Compiler::new(options()).compile(&inputs(&project));
        prop_assert_eq!(compiled.count(Severity::Error), 0);
        let bytes = compiled.bank.unwrap();
        compare(&project, &bytes);
        prop_assert_eq!(unpacked(&bytes), written(files(&project)));
        let stripped = Compiler::new(options().strip(true)).compile(&inputs(&project)).into_bank().unwrap();
        compare(&project, &stripped);
        let base = SplitBank::from_bytes(&bytes).unwrap().base;
        let base = Bank::open(&base).unwrap().verify().unwrap();
        prop_assert_eq!(base.voices().count(), Bank::open(&bytes).unwrap().voices().count());
    }

    #[test]
    fn packing_again_is_packing_afresh(before in project(), after in project(), strip in any::<bool>()) {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let compiler = Compiler::new(options().strip(strip));
        // Half of the files stay unchanged.
        let mixed: Vec<Line> = before.iter().zip(&after).map(|(before, after)| {
            let versions = [0, 1, 2, 3].map(|at: usize| {
                if at.is_multiple_of(2) { before.versions[at].clone() } else { after.versions[at].clone() }
            });
            Line { versions, ..before.clone() }
        }).collect();
        for project in [&before, &mixed, &mixed] {
            let _ = fs::remove_dir_all(path("files"));
            for (key, file) in files(project) {
                let file_path = path(&format!("files/{key}.lipz"));
                fs::create_dir_all(file_path.parent().unwrap()).unwrap();
                fs::write(file_path, file).unwrap();
            }
            fs::create_dir_all(path("files")).unwrap();
            let inputs = discover(&[path("files")], None).unwrap();
            let cached = compiler.pack_cached(&inputs, &path("bank"), &path("cache"));
            let cached = cached.map(|file| fs::read(file.path).unwrap());
            let fresh = compiler.compile(&inputs);
            prop_assert_eq!(&cached.bank, &fresh.bank);
            let texts = |reports: &[lipz_diagnostics::Report]| reports.iter().map(ToString::to_string).collect::<Vec<_>>();
            prop_assert_eq!(texts(&cached.reports), texts(&fresh.reports), "reported in every run");
        }
    }
}

/// Returns the codes of the diagnostics of two files.
fn codes(original: &str, dub: (&str, &str)) -> Vec<Code> {
    let inputs = [Input::from_bytes("a", original), Input::from_bytes(dub.0, dub.1)];
    let reports = Compiler::new(options()).check(&inputs).reports;
    reports.iter().flat_map(|report| &report.diagnostics).map(|diagnostic| diagnostic.code).collect()
}

#[test]
fn what_does_not_belong_together_is_told() {
    let two = r#"{ "visemes": "MA|EO", "viseme_type": "blair", "text_de-de": "Herr|Mayor!" }"#;
    assert_eq!(codes(two, ("de/a", r#"{ "visemes": "MAM|EO-", "viseme_type": "blair" }"#)), []);
    assert_eq!(codes(two, ("de/a", r#"{ "visemes": "MAM", "viseme_type": "blair" }"#)), [Code::DubSegments]);
    assert_eq!(codes(two, ("de/b", r#"{ "visemes": "MAM|EO-", "viseme_type": "blair" }"#)), [Code::DubWithoutOriginal]);
    let says = |text: &str| format!(r#"{{ "visemes": "MAM|EO-", "viseme_type": "blair", "text_de-de": "{text}" }}"#);
    assert_eq!(codes(two, ("a_fr", &says(" Herr |{loud}Mayor!"))), [], "display texts are compared");
    assert_eq!(codes(two, ("a_fr", &says("Herr|Meier!"))), [Code::DubText]);
    assert_eq!(codes(two, ("a_fr", &says("HerrM|ayor!"))), [Code::DubText], "different segments are different texts");
}

#[test]
fn a_voice_of_which_no_text_is_is_told() {
    let file = r#"{ "visemes": "MA", "viseme_type": "blair", "text_en-us": "Ma", "text_de-de": "Ma" }"#;
    let inputs =
        [Input::from_bytes("a", file), Input::from_bytes("at/a", r#"{ "visemes": "MA", "viseme_type": "blair" }"#)];
    let compiled = Compiler::new(options()).compile(&inputs);
    let told: Vec<String> = compiled.reports.iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("are spoken in `de-at`") && told[0].contains("did you mean `de-de`?"), "{told:?}");
    assert!(told[0].contains("are spoken in `fr-fr`"), "{told:?}");
}
