//! The editor's notifications: files that are opened, changed, saved and closed.

use super::Server;
use crate::document::Document;
use crate::project::KnownProject;
use crate::uri;
use lipz_compiler::settings::FILE_NAME;
use lsp_server::{Notification, Request};
use lsp_types::notification::{
    DidChangeTextDocument, DidChangeWatchedFiles, DidCloseTextDocument, DidOpenTextDocument, DidSaveTextDocument,
    Notification as _,
};
use lsp_types::{DidChangeTextDocumentParams, DidChangeWatchedFilesParams, DidOpenTextDocumentParams};
use serde::de::DeserializeOwned;
use serde_json::json;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

impl<W: Write> Server<W> {
    /// Processes a notification. An invalid one is ignored, because notifications have no response.
    pub(super) fn notice(&mut self, notification: Notification) -> io::Result<()> {
        match notification.method.as_str() {
            "initialized" => return self.begin(),
            DidOpenTextDocument::METHOD => read(notification).into_iter().for_each(|params| self.open(params)),
            DidChangeTextDocument::METHOD => read(notification).into_iter().for_each(|params| self.change(params)),
            DidSaveTextDocument::METHOD => {
                let params: Option<lsp_types::DidSaveTextDocumentParams> = read(notification);
                if let Some(path) = params.and_then(|params| uri::path(params.text_document.uri.as_str())) {
                    self.changed_on_disk(&[path])?;
                }
            }
            DidChangeWatchedFiles::METHOD => {
                let params: Option<DidChangeWatchedFilesParams> = read(notification);
                let changes = params.into_iter().flat_map(|params| params.changes);
                let paths: Vec<PathBuf> = changes.filter_map(|change| uri::path(change.uri.as_str())).collect();
                self.changed_on_disk(&paths)?;
            }
            DidCloseTextDocument::METHOD => {
                let params: Option<lsp_types::DidCloseTextDocumentParams> = read(notification);
                if let Some(params) = params {
                    self.close(params.text_document.uri.as_str())?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Requests notifications of changes by other programs, and checks the projects of the open folders.
    fn begin(&mut self) -> io::Result<()> {
        if self.client.watches_files {
            let watchers = ["**/*.lipz", "**/lipz.toml", "**/lipz-texts.txt", "**/lipz-sync.txt"];
            let watchers = watchers.map(|pattern| json!({ "globPattern": pattern }));
            let registration = json!({
                "id": "files", "method": DidChangeWatchedFiles::METHOD, "registerOptions": { "watchers": watchers },
            });
            let params = json!({ "registrations": [registration] });
            self.send(Request::new("files".to_owned().into(), "client/registerCapability".to_owned(), params))?;
        }
        for folder in self.client.folders.clone() {
            if folder.join(FILE_NAME).is_file() {
                self.project_of(Some(&folder.join(FILE_NAME)))?;
            }
        }
        Ok(())
    }

    fn open(&mut self, params: DidOpenTextDocumentParams) {
        let opened = params.text_document;
        let key = opened.uri.as_str().to_owned();
        let document = Document::new(opened.uri, opened.version, opened.text);
        // Problems of its settings file are reported when it is read. A broken stream is detected by the next write.
        if let Ok(home) = self.project_of(document.path.as_deref()) {
            self.homes.insert(key.clone(), home);
        }
        self.documents.insert(key, document);
    }

    fn change(&mut self, params: DidChangeTextDocumentParams) {
        let key = params.text_document.uri.as_str();
        let Some(document) = self.documents.get_mut(key) else { return };
        document.change(params.text_document.version, params.content_changes);
        if let Some(home) = self.homes.get(key) {
            self.runs.after_typing(home);
        }
    }

    fn close(&mut self, key: &str) -> io::Result<()> {
        let Some(document) = self.documents.remove(key) else { return Ok(()) };
        let home = self.homes.remove(key);
        if document.path.is_none() {
            self.publish(document.uri, Vec::new(), None)?;
            self.sent.remove(key);
            return Ok(());
        }
        // Some editors forget the diagnostics of a file that is closed.
        self.sent.remove(key);
        // Unsaved changes are lost.
        home.iter().for_each(|home| self.runs.soon(home));
        Ok(())
    }

    /// Checks the projects of these files, which have changed on disk.
    fn changed_on_disk(&mut self, paths: &[PathBuf]) -> io::Result<()> {
        if paths.iter().any(|path| path.file_name().is_some_and(|name| name == FILE_NAME)) {
            return self.read_settings_again();
        }
        for path in paths {
            let home = KnownProject::of(Some(path), &self.client.folders).id();
            if self.projects.contains_key(&home) {
                self.runs.soon(&home);
            }
        }
        Ok(())
    }

    /// Finds the projects of all open files again, because a settings file has changed, appeared or disappeared.
    fn read_settings_again(&mut self) -> io::Result<()> {
        self.projects.clear();
        let open: Vec<(String, Option<PathBuf>)> =
            self.documents.iter().map(|(key, document)| (key.clone(), document.path.clone())).collect();
        for (key, path) in open {
            let home = self.project_of(path.as_deref())?;
            self.homes.insert(key, home);
        }
        self.documents.values_mut().for_each(|document| document.is_stale = true);
        self.forget_other_projects()
    }

    /// Returns the project of a file, and reads it if necessary.
    fn project_of(&mut self, path: Option<&Path>) -> io::Result<PathBuf> {
        let known = KnownProject::of(path, &self.client.folders);
        let home = known.id();
        if !self.projects.contains_key(&home) {
            self.projects.insert(home.clone(), known);
            self.publish_settings(&home)?;
        }
        if path.is_some() {
            self.runs.soon(&home);
        }
        Ok(home)
    }
}

fn read<P: DeserializeOwned>(notification: Notification) -> Option<P> {
    serde_json::from_value(notification.params).ok()
}
