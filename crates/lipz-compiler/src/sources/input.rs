//! The inputs of a run: Lipz files with their keys.

use crate::files::path::display;
use crate::sources::key::EXTENSION;
use lipz_diagnostics::Report;
use std::borrow::Cow;
use std::ops::Deref;
use std::path::PathBuf;

/// A Lipz file to pack.
#[derive(Clone, Debug)]
pub struct Input {
    /// The clip's key: its path relative to the source root, with `/`, without extension.
    pub key: String,
    /// The source of the bytes.
    pub content: Content,
}

/// The Lipz files of a project, sorted by path: a slice of [`Input`]s.
///
/// [`Settings::discover`](crate::settings::Settings::discover) finds them.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    pub(crate) inputs: Vec<Input>,
    pub(crate) warnings: Vec<Report>,
}

impl Inputs {
    /// Returns the warnings about the sources, which are errors that the project has lowered.
    pub fn warnings(&self) -> &[Report] {
        &self.warnings
    }

    /// Returns the inputs without the warnings.
    pub fn into_vec(self) -> Vec<Input> {
        self.inputs
    }
}

impl Deref for Inputs {
    type Target = [Input];

    fn deref(&self) -> &[Input] {
        &self.inputs
    }
}

/// The bytes of an input.
#[derive(Clone, Debug)]
pub enum Content {
    /// In a file.
    File(PathBuf),
    /// In memory.
    Bytes {
        /// The name of the file in messages.
        name: String,
        /// The bytes.
        bytes: Vec<u8>,
    },
}

impl Input {
    /// Creates an input in memory from a string or bytes, with the name `key.lipz` in messages.
    ///
    /// The bytes are copied. To avoid that, fill in [`Content::Bytes`].
    ///
    /// ```
    /// use lipz_compiler::Input;
    /// let text = String::from(r#"{ "text_en-us": "Aye." }"#);
    /// let inputs = [Input::from_bytes("a", &text), Input::from_bytes("b", text.as_bytes()), Input::from_bytes("c", "{}")];
    /// assert_eq!(inputs[1].name(), "b.lipz");
    /// ```
    pub fn from_bytes(key: impl Into<String>, bytes: impl AsRef<[u8]>) -> Input {
        let key = key.into();
        let name = format!("{key}.{EXTENSION}");
        Input { content: Content::Bytes { name, bytes: bytes.as_ref().to_vec() }, key }
    }

    /// Returns the name of the file in messages: its path, with `/` on every system.
    pub fn name(&self) -> String {
        self.shown_name().into_owned()
    }

    /// Returns the same without a copy, if possible.
    pub(crate) fn shown_name(&self) -> Cow<'_, str> {
        match &self.content {
            Content::File(path) => Cow::Owned(display(path)),
            Content::Bytes { name, .. } => Cow::Borrowed(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_and_bytes_are_inputs() {
        let (text, bytes) = (String::from("{}"), b"{}".to_vec());
        let inputs = [
            Input::from_bytes("a", &text),
            Input::from_bytes("a", text.as_str()),
            Input::from_bytes("a", text.clone()),
            Input::from_bytes("a", &bytes),
            Input::from_bytes("a", bytes.as_slice()),
            Input::from_bytes("a", bytes.clone()),
            Input::from_bytes(String::from("a"), b"{}"),
        ];
        for Input { key, content } in inputs {
            assert_eq!(key, "a");
            assert!(matches!(content, Content::Bytes { name, bytes } if name == "a.lipz" && bytes == b"{}"));
        }
    }
}
