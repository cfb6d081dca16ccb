//! The individual files of a dialogue, for programs with their own storage, and for tools.

pub use crate::dialogue::{DialogueError, DialogueFile, FileKind, Files, Layer};
pub use crate::set_index::{SetBank, SetIndex};
