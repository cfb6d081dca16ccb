//! Banks split by locale: each text of the whole bank is in the text bank of its locale.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_bank::Bank;
use lipz_compiler::{Compiler, Options, SplitBank, Stack, discover};
use lipz_testkit::dialogues::with;

#[test]
fn text_banks_answer_as_the_whole() {
    let options = Options::new().default_locale("en-us").unwrap();
    let inputs = discover(&[support::folder("drama")], None).unwrap();
    let whole = Compiler::new(options.clone()).compile(&inputs).bank.unwrap();
    let bank = Bank::open(&whole).unwrap().verify().unwrap();
    let split = SplitBank::from_bytes(&whole).unwrap();
    let base = Bank::open(&split.base).unwrap().verify().unwrap();
    assert!(base.locales().next().is_none() && base.sections().all(|(tag, _)| tag != *b"SRCE"));
    assert_eq!(split.texts.len(), bank.locales().count());
    let mut text_count = 0;
    for ((tag, bytes), locale) in split.texts.iter().zip(bank.locales()) {
        assert_eq!(tag, bank.locale_tag(locale));
        let mut base = base;
        base.open_texts(bytes).unwrap();
        let own = base.locale(tag).unwrap();
        let is_default = base.default_locale() == Some(own);
        assert_eq!((base.locales().count(), is_default), (1, bank.default_locale() == Some(locale)));
        for (clip, whole_clip) in base.clips().zip(bank.clips()) {
            assert_eq!((clip.key(), clip.frames()), (whole_clip.key(), whole_clip.frames()));
            for (segment, whole_segment) in clip.segments().zip(whole_clip.segments()) {
                assert_eq!(segment.text(own), whole_segment.text(locale));
                text_count += usize::from(segment.text(own).is_some());
            }
        }
        // It contains no texts of other languages, except for those that the locale falls back to.
        assert!(bytes.len() < whole.len() / 5, "{tag}: {} of {} bytes", bytes.len(), whole.len());
    }
    assert!(text_count > 500, "{text_count} texts");
}

#[test]
fn what_was_split_is_joined_again() {
    let options = Options::new().default_locale("en-us").unwrap().strip(true);
    let inputs = discover(&[support::folder("drama")], None).unwrap();
    let whole = Compiler::new(options).compile(&inputs).bank.unwrap();
    let split = SplitBank::from_bytes(&whole).unwrap();
    let files: Vec<&[u8]> =
        std::iter::once(&split.base).chain(split.texts.iter().map(|(_, texts)| texts)).map(Vec::as_slice).collect();
    let whole = Bank::open(&whole).unwrap().verify().unwrap();
    let joined = with(&files, |dialogue| Stack::of("base", dialogue)).unwrap().into_bank();
    let joined = Bank::open(&joined).unwrap().verify().unwrap();
    let locales = |bank: &Bank<'_>| {
        let locale = |at| (bank.locale_tag(at).to_owned(), bank.default_locale() == Some(at));
        bank.locales().map(locale).collect::<Vec<_>>()
    };
    assert_eq!((joined.fingerprint(), locales(&joined)), (whole.fingerprint(), locales(&whole)));
    let mut fallbacks = 0;
    for (clip, whole_clip) in joined.clips().zip(whole.clips()) {
        for (segment, whole_segment) in clip.segments().zip(whole_clip.segments()) {
            assert_eq!(segment.event(), whole_segment.event());
            for (locale, whole_locale) in joined.locales().zip(whole.locales()) {
                let text = segment.text(locale);
                assert_eq!(text, whole_segment.text(whole_locale), "{} in {}", clip.key(), joined.locale_tag(locale));
                fallbacks += usize::from(text.is_some_and(lipz_bank::Text::is_fallback));
            }
        }
    }
    assert!(fallbacks > 50, "{fallbacks}");
    let some = with(&files[..2], |dialogue| Stack::of("base", dialogue)).unwrap().into_bank();
    let some = Bank::open(&some).unwrap().verify().unwrap();
    assert!(some.locales().map(|locale| some.locale_tag(locale)).eq([split.texts[0].0.as_str()]));
}

#[test]
fn a_bank_without_clips() {
    let whole = Compiler::default().compile(&[]).bank.unwrap();
    let split = SplitBank::from_bytes(&whole).unwrap();
    assert!(Bank::open(&split.base).unwrap().verify().is_ok() && split.texts.is_empty());
}

#[test]
fn what_is_no_bank_is_refused() {
    assert!(SplitBank::from_bytes(b"not a bank").is_err());
}
