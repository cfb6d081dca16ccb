//! A bank compared with its documents: the reader returns every frame, segment, text and event of the compiler's input,
//! before and after verification.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use lipz_bank::{Bank, Clip, EventName, Micros, Segment};
use lipz_compiler::{Compiler, Input, Options};
use lipz_file::locale::{TextName, found_keys, language, split_variant, text_name, without_category};
use lipz_file::{Document, Value, event, text};
use lipz_testkit::documents::document;
use proptest::prelude::*;
use proptest::{collection, option, sample};
use std::collections::BTreeMap;

/// The locales of the documents. No two have the same language, so that a locale falls back to those named by a
/// project, or else to the default locale.
const TAGS: [&str; 7] = ["ar-eg", "de-de", "en-us", "es-mx", "fr-ca", "ja-jp", "pt-br"];

/// The expected contents of a clip, computed in the simplest way.
struct Model {
    fps: Option<f64>,
    viseme_type: Option<String>,
    /// Codes of each segment.
    visemes: Option<Vec<String>>,
    /// Display texts of each segment, by locale.
    texts: BTreeMap<String, Vec<String>>,
    /// Event strings of each segment.
    events: Option<Vec<String>>,
}

impl Model {
    fn from_document(document: &Document<'_>) -> Model {
        let split = |string: &str| string.split('|').map(str::to_owned).collect::<Vec<_>>();
        let string = |name: &str| document.string(name).map(str::to_owned);
        let without_blanks = |codes: String| codes.replace(' ', "");
        let trimmed = |segment: String| text::trim(&segment).to_owned();
        let display = |segment: String| text::display(&segment).text.into_owned();
        let texts = document.elements.iter().filter_map(|element| {
            let (Some(TextName::Canonical(tag) | TextName::Misspelt(tag)), Value::String(string)) =
                (text_name(&element.name.text), &element.value)
            else {
                return None;
            };
            Some((tag, split(&string.text).into_iter().map(display).collect()))
        });
        let mut texts: BTreeMap<String, Vec<String>> = texts.collect();
        let whole = texts.clone();
        for (tag, segments) in &mut texts {
            let (locale, key) = split_variant(tag);
            for (segment, of_locale) in segments.iter_mut().zip(whole.get(locale).into_iter().flatten()) {
                if key.is_some() && segment.is_empty() {
                    segment.clone_from(of_locale);
                }
            }
        }
        Model {
            fps: document.get("fps").map(|element| match &element.value {
                Value::Number(raw) => raw.text.parse().unwrap(),
                other => panic!("{other:?}"),
            }),
            viseme_type: string("viseme_type"),
            visemes: string("visemes").map(|codes| split(&codes).into_iter().map(without_blanks).collect()),
            texts,
            events: string("events").map(|events| split(&events).into_iter().map(trimmed).collect()),
        }
    }

    fn segment_count(&self) -> usize {
        let lists = self.visemes.iter().chain(self.texts.values()).chain(&self.events);
        lists.map(Vec::len).next().unwrap_or(1)
    }

    /// Returns the texts in a locale, and whether they are those of a different one.
    fn texts_in(&self, tag: &str, options: &Options) -> Option<(&Vec<String>, bool)> {
        self.shown_in(tag, options).map(|shown| (&self.texts[&shown], shown != tag))
    }

    /// Returns the locale or variant whose text is shown.
    fn shown_in(&self, tag: &str, options: &Options) -> Option<String> {
        if self.texts.contains_key(tag) {
            return Some(tag.to_owned());
        }
        if let (locale, Some(key)) = split_variant(tag) {
            let shown = self.shown_in(locale, options)?;
            let key = if language(&shown) == language(locale) { Some(key) } else { without_category(key) };
            let mut variants = key.into_iter().flat_map(found_keys).map(|key| format!("{shown}-x-{key}"));
            return variants.find(|variant| self.texts.contains_key(variant)).or(Some(shown));
        }
        let named = options.get_fallbacks().get(tag).cloned();
        let chain = named.unwrap_or_else(|| options.get_default_locale().map(str::to_owned).into_iter().collect());
        chain.into_iter().find(|other| self.texts.contains_key(other))
    }

    fn compare(&self, clip: &Clip<'_>, bank: &Bank<'_>, options: &Options) {
        assert_eq!(clip.viseme_type().map(|of| of.name().to_owned()), self.viseme_type);
        assert_eq!(clip.has_visemes(), self.visemes.is_some());
        assert_eq!(clip.has_events(), self.events.is_some());
        assert_eq!(clip.segment_count() as usize, self.segment_count());
        match (clip.fps(), self.fps) {
            (Some(fps), Some(written)) => assert!((fps.to_f64() - written).abs() < 1e-3, "{fps:?} {written}"),
            (stored, written) => assert!(stored.is_none() && written.is_none()),
        }
        let codes = self.visemes.clone().unwrap_or_else(|| vec![String::new(); self.segment_count()]);
        assert_eq!(clip.frames(), codes.concat().as_bytes());
        let mut frame = 0;
        for (segment, codes) in clip.segments().zip(&codes) {
            assert_eq!((segment.start_frame(), segment.frames()), (frame, codes.as_bytes()));
            for code in codes.chars() {
                assert_eq!(clip.viseme(frame).to_char(), code);
                assert_eq!(clip.segment_of_frame(frame).map(|found| found.index()), Some(segment.index()));
                if let Some(fps) = clip.fps() {
                    let start = Micros(fps.start_of_frame_us(frame) as i64);
                    assert_eq!((clip.frame_at(start), clip.viseme_at(start).to_char()), (Some(frame), code));
                }
                frame += 1;
            }
            assert_eq!(segment.end_frame(), frame);
        }
        assert_eq!(clip.frame_count(), frame);
        for (index, segment) in clip.segments().enumerate() {
            for locale in bank.locales() {
                let found = segment.text(locale).map(|text| (text.as_str().to_owned(), text.is_fallback()));
                let expected = self.texts_in(bank.locale_tag(locale), options);
                assert_eq!(found, expected.map(|(texts, falls_back)| (texts[index].clone(), falls_back)));
            }
            let string = self.events.as_ref().map(|events| events[index].as_str());
            assert_eq!(segment.event(), string);
            assert_eq!(typed(&segment), parsed(string.unwrap_or_default()));
        }
    }
}

/// Character, verb and object of each event.
type Parts<'e> = Vec<(Option<&'e str>, &'static str, Option<&'e str>)>;

fn typed<'d>(segment: &Segment<'d>) -> Parts<'d> {
    let name = |name: Option<EventName<'d>>| name.map(EventName::as_str);
    segment.events().map(|event| (name(event.character), event.command.verb(), name(event.command.object()))).collect()
}

fn parsed(string: &str) -> Parts<'_> {
    let events = event::parse(string).into_iter().flatten();
    events
        .map(|event| {
            let [character, object] = [event.character, event.command.object()].map(|word| word.map(|word| word.text));
            (character, event.command.verb(), object)
        })
        .collect()
}

fn options() -> impl Strategy<Value = Options> {
    let chain = sample::subsequence(TAGS.to_vec(), 0..4).prop_shuffle();
    let fallbacks = collection::btree_map(sample::select(&TAGS[..]), chain, 0..4);
    (option::of(sample::select(&TAGS[..])), fallbacks, any::<bool>()).prop_map(|(default_locale, fallbacks, strip)| {
        let options = Options::new().strip(strip);
        let options = default_locale.into_iter().fold(options, |options, tag| options.default_locale(tag).unwrap());
        fallbacks.into_iter().fold(options, |options, (tag, chain)| options.fallback(tag, chain).unwrap())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn the_reader_returns_what_the_compiler_was_given(
        documents in collection::vec(document(), 1..8),
        options in options(),
    ) {
        let key = |number: usize| format!("clip-{number}");
        let input = |(number, document)| Input::from_bytes(key(number), lipz_file::write(document));
        let inputs: Vec<Input> = documents.iter().enumerate().map(input).collect();
        let compiled = Compiler::new(options.clone()).compile(&inputs);
        let bytes = compiled.bank.unwrap_or_else(|| panic!("{:#?}", compiled.reports));
        let opened = Bank::open(&bytes).unwrap();
        for bank in [opened, opened.verify().unwrap()] {
            prop_assert_eq!(bank.clip_count(), documents.len());
            for (number, document) in documents.iter().enumerate() {
                let model = Model::from_document(document);
                prop_assert!(model.texts.keys().all(|tag| bank.locale(tag).is_some()));
                model.compare(&bank.clip_by_key(&key(number)).unwrap(), &bank, &options);
            }
        }
    }
}
