//! Changes of a clip: packed in memory for the page, and written into the Lipz file.

use super::places::{Placed, placed};
use super::version::Version;
use crate::interrupt;
use crate::shared::rewriting::diff;
use lipz_compiler::{Compiler, Content, Input, MinCoverage, rewrite_file};
use lipz_diagnostics::reports::have_errors;
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::locale::text_name;
use lipz_file::{Document, Element, JsonString, Value, parse};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// What the page asks for.
#[derive(Deserialize)]
pub(super) struct Change {
    key: String,
    /// The file that the page has read.
    source: String,
    /// The elements that are others now.
    elements: BTreeMap<String, String>,
}

/// What became of it.
#[derive(Serialize)]
#[serde(tag = "result", rename_all = "snake_case")]
pub(super) enum Changed {
    /// The draft, as a file. Its bank follows, unless there are errors.
    Draft { source: String, has_bank: bool, diagnostics: Vec<Placed> },
    /// It is in the file, which is this now.
    Saved { source: String },
    /// The draft has errors: the file is as it was.
    Errors { diagnostics: Vec<Placed> },
    /// Somebody has changed the file since the page read it: it is as they left it.
    Conflict { theirs: String, yours: String },
    /// Why nothing was done.
    Refused { message: String },
}

impl Change {
    /// Packs the clip as it would be. Gives its bank, too, if there are no errors.
    pub(super) fn draft(&self, version: &Version) -> (Changed, Option<Vec<u8>>) {
        let source = match self.applied(version) {
            Ok(source) => source,
            Err(message) => return (Changed::Refused { message }, None),
        };
        let (bank, diagnostics) = self.packed(version, &source);
        (Changed::Draft { source, has_bank: bank.is_some(), diagnostics }, bank)
    }

    /// Writes the change into the file of the clip, if that is as the page has read it, and packs with it.
    pub(super) fn save(&self, version: &Version) -> Changed {
        let Some(path) = version.files.get(&self.key) else {
            return Changed::Refused { message: "the project has no such file any more".to_owned() };
        };
        let source = match self.applied(version) {
            Ok(source) => source,
            Err(message) => return Changed::Refused { message },
        };
        if let Some(conflict) = self.conflict(path, &source) {
            return conflict;
        }
        let (bank, diagnostics) = self.packed(version, &source);
        if bank.is_none() {
            return Changed::Errors { diagnostics };
        }
        let written = interrupt::whole(|| rewrite_file(path, self.source.as_bytes(), source.as_bytes()));
        match written {
            Ok(()) => Changed::Saved { source },
            // Somebody may have been faster.
            Err(report) => self.conflict(path, &source).unwrap_or_else(|| {
                let messages = report.diagnostics.iter().map(|found| found.message.clone());
                Changed::Refused { message: messages.collect::<Vec<_>>().join("; ") }
            }),
        }
    }

    /// The file with the change, in the layout that it has.
    fn applied(&self, version: &Version) -> Result<String, String> {
        let before = parse(self.source.as_bytes()).document.ok_or("the file has errors of syntax")?;
        let mut after = before.clone();
        for (name, text) in &self.elements {
            if !matches!(name.as_str(), "visemes" | "events") && text_name(name).is_none() {
                return Err(format!("`{name}` is no element that can be edited here"));
            }
            set(&mut after, name, text);
        }
        let default_locale = version.options.default_locale.as_deref();
        let style = Style { default_locale, line_ending: LineEnding::detect(&self.source) };
        Ok(rewrite(&self.source, &before, &after, style))
    }

    /// The clip alone, packed as the project is, and what is wrong with it.
    fn packed(&self, version: &Version, source: &str) -> (Option<Vec<u8>>, Vec<Placed>) {
        // How much of the project is translated, one clip does not tell.
        let mut options = version.options.clone();
        options.min_coverage = MinCoverage::default();
        let name = version.files.get(&self.key).map_or_else(String::new, |path| crate::console::path(path));
        let content = Content::Bytes { name, bytes: source.as_bytes().to_vec() };
        let compiled = Compiler::new(options).compile(&[Input { key: self.key.clone(), content }]);
        let bank = compiled.bank.filter(|_| !have_errors(&compiled.reports));
        (bank, placed(&compiled.reports))
    }

    /// The two changes of the file, if it is another one than the page has read.
    fn conflict(&self, path: &Path, mine: &str) -> Option<Changed> {
        let now = fs::read(path).ok()?;
        if now == self.source.as_bytes() {
            return None;
        }
        let name = crate::console::path(path);
        let theirs = diff(&name, self.source.as_bytes(), &String::from_utf8_lossy(&now));
        Some(Changed::Conflict { theirs, yours: diff(&name, self.source.as_bytes(), mine) })
    }
}

/// Gives an element another text; a new one comes behind the last text.
fn set<'s>(document: &mut Document<'s>, name: &str, text: &str) {
    let value = Value::String(JsonString::from(Cow::Owned(text.to_owned())));
    if let Some(element) = document.elements.iter_mut().find(|element| element.name.text == name) {
        element.value = value;
        return;
    }
    let last = document.elements.iter().rposition(|element| text_name(&element.name.text).is_some());
    let place = last.map_or(document.elements.len(), |last| last + 1);
    document.elements.insert(place, Element { name: JsonString::from(Cow::Owned(name.to_owned())), value });
}
