//! The inputs of a run: Lipz files with their keys.

use std::path::PathBuf;

/// One Lipz file to be packed.
#[derive(Clone, Debug)]
pub struct Input {
    /// The clip's key: path below the source root, with `/`, without extension.
    pub key: String,
    /// How messages name the file.
    pub name: String,
    /// Where the bytes are.
    pub content: Content,
}

/// The bytes of an input.
#[derive(Clone, Debug)]
pub enum Content {
    /// In a file.
    File(PathBuf),
    /// Here.
    Bytes(Vec<u8>),
}

impl Input {
    /// An input in memory; messages call it `key.lipz`.
    pub fn from_bytes(key: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Input {
        let key = key.into();
        Input { name: format!("{key}.lipz"), key, content: Content::Bytes(bytes.into()) }
    }
}
