//! A line of the record: path, source locale, translations and source text, with tabs between them.
//!
//! `voices/mayor.lipz⇥en-us⇥de-de:1a2b3c4d,5e6f7a8br fr-fr:-,0a1b2c3dni⇥Mayor? | Mayor!` states that the German texts
//! with these marks, the second of them reviewed (`r`; `f` is final), and the French text of the second segment were made
//! from that English text. The French text needs work (`n`), and comes from an import (`i`).

use super::version::{ApprovedMark, Version};
use crate::exchange::State;
use crate::exchange::clip_texts::trimmed;
use std::fmt;

/// The mark of a segment without information.
const NOTHING: &str = "-";
/// The states, as they follow a mark.
const STATES: [(State, &str); 4] =
    [(State::Initial, "n"), (State::Translated, ""), (State::Reviewed, "r"), (State::Final, "f")];
/// The flag of an imported text, which follows the state.
const IMPORTED: &str = "i";

pub(super) struct Line {
    pub(super) file: String,
    pub(super) version: Version,
}

impl Line {
    /// Parses a line; `None` if it is invalid.
    pub(super) fn parse(line: &str) -> Option<Line> {
        let mut parts = line.splitn(4, '\t');
        let (file, source_locale, translations, source) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
        let mut version = Version {
            source_locale: source_locale.to_owned(),
            sources: trimmed(&unescaped(source)?),
            ..Version::default()
        };
        for translation in translations.split(' ') {
            let (locale, marks) = translation.split_once(':')?;
            let made: Option<Vec<Option<ApprovedMark>>> = marks.split(',').map(made).collect();
            let made = made.filter(|made| made.len() == version.sources.len())?;
            version.made.insert(locale.to_owned(), made);
        }
        let is_whole = !file.is_empty() && !source_locale.is_empty();
        is_whole.then_some(Line { file: unescaped(file)?, version })
    }
}

/// Parses the information about a segment; `None` if it is invalid.
fn made(text: &str) -> Option<Option<ApprovedMark>> {
    if text == NOTHING {
        return Some(None);
    }
    let (mark, flags) = text.split_at_checked(8)?;
    let (flags, is_imported) = flags.strip_suffix(IMPORTED).map_or((flags, false), |flags| (flags, true));
    let state = STATES.iter().find(|(_, name)| *name == flags)?.0;
    Some(Some(ApprovedMark { mark: mark.parse().ok()?, state, is_imported }))
}

/// Returns the marks of a translation without information about any of its segments.
pub(super) fn no_marks(segments: usize) -> String {
    vec![NOTHING; segments].join(",")
}

/// Writes the line of a version, whose source texts are `source`.
pub(super) fn write(f: &mut fmt::Formatter<'_>, file: &str, version: &Version, source: &str) -> fmt::Result {
    escaped(f, file)?;
    write!(f, "\t{}", version.source_locale)?;
    for (number, (locale, made)) in version.made.iter().enumerate() {
        write!(f, "{}{locale}:", if number == 0 { '\t' } else { ' ' })?;
        for (at, made) in made.iter().enumerate() {
            f.write_str(if at == 0 { "" } else { "," })?;
            match made {
                None => f.write_str(NOTHING)?,
                Some(ApprovedMark { mark, state, is_imported }) => {
                    let name = STATES.iter().find(|(known, _)| known == state).map_or("", |(_, name)| name);
                    write!(f, "{mark}{name}")?;
                    f.write_str(if *is_imported { IMPORTED } else { "" })?;
                }
            }
        }
    }
    f.write_str("\t")?;
    escaped(f, source)?;
    f.write_str("\n")
}

/// The characters that would end a part or a line, and their escapes.
const ESCAPES: [(char, char); 4] = [('\\', '\\'), ('\t', 't'), ('\n', 'n'), ('\r', 'r')];

pub(super) fn escaped(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    let mut rest = text;
    while let Some(at) = rest.find(ESCAPES.map(|(character, _)| character)) {
        let (plain, behind) = rest.split_at(at);
        let mut behind = behind.chars();
        let spelled = ESCAPES.iter().find(|(character, _)| Some(*character) == behind.clone().next());
        write!(f, "{plain}\\{}", spelled.map_or('\\', |(_, letter)| *letter))?;
        behind.next();
        rest = behind.as_str();
    }
    f.write_str(rest)
}

pub(super) fn unescaped(text: &str) -> Option<String> {
    let mut out = String::with_capacity(text.len());
    let mut characters = text.chars();
    while let Some(character) = characters.next() {
        match character {
            '\\' => {
                let letter = characters.next()?;
                out.push(ESCAPES.iter().find(|(_, known)| *known == letter)?.0);
            }
            character => out.push(character),
        }
    }
    Some(out)
}
