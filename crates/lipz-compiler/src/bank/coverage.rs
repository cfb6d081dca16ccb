//! Coverage: the share of a dialogue that is translated into each locale of a bank.

use crate::bank::dialogue::{TaggedLocale, clips_by_key, locales_by_tag, texts_bytes};
use crate::locales::fallback;
use crate::project::pseudo_locale::is_pseudo;
use crate::project::{MinCoverage, Options};
use lipz_bank::{Clip, Dialogue, Locale, Text};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::locale::is_variant;
use std::cell::OnceCell;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The clips of a bank that have, borrow or lack a text in one locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Coverage {
    /// The locale, `de-de`.
    pub tag: String,
    /// Whether it is the default locale of the bank.
    pub is_default: bool,
    /// The number of clips that have a text in any locale.
    pub clip_count: usize,
    /// The number of clips that have a text in this one.
    pub own_count: usize,
    /// Keys of those among them whose text equals that of the default locale exactly: names, or texts that are not yet
    /// translated.
    pub same_as_default: Vec<String>,
    /// Clips that show the text of another locale, by its tag. The tag is empty if that locale is not in the bank.
    pub fallbacks: BTreeMap<String, Vec<String>>,
    /// Clips that show no text, although they have one in some locale.
    pub missing: Vec<String>,
}

impl Coverage {
    /// Returns the percentage of clips with a text of their own; 100 if there is nothing to translate.
    pub fn percent(&self) -> f64 {
        if self.clip_count == 0 { 100.0 } else { self.own_count as f64 * 100.0 / self.clip_count as f64 }
    }

    /// Returns [`percent`](Self::percent) for people: truncated to one decimal place instead of rounded, because 99.96
    /// % is not all.
    pub fn percent_in_tenths(&self) -> f64 {
        (self.percent() * 10.0).floor() / 10.0
    }
}

/// Returns the coverage of each locale of a verified dialogue, sorted by tag. Keys are sorted too. Variants of texts are
/// left out, because clips need none.
///
/// A text bank contains copies of the texts that its locale borrows. These are attributed to the first locale with the
/// same text, in the default order of [fallback](Options::fallback).
///
/// ```
/// use lipz_compiler::{Compiler, Input, Options, coverage};
/// let inputs = [
///     Input::from_bytes("aye", r#"{ "text_en-us": "Aye.", "text_de-de": "Ja." }"#),
///     Input::from_bytes("no", r#"{ "text_en-us": "No." }"#),
/// ];
/// let options = Options::new().default_locale("en-us")?;
/// let bytes = Compiler::new(options.clone()).compile(&inputs).bank.ok_or("no bank")?;
/// let mut files = [lipz_bank::files::DialogueFile::ABSENT];
/// let german = &coverage(&lipz_bank::Dialogue::open(&mut files, [bytes.as_slice()])?)[0];
/// assert_eq!((german.tag.as_str(), german.percent()), ("de-de", 50.0));
/// assert_eq!(german.fallbacks["en-us"], ["no"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn coverage(dialogue: &Dialogue<'_>) -> Vec<Coverage> {
    let mut locales = locales_by_tag(dialogue);
    locales.retain(|locale| !is_variant(locale.tag));
    let default = locales.iter().position(|locale| locale.is_default);
    let empty = |locale: &TaggedLocale<'_>| Coverage {
        tag: locale.tag.to_owned(),
        is_default: locale.is_default,
        ..Coverage::default()
    };
    let mut found: Vec<Coverage> = locales.iter().map(empty).collect();
    let chains = if texts_bytes(dialogue) == 0 { Vec::new() } else { chains(&locales) };
    // The texts of a dub are those of its original.
    for clip in clips_by_key(dialogue).iter().filter(|clip| clip.original().is_none()) {
        let shown: Vec<DisplayedText<'_>> = locales.iter().map(|locale| shown(clip, locale.locale)).collect();
        if shown.iter().all(|shown| matches!(shown, DisplayedText::Nothing)) {
            continue;
        }
        let default = default.and_then(|default| shown.get(default));
        let origins = OnceCell::new();
        for (number, (coverage, text)) in std::iter::zip(&mut found, &shown).enumerate() {
            coverage.clip_count += 1;
            let key = clip.key().to_owned();
            match text {
                DisplayedText::Own(text) => {
                    coverage.own_count += 1;
                    if !coverage.is_default && matches!(default, Some(DisplayedText::Own(default)) if default == text) {
                        coverage.same_as_default.push(key);
                    }
                }
                DisplayedText::Fallback(text) => {
                    let is_equal =
                        |other: &usize| matches!(shown.get(*other), Some(DisplayedText::Own(own)) if own == text);
                    let equal = || chains.get(number)?.iter().copied().find(is_equal);
                    let origin = origins.get_or_init(|| origins_of(&shown)).get(&text.place()).copied().or_else(equal);
                    let tag = origin.and_then(|origin| locales.get(origin)).map_or("", |locale| locale.tag);
                    coverage.fallbacks.entry(tag.to_owned()).or_default().push(key);
                }
                DisplayedText::Nothing => coverage.missing.push(key),
            }
        }
    }
    found
}

/// Returns the locale of each own text, by the position of the text.
fn origins_of(shown: &[DisplayedText<'_>]) -> HashMap<Option<TextSpan>, usize> {
    let own = |(number, text): (usize, &DisplayedText<'_>)| match text {
        DisplayedText::Own(own) => Some((own.place(), number)),
        _ => None,
    };
    // For equal positions, keep the first.
    shown.iter().enumerate().rev().filter_map(own).collect()
}

/// Returns for each locale the indexes of those that it falls back to.
fn chains(locales: &[TaggedLocale<'_>]) -> Vec<Vec<usize>> {
    let tags: Vec<&str> = locales.iter().map(|locale| locale.tag).collect();
    let default = locales.iter().find(|locale| locale.is_default);
    let options = Options { default_locale: default.map(|locale| locale.tag.to_owned()), ..Options::default() };
    (0..tags.len()).map(|locale| fallback::chain(&tags, locale, &options)).collect()
}

/// Returns a diagnostic for each locale below its required coverage, including locales without any texts.
///
/// Pseudo-locales are not checked.
pub fn shortfalls(found: &[Coverage], wanted: &MinCoverage) -> Vec<Diagnostic> {
    let clip_count = found.first().map_or(0, |coverage| coverage.clip_count);
    let known: HashSet<&str> = found.iter().map(|coverage| coverage.tag.as_str()).collect();
    let absent = wanted.locales.keys().filter(|tag| !known.contains(tag.as_str()));
    let absent = absent.map(|tag| Coverage { tag: tag.clone(), clip_count, ..Coverage::default() });
    let absent: Vec<Coverage> = absent.collect();
    let judged = found.iter().chain(&absent).filter(|coverage| !is_pseudo(&coverage.tag));
    judged
        .filter_map(|coverage| {
            let percent = wanted.locales.get(&coverage.tag).copied().or(wanted.all)?;
            (coverage.percent() < percent).then(|| shortfall(coverage, percent))
        })
        .collect()
}

fn shortfall(coverage: &Coverage, wanted_percent: f64) -> Diagnostic {
    let (tag, percent) = (&coverage.tag, coverage.percent_in_tenths());
    let message = format!("{percent} % of the clips have a text in `{tag}`, but {wanted_percent} % are required");
    let missing = coverage.clip_count - coverage.own_count;
    Diagnostic::new(Code::LowCoverage, message)
        .note(format!("{missing} of {} clips do not have one", coverage.clip_count))
        .help("translate the missing texts, or lower the minimum")
}

/// The start and the end of a text.
type TextSpan = (*const u8, *const u8);

/// The text of a clip that is displayed in a locale.
enum DisplayedText<'data> {
    Own(ClipText<'data>),
    Fallback(ClipText<'data>),
    Nothing,
}

/// The texts of a clip's segments.
#[derive(PartialEq)]
struct ClipText<'data>(Vec<&'data str>);

impl ClipText<'_> {
    /// Returns the position of the text in the file: each locale's texts are stored separately, even if they are equal.
    /// An empty text has the position of the next one.
    fn place(&self) -> Option<TextSpan> {
        Some((self.0.first()?.as_ptr(), self.0.last()?.as_bytes().as_ptr_range().end))
    }
}

fn shown<'data>(clip: &Clip<'data>, locale: Locale) -> DisplayedText<'data> {
    let is_fallback = clip.segment(0).and_then(|segment| segment.text(locale)).map(Text::is_fallback);
    let texts = clip.segments().filter_map(|segment| segment.text(locale)).map(Text::as_str);
    match is_fallback {
        None => DisplayedText::Nothing,
        Some(false) => DisplayedText::Own(ClipText(texts.collect())),
        Some(true) => DisplayedText::Fallback(ClipText(texts.collect())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bank::SplitBank;
    use crate::run::Compiler;
    use crate::sources::Input;
    use lipz_testkit::dialogues::with;

    #[test]
    fn every_kind_of_text() {
        let inputs = [
            Input::from_bytes("a", r#"{ "text_en-us": "Aye.", "text_de-de": "Ja.", "text_de-at": "Jo." }"#),
            Input::from_bytes("b", r#"{ "text_en-us": "OK", "text_de-de": "OK" }"#),
            Input::from_bytes("c", r#"{ "text_fr-fr": "Oui." }"#),
            Input::from_bytes("d", r#"{ "text_en-us": "No." }"#),
            Input::from_bytes("e", r#"{ "visemes": "-A-" }"#),
        ];
        let options = Options::new().default_locale("en-us").unwrap();
        let bytes = Compiler::new(options.clone()).compile(&inputs).bank.unwrap();
        let found = with(&[&bytes], coverage);
        let of = |tag: &str| found.iter().find(|coverage| coverage.tag == tag).unwrap();
        let keys = |keys: &[&str]| keys.iter().map(|key| (*key).to_owned()).collect::<Vec<_>>();
        let german = of("de-de");
        assert_eq!((german.clip_count, german.own_count, german.percent()), (4, 2, 50.0));
        assert_eq!(german.same_as_default, keys(&["b"]));
        assert_eq!(german.fallbacks, [("en-us".to_owned(), keys(&["d"]))].into());
        assert_eq!(german.missing, keys(&["c"]));
        let austrian = of("de-at");
        assert_eq!(austrian.fallbacks["de-de"], keys(&["b"]));
        assert_eq!(austrian.fallbacks["en-us"], keys(&["d"]));
        let english = of("en-us");
        assert!(english.is_default && english.same_as_default.is_empty());
        assert_eq!(english.missing, keys(&["c"]));
    }

    #[test]
    fn a_split_bank_is_covered_as_the_whole() {
        let inputs = [
            Input::from_bytes("a", r#"{ "text_en-us": "OK", "text_de-de": "OK", "text_de-at": "Jo." }"#),
            Input::from_bytes("b", r#"{ "text_en-us": "OK", "text_de-de": "OK" }"#),
            Input::from_bytes("c", r#"{ "text_en-us": "No.|No!" }"#),
        ];
        let options = Options::new().default_locale("en-us").unwrap();
        let bytes = Compiler::new(options.clone()).compile(&inputs).bank.unwrap();
        let split = SplitBank::from_bytes(&bytes).unwrap();
        let whole = with(&[&bytes], coverage);
        assert_eq!(whole[0].fallbacks["de-de"], ["b"], "the nearest of two with the same text");
        let mut files: Vec<&[u8]> = vec![&split.base];
        files.extend(split.texts.iter().map(|(_, texts)| texts.as_slice()));
        assert_eq!(with(&files, coverage), whole);
        files[1..].rotate_left(1);
        assert_eq!(with(&files, coverage), whole, "in any order");
    }

    #[test]
    fn shortfalls_are_found() {
        let covered =
            |tag: &str, own_count| Coverage { tag: tag.into(), clip_count: 3, own_count, ..Coverage::default() };
        let found = [covered("de-de", 2), covered("en-us", 3), covered("en-xa", 0)];
        let headlines = |all, locales: &[(&str, f64)]| {
            let locales = locales.iter().map(|&(tag, percent)| (tag.to_owned(), percent)).collect();
            shortfalls(&found, &MinCoverage { all, locales }).into_iter().map(|found| found.message).collect::<Vec<_>>()
        };
        assert_eq!(headlines(None, &[]), [""; 0]);
        assert_eq!(headlines(Some(66.6), &[]), [""; 0]);
        let german = "66.6 % of the clips have a text in `de-de`, but 100 % are required";
        assert_eq!(headlines(Some(100.0), &[]), [german]);
        let french = "0 % of the clips have a text in `fr-fr`, but 50 % are required";
        assert_eq!(headlines(Some(100.0), &[("de-de", 10.0), ("fr-fr", 50.0)]), [french]);
    }

    #[test]
    fn nothing_to_translate_is_complete() {
        let bytes = Compiler::default().compile(&[]).bank.unwrap();
        assert!(with(&[&bytes], coverage).is_empty());
        assert_eq!(Coverage::default().percent(), 100.0);
    }
}
