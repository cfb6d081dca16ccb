//! The files of a dialogue, one by one: for programs that keep them in their own way, and for tools.

pub use crate::dialogue::{DialogueError, DialogueFile, FileKind, Files, Layer};
pub use crate::set_index::{SetBank, SetIndex};
