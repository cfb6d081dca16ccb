//! The tokens that the network names: symbols of the IPA, borders of words, and nothing.

use crate::pronounce::ipa_phones;

/// A token.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Token {
    /// Nothing new is heard.
    Blank,
    /// A word ends.
    Border,
    /// Symbols of the IPA.
    Symbols(String),
    /// Anything else.
    Other,
}

/// Tokens by their names; none if there is no blank.
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
