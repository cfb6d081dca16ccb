//! The inputs of a run: Lipz files with their keys.

use crate::discover::display;
use crate::key::EXTENSION;
use lipz_diagnostics::Report;
use std::borrow::Cow;
use std::ops::Deref;
use std::path::PathBuf;

/// One Lipz file to be packed.
#[derive(Clone, Debug)]
pub struct Input {
    /// The clip's key: path below the source root, with `/`, without extension.
    pub key: String,
    /// Where the bytes are.
    pub content: Content,
}

/// The Lipz files of a project, in the order of their paths: a slice of [`Input`]s.
///
/// [`Settings::discover`](crate::settings::Settings::discover) finds them.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    pub(crate) inputs: Vec<Input>,
    pub(crate) warnings: Vec<Report>,
}

impl Inputs {
    /// The warnings about the sources: those that the project has lowered from errors.
    pub fn warnings(&self) -> &[Report] {
        &self.warnings
    }

    /// The inputs without the warnings.
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
    /// Here.
    Bytes {
        /// How messages name the file.
        name: String,
        /// The bytes.
        bytes: Vec<u8>,
    },
}

impl Input {
    /// An input in memory, from a string or from bytes; messages call it `key.lipz`.
    ///
    /// The bytes are copied. A program that owns them and cannot afford that fills in [`Content::Bytes`].
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
