//! Spoken texts: the words of each segment, without `{meta}`, with their `{say: …}`.

mod apostrophe;
mod display;
pub(crate) mod numbers;
mod runs;
mod say;
mod stutter;
mod tokens;

pub(crate) use runs::{WritingSystem, writing};
pub(crate) use tokens::{Context, Item, Spelling, Token, TokenKind, items};
