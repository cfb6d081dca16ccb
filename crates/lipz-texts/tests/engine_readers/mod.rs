//! The readers of engines, made again after their sources: what they accept, and which texts a player then sees.
//!
//! They follow the behaviour of Unity Localization 1.5.7 (`Plugins/CSV/Columns`), Yarn Spinner for Unity 3.2.7
//! (`StringTableEntry`, `YarnImporter`), Godot 4.6 (`ResourceImporterCSVTranslation`, `String::c_unescape`) and Unreal 5
//! (`FStringTable::ImportStrings`, `FString::ReplaceEscapedCharWithChar`).

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Texts by key.
pub(crate) type Texts = BTreeMap<String, String>;

/// Returns the rows of a CSV file, the first of which has the names of its columns.
fn rows(file: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(file.as_bytes());
    let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let head = cells(reader.headers().unwrap());
    (head, reader.records().map(|record| cells(&record.unwrap())).collect())
}

fn place(head: &[String], name: &str) -> Option<usize> {
    head.iter().position(|known| known == name)
}

/// Returns the texts of a locale in Unity. Its column has the name of the culture and the code. Without such a column,
/// all texts are empty.
pub(crate) fn unity(file: &str, culture: &str, code: &str) -> Texts {
    let (head, rows) = rows(file);
    let (key, text) = (place(&head, "Key").unwrap(), place(&head, &format!("{culture}({code})")));
    let text_of = |row: &Vec<String>| text.and_then(|at| row.get(at)).cloned().unwrap_or_default();
    rows.iter().map(|row| (row[key].clone(), text_of(row))).collect()
}

/// Returns the texts of a strings file of Yarn Spinner, after an update with the project's `lines`. Lines whose lock is
/// that of an older text need work; lines that the project does not have are lost.
pub(crate) fn yarn(file: &str, lines: &[(&str, &str)]) -> Texts {
    let (head, rows) = rows(file);
    let at = |name: &str| place(&head, name).unwrap();
    let (id, text, lock) = (at("id"), at("text"), at("lock"));
    let mut texts = Texts::new();
    for (name, base) in lines {
        let Some(row) = rows.iter().find(|row| row[id] == *name) else { continue };
        let hash = Sha256::digest(base.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
        let is_current = row[lock] == hash[..8];
        let text = if is_current { row[text].clone() } else { format!("(NEEDS UPDATE) {}", row[text]) };
        texts.insert((*name).to_owned(), text);
    }
    texts
}

/// Returns the texts of a locale in Godot. Columns whose names start with `_` are skipped, and cells are unescaped.
pub(crate) fn godot(file: &str, locale: &str) -> Texts {
    const ESCAPES: [(&str, &str); 10] = [
        ("\\a", "\u{7}"),
        ("\\b", "\u{8}"),
        ("\\f", "\u{c}"),
        ("\\n", "\n"),
        ("\\r", "\r"),
        ("\\t", "\t"),
        ("\\v", "\u{b}"),
        ("\\'", "'"),
        ("\\\"", "\""),
        ("\\\\", "\\"),
    ];
    let (head, rows) = rows(file);
    let at = place(&head, locale).filter(|_| !locale.starts_with('_')).unwrap();
    rows.iter().map(|row| (row[0].clone(), replaced(&row[at], &ESCAPES))).collect()
}

/// Returns the source texts of a string table in Unreal.
pub(crate) fn unreal(file: &str) -> Texts {
    const ESCAPES: [(&str, &str); 6] =
        [("\\\"", "\""), ("\\'", "'"), ("\\t", "\t"), ("\\r", "\r"), ("\\n", "\n"), ("\\\\", "\\")];
    let (head, rows) = rows(file);
    let (key, source) = (place(&head, "Key").unwrap(), place(&head, "SourceString").unwrap());
    let text = |row: &Vec<String>, at: usize| replaced(&row[at], &ESCAPES);
    rows.iter().map(|row| (text(row, key), text(row, source))).collect()
}

/// Replaces escapes one after the other, as both engines do: an escaped backslash before an `n` is a line end, too.
fn replaced(cell: &str, escapes: &[(&str, &str)]) -> String {
    escapes.iter().fold(cell.to_owned(), |text, (escape, character)| text.replace(escape, character))
}

/// Returns the translations that Unreal imports from a PO file, by namespace and key, joined by a comma. Follows Unreal 5
/// (`PortableObjectPipeline::ImportPortableObject`): entries are found by namespace and key, entries without a
/// translation or with an unknown key are skipped, and flags such as `fuzzy` have no effect. The engine shows a
/// translation only if its source text is that of the game.
pub(crate) fn unreal_po(file: &str, game: &[(&str, &str, &str)]) -> Texts {
    let mut texts = Texts::new();
    let mut fields: BTreeMap<&str, String> = BTreeMap::new();
    let mut field = "";
    for line in file.lines().chain([""]) {
        let keyword = ["msgctxt", "msgid", "msgstr"].into_iter().find(|name| line.starts_with(&format!("{name} \"")));
        field = keyword.unwrap_or(field);
        if let (Some(start), Some(end)) = (line.find('"'), line.rfind('"'))
            && !line.starts_with('#')
        {
            fields.entry(field).or_default().push_str(&line[start + 1..end]);
        }
        if !line.trim().is_empty() {
            continue;
        }
        let own = |name: &str| unreal_po_text(fields.get(name).map_or("", String::as_str));
        let (context, source, text) = (own("msgctxt"), own("msgid"), own("msgstr"));
        fields.clear();
        let (namespace, key) = unreal_identity(&context);
        let is_known = |known: &&(&str, &str, &str)| (known.0, known.1) == (namespace.as_str(), key.as_str());
        if let Some(known) = game.iter().find(is_known)
            && !source.is_empty()
            && !text.is_empty()
            && known.2 == source
        {
            texts.insert(format!("{namespace},{key}"), text);
        }
    }
    texts
}

/// Replaces the escapes of a PO file as Unreal does: one after the other.
fn unreal_po_text(text: &str) -> String {
    let escapes = [("\\t", "\t"), ("\\n", "\n"), ("\\r", "\r"), ("\\\"", "\""), ("\\\\", "\\")];
    escapes.iter().fold(text.to_owned(), |text, (escape, character)| text.replace(escape, character))
}

/// Divides a context at its first comma without a backslash: the namespace and the key.
fn unreal_identity(context: &str) -> (String, String) {
    let mut is_escaped = false;
    for (at, character) in context.char_indices() {
        match character {
            _ if is_escaped => is_escaped = false,
            ',' => return (context[..at].replace("\\,", ","), context[at + 1..].replace("\\,", ",")),
            '\\' => is_escaped = true,
            _ => {}
        }
    }
    (context.to_owned(), String::new())
}
