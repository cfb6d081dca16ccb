//! Changes of a clip: packed in memory for the page, and written into the Lipz file.

use super::places::{Placed, elements_with_errors, placed};
use super::version::Version;
use crate::interrupt;
use crate::shared::rewriting::diff;
use lipz_compiler::{Compiler, Content, Input, MinCoverage, rewrite_file};
use lipz_diagnostics::Report;
use lipz_diagnostics::reports::have_errors;
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::locale::text_name;
use lipz_file::{Document, Element, JsonString, Value, parse};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
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
    /// The draft, as a file. Its bank follows, if there is one: of all in the file that has no errors.
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
    /// Packs the clip as it would be. Gives the bank of what has no errors, too.
    pub(super) fn draft(&self, version: &Version) -> (Changed, Option<Vec<u8>>) {
        let source = match self.applied(version) {
            Ok(source) => source,
            Err(message) => return (Changed::Refused { message }, None),
        };
        let Packed { bank, has_errors, diagnostics, .. } = self.packed(version, &source);
        let right = if has_errors { self.right_part(version, &source) } else { None };
        let bank = bank.or_else(|| self.packed(version, &right?).bank);
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
        let Packed { has_errors, diagnostics, .. } = self.packed(version, &source);
        if has_errors {
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
        let default_locale = version.options.get_default_locale();
        let style = Style { default_locale, line_ending: LineEnding::detect(&self.source) };
        Ok(rewrite(&self.source, &before, &after, style))
    }

    /// The clip, packed as the project is, and what is wrong with it. A dub needs its original: the texts are there.
    fn packed(&self, version: &Version, source: &str) -> Packed {
        let original = self.original(version);
        let as_it_is = original.as_ref().map(|original| original.input(version, original.source.clone()));
        let (mut bank, own) = self.compiled(version, source, as_it_is);
        let has_errors = have_errors(&own) || bank.is_none() && original.is_none();
        if bank.is_none() && !has_errors {
            // The original has errors, which are not those of the dub: what is right of it stands in for it.
            let right = original.and_then(|original| {
                let right = original.right_part(version, &original.source)?;
                Some(original.input(version, right))
            });
            bank = self.compiled(version, source, right).0;
        }
        let diagnostics = placed(&own);
        Packed { bank, has_errors, wrong: elements_with_errors(&diagnostics), diagnostics }
    }

    /// The bank of the clip and its original, and what is wrong with the clip.
    fn compiled(&self, version: &Version, source: &str, original: Option<Input>) -> (Option<Vec<u8>>, Vec<Report>) {
        // How much of the project is translated, one clip does not tell.
        let options = version.options.clone().min_coverage(MinCoverage::new());
        let own = self.input(version, source.to_owned());
        let name = own.name();
        let inputs: Vec<Input> = original.into_iter().chain([own]).collect();
        let compiled = Compiler::new(options).compile(&inputs);
        let own: Vec<Report> = compiled.reports.into_iter().filter(|report| report.source.path == name).collect();
        (compiled.bank.filter(|_| !have_errors(&own)), own)
    }

    /// The original of the clip, as it is, if the clip is a dub.
    fn original(&self, version: &Version) -> Option<Change> {
        let key = version.options.get_voices().original_of(&self.key, |key| version.files.contains_key(key))?;
        let source = String::from_utf8(fs::read(version.files.get(&key)?).ok()?).ok()?;
        Some(Change { key, source, elements: BTreeMap::new() })
    }

    /// The file of the clip with this text.
    fn input(&self, version: &Version, source: String) -> Input {
        let name = version.files.get(&self.key).map_or_else(String::new, |path| crate::console::path(path));
        Input { key: self.key.clone(), content: Content::Bytes { name, bytes: source.into_bytes() } }
    }

    /// The file without the elements that have errors; none if something else is wrong.
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
            // Without one element, another may be wrong: each turn leaves out more of them.
            if packed.wrong.is_subset(&wrong) {
                return None;
            }
            wrong.extend(packed.wrong);
        }
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

/// A clip, packed.
struct Packed {
    /// None if it has errors.
    bank: Option<Vec<u8>>,
    has_errors: bool,
    /// The elements that have errors.
    wrong: BTreeSet<String>,
    diagnostics: Vec<Placed>,
}

/// Gives an element another text; a new one comes behind the last text, a mouth first.
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
