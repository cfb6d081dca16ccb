//! Keys that are equal, or the same file on some systems.

use super::{is_plain, refusal};
use crate::sources::Input;
use crate::util::parallel;
use foldhash::fast::RandomState;
use foldhash::{HashMap, HashMapExt};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use std::cmp::Ordering;
use std::hash::BuildHasher;
use unicase::UniCase;
use unicode_normalization::UnicodeNormalization;

/// The code points of a character that is spelled in two ways.
const SPELLED: usize = 4;

/// Returns the key as compared by file systems that ignore case and Unicode normalisation: equal for keys of the same
/// file (Unicode Standard, section 3.13, canonical caseless matching).
pub fn folded(key: &str) -> String {
    if key.is_ascii() {
        return key.to_ascii_lowercase();
    }
    let decomposed: String = key.nfd().collect();
    UniCase::unicode(decomposed).to_folded_case().nfd().collect()
}

/// Whether no key is refused and no two are equal when folded, which is the usual case. Computed on all threads, with a
/// hash per key instead of a string.
fn are_fine(inputs: &[Input]) -> bool {
    let state = RandomState::default();
    let hash = |lower: &mut String, key: &str| {
        if !key.is_ascii() {
            return state.hash_one(folded(key).as_str());
        }
        lower.clear();
        lower.push_str(key);
        lower.make_ascii_lowercase();
        state.hash_one(lower.as_str())
    };
    let judged = |lower: &mut String, input: &Input| refusal(&input.key).is_none().then(|| hash(lower, &input.key));
    let hashes: Option<Vec<u64>> = parallel::map_init(inputs, String::new, judged);
    let Some(mut hashes) = hashes else { return false };
    parallel::sort(&mut hashes);
    hashes.array_windows().all(|[one, next]| one != next)
}

/// Whether a quick check shows that the keys are fine: they are plain, have no capitals, and are in the order of their
/// files' paths, which is the usual case.
fn are_plain_and_ascend(inputs: &[Input]) -> bool {
    let has_capitals = |key: &str| key.bytes().fold(false, |has_some, byte| has_some | byte.is_ascii_uppercase());
    let is_plain = |input: &Input| is_plain(&input.key) && !has_capitals(&input.key);
    inputs.iter().all(is_plain) && inputs.array_windows().all(|[one, next]| path_is_before(&one.key, &next.key))
}

/// Whether a key without dots is less than another when `.lipz` is appended to both.
fn path_is_before(one: &str, next: &str) -> bool {
    let (one, next) = (one.as_bytes(), next.as_bytes());
    let common = one.len().min(next.len());
    match (one[..common].cmp(&next[..common]), one.get(common), next.get(common)) {
        (Ordering::Equal, Some(more), _) => *more < b'.',
        (Ordering::Equal, None, Some(more)) => b'.' < *more,
        (order, ..) => order == Ordering::Less,
    }
}

/// Reports refused keys, duplicate keys, and keys that are the same file on some systems.
pub fn check(inputs: &[Input], reports: &mut Vec<Report>) {
    if are_plain_and_ascend(inputs) || are_fine(inputs) {
        return;
    }
    let mut seen: HashMap<String, &Input> = HashMap::with_capacity(inputs.len());
    for input in inputs {
        let key = &input.key;
        if let Some(why) = refusal(key) {
            reports.push(Report::failure(
                input.name(),
                Code::RefusedKey,
                format!("the key `{}` cannot be used: {why}", escape::text(key)),
                "rename the file or folder; keys become file names on other systems when a bank is unpacked",
            ));
            continue;
        }
        let Some(before) = seen.insert(folded(key), input) else { continue };
        let diagnostic = if before.key == *key {
            Diagnostic::new(Code::DuplicateKey, format!("the key `{}` appears twice", escape::text(key)))
                .help("pack one of the two, or give the sources a common `root`")
        } else {
            clash(&before.key, key).help("rename one of the two")
        };
        let diagnostic = diagnostic.note(format!("the other file is {}", before.name()));
        reports.push(Report::about(input.name(), diagnostic));
    }
}

/// Returns the diagnostic for two different keys that are equal when [`folded`].
pub(crate) fn clash(first: &str, second: &str) -> Diagnostic {
    let keys = format!("the keys `{}` and `{}`", escape::text(first), escape::text(second));
    match two_spellings(first, second) {
        Some((one, other)) => {
            let character: String = one.nfc().collect();
            Diagnostic::new(Code::KeyClash, format!("{keys} look alike and are the same file on some systems")).note(
                format!(
                    "one has `{character}` as {}, the other as {}; macOS ignores the difference",
                    code_points(one),
                    code_points(other)
                ),
            )
        }
        None => Diagnostic::new(Code::KeyClash, format!("{keys} are the same file on some systems"))
            .note("Windows and macOS ignore case, macOS ignores Unicode normalisation"),
    }
}

/// Returns the first character that two keys spell with different code points, if the keys differ only in this way.
fn two_spellings<'k>(first: &'k str, second: &'k str) -> Option<(&'k str, &'k str)> {
    if !first.nfc().eq(second.nfc()) {
        return None;
    }
    let same = std::iter::zip(first.chars(), second.chars()).take_while(|(a, b)| a == b).map(|(a, _)| a.len_utf8());
    let start: usize = same.sum();
    let (first, second) = (first.get(start..)?, second.get(start..)?);
    let starts = |text: &'k str| text.char_indices().take(SPELLED).map(|(at, c)| &text[..at + c.len_utf8()]);
    starts(first).find_map(|one| Some((one, starts(second).find(|other| one.nfc().eq(other.nfc()))?)))
}

/// Returns the code points of a character: `A and U+0308`.
fn code_points(character: &str) -> String {
    let point = |c: char| if c.is_ascii_graphic() { c.to_string() } else { escape::code_point(c) };
    character.chars().map(point).collect::<Vec<_>>().join(" and ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folding_finds_what_file_systems_equate() {
        assert_eq!(folded("Act1/HELLO"), folded("act1/hello"));
        assert_eq!(folded("\u{e9}t\u{e9}"), folded("E\u{301}TE\u{301}"));
        assert_eq!(folded("STRASSE/é"), folded("straße/É"));
        assert_ne!(folded("a"), folded("b"));
    }

    #[test]
    fn every_character_folds_as_in_icu() {
        let icu = icu_casemap::CaseMapper::new();
        for character in '\0'..=char::MAX {
            let decomposed: String = std::iter::once(character).nfd().collect();
            let expected: String = icu.fold_string(&decomposed).nfd().collect();
            assert_eq!(folded(&character.to_string()), expected, "{character:?}");
        }
    }

    #[test]
    fn keys_in_the_order_of_paths_are_told_at_a_glance() {
        let glance = |keys: &[&str]| {
            let inputs: Vec<Input> = keys.iter().map(|key| Input::from_bytes(*key, "{}")).collect();
            are_plain_and_ascend(&inputs)
        };
        let mut paths =
            ["hello.lipz", "hello-again.lipz", "hello/sailor.lipz", "hello0.lipz", "b/a.lipz", "b-to-a.lipz", "b.lipz"];
        paths.sort_unstable();
        let keys: Vec<&str> = paths.iter().map(|path| path.trim_end_matches(".lipz")).collect();
        assert!(glance(&keys) && glance(&[]), "{keys:?}");
        for (one, next) in (0..keys.len()).flat_map(|one| (0..one).map(move |next| (one, next))) {
            assert!(!glance(&[keys[one], keys[next]]), "{} before {}", keys[one], keys[next]);
        }
        assert!(
            !glance(&["hello", "hello"])
                && !glance(&["Hello", "hello"])
                && !glance(&["a", "b", "con"])
                && !glance(&["a", ""])
        );
    }

    #[test]
    fn spellings_are_told_apart() {
        assert_eq!(two_spellings("x/\u{c4}rger", "x/A\u{308}rger"), Some(("\u{c4}", "A\u{308}")));
        assert_eq!(two_spellings("\u{ac01}", "\u{1100}\u{1161}\u{11a8}").map(|(_, b)| b.chars().count()), Some(3));
        assert_eq!(two_spellings("\u{c4}a", "A\u{308}A"), None);
        assert_eq!(code_points("A\u{308}"), "A and U+0308");
    }
}
