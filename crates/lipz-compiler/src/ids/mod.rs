//! Constants for programs: the clip ids and locales of a dialogue as source code, so that a misspelt key
//! does not compile.
//!
//! An identifier is made of the words of a key, part by part: runs of letters, digits and other
//! characters that Unicode allows in identifiers, divided where a capital starts a new word. What
//! else a key contains only divides words. `act1/mara-good evening` gives
//!
//! | language | identifier |
//! | --- | --- |
//! | Rust | `act1::MARA_GOOD_EVENING` |
//! | C | `LIPZ_ID_ACT1_MARA_GOOD_EVENING` |
//! | C# | `Clips.Act1.MaraGoodEvening` |
//! | TypeScript | `act1.maraGoodEvening` |
//!
//! `_` is put in front of a digit that cannot start an identifier, behind a word that the language
//! reserves, and, in C# and TypeScript, behind a clip that is named like a folder beside it. C names
//! are ASCII: letters lose their accents, other characters are spelled by number (`U306F`), as is in
//! every language a part without any letter or digit. Two keys with the same identifier are a
//! diagnostic, [`Code::IdentifierClash`](lipz_diagnostics::Code::IdentifierClash).

mod c;
mod csharp;
mod json;
mod rust;
mod tree;
mod typescript;
mod words;

use crate::dialogue::{clips_by_key, locales_by_tag};
use lipz_bank::{Clip, Dialogue};
use lipz_diagnostics::Diagnostic;
use tree::Folder;

/// A language that ids are written in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Language {
    /// A Rust file for `include!`: a module per folder, a `const` per clip. It needs `lipz-bank` and
    /// no `std`.
    Rust,
    /// A header for C99, C++11 and later: a macro per clip, of type `uint64_t`.
    C,
    /// A C# file: a static class per folder, a `const ulong` per clip.
    CSharp,
    /// A TypeScript module: an object per folder, a `bigint` per clip, a type of all keys.
    TypeScript,
    /// A JSON object with all keys, their ids as 16 hexadecimal digits, and all locales.
    Json,
}

impl Language {
    /// Every language.
    pub const ALL: [Language; 5] =
        [Language::Rust, Language::C, Language::CSharp, Language::TypeScript, Language::Json];

    /// The name as messages spell it.
    pub const fn name(self) -> &'static str {
        match self {
            Language::Rust => "Rust",
            Language::C => "C",
            Language::CSharp => "C#",
            Language::TypeScript => "TypeScript",
            Language::Json => "JSON",
        }
    }

    /// The prefix unless another is chosen: what every C name starts with, and the C# namespace.
    /// `None` for languages whose files have names of their own.
    pub const fn default_prefix(self) -> Option<&'static str> {
        match self {
            Language::C => Some(c::DEFAULT_PREFIX),
            Language::CSharp => Some("Lipz"),
            Language::Rust | Language::TypeScript | Language::Json => None,
        }
    }

    /// Whether `prefix` can be the prefix: an ASCII identifier, in C# also several with dots. In C it must lead to
    /// no name of `lipz.h` (a clip `ok` would be `LIPZ_OK`) and to none that the language keeps for itself.
    pub fn accepts_prefix(self, prefix: &str) -> bool {
        let is_identifier = |name: &str| {
            name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
                && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        };
        match self {
            Language::C => is_identifier(prefix) && !c::is_taken(prefix),
            Language::CSharp => prefix.split('.').all(is_identifier),
            Language::Rust | Language::TypeScript | Language::Json => false,
        }
    }
}

/// The ids of a dialogue's clips but dubs, and its locales, as source code.
///
/// `prefix` replaces the language's own; one that [`Language::accepts_prefix`] refuses is not used.
///
/// ```
/// use lipz_compiler::ids::{Language, generate};
/// use lipz_compiler::{Compiler, Input};
///
/// let file = Input::from_bytes("act1/mara-hello", r#"{ "text_en-us": "Hello, Otto." }"#);
/// let bytes = Compiler::default().compile(&[file]).bank.ok_or("errors")?;
/// let mut files = [lipz_bank::files::DialogueFile::ABSENT];
/// let dialogue = lipz_bank::Dialogue::open(&mut files, [bytes.as_slice()])?;
/// let header = generate(&dialogue, Language::C, None).map_err(|_| "clashes")?;
/// assert!(header.contains("#define LIPZ_ID_ACT1_MARA_HELLO UINT64_C(0x"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Keys that have the same identifier in this language.
pub fn generate(dialogue: &Dialogue<'_>, language: Language, prefix: Option<&str>) -> Result<String, Vec<Diagnostic>> {
    let prefix =
        prefix.filter(|prefix| language.accepts_prefix(prefix)).or(language.default_prefix()).unwrap_or_default();
    let of_dialogue = locales_by_tag(dialogue);
    let locales: Vec<&str> = of_dialogue.iter().map(|locale| locale.tag).collect();
    let clips = asked_for(dialogue);
    let tree = |naming| Folder::new(&clips, &of_dialogue, naming, language.name());
    Ok(match language {
        Language::Rust => rust::module(&tree(rust::identifiers)?, &locales),
        Language::C => c::header(&tree(c::identifiers)?, &locales, prefix),
        Language::CSharp => csharp::file(&tree(csharp::identifiers)?, &locales, prefix),
        Language::TypeScript => typescript::module(&tree(typescript::identifiers)?, &locales, &clips),
        Language::Json => json::object(&clips, &locales),
    })
}

/// The clips that programs ask for by their ids: dubs are found by those of their originals.
fn asked_for<'d>(dialogue: &'d Dialogue<'d>) -> Vec<Clip<'d>> {
    let mut clips = clips_by_key(dialogue);
    clips.retain(|clip| clip.original().is_none());
    clips
}

/// What every generated file starts with, as far as it can have comments.
const NOTICE: &str = "Clip ids and locales of a lipz bank. Made by lipz: changes are lost.";

/// The text as a string of JSON, which is also one of TypeScript, C# and, for ASCII, C.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
