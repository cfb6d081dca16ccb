//! The texts of a package of articy:draft X, which are in a file next to its objects.

use crate::json::{Node, root};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::locale::{language, language_or_locale};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The ends of the names of a package's files.
const OBJECTS: &str = "_objects.json";
const TEXTS: &str = "_localization.json";

/// The member of a text that is not a language.
const CONTEXT: &str = "Context";

/// Returns the path of the texts that belong to the objects of a package; `None` for other files.
pub(in crate::script) fn path_beside(objects: &Path) -> Option<PathBuf> {
    let name = objects.file_name()?.to_str()?;
    Some(objects.with_file_name(format!("{}{TEXTS}", name.strip_suffix(OBJECTS)?)))
}

/// Whether a file has the texts of a package rather than its objects.
pub(super) fn are_texts(file: Node<'_>) -> bool {
    file.members().first().is_some_and(|(_, text)| text.get(&[CONTEXT]).is_some())
}

/// Reads the texts of a package in a locale, by their keys: `DFr_1A2B3C4D.Text`.
pub(super) fn read(bytes: &[u8], locale: Option<&str>, found: &mut Vec<Diagnostic>) -> HashMap<String, String> {
    let mut faults = Vec::new();
    let text = String::from_utf8_lossy(lipz_file::without_byte_order_mark(bytes));
    let Some(file) = root(&text, &mut faults) else {
        // The positions of the faults are in the other file.
        found.extend(faults.into_iter().map(|fault| {
            let message = format!("the texts of the package ({TEXTS}) cannot be read: {}", fault.message);
            Diagnostic::new(Code::ForeignSyntax, message).help("export the project again")
        }));
        return HashMap::new();
    };
    file.members().into_iter().filter_map(|(key, text)| Some((key, in_locale(text, locale)?))).collect()
}

/// Returns a text in a locale, in its language, or in the only language of the project.
fn in_locale(text: Node<'_>, locale: Option<&str>) -> Option<String> {
    let texts: Vec<(String, Node<'_>)> = text.members().into_iter().filter(|(name, _)| name != CONTEXT).collect();
    let tag = |name: &str| language_or_locale(name, true);
    let has = |wanted: &str| texts.iter().find(|(name, _)| tag(name).as_deref() == Some(wanted));
    let wanted = locale.and_then(|locale| has(locale).or_else(|| has(language(locale))));
    // A project without localisation has one language without a name.
    let unnamed = || texts.iter().find(|(name, _)| name.is_empty()).or(texts.first().filter(|_| texts.len() == 1));
    let (_, text) = wanted.or_else(unnamed)?;
    text.string().or_else(|| text.get(&["Text"])?.string())
}
