//! Descriptions of rigs: `mouthFunnel = 0.18 rounding + 0.6 rounding*jaw`.

use lipz_bank::articulation::Articulator;
use lipz_bank::face::Emotion;
use lipz_layout::NO_INPUT;

/// A weight of a rig.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WeightSpec {
    /// The name of the shape.
    pub name: String,
    /// The terms of the sum.
    pub(super) terms: Vec<Term>,
    /// The range of the weight, in thousandths.
    pub(super) least: i16,
    pub(super) most: i16,
}

#[cfg(feature = "settings")]
impl WeightSpec {
    /// Returns the number of terms.
    pub(crate) fn term_count(&self) -> usize {
        self.terms.len()
    }
}

/// A factor times one input, or the product of two.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Term {
    pub(super) factor_thousandths: i16,
    pub(super) first: u8,
    pub(super) second: u8,
}

/// The problem of a description.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum RigError {
    /// A word is not an input.
    UnknownInput(String),
    /// A word is not a factor from -32 to 32.
    Factor(String),
    /// The name is empty, or the range after it is not two ascending numbers from -32 to 32.
    Name,
    /// The sum is not written as terms with `+` or `-` between them.
    Syntax,
}

/// The inputs after articulators and emotions. `1` is always 1.
const FACE: [&str; 4] = ["blink", "brows", "shrug", "1"];

/// Returns the names of all inputs, in the order of their numbers.
pub fn inputs() -> impl Iterator<Item = &'static str> {
    let face = FACE.into_iter();
    Articulator::ALL.map(Articulator::name).into_iter().chain(Emotion::ALL.map(Emotion::name)).chain(face)
}

/// Returns the weights of a description with one weight per line.
pub(super) fn description(text: &str) -> Result<Vec<WeightSpec>, RigError> {
    let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    lines.map(|line| line.split_once(" = ").ok_or(RigError::Syntax).and_then(|(name, sum)| weight(name, sum))).collect()
}

/// Returns a weight. The name may be followed by its range: `ParamMouthForm [-1 1]`.
///
/// # Errors
/// If the range or the sum is not written as described, or names an unknown input.
pub fn weight(name: &str, sum: &str) -> Result<WeightSpec, RigError> {
    let (name, least, most) = name_and_range(name).ok_or(RigError::Name)?;
    Ok(WeightSpec { name: name.to_owned(), terms: terms(sum)?, least, most })
}

/// Returns the name, and the range in thousandths.
fn name_and_range(text: &str) -> Option<(&str, i16, i16)> {
    let (name, range) = match text.split_once(" [") {
        Some((name, range)) => (name, range.strip_suffix(']')?),
        None => (text, "0 1"),
    };
    let (least, most) = range.split_once(' ')?;
    let (least, most) = (factor(least).ok()?, factor(most).ok()?);
    (!name.is_empty() && least < most).then_some((name, least, most))
}

/// Returns the terms of a sum.
fn terms(sum: &str) -> Result<Vec<Term>, RigError> {
    let mut terms = Vec::new();
    let mut words = sum.split_whitespace().peekable();
    let mut sign = 1;
    loop {
        let word = words.next().ok_or(RigError::Syntax)?;
        let (factor_thousandths, product) = match words.peek() {
            // A factor is followed by its input.
            Some(next) if !matches!(*next, "+" | "-") => (factor(word)?, words.next().unwrap_or_default()),
            _ if word.starts_with(|c: char| c.is_ascii_digit()) => (factor(word)?, "1"),
            _ => (1000, word),
        };
        let (first, second) = match product.split_once('*') {
            Some((first, second)) => (input(first)?, input(second)?),
            None => (input(product)?, NO_INPUT),
        };
        terms.push(Term { factor_thousandths: sign * factor_thousandths, first, second });
        sign = match words.next() {
            None => return Ok(terms),
            Some("+") => 1,
            Some("-") => -1,
            Some(_) => return Err(RigError::Syntax),
        };
    }
}

fn input(name: &str) -> Result<u8, RigError> {
    let number = inputs().position(|known| known == name).and_then(|number| u8::try_from(number).ok());
    number.ok_or_else(|| RigError::UnknownInput(name.to_owned()))
}

/// Returns a decimal number from -32 to 32 in thousandths.
fn factor(text: &str) -> Result<i16, RigError> {
    let wrong = || RigError::Factor(text.to_owned());
    let number: f64 = text.parse().map_err(|_| wrong())?;
    let thousandths = (number * 1000.0).round();
    // Casts saturate, and the range excludes NaN.
    if (-32_000.0..=32_000.0).contains(&thousandths) { Ok(thousandths as i16) } else { Err(wrong()) }
}
