//! The columns of a script, found by the names that people and other tools give them.

use super::YARN_LINE;
use crate::script::Purpose;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::locale::canonical_tag;
use lipz_file::table::Rows;

/// The names of the column with the files, the best first. Spaces, `-` and `_` are ignored, as is case.
const FILES: [&str; 20] = [
    "file",
    "filename",
    "filepath",
    "path",
    "audio",
    "audiofile",
    "audiofilename",
    "audiopath",
    "wav",
    "wavfile",
    "wavname",
    "sound",
    "soundfile",
    "recording",
    "recordingfile",
    "voice",
    "voicefile",
    "vofile",
    "vofilename",
    "asset",
];

/// The names of the column with the IDs, the best first.
const IDS: [&str; 7] = ["clip", "key", "lineid", "utteranceid", "stringid", "id", "identifier"];

/// The names of the column with the texts, the best first.
const TEXTS: [&str; 17] = [
    "text",
    "transcript",
    "transcription",
    "script",
    "dialogue",
    "dialog",
    "dialogueline",
    "dialogtext",
    "sentence",
    "utterance",
    "spokentext",
    // Unreal.
    "spokendialogue",
    "subtitle",
    "caption",
    "content",
    "source",
    "sourcetext",
];

/// The name of a column with texts, unless columns are named after locales: then it has the numbers of lines.
const LINE: [&str; 1] = ["line"];

/// The characters that may separate columns. Where the comma is the decimal point, spreadsheets write semicolons.
const DELIMITERS: [u8; 4] = [b',', b';', b'\t', b'|'];

/// The used columns of a script.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Columns {
    pub(super) delimiter: u8,
    /// The index of the column with the files or IDs, and of that with the texts.
    pub(super) name: usize,
    pub(super) text: usize,
    pub(super) origin: TableOrigin,
    /// Whether the first one has IDs, which are no paths of files.
    pub(super) is_id: bool,
}

/// The tool that wrote a table.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum TableOrigin {
    YarnSpinner,
    RenPy,
    Other,
}

/// Returns the columns by the names in the first line of a script.
pub(super) fn find(script: &str, purpose: Purpose<'_>) -> Result<Columns, Box<Diagnostic>> {
    let of = |delimiter| Some((delimiter, head(script, delimiter)?));
    let heads: Vec<(u8, Vec<String>)> = DELIMITERS.into_iter().filter_map(of).collect();
    let both = |(delimiter, names): &(u8, Vec<String>)| {
        let (name, is_id, origin) = name(names, purpose, has_yarn_ids(script, *delimiter, names))?;
        Some(Columns { delimiter: *delimiter, name, text: text(names, name, purpose)?, origin, is_id })
    };
    heads.iter().find_map(both).ok_or_else(|| {
        // The delimiter that divides the line into most columns is the one that was meant.
        let names = heads.iter().map(|(_, names)| names.as_slice()).max_by_key(|names| names.len());
        Box::new(without_columns(script, names.unwrap_or_default(), purpose))
    })
}

fn head(script: &str, delimiter: u8) -> Option<Vec<String>> {
    let head = Rows::new(script, delimiter).next()?.ok()?;
    Some(head.iter().map(|cell| cell.text.trim().to_owned()).collect())
}

/// Whether the first ID in the column `id` is one of Yarn Spinner. Its recording sheets have the columns that a project
/// chooses.
fn has_yarn_ids(script: &str, delimiter: u8, names: &[String]) -> bool {
    let Some(id) = column(names, &["id"]) else { return false };
    let mut rows = Rows::new(script, delimiter).skip(1).map_while(Result::ok);
    let first = rows.find_map(|row| row.get(id).map(|cell| cell.text.trim().to_owned()).filter(|id| !id.is_empty()));
    first.is_some_and(|id| id.starts_with(YARN_LINE))
}

/// Returns the column with the names of recordings or the IDs of lines, whether it has IDs, and the tool.
fn name(names: &[String], purpose: Purpose<'_>, has_yarn_ids: bool) -> Option<(usize, bool, TableOrigin)> {
    if let Some(id) = column(names, &["id"]).filter(|_| has_yarn_ids) {
        return Some((id, true, TableOrigin::YarnSpinner));
    }
    if let Some((id, origin)) = id(names) {
        return Some((id, true, origin));
    }
    let file = || Some((column(names, &FILES)?, false, TableOrigin::Other));
    let id = || column(names, &IDS);
    match purpose {
        // Scripts of recordings may have the names of files in such a column, with extensions.
        Purpose::Recordings => file().or_else(|| Some((id()?, false, TableOrigin::Other))),
        Purpose::Lines { .. } => id().map(|id| (id, true, TableOrigin::Other)).or_else(file),
    }
}

/// Returns the column with the best of these names.
fn column(names: &[String], known: &[&str]) -> Option<usize> {
    let plain: Vec<String> = names.iter().map(|name| plain(name)).collect();
    known.iter().find_map(|known| plain.iter().position(|name| name == known))
}

/// Returns the column with the IDs in tables of Yarn Spinner and Ren'Py, whose column `file` names a part of the script.
fn id(names: &[String]) -> Option<(usize, TableOrigin)> {
    let tables = [("id", "node", TableOrigin::YarnSpinner), ("identifier", "dialogue", TableOrigin::RenPy)];
    tables.into_iter().find_map(|(id, other, origin)| {
        column(names, &[other])?;
        Some((column(names, &[id])?, origin))
    })
}

/// Returns the column with the texts: by its name, or the one named after the wanted or the only locale, `en-us` or
/// `text_en-us`.
fn text(names: &[String], name: usize, purpose: Purpose<'_>) -> Option<usize> {
    let locale_of = |name: &String| {
        let tag = name.strip_prefix("text_").unwrap_or(name);
        // A language alone may be a word, such as `key`.
        tag.contains(['-', '_']).then(|| canonical_tag(tag, true))?
    };
    let all = (0..).zip(names).filter(|(at, _)| *at != name);
    let of_locales: Vec<(usize, String)> = all.filter_map(|(at, name)| Some((at, locale_of(name)?))).collect();
    let named = |known: &[&str]| column(names, known).filter(|text| *text != name);
    named(&TEXTS).or_else(|| match (of_locales.as_slice(), purpose) {
        ([], _) => named(&LINE),
        ([(only, _)], _) => Some(*only),
        (several, Purpose::Lines { locale, .. }) => {
            several.iter().find(|(_, tag)| Some(tag.as_str()) == locale).map(|(at, _)| *at)
        }
        (_, Purpose::Recordings) => None,
    })
}

/// Returns a name as it is compared.
fn plain(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, ' ' | '-' | '_' | '.')).flat_map(char::to_lowercase).collect()
}

/// Returns the diagnostic for a first line that does not name both columns.
fn without_columns(script: &str, names: &[String], purpose: Purpose<'_>) -> Diagnostic {
    let wanted = match purpose {
        Purpose::Recordings => "file",
        Purpose::Lines { .. } => "id",
    };
    let name = name(names, purpose, false).map(|(name, ..)| name);
    let missing = match (name, text(names, name.unwrap_or(usize::MAX), purpose)) {
        (Some(_), None) => Some("text"),
        (None, Some(_)) => Some(wanted),
        _ => None,
    };
    let message = match missing {
        Some(name) => format!("the first line has no column `{name}`"),
        None => "the first line does not name the columns".to_owned(),
    };
    let end = script.lines().next().map_or(0, str::len);
    let mut diagnostic = Diagnostic::at(Code::ForeignSyntax, Span::new(0, end), message);
    if missing.is_some() {
        let shown: Vec<String> = names.iter().map(|name| escape::quoted(name).to_string()).collect();
        diagnostic = diagnostic.note(format!("its columns: {}", shown.join(", ")));
    }
    diagnostic.help(format!("name the columns `{wanted}` and `text`; other columns are ignored"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_other_tools() {
        for (head, file, text) in [
            ("file,text", 0, 1),
            ("text,FILE", 1, 0),
            ("Character,Line ID,Dialogue,Audio File", 3, 2),
            ("Filename;Transcript;Notes", 0, 1),
            ("wav\tsentence", 0, 1),
            ("client_id\tpath\tsentence\tlocale", 1, 2),
            ("id|text|speaker", 0, 1),
            ("key,en-us,note", 0, 1),
            ("key,recording,text_en-us", 1, 2),
            ("language,id,text,file,node", 1, 2),
            ("Identifier\tCharacter\tDialogue\tFilename\tLine Number\tRen'Py Script", 0, 2),
            ("VO_Filename,Text,Source", 0, 1),
        ] {
            let columns = find(&format!("{head}\n"), Purpose::Recordings).map(|columns| (columns.name, columns.text));
            assert_eq!(columns, Ok((file, text)), "{head}");
        }
        for (head, message) in [
            ("name,words", "the first line does not name the columns"),
            ("file;words", "the first line has no column `text`"),
            ("who,text", "the first line has no column `file`"),
            ("key,en-us,de-de", "the first line has no column `text`"),
            ("text", "the first line has no column `file`"),
            ("source", "the first line has no column `file`"),
        ] {
            let found = find(head, Purpose::Recordings).map_err(|diagnostic| diagnostic.message);
            assert_eq!(found, Err(message.to_owned()), "{head}");
        }
    }

    #[test]
    fn lines_are_named_by_ids() {
        for (head, name, is_id, text) in [
            ("Character,Line ID,Dialogue,Audio File", 1, true, 2),
            ("file,id,text", 1, true, 2),
            ("key,recording,text_en-us", 0, true, 2),
            ("Filename;Transcript;Notes", 0, false, 1),
            ("id,Line", 0, true, 1),
            ("line,key,speaker,de_DE,en-us,take", 1, true, 4),
            ("line,key,text_de-de", 1, true, 2),
        ] {
            let found = find(head, Purpose::Lines { locale: Some("en-us"), texts: None })
                .map(|columns| (columns.name, columns.is_id, columns.text));
            assert_eq!(found, Ok((name, is_id, text)), "{head}");
        }
        let without = find("who,text", Purpose::Lines { locale: None, texts: None }).unwrap_err();
        assert_eq!(without.message, "the first line has no column `id`");
        assert_eq!(without.help.as_deref(), Some("name the columns `id` and `text`; other columns are ignored"));
    }
}
