//! Blends of emotions as people write them: `anger 2.2 + joy 3 over 0.4s`.
//!
//! In the meta of a text (`{anger 6, joy 1}`), they apply from the next word on; in events (`feels anger 6 + joy 1`),
//! from the start of the segment. A blend describes the whole face: unnamed emotions are 0.

mod near;
mod presets;

pub use near::NearBlend;
pub use presets::{Feeling, PRESETS, preset};

use crate::curve::thousandths;
use crate::event::Word;
use crate::text::is_white_space;

/// A blend of emotions.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Blend<'t> {
    /// Its emotions, at least one.
    pub terms: Vec<Term<'t>>,
    /// The milliseconds in which the face changes; `None` for the project's default.
    pub over_ms: Option<u32>,
}

/// An emotion of a blend, possibly unknown.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Term<'t> {
    /// Its name.
    pub name: Word<'t>,
    /// Its value in thousandths, if specified.
    pub thousandths: Option<i32>,
}

/// The maximal time of a change, in milliseconds.
const MOST_OVER_MS: u32 = 60_000;

impl<'t> Blend<'t> {
    /// Parses a text as a blend. The text starts at byte `start` of its segment. `None` if it is something else. The
    /// emotions are separated by `+` or `,`.
    ///
    /// ```
    /// use lipz_file::emotion::Blend;
    /// let blend = Blend::parse("anger 2.2 + joy over 0.4s", 0).ok_or("a blend")?;
    /// assert_eq!((blend.terms[0].thousandths, blend.terms[1].name.text, blend.over_ms), (Some(2200), "joy", Some(400)));
    /// assert!(Blend::parse("whispers to the others", 0).is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn parse(text: &'t str, start: usize) -> Option<Blend<'t>> {
        let (text, over_ms) = match text.rsplit_once(" over ") {
            Some((blend, time)) => (blend, Some(milliseconds(time.trim_matches(is_white_space))?)),
            None => (text, None),
        };
        let mut at = 0;
        let mut terms = Vec::new();
        for part in text.split(['+', ',']) {
            terms.push(term(part, start + at)?);
            at += part.len() + 1;
        }
        Some(Blend { terms, over_ms })
    }

    /// Whether one of its emotions has a value.
    pub fn has_value(&self) -> bool {
        self.terms.iter().any(|term| term.thousandths.is_some())
    }

    /// Returns the emotion with the highest value, or the first of several.
    pub fn strongest(&self) -> Option<Word<'t>> {
        let value = |term: &Term<'_>| term.thousandths.unwrap_or(0);
        let most = self.terms.iter().map(value).max()?;
        self.terms.iter().find(|term| value(term) == most).map(|term| term.name)
    }
}

/// Parses `NAME [VALUE]`.
fn term(part: &str, start: usize) -> Option<Term<'_>> {
    let mut words = part.split(is_white_space).filter(|word| !word.is_empty());
    let (name, value) = (words.next()?, words.next());
    let is_name = name.starts_with(char::is_alphabetic) && words.next().is_none();
    let name = Word { text: name, start: start + (name.as_ptr() as usize - part.as_ptr() as usize) };
    match value.map(thousandths) {
        _ if !is_name => None,
        None => Some(Term { name, thousandths: None }),
        Some(Ok(value)) => Some(Term { name, thousandths: Some(value) }),
        Some(Err(_)) => None,
    }
}

/// Parses `0.4s` or `400ms`.
fn milliseconds(time: &str) -> Option<u32> {
    let (number, is_milli) = match time.strip_suffix("ms") {
        Some(number) => (number, true),
        None => (time.strip_suffix('s')?, false),
    };
    let thousandths = u32::try_from(thousandths(number).ok()?).ok()?;
    let milliseconds = if is_milli { thousandths / 1000 } else { thousandths };
    (milliseconds <= MOST_OVER_MS).then_some(milliseconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Name, value and offset of an emotion.
    type EmotionTerm<'t> = (&'t str, Option<i32>, usize);

    fn blend(text: &str) -> Option<(Vec<EmotionTerm<'_>>, Option<u32>)> {
        let blend = Blend::parse(text, 0)?;
        let terms = blend.terms.iter().map(|term| (term.name.text, term.thousandths, term.name.start));
        Some((terms.collect(), blend.over_ms))
    }

    #[test]
    fn blends_of_every_shape() {
        assert_eq!(blend("calm"), Some((vec![("calm", None, 0)], None)));
        assert_eq!(blend(" anger 6, joy 1 "), Some((vec![("anger", Some(6000), 1), ("joy", Some(1000), 10)], None)));
        assert_eq!(
            blend("anger 2.2+fear over 250ms"),
            Some((vec![("anger", Some(2200), 0), ("fear", None, 10)], Some(250)))
        );
        assert_eq!(blend("joy -1 over 2s"), Some((vec![("joy", Some(-1000), 0)], Some(2000))));
    }

    #[test]
    fn notes_are_no_blends() {
        for text in
            ["", "whispers softly", "anger six", "to: amy", "0", "joy 1 over it", "joy 1,", "a 1 2", "joy 1 over 2h"]
        {
            assert_eq!(blend(text), None, "{text}");
        }
    }
}
