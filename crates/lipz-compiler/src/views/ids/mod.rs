//! Constants for programs: the clip ids and locales of a dialogue as source code, so that a misspelt key does not
//! compile.
//!
//! An identifier consists of the words of a key, part by part: runs of letters, digits and other characters that
//! Unicode allows in identifiers, divided where a capital starts a new word. All other characters of a key only
//! separate words. `act1/mara-good evening` becomes
//!
//! | language | identifier |
//! | --- | --- |
//! | Rust | `act1::MARA_GOOD_EVENING` |
//! | C | `LIPZ_ID_ACT1_MARA_GOOD_EVENING` |
//! | C# | `Clips.Act1.MaraGoodEvening` |
//! | TypeScript | `act1.maraGoodEvening` |
//!
//! `_` is added before a digit that cannot start an identifier, after a reserved word of the language, and, in C# and
//! TypeScript, after a clip with the name of a folder next to it. C names are ASCII: letters lose their accents, and
//! other characters are replaced by their numbers (`U306F`). In every language, this also applies to a part without any
//! letter or digit. Two keys with the same identifier are a diagnostic,
//! [`Code::IdentifierClash`](lipz_diagnostics::Code::IdentifierClash).

mod c;
mod csharp;
mod json;
mod rust;
mod source_text;
mod tree;
mod typescript;
mod words;

use crate::bank::dialogue::{clips_by_key, locales_by_tag};
use lipz_bank::{Clip, Dialogue};
use lipz_diagnostics::Diagnostic;
use tree::IdFolder;

/// A language of generated ids.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Language {
    /// A Rust file for `include!`: a module per folder, a `const` per clip. It requires `lipz-bank`, but not `std`.
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

    /// Returns the name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Language::Rust => "Rust",
            Language::C => "C",
            Language::CSharp => "C#",
            Language::TypeScript => "TypeScript",
            Language::Json => "JSON",
        }
    }

    /// Returns the default prefix: the start of every C name, and the C# namespace. `None` for languages without a
    /// prefix.
    pub const fn default_prefix(self) -> Option<&'static str> {
        match self {
            Language::C => Some(c::DEFAULT_PREFIX),
            Language::CSharp => Some("Lipz"),
            Language::Rust | Language::TypeScript | Language::Json => None,
        }
    }

    /// Whether `prefix` is valid: an ASCII identifier, in C# also several joined with dots. In C, it must not lead to a
    /// name of `lipz.h` (a clip `ok` would be `LIPZ_OK`) or to a reserved one.
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

/// Returns the ids of a dialogue's clips, without dubs, and its locales as source code.
///
/// `prefix` replaces the default one. A prefix that [`Language::accepts_prefix`] refuses is ignored.
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
/// If keys have the same identifier in this language.
pub fn generate(dialogue: &Dialogue<'_>, language: Language, prefix: Option<&str>) -> Result<String, Vec<Diagnostic>> {
    let prefix =
        prefix.filter(|prefix| language.accepts_prefix(prefix)).or(language.default_prefix()).unwrap_or_default();
    let of_dialogue = locales_by_tag(dialogue);
    let locales: Vec<&str> = of_dialogue.iter().map(|locale| locale.tag).collect();
    let clips = asked_for(dialogue);
    let tree = |naming| IdFolder::new(&clips, &of_dialogue, naming, language.name());
    Ok(match language {
        Language::Rust => rust::module(&tree(rust::identifiers)?, &locales),
        Language::C => c::header(&tree(c::identifiers)?, &locales, prefix),
        Language::CSharp => csharp::file(&tree(csharp::identifiers)?, &locales, prefix),
        Language::TypeScript => typescript::module(&tree(typescript::identifiers)?, &locales, &clips),
        Language::Json => json::object(&clips, &locales),
    })
}

/// Returns the clips that programs look up by id. Dubs are looked up by their originals.
fn asked_for<'d>(dialogue: &'d Dialogue<'d>) -> Vec<Clip<'d>> {
    let mut clips = clips_by_key(dialogue);
    clips.retain(|clip| clip.original().is_none());
    clips
}
