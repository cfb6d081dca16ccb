//! Lip sync of a recording and its text in one call has the same result as step by step.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_speech::{
    AlignOptions, Aligner, Fps, Language, Lexicon, LipSync, Model, ProblemKind, Pronouncer, RenderRules, RmsRules,
    Sound, SoundError, VisemeType, render, rms,
};
use std::path::{Path, PathBuf};

const TEXT: &str = "Bobby ripped | the ledger.";

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/speech").join(name)
}

fn bobby() -> Sound {
    Sound::read(std::fs::File::open(fixture("bobby.wav")).unwrap(), Some("wav")).unwrap()
}

#[test]
fn one_call_does_what_all_steps_do() {
    let line = LipSync::new(Language::ENGLISH).file(fixture("bobby.wav"), TEXT).unwrap();
    let script = Pronouncer::new(Language::ENGLISH).script(TEXT);
    let alignment = Aligner::new(Model::english(), AlignOptions::default()).align(&bobby(), &script);
    let mouth = render(&alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    assert_eq!((&line.mouth, &line.alignment, &line.script), (&mouth, &alignment, &script));
    assert_eq!(line.problems, []);
    let words: Vec<&str> = line.words().map(|(word, _)| word.text.as_str()).collect();
    assert_eq!(words, ["Bobby", "ripped", "the", "ledger"]);
    assert!(line.words().all(|(_, time)| time.confidence > 0.7 && time.start_us < time.end_us));
    assert_eq!(LipSync::new(Language::ENGLISH).sound(&bobby(), TEXT), line);
}

#[test]
fn rates_types_and_rules_are_those_that_are_set() {
    let mut rules = RenderRules::default();
    rules.lead_us = 0;
    let lip_sync = LipSync::new(Language::ENGLISH).fps(Fps::whole(30)).viseme_type(VisemeType::ToonBoom).rules(rules);
    let line = lip_sync.sound(&bobby(), TEXT);
    assert_eq!(line.mouth, render(&line.alignment, Fps::whole(30), VisemeType::ToonBoom, &rules));
    assert_ne!(line.mouth, render(&line.alignment, Fps::whole(30), VisemeType::ToonBoom, &RenderRules::default()));
    let loud = LipSync::new(Language::ENGLISH).viseme_type(VisemeType::Rms).sound(&bobby(), TEXT).mouth;
    assert_eq!(loud.frames, rms(&bobby(), Fps::whole(24), &RmsRules::default()).frames);
    assert_eq!(loud.segment_starts.len(), 2);
}

#[test]
fn pronunciations_help_and_problems_are_told() {
    let lexicon = Lexicon::parse("XQZT  B AA B IY\n");
    let line =
        LipSync::new(Language::ENGLISH).lexicon(lexicon).sound(&bobby(), "Xqzt ripped the ledger{say: L EH QQ ER}.");
    assert!(line.words().next().unwrap().1.confidence > 0.7);
    assert_eq!(line.problems.iter().map(|problem| problem.kind).collect::<Vec<_>>(), [ProblemKind::UnknownPhone]);
}

#[test]
fn without_a_text_phones_are_found_all_the_same() {
    let line = LipSync::new(Language::ENGLISH).sound(&bobby(), "{sighs}");
    assert_eq!(line.words().count(), 0);
    assert!(line.mouth.frames.contains("MM"), "{}", line.mouth.frames);
}

#[test]
fn files_that_cannot_be_read_are_errors() {
    let lip_sync = LipSync::new(Language::ENGLISH);
    assert!(matches!(lip_sync.file(fixture("nowhere.wav"), TEXT), Err(SoundError::Io(_))));
    assert!(matches!(lip_sync.file(fixture("README.md"), TEXT), Err(SoundError::OtherFormat { .. })));
}
