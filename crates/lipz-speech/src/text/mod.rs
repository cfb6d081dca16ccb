//! Texts as they are spoken: the words of each segment, without `{meta}`, with what `{say: …}` tells about them.

mod apostrophe;
mod display;
pub(crate) mod numbers;
mod runs;
mod say;
mod tokens;

pub(crate) use runs::{Writing, writing};
pub(crate) use tokens::{Context, Item, Kind, Spelling, Token, items};
