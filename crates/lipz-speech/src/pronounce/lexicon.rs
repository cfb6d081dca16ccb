//! A project's own pronunciations.

use super::{ipa, kana};
use crate::{Phone, Problem, ProblemKind};
use std::collections::HashMap;
use std::ops::Range;
use unicode_normalization::UnicodeNormalization;
use unicode_segmentation::UnicodeSegmentation;

/// A project's own pronunciations, from a text file with one word per line, as in the CMU Pronouncing Dictionary and in
/// dictionaries of the Montreal Forced Aligner.
///
/// ```text
/// # a remark; CMUdict's own begin with ;;;
/// WESNOTH  W EH S N AO TH
/// KONRAD  K AA N R AE D
/// KONRAD(2)  K OW N R AA D
/// Asheviere  a ʃ ə v i ɛ ɹ
/// 東京  とうきょう
/// ```
///
/// The word ends at a tab, at two spaces, or else at the first space. It may consist of up to 16 words (`New York`,
/// `Jean-Luc`). Case is ignored. The rest of the line consists of ARPAbet phones in capitals, with or without stress,
/// or of IPA, or of a reading in kana. Numbers between word and phones (the probabilities of MFA) are skipped. A word
/// on several lines has several pronunciations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Lexicon {
    words: HashMap<String, Vec<Vec<Phone>>>,
    /// The number of words in the longest entry: `New York` and `Jean-Luc` have two.
    longest: usize,
    problems: Vec<Problem>,
}

/// The most words of an entry that are looked up in texts.
const LONGEST: usize = 16;

impl Lexicon {
    /// Reads a lexicon. Lines with a problem are skipped, and [`problems`](Lexicon::problems) lists them.
    ///
    /// ```
    /// use lipz_speech::{Lexicon, ProblemKind};
    /// let lexicon = Lexicon::parse("WESNOTH  W EH S N AO TH\nKONRAD  K QQ\n");
    /// assert_eq!(lexicon.len(), 1);
    /// let problem = &lexicon.problems()[0];
    /// assert_eq!((problem.kind, problem.range.clone()), (ProblemKind::UnknownPhone, 34..36));
    /// ```
    pub fn parse(text: &str) -> Lexicon {
        let mut lexicon = Lexicon::default();
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let line_start = start;
            start += line.len();
            let line = line.trim_end_matches(['\n', '\r']);
            let mark = if line_start == 0 { line.len() - line.trim_start_matches('\u{feff}').len() } else { 0 };
            match read_line(line.get(mark..).unwrap_or_default()) {
                Ok(Some((word, all))) => all.into_iter().for_each(|phones| lexicon.add(&word, phones)),
                Ok(None) => {}
                Err((kind, range)) => {
                    let at = line_start + mark;
                    lexicon.problems.push(Problem { kind, range: at + range.start..at + range.end });
                }
            }
        }
        lexicon
    }

    /// Returns the problems of the skipped lines, in order. Ranges are bytes of the text that was read.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// Adds a pronunciation of a word, after its others.
    pub fn add(&mut self, word: &str, phones: Vec<Phone>) {
        let word = folded(word);
        let count = word.unicode_words().count();
        self.longest = self.longest.max(count.min(LONGEST));
        let all = self.words.entry(word).or_default();
        if !all.contains(&phones) {
            all.push(phones);
        }
    }

    /// Adds all words of another lexicon, without its problems. If both have a word, the pronunciations from `other`
    /// come last.
    pub fn extend(&mut self, other: Lexicon) {
        for (word, all) in other.words {
            all.into_iter().for_each(|phones| self.add(&word, phones));
        }
    }

    /// Returns the pronunciations of a word, or an empty slice if it is not in the lexicon.
    pub fn find(&self, word: &str) -> &[Vec<Phone>] {
        match self.words.is_empty() {
            true => &[],
            false => self.words.get(&folded(word)).map_or(&[], Vec::as_slice),
        }
    }

    /// Returns the number of words in the longest entry, at most 16.
    pub(super) fn longest(&self) -> usize {
        self.longest
    }

    /// Returns the number of entries.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// Whether the lexicon is empty.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }
}

/// Returns a word in the form used for lookup: composed, in lower case, with plain apostrophes and single spaces.
pub(super) fn folded(word: &str) -> String {
    let folded = match word.is_ascii() {
        true => word.to_ascii_lowercase(),
        false => word.nfc().collect::<String>().to_lowercase().replace('’', "'"),
    };
    match folded.contains(char::is_whitespace) {
        true => folded.split_whitespace().collect::<Vec<_>>().join(" "),
        false => folded,
    }
}

/// A word with its pronunciations.
type Line = Option<(String, Vec<Vec<Phone>>)>;

/// Reads a line: returns its word and phones, or `None` if there are none, or a problem with its range.
fn read_line(line: &str) -> Result<Line, (ProblemKind, Range<usize>)> {
    let content = line.trim_start();
    if content.is_empty() || content.starts_with('#') || content.starts_with(";;;") {
        return Ok(None);
    }
    let indent = line.len() - content.len();
    let content = content.split(" #").next().unwrap_or(content).trim_end();
    // Words that contain single spaces end at a tab or at two spaces.
    let end = content.find('\t').or_else(|| content.find("  ")).or_else(|| content.find(char::is_whitespace));
    let end = end.unwrap_or(content.len());
    let (word, rest) = content.split_at(end);
    let word_range = indent..indent + word.len();
    let mut fields: Vec<(usize, &str)> = fields(rest).map(|(at, field)| (indent + end + at, field)).collect();
    while fields.first().is_some_and(|(_, field)| field.parse::<f64>().is_ok()) {
        fields.remove(0);
    }
    if fields.is_empty() {
        return Err((ProblemKind::NoPhones, word_range));
    }
    if fields.iter().all(|(_, field)| kana::is_kana(field)) {
        let whole: String = fields.iter().map(|(_, field)| *field).collect();
        return Ok(Some((without_variant(word).to_owned(), kana::reading(&whole))));
    }
    let unknown = |(at, field): (usize, &str)| (ProblemKind::UnknownPhone, at..at + field.len());
    let is_lower = |field: &str| field.chars().any(|c| c.is_lowercase() || !c.is_ascii());
    let mut phones = Vec::new();
    if fields.iter().any(|(_, field)| is_lower(field)) {
        for field in fields {
            phones.extend(ipa::phones(field.1).map_err(|_| unknown(field))?);
        }
    } else {
        for field in fields {
            phones.push(arpabet(field.1).ok_or_else(|| unknown(field))?);
        }
    }
    Ok(Some((without_variant(word).to_owned(), vec![phones])))
}

/// Returns a phone of speech from its ARPAbet name in capitals.
pub(super) fn arpabet(name: &str) -> Option<Phone> {
    let phone: Phone = name.parse().ok()?;
    (phone.is_speech() && !name.contains(|c: char| c.is_ascii_lowercase())).then_some(phone)
}

/// Returns the words between whitespace, with their offsets.
fn fields(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let start = text.as_ptr() as usize;
    text.split_whitespace().map(move |field| (field.as_ptr() as usize - start, field))
}

/// Removes the number of a variant: `KONRAD(2)` is a second pronunciation of `KONRAD`.
fn without_variant(word: &str) -> &str {
    let variant = word.strip_suffix(')').and_then(|word| word.rsplit_once('('));
    match variant {
        Some((word, number)) if !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()) => word,
        _ => word,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(lexicon: &Lexicon, word: &str) -> Vec<String> {
        let join = |phones: &Vec<Phone>| phones.iter().map(|phone| phone.name()).collect::<Vec<_>>().join(" ");
        lexicon.find(word).iter().map(join).collect()
    }

    #[test]
    fn lines_of_every_kind_of_dictionary() {
        let text = "\u{feff};;; CMUdict\r\nKONRAD  K AA1 N R AE2 D\r\nkonrad(2) K OW N R AA D # remark\n\n\
                    # MFA\nLi'sar\t0.99\t0.1\t1.0\t1.0\tl iː s ɑː ɹ\nNew York  N UW Y AO R K\nÉowyn\teɪoʊɪn";
        let lexicon = Lexicon::parse(text);
        assert_eq!(lexicon.problems(), []);
        assert_eq!(all(&lexicon, "Konrad"), ["K AA N R AE D", "K OW N R AA D"]);
        assert_eq!(all(&lexicon, "li’sar"), ["L IY S AA R"]);
        assert_eq!(all(&lexicon, "NEW YORK"), ["N UW Y AO R K"]);
        assert_eq!(all(&lexicon, "E\u{301}owyn"), ["EY OW IH N"]);
        assert!(lexicon.find("york").is_empty());
    }

    #[test]
    fn readings_in_kana() {
        let lexicon = Lexicon::parse("東京 とうきょう\nWESNOTH  ウェスノス\n母\tは は\n朝 あさ kk\n");
        assert_eq!(all(&lexicon, "東京"), ["T AO K Y AO"]);
        assert_eq!(all(&lexicon, "Wesnoth").first().map(String::as_str), Some("W EH S UW N AO S UW"));
        assert_eq!(all(&lexicon, "母"), ["HH AA HH AA"], "no particle");
        let kinds: Vec<ProblemKind> = lexicon.problems().iter().map(|problem| problem.kind).collect();
        assert_eq!(kinds, [ProblemKind::UnknownPhone]);
    }

    #[test]
    fn problems_say_where_they_are() {
        let text = "A  K\nB  k xx1 Ü\nC\n  D  SIL\nE  k 世";
        let found = |(kind, range): (ProblemKind, &str)| (kind, range.to_owned());
        let lexicon = Lexicon::parse(text);
        let problems: Vec<_> =
            lexicon.problems().iter().map(|problem| found((problem.kind, &text[problem.range.clone()]))).collect();
        let unknown = |text| found((ProblemKind::UnknownPhone, text));
        assert_eq!(problems, [unknown("Ü"), found((ProblemKind::NoPhones, "C")), unknown("SIL"), unknown("世")]);
        assert_eq!(lexicon.len(), 1);
    }
}
