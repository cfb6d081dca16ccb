//! The typed events of a bank equal its parsed event strings.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz_bank::{Bank, EventName, Segment, Strength};
use lipz_compiler::{Compiler, Input, KnownNames, Options};
use lipz_file::event;
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Character, verb and object of an event, from either source.
type Parts<'e> = (Option<&'e str>, &'static str, Option<&'e str>);

fn stored<'d>(segment: &Segment<'d>) -> Vec<Parts<'d>> {
    let name = |name: Option<EventName<'d>>| name.map(EventName::as_str);
    let parts =
        |event: lipz_bank::Event<'d>| (name(event.character), event.command.verb(), name(event.command.object()));
    segment.events().map(parts).collect()
}

fn parsed(string: &str) -> Vec<Parts<'_>> {
    let events = event::parse(string).into_iter().flatten();
    events
        .map(|event| {
            let [character, object] = [event.character, event.command.object()].map(|word| word.map(|word| word.text));
            (character, event.command.verb(), object)
        })
        .collect()
}

/// Returns the numbers of gestures as written, which are stored among the names.
fn numbers(string: &str) -> impl Iterator<Item = &str> {
    let events = event::parse(string).into_iter().flatten();
    events.filter_map(|event| event.command.amount().map(|word| word.text))
}

/// Returns the same numbers from a bank.
fn strengths(segment: &Segment<'_>) -> Vec<Strength> {
    segment.events().filter_map(|event| event.command.amount()).collect()
}

/// Compares all events of a bank with its strings. Returns their number.
fn compare(bytes: &[u8]) -> usize {
    let bank = Bank::open(bytes).and_then(Bank::verify).unwrap();
    let (mut count, mut names) = (0, BTreeSet::new());
    for segment in bank.clips().flat_map(|clip| clip.segments()) {
        let events = stored(&segment);
        let string = segment.event().unwrap_or_default();
        assert_eq!(events, parsed(string));
        let of_string = numbers(string).filter_map(|number| Strength::parse(number.as_bytes()));
        assert_eq!(strengths(&segment), of_string.collect::<Vec<_>>());
        names.extend(numbers(string));
        count += events.len();
        names.extend(events.iter().flat_map(|(character, _, object)| [*character, *object]).flatten());
    }
    // Curves have names of the same kind.
    let curves: Vec<String> =
        bank.clips().flat_map(|clip| clip.curves()).map(|curve| curve.name().to_string()).collect();
    names.extend(curves.iter().map(String::as_str));
    // Names are numbered in order, without gaps, and each is used by an event or a curve.
    for (name, number) in names.iter().zip(0..) {
        assert_eq!(bank.event_name(name).map(|name| name.to_words()[1]), Some(number), "{names:?}");
    }
    let sections: Vec<_> = bank.sections().filter(|(tag, _)| *tag == lipz_layout::Tag::EVENT_NAMES.0).collect();
    assert_eq!(sections[0].1.len(), names.len() * size_of::<lipz_layout::EventNameRecord>());
    count
}

#[test]
fn the_drama() {
    let inputs: Vec<_> =
        support::files("drama").into_iter().map(|(key, bytes)| Input::from_bytes(&key, bytes)).collect();
    let bank = Compiler::default().compile(&inputs).bank.unwrap();
    assert!(compare(&bank) > 100);
}

/// Generates one part of an event string: an event, an almost valid one, or other text.
fn part() -> impl Strategy<Value = String> {
    let word = "amy|rob|door|sad|feels|stops|staring|日本|é|x";
    let words = proptest::collection::vec(word, 0..5).prop_map(|words| words.join(" "));
    let event = ("(amy |rob |feels )?", "feels|sees|stares|points|does", word)
        .prop_map(|(character, verb, object)| format!("{character}{verb} {object}"));
    prop_oneof![8 => event, 2 => "(日本 )?stops (staring|pointing)", 1 => words, 1 => "[ !(-9;-@_]{0,6}"]
}

proptest! {
    #[test]
    fn generated_events(segments in proptest::collection::vec(proptest::collection::vec(part(), 1..4), 1..6)) {
        let strings: Vec<String> = segments.iter().map(|parts| parts.join(",")).collect();
        let file = format!(r#"{{ "events": "{}" }}"#, strings.join("|"));
        let inputs = ["a", "b"].map(|key| Input::from_bytes(key, file.clone()));
        // The diagnostics about the events do not affect them.
        let names = KnownNames::new().characters(["amy"]).props(["door"]);
        let banks = [KnownNames::new(), names].map(|names| {
            Compiler::new(Options::new().known_names(names)).compile(&inputs).bank.unwrap()
        });
        prop_assert!(banks[0] == banks[1]);
        compare(&banks[0]);
    }
}
