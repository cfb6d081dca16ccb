//! Publishing of diagnostics, after each change of a text and after each check of a project.

use super::runs::CheckRun;
use super::{Server, path_name};
use crate::document::Document;
use crate::project::{KnownProject, without};
use crate::{check, convert};
use lipz_compiler::settings::{FILE_NAME, Settings};
use lipz_diagnostics::{Diagnostic, Report};
use lsp_types::notification::{Notification as _, PublishDiagnostics};
use lsp_types::{Diagnostic as Shown, PublishDiagnosticsParams, Uri};
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

impl<W: Write> Server<W> {
    /// Checks changed files and publishes their diagnostics.
    pub(super) fn publish_changed(&mut self) -> io::Result<()> {
        let nobody = KnownProject::default();
        let mut changed = Vec::new();
        for (key, document) in self.documents.iter_mut().filter(|(_, document)| document.is_stale) {
            let known = self.homes.get(key).and_then(|home| self.projects.get(home)).unwrap_or(&nobody);
            document.shown = local(document, known);
            document.shown.extend(document.from_project.iter().cloned());
            document.shown.sort_by_key(Diagnostic::start);
            document.is_stale = false;
            changed.push((document.uri.clone(), convert::of_document(document), document.version));
        }
        changed.into_iter().try_for_each(|(uri, shown, version)| self.publish(uri, shown, Some(version)))
    }

    /// Processes the result of checking a project.
    pub(super) fn take_result(&mut self, ran: CheckRun) -> io::Result<()> {
        self.runs.done(&ran.home, ran.took);
        let Some(known) = self.projects.get_mut(&ran.home) else { return Ok(()) };
        known.discovered(ran.checked.inputs, ran.recordings);
        known.words = ran.words;
        known.diagnostics = by_path(ran.checked.reports);
        let known = &self.projects[&ran.home];
        let (mut open, mut updates) = (BTreeSet::new(), Vec::new());
        for (key, document) in &mut self.documents {
            let Some(path) = document.path.as_deref().filter(|_| self.homes.get(key) == Some(&ran.home)) else {
                continue;
            };
            let name = path_name(path);
            if ran.versions.get(&name) == Some(&document.version) && known.keys.contains_key(path) {
                let found = known.diagnostics.get(&name).map(|report| report.diagnostics.clone()).unwrap_or_default();
                document.from_project = without(&found, &local(document, known));
                document.shown = found;
                document.is_stale = false;
                updates.push((document.uri.clone(), convert::of_document(document), Some(document.version)));
            } else {
                document.is_stale = true; // its project may have become known only now
            }
            open.insert(name);
        }
        let closed = known.diagnostics.values().filter(|report| !open.contains(&report.source.path));
        updates.extend(closed.filter_map(convert::of_report).map(|(uri, shown)| (uri, shown, None)));
        self.replace_published(&ran.home, updates)
    }

    /// Publishes the diagnostics of these files of a project, and clears those of all its other files.
    fn replace_published(&mut self, home: &Path, updates: Vec<(Uri, Vec<Shown>, Option<i32>)>) -> io::Result<()> {
        let now: BTreeSet<String> = updates.iter().map(|(uri, ..)| uri.as_str().to_owned()).collect();
        let before = self.published.insert(home.to_owned(), now.clone()).unwrap_or_default();
        for (uri, shown, version) in updates {
            self.publish(uri, shown, version)?;
        }
        self.clear(before.difference(&now))
    }

    /// Publishes the diagnostics of a project's settings file.
    pub(super) fn publish_settings(&mut self, home: &Path) -> io::Result<()> {
        let Some(known) = self.projects.get(home) else { return Ok(()) };
        let Some(file) = known.project.file.as_deref() else { return Ok(()) };
        let report = known.settings_report.clone().unwrap_or_else(|| Report::all_about(path_name(file), Vec::new()));
        let is_open = self.documents.values().any(|document| document.path.as_deref() == Some(file));
        match convert::of_report(&report).filter(|_| !is_open) {
            Some((uri, shown)) => self.publish(uri, shown, None),
            None => Ok(()),
        }
    }

    /// Clears the diagnostics of former projects.
    pub(super) fn forget_other_projects(&mut self) -> io::Result<()> {
        let gone: Vec<PathBuf> =
            self.published.keys().filter(|home| !self.projects.contains_key(*home)).cloned().collect();
        for home in gone {
            let files = self.published.remove(&home).unwrap_or_default();
            self.clear(files.iter())?;
        }
        Ok(())
    }

    fn clear<'u>(&mut self, uris: impl Iterator<Item = &'u String>) -> io::Result<()> {
        for uri in uris {
            // Open files are published when they change.
            if let Some(uri) = (!self.documents.contains_key(uri)).then(|| uri.parse().ok()).flatten() {
                self.publish(uri, Vec::new(), None)?;
            }
        }
        Ok(())
    }

    /// Publishes the diagnostics of a file. Without a version, they are only sent if they have changed.
    pub(super) fn publish(&mut self, uri: Uri, diagnostics: Vec<Shown>, version: Option<i32>) -> io::Result<()> {
        let mut hasher = DefaultHasher::new();
        serde_json::to_string(&diagnostics).unwrap_or_default().hash(&mut hasher);
        let hash = hasher.finish();
        let before = self.sent.insert(uri.as_str().to_owned(), hash);
        if version.is_none() && before == Some(hash) {
            return Ok(());
        }
        self.notify(PublishDiagnostics::METHOD, PublishDiagnosticsParams { uri, diagnostics, version })
    }
}

/// Returns the diagnostics of an open file on its own.
fn local(document: &Document, known: &KnownProject) -> Vec<Diagnostic> {
    match &document.path {
        Some(path) if path.file_name().is_some_and(|name| name == FILE_NAME) => {
            let folder = path.parent().unwrap_or(Path::new(""));
            Settings::parse_with_report(&document.text, path_name(path), folder).1.diagnostics
        }
        path => check::check(known, path.as_deref(), &document.text),
    }
}

/// Merges the reports of each file.
fn by_path(reports: Vec<Report>) -> BTreeMap<String, Report> {
    let mut all: BTreeMap<String, Report> = BTreeMap::new();
    for report in reports {
        let one = all.entry(report.source.path.clone()).or_default();
        if one.source.text.is_empty() {
            one.source = report.source;
        }
        one.diagnostics.extend(report.diagnostics);
    }
    all.values_mut().for_each(|report| report.diagnostics.sort_by_key(Diagnostic::start));
    all
}
