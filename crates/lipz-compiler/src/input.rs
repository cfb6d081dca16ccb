//! The inputs of a run: Lipz files with their keys.

use crate::discover::display;
use crate::key::EXTENSION;
use std::borrow::Cow;
use std::path::PathBuf;

/// One Lipz file to be packed.
#[derive(Clone, Debug)]
pub struct Input {
    /// The clip's key: path below the source root, with `/`, without extension.
    pub key: String,
    /// Where the bytes are.
    pub content: Content,
}

/// The bytes of an input.
#[derive(Clone, Debug)]
pub enum Content {
    /// In a file.
    File(PathBuf),
    /// Here.
    Bytes {
        /// How messages name the file.
        name: String,
        /// The bytes.
        bytes: Vec<u8>,
    },
}

impl Input {
    /// An input in memory; messages call it `key.lipz`.
    pub fn from_bytes(key: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Input {
        let key = key.into();
        Input { content: Content::Bytes { name: format!("{key}.{EXTENSION}"), bytes: bytes.into() }, key }
    }

    /// How messages name the file: by its path, with `/` on every system.
    pub fn name(&self) -> String {
        self.shown_name().into_owned()
    }

    /// The same without a copy, if that is possible.
    pub(crate) fn shown_name(&self) -> Cow<'_, str> {
        match &self.content {
            Content::File(path) => Cow::Owned(display(path)),
            Content::Bytes { name, .. } => Cow::Borrowed(name),
        }
    }
}
