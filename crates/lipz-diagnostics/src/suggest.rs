//! "Did you mean": the known name nearest to a misspelt one.

/// The greatest length of names that are compared, in bytes, because the work grows with the product of the lengths.
const LONGEST_COMPARED: usize = 200;

/// The number of letters of a known name per letter that may differ.
const LETTERS_PER_CHANGE: usize = 3;

/// Returns the known name that was probably meant by `written`, or the first of several that are equally near.
///
/// Case, separators and other signs are ignored. In every three letters of the known name, one may be missing, wrong,
/// extra or swapped with the next.
///
/// ```
/// use lipz_diagnostics::suggest;
/// let elements = ["fps", "visemes", "viseme_type", "events"];
/// assert_eq!(suggest::nearest("Viseme-Typ", elements), Some("viseme_type"));
/// assert_eq!(suggest::nearest("subtitle", elements), None);
/// ```
pub fn nearest<'k>(written: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let near = known.into_iter().filter_map(|known| Some((distance(written, known)?, known)));
    near.min_by_key(|&(distance, _)| distance).map(|(_, known)| known)
}

/// Returns the number of letters to change to get from `written` to `known`; `None` if there are too many for a
/// misspelling.
///
/// ```
/// use lipz_diagnostics::suggest;
/// assert_eq!(suggest::distance("suspicous", "suspicious"), Some(1));
/// assert_eq!(suggest::distance("FPS", "fps"), Some(0));
/// assert_eq!(suggest::distance("jealous", "suspicious"), None);
/// ```
pub fn distance(written: &str, known: &str) -> Option<usize> {
    if written.len().max(known.len()) > LONGEST_COMPARED {
        return None;
    }
    let known = letters(known);
    let distance = strsim::damerau_levenshtein(&letters(written), &known);
    (distance * LETTERS_PER_CHANGE <= known.chars().count()).then_some(distance)
}

/// Returns the compared form: letters and digits, in lower case.
fn letters(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_letter_of_three_may_differ() {
        assert_eq!(nearest("fbs", ["fps"]), Some("fps"));
        assert_eq!(nearest("fbz", ["fps"]), None);
        assert_eq!(nearest("vismees", ["events", "visemes"]), Some("visemes"));
        assert_eq!(nearest("灯台守る", ["灯台守り"]), Some("灯台守り"), "letters, not bytes");
    }

    #[test]
    fn the_nearest_wins_and_then_the_first() {
        assert_eq!(nearest("amusd", ["abused", "amused"]), Some("amused"));
        assert_eq!(nearest("sae", ["sad", "sat"]), Some("sad"));
    }

    #[test]
    fn very_long_names_are_not_compared() {
        let long = "x".repeat(LONGEST_COMPARED);
        assert_eq!(distance(&long, &long), Some(0));
        assert_eq!(distance(&format!("{long}x"), &long), None);
    }
}
