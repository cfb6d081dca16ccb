//! Tests that a patched bank equals the one made from all clips, or does not exist.

use super::patched;
use crate::project::Options;
use crate::run::Compiler;
use crate::run::cache::old_bank::OldBank;
use crate::run::cache::recall::{Recall, checksum_of};
use crate::run::compile::CompileRun;
use crate::sources::Input;
use lipz_layout::CHECKED_FROM;
use proptest::prelude::*;

/// The parts of a clip, with a text for each of three locales.
type Parts = (String, [Option<String>; 3], String);

const TAGS: [&str; 3] = ["en-us", "de-de", "fr-fr"];

fn input(number: usize, (visemes, texts, events): &Parts) -> Input {
    let mut members = vec![format!(r#""fps":24,"viseme_type":"blair","visemes":"{visemes}""#)];
    let named = TAGS.iter().zip(texts).filter_map(|(tag, text)| Some((tag, text.as_ref()?)));
    members.extend(named.map(|(tag, text)| format!(r#""text_{tag}":"{text}""#)));
    if !events.is_empty() {
        members.push(format!(r#""events":"{events}""#));
    }
    Input::from_bytes(format!("clip{number}"), format!("{{{}}}", members.join(",")))
}

fn options(is_stripped: bool) -> Options {
    Options::new().default_locale("en-us").unwrap().strip(is_stripped).threads(1)
}

/// Returns the bank of `before` patched with the changed clips of `after`, if possible; and the bank of `after`.
fn both(before: &[Parts], after: &[Parts], options: &Options) -> Option<(Option<Vec<u8>>, Vec<u8>)> {
    let inputs =
        |clips: &[Parts]| -> Vec<Input> { clips.iter().enumerate().map(|(at, clip)| input(at, clip)).collect() };
    let bank = |clips| Compiler::new(options.clone()).compile(&inputs(clips)).bank;
    let old = OldBank::Whole(bank(before)?.into());
    let all = inputs(after).into_iter().zip(before.iter().zip(after));
    let changed: Vec<Input> = all.filter(|(_, (before, after))| before != after).map(|(input, _)| input).collect();
    let run = CompileRun::read(&changed, options, None, &|_| {});
    let recall = Recall::new(&old)?;
    // Its contents must not matter.
    let room = vec![0xA5; old.tables().len() + 3];
    Some((patched(&recall, &run.changed_clips(), room), bank(after)?))
}

fn parts(visemes: &str, texts: [&str; 3], events: &str) -> Parts {
    let texts = texts.map(|text| (!text.is_empty()).then(|| text.to_owned()));
    (visemes.to_owned(), texts, events.to_owned())
}

fn scene() -> Vec<Parts> {
    vec![
        parts("MA|E-", ["Hi|you", "Na|du", "Toi|là"], "sees amy|"),
        parts("MAE", ["One line", "Eine Zeile", ""], ""),
        parts("A-", ["Same", "Gleich", "Pareil"], ""),
        parts("MMA-", ["Same", "Anders", "Pareil"], ""),
        parts("AO", ["The end", "", ""], ""),
    ]
}

#[test]
fn frames_and_texts_of_a_clip_become_others() {
    let edits: [(usize, Parts); 6] = [
        (0, parts("MAAA|EEE-", ["Hi|you", "Na|du", "Toi|là"], "sees amy|")),
        (0, parts("M|E", ["Hello|y", "Na|du", "Toi|là"], "sees amy|")),
        (1, parts("MAE", ["One longer line", "Eine Zeile", ""], "")),
        (1, parts("MAEOO", ["Line", "Eine ganz andere Zeile", ""], "")),
        (3, parts("MMA-", ["Same", "Sehr anders", "Pareil"], "")),
        (4, parts("OA", ["The very end", "", ""], "")),
    ];
    for is_stripped in [false, true] {
        for (at, edit) in &edits {
            let mut after = scene();
            after[*at] = edit.clone();
            let (patched, made) = both(&scene(), &after, &options(is_stripped)).unwrap();
            assert!(patched.as_ref() == Some(&made), "{edit:?}: patched {}", patched.is_some());
        }
    }
}

#[test]
fn what_may_stand_once_is_left_to_all_clips() {
    let edits: [(usize, Parts); 6] = [
        (2, parts("A-", ["Other", "Gleich", "Pareil"], "")),
        (1, parts("MAE", ["Same", "Eine Zeile", ""], "")),
        (1, parts("MAE", ["One line", "Eine Zeile", "Une ligne"], "")),
        (0, parts("MA|E-", ["Hi|you", "Na|du", "Toi|là"], "sees rob|")),
        (0, parts("MA|E|-", ["Hi|y|ou", "Na|d|u", "To|i|là"], "sees amy||")),
        (4, parts("AO", [" The end", "", ""], "")),
    ];
    for (at, edit) in edits {
        let mut after = scene();
        after[at] = edit;
        assert_eq!(both(&scene(), &after, &options(false)).unwrap().0, None, "{:?}", after[at]);
    }
}

#[test]
fn texts_that_stand_there_with_a_count_are_found() {
    // Two clips share a text, which is therefore counted. That of the third one is not counted.
    let clips = |last: &str| ["One|two", "One|two", last].map(|text| parts("MA|E", [text, "", ""], "")).to_vec();
    assert_eq!(both(&clips("Else|two"), &clips("One|two"), &options(false)).unwrap().0, None);
    assert!(both(&clips("Else|two"), &clips("Other|two"), &options(false)).unwrap().0.is_some());
    // And the reverse.
    let clips = |first: &str| [first, "Two|three", "One|two"].map(|text| parts("MA|E", [text, "", ""], "")).to_vec();
    let (patched, made) = both(&clips("Else|two"), &clips("One|two"), &options(false)).unwrap();
    assert!(patched.is_none_or(|patched| patched == made));
}

#[test]
fn texts_that_start_inside_of_the_new_one_are_found() {
    let event = "sees amy|sees amy";
    let shown = parts("A|A", ["", "bbb|bbb", ""], "");
    let empty = ["-", "E"].map(|visemes| parts(visemes, ["", "", ""], ""));
    let clips = |visemes, texts| [&[shown.clone(), parts(visemes, texts, event)], &empty[..]].concat();
    let (before, after) = (clips("-|-", ["a|a"; 3]), clips("A|A", ["a|a", "bbb|bbb", "a|a"]));
    for is_stripped in [false, true] {
        let (patched, made) = both(&before, &after, &options(is_stripped)).unwrap();
        assert!(patched.is_none_or(|patched| patched == made));
    }
}

/// Tables and directory are read before anything is proven.
#[test]
fn a_damaged_bank_is_not_patched() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.lipzbank");
    let mut long = scene();
    long.extend((0..90).map(|number| parts("MAE", [&format!("{number}. ").repeat(300), "Na", ""], "")));
    for (clips, step) in [(scene(), 1), (long, 509)] {
        let mut after = clips.clone();
        after[1] = parts("MAEOO", ["Line", "Eine ganz andere Zeile", ""], "");
        let options = options(false);
        let inputs: Vec<Input> = clips.iter().enumerate().map(|(at, clip)| input(at, clip)).collect();
        let bank = Compiler::new(options.clone()).compile(&inputs).into_bank().unwrap();
        let checksum = checksum_of(&bank).unwrap();
        let run = CompileRun::read(&[input(1, &after[1])], &options, None, &|_| {});
        let patched_from = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            let old = OldBank::open(&path, checksum)?;
            patched(&Recall::new(&old)?, &run.changed_clips(), Vec::new())
        };
        assert!(patched_from(&bank).is_some());
        for at in (CHECKED_FROM..bank.len()).step_by(step) {
            for bit in [0, 3, 6, 7] {
                let mut damaged = bank.clone();
                damaged[at] ^= 1 << bit;
                assert!(patched_from(&damaged).is_none(), "bit {bit} of byte {at}");
            }
        }
    }
}

fn clip() -> impl Strategy<Value = Parts> {
    let text = || prop::option::weighted(0.8, "[ab]{1,3}|[a-z]{2,9}( [a-z]{2,9}){0,3}");
    (1_usize..3, prop::array::uniform3(text()), "[MAEO-]{1,6}", any::<bool>()).prop_map(
        |(count, texts, visemes, has_events)| {
            let divided = |part: &str| vec![part; count].join("|");
            let events = if has_events { divided("sees amy") } else { String::new() };
            (divided(&visemes), texts.map(|text| text.map(|text| divided(&text))), events)
        },
    )
}

proptest! {
    #[test]
    fn patched_banks_are_those_of_all_clips(
        before in prop::collection::vec(clip(), 1..8),
        edits in prop::collection::vec((any::<prop::sample::Index>(), clip(), 0_usize..4), 1..4),
        is_stripped in any::<bool>(),
    ) {
        let mut after = before.clone();
        for (at, edit, kind) in edits {
            let clip = at.get_mut(&mut after);
            match kind {
                0 => *clip = edit,
                1 => clip.0.push_str("AA"),
                2 => clip.1.iter_mut().flatten().for_each(|text| text.push('x')),
                _ => clip.1.iter_mut().flatten().take(1).for_each(|text| text.insert(0, 'ü')),
            }
        }
        if let Some((Some(patched), made)) = both(&before, &after, &options(is_stripped)) {
            prop_assert!(patched == made, "another bank: {before:?} -> {after:?}");
        }
    }
}
