//! Changes of a clip: packed in memory for the page, or written to the Lipz file.

use super::placed_diagnostic::{PlacedDiagnostic, elements_with_errors, placed};
use super::project_file;
use super::version::Version;
use crate::interrupt;
use crate::shared::rewrite_mode::diff;
use lipz_compiler::{Compiler, Content, Input, MinCoverage, rewrite_file};
use lipz_diagnostics::Report;
use lipz_diagnostics::reports::have_errors;
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::locale::text_name;
use lipz_file::{Document, Element, JsonString, Value, parse};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::Path;

/// A request of the page.
#[derive(Deserialize)]
pub(super) struct DraftRequest {
    key: String,
    /// The file as the page read it.
    source: String,
    /// The changed elements.
    elements: BTreeMap<String, String>,
}

/// The result of a change.
#[derive(Serialize)]
#[serde(tag = "result", rename_all = "snake_case")]
pub(super) enum DraftAnswer {
    /// The draft as a file. If `has_bank`, a bank follows, made from the parts of the file without errors.
    Draft { source: String, has_bank: bool, diagnostics: Vec<PlacedDiagnostic> },
    /// Saved; `source` is the new file.
    Saved { source: String },
    /// The draft has errors. The file stays unchanged.
    Errors { diagnostics: Vec<PlacedDiagnostic> },
    /// The file has changed since the page read it. It stays as it is.
    Conflict { theirs: String, yours: String },
    /// Refused for this reason.
    Refused { message: String },
}

impl DraftRequest {
    /// Packs the clip with the change. Also returns the bank of the parts without errors.
    pub(super) fn draft(&self, version: &Version) -> (DraftAnswer, Option<Vec<u8>>) {
        let source = match self.applied(version) {
            Ok(source) => source,
            Err(message) => return (DraftAnswer::Refused { message }, None),
        };
        let PackedClip { bank, has_errors, diagnostics, .. } = self.packed(version, &source);
        let right = if has_errors { self.right_part(version, &source) } else { None };
        let bank = bank.or_else(|| self.packed(version, &right?).bank);
        (DraftAnswer::Draft { source, has_bank: bank.is_some(), diagnostics }, bank)
    }

    /// Writes the change into the clip's file, if that still matches what the page read, and packs the file.
    pub(super) fn save(&self, version: &Version) -> DraftAnswer {
        let Some(path) = version.files.get(&self.key) else {
            return DraftAnswer::Refused { message: "the file is no longer in the project".to_owned() };
        };
        let source = match self.applied(version) {
            Ok(source) => source,
            Err(message) => return DraftAnswer::Refused { message },
        };
        match self.conflict(path, &source) {
            Ok(None) => {}
            Ok(Some(conflict)) => return conflict,
            Err(error) => return DraftAnswer::Refused { message: format!("the file cannot be read: {error}") },
        }
        let PackedClip { has_errors, diagnostics, .. } = self.packed(version, &source);
        if has_errors {
            return DraftAnswer::Errors { diagnostics };
        }
        let written = interrupt::whole(|| rewrite_file(path, self.source.as_bytes(), source.as_bytes()));
        match written {
            Ok(()) => DraftAnswer::Saved { source },
            // The file may have changed in between.
            Err(report) => self.conflict(path, &source).ok().flatten().unwrap_or_else(|| {
                let messages = report.diagnostics.iter().map(|found| found.message.clone());
                DraftAnswer::Refused { message: messages.collect::<Vec<_>>().join("; ") }
            }),
        }
    }

    /// Returns the file with the change, in its existing layout.
    fn applied(&self, version: &Version) -> Result<String, String> {
        let before = parse(self.source.as_bytes()).document.ok_or("the file has syntax errors")?;
        let mut after = before.clone();
        for (name, text) in &self.elements {
            if !matches!(name.as_str(), "visemes" | "events") && text_name(name).is_none() {
                return Err(format!("`{name}` cannot be edited on this page"));
            }
            set(&mut after, name, text);
        }
        let default_locale = version.options.get_default_locale();
        let style = Style { default_locale, line_ending: LineEnding::detect(&self.source) };
        Ok(rewrite(&self.source, &before, &after, style))
    }

    /// Packs the clip with the project's options, and returns its problems. A dub needs its original, which has the
    /// texts.
    fn packed(&self, version: &Version, source: &str) -> PackedClip {
        let original = self.original(version);
        let as_it_is = original.as_ref().map(|original| original.input(version, original.source.clone()));
        let (mut bank, own) = self.compiled(version, source, as_it_is);
        let has_errors = have_errors(&own) || bank.is_none() && original.is_none();
        if bank.is_none() && !has_errors {
            // Errors of the original do not belong to the dub. The correct parts of the original are sufficient.
            let right = original.and_then(|original| {
                let right = original.right_part(version, &original.source)?;
                Some(original.input(version, right))
            });
            bank = self.compiled(version, source, right).0;
        }
        let diagnostics = placed(&own);
        PackedClip { bank, has_errors, wrong: elements_with_errors(&diagnostics), diagnostics }
    }

    /// Returns the bank of the clip and its original, and the problems of the clip.
    fn compiled(&self, version: &Version, source: &str, original: Option<Input>) -> (Option<Vec<u8>>, Vec<Report>) {
        // A single clip cannot show the coverage of the project.
        let options = version.options.clone().min_coverage(MinCoverage::new());
        let own = self.input(version, source.to_owned());
        let name = own.name();
        let inputs: Vec<Input> = original.into_iter().chain([own]).collect();
        let compiled = Compiler::new(options).compile(&inputs);
        let own: Vec<Report> = compiled.reports.into_iter().filter(|report| report.source.path == name).collect();
        (compiled.bank.filter(|_| !have_errors(&own)), own)
    }

    /// Returns the unchanged original of the clip, if the clip is a dub.
    fn original(&self, version: &Version) -> Option<DraftRequest> {
        let key = version.options.get_voices().original_of(&self.key, |key| version.files.contains_key(key))?;
        let source = String::from_utf8(project_file::read(version.files.get(&key)?).ok()?).ok()?;
        Some(DraftRequest { key, source, elements: BTreeMap::new() })
    }

    /// Returns the clip's file with this text.
    fn input(&self, version: &Version, source: String) -> Input {
        let name = version.files.get(&self.key).map_or_else(String::new, |path| crate::console::path(path));
        Input { key: self.key.clone(), content: Content::Bytes { name, bytes: source.into_bytes() } }
    }

    /// Returns the file without the elements that have errors, or `None` if there are other errors.
    fn right_part(&self, version: &Version, source: &str) -> Option<String> {
        let whole = parse(source.as_bytes()).document?;
        let mut wrong = BTreeSet::new();
        loop {
            let mut rest = whole.clone();
            rest.elements.retain(|element| !wrong.contains(element.name.text.as_ref()));
            let rest = rewrite(source, &whole, &rest, Style::default());
            let packed = self.packed(version, &rest);
            if !packed.has_errors {
                return Some(rest);
            }
            // Removing one element can make another invalid, so that each round removes more of them.
            if packed.wrong.is_subset(&wrong) {
                return None;
            }
            wrong.extend(packed.wrong);
        }
    }

    /// Returns both versions of the file, if it has changed since the page read it.
    fn conflict(&self, path: &Path, mine: &str) -> io::Result<Option<DraftAnswer>> {
        let now = project_file::read(path)?;
        if now == self.source.as_bytes() {
            return Ok(None);
        }
        let name = crate::console::path(path);
        let theirs = diff(&name, self.source.as_bytes(), &String::from_utf8_lossy(&now));
        Ok(Some(DraftAnswer::Conflict { theirs, yours: diff(&name, self.source.as_bytes(), mine) }))
    }
}

/// A clip, packed.
struct PackedClip {
    /// `None` if it has errors.
    bank: Option<Vec<u8>>,
    has_errors: bool,
    /// The elements with errors.
    wrong: BTreeSet<String>,
    diagnostics: Vec<PlacedDiagnostic>,
}

/// Sets the text of an element. A new element goes after the last text, new visemes to the start.
fn set<'s>(document: &mut Document<'s>, name: &str, text: &str) {
    let value = Value::String(JsonString::from(Cow::Owned(text.to_owned())));
    if let Some(element) = document.elements.iter_mut().find(|element| element.name.text == name) {
        element.value = value;
        return;
    }
    let last = document.elements.iter().rposition(|element| text_name(&element.name.text).is_some());
    let place = if name == "visemes" { 0 } else { last.map_or(document.elements.len(), |last| last + 1) };
    document.elements.insert(place, Element { name: JsonString::from(Cow::Owned(name.to_owned())), value });
}
