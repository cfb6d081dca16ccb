//! The tokens of the network: symbols of the IPA, word boundaries, and blanks.

use crate::pronounce::ipa_phones;

/// A token.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Token {
    /// No new symbol.
    Blank,
    /// A word boundary.
    Border,
    /// Symbols of the IPA.
    Symbols(String),
    /// Anything else.
    Other,
}

/// Returns tokens from their names, or `None` if there is no blank.
pub(super) fn tokens(names: &[String]) -> Option<Vec<Token>> {
    let token = |name: &String| match name.as_str() {
        "<blank>" => Token::Blank,
        "<wb>" => Token::Border,
        name if ipa_phones(name).is_ok() => Token::Symbols(name.to_owned()),
        _ => Token::Other,
    };
    let tokens: Vec<Token> = names.iter().map(token).collect();
    tokens.contains(&Token::Blank).then_some(tokens)
}
