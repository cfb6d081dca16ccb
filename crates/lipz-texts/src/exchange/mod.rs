//! Exchange with translators: the texts of clips, the entries of files, and their comparison.

pub(crate) mod changes;
pub(crate) mod clip_texts;
mod collect;
pub(crate) mod culture;
pub(crate) mod decode;
pub mod difference;
pub(crate) mod entry;
pub(crate) mod mark;
pub(crate) mod markup;
pub(crate) mod model;
pub(crate) mod placeholder;
pub(crate) mod tag;
pub(crate) mod unreal;
pub(crate) mod variants;
mod words;
pub(crate) mod write_options;

pub use clip_texts::{ClipTexts, texts_of};
pub use collect::Collect;
pub use entry::{ChosenTake, Entry, IncomingFile, ReadOptions, Words};
pub use mark::Mark;
pub use model::{Division, Exchange, Segment, State, Translation, Unit};
pub use variants::{ClipSources, SourceTexts};
pub use words::words;
pub use write_options::{Shape, WriteOptions};
