//! Division of texts at the ends of sentences, or by shares of the speech.

use lipz_file::text::trim;
use unicode_segmentation::UnicodeSegmentation;

/// The cost of cutting a text at other places than the end of a sentence, as a share of the whole text: at other
/// punctuation, and between any two words.
const COST_AT_SENTENCE: f64 = 0.0;
const COST_AT_MARK: f64 = 0.04;
const COST_AT_BLANK: f64 = 0.10;

/// Returns the words of a text as tools count them: separated by whitespace.
pub(super) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split_whitespace()
}

/// Returns the sentences of a text (Unicode Standard Annex 29).
pub(super) fn sentences(text: &str) -> Vec<String> {
    let found: Vec<String> = text
        .split_sentence_bounds()
        .map(|sentence| trim(sentence).to_owned())
        .filter(|part| !part.is_empty())
        .collect();
    if found.is_empty() { vec![String::new()] } else { found }
}

/// Cuts a text near these shares of it, preferably at the end of a sentence or clause. Returns one more part than there
/// are shares. Parts may be empty.
pub(super) fn cut(text: &str, shares: &[f64]) -> Vec<String> {
    let places = places(text);
    // The places of each cost are also sorted by share, so a binary search finds the best one.
    let of_cost = |cost: f64| places.iter().filter(|place| place.cost == cost).collect::<Vec<_>>();
    let by_cost = [COST_AT_SENTENCE, COST_AT_MARK, COST_AT_BLANK].map(of_cost);
    let mut parts = Vec::with_capacity(shares.len() + 1);
    let mut start = 0;
    for &share in shares {
        let nearest = by_cost.iter().flat_map(|places| nearest(places, start, share));
        let cost = |place: &&SentenceCut| (place.share - share).abs() + place.cost;
        let best = nearest.min_by(|a, b| cost(a).total_cmp(&cost(b)).then(a.at.cmp(&b.at)));
        let end = best.map_or(text.len(), |place| place.at);
        parts.push(trim(text.get(start..end).unwrap_or_default()).to_owned());
        start = end.max(start);
    }
    parts.push(trim(text.get(start..).unwrap_or_default()).to_owned());
    parts
}

/// Returns the places from byte `start` on that are nearest to a share: one before it, and one at or after it. Of
/// several with the same share, it returns the first.
fn nearest<'p>(
    places: &[&'p SentenceCut],
    start: usize,
    share: f64,
) -> impl Iterator<Item = &'p SentenceCut> + use<'p> {
    let left = places.get(places.partition_point(|place| place.at < start)..).unwrap_or_default();
    let behind = left.partition_point(|place| place.share < share);
    let before = behind.checked_sub(1).and_then(|last| left.get(last)).and_then(|last| {
        let first = left.partition_point(|place| place.share < last.share);
        left.get(first)
    });
    before.into_iter().chain(left.get(behind)).copied().collect::<Vec<_>>().into_iter()
}

/// A place where a text can be cut.
struct SentenceCut {
    /// The offset of the cut in bytes.
    at: usize,
    /// The share of the letters before it.
    share: f64,
    cost: f64,
}

#[allow(clippy::cast_precision_loss, reason = "lengths of texts")]
fn places(text: &str) -> Vec<SentenceCut> {
    let letters = |text: &str| text.chars().filter(|c| c.is_alphanumeric()).count();
    let all = letters(text).max(1) as f64;
    let at_end = |at, share| SentenceCut { at, share, cost: COST_AT_SENTENCE };
    let mut places = vec![at_end(0, 0.0), at_end(text.len(), 1.0)];
    let ends_of_sentences: Vec<usize> =
        text.split_sentence_bound_indices().map(|(start, sentence)| start + sentence.trim_end().len()).collect();
    let (mut before, mut counted) = (0, 0);
    for (blank, _) in text.char_indices().filter(|(_, c)| c.is_whitespace()) {
        let word = text.get(counted..blank).unwrap_or_default();
        counted = blank;
        before += letters(word);
        let cost = match word.chars().next_back() {
            _ if ends_of_sentences.binary_search(&blank).is_ok() => COST_AT_SENTENCE,
            Some(mark) if !mark.is_alphanumeric() && !mark.is_whitespace() => COST_AT_MARK,
            _ => COST_AT_BLANK,
        };
        places.push(SentenceCut { at: blank, share: before as f64 / all, cost });
    }
    places.sort_by_key(|place| place.at);
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_in_several_languages() {
        assert_eq!(sentences("Who's there? It is 3.5 miles. Go!"), ["Who's there?", "It is 3.5 miles.", "Go!"]);
        assert_eq!(sentences("誰だ？灯台守か。"), ["誰だ？", "灯台守か。"]);
        assert_eq!(sentences(" "), [""]);
    }

    #[test]
    fn cuts_prefer_the_ends_of_sentences() {
        assert_eq!(cut("Let me think... It was you!", &[0.5]), ["Let me think...", "It was you!"]);
        assert_eq!(cut("one two three four", &[0.5]), ["one two", "three four"]);
        assert_eq!(cut("Yes", &[0.3, 0.6]).len(), 3);
        assert_eq!(cut("", &[0.5]), ["", ""]);
    }

    #[test]
    fn the_place_is_the_best_of_all() {
        let text =
            "Aye, sir.  The light!\n - the light - it went out; at ten ( or so ). Nobody heard: it was dark... ok "
                .repeat(3);
        let shares: Vec<f64> = (0..60).map(|number| f64::from(number * 37 % 61) / 60.0).collect();
        for shares in shares.chunks(3).chain(std::iter::once(&shares[..])) {
            let places = places(&text);
            let mut start = 0;
            let mut expected = Vec::new();
            for share in shares {
                let cost = |place: &&SentenceCut| (place.share - share).abs() + place.cost;
                let behind = places.iter().filter(|place| place.at >= start);
                let end = behind.min_by(|a, b| cost(a).total_cmp(&cost(b))).map_or(text.len(), |place| place.at);
                expected.push(trim(&text[start..end]).to_owned());
                start = end;
            }
            expected.push(trim(&text[start..]).to_owned());
            assert_eq!(cut(&text, shares), expected);
        }
    }

    #[test]
    fn nothing_of_the_text_is_lost() {
        let text = "Aye, sir. The light, the light! It went out at ten.";
        for share in [[0.1, 0.2, 0.9], [0.0, 0.5, 1.0], [0.9, 0.1, 0.5]] {
            assert_eq!(words(&cut(text, &share).join(" ")).collect::<Vec<_>>(), words(text).collect::<Vec<_>>());
        }
    }
}
