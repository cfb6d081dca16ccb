//! The editor's requests.

use super::{Server, path_name};
use crate::document::Document;
use crate::project::KnownProject;
use crate::{actions, completion, convert, hover, links, place, rename, symbols};
use lipz_compiler::settings::FILE_NAME;
use lipz_file::format::{LineEnding, Style, format};
use lsp_server::{ErrorCode, Request, Response};
use lsp_types::request::{
    CodeActionRequest, Completion, DocumentLinkRequest, DocumentSymbolRequest, Formatting, HoverRequest,
    PrepareRenameRequest, Rename, Request as Asked,
};
use lsp_types::{
    CodeActionParams, CodeActionResponse, CompletionParams, CompletionResponse, DocumentFormattingParams, DocumentLink,
    DocumentLinkParams, DocumentSymbolParams, DocumentSymbolResponse, Hover, HoverParams, PrepareRenameResponse,
    RenameParams, TextDocumentPositionParams, TextEdit, Uri, WorkspaceEdit,
};
use std::io::{self, Write};

/// A result, or an error message.
type Answer<T> = Result<T, String>;

impl<W: Write> Server<W> {
    /// Answers a request.
    pub(super) fn respond(&mut self, request: Request) -> io::Result<Response> {
        let method = request.method.clone();
        if matches!(method.as_str(), HoverRequest::METHOD | CodeActionRequest::METHOD) {
            self.publish_changed()?; // they also depend on diagnostics
        }
        if method == DocumentLinkRequest::METHOD {
            // Editors request links once, when they open a file, which is before the check of its project.
            self.projects.values_mut().for_each(KnownProject::discover);
        }
        Ok(match method.as_str() {
            Completion::METHOD => self.with::<Completion>(request, Self::completion),
            HoverRequest::METHOD => self.with::<HoverRequest>(request, Self::hover),
            DocumentSymbolRequest::METHOD => self.with::<DocumentSymbolRequest>(request, Self::symbols),
            DocumentLinkRequest::METHOD => self.with::<DocumentLinkRequest>(request, Self::links),
            CodeActionRequest::METHOD => self.with::<CodeActionRequest>(request, Self::actions),
            Formatting::METHOD => self.with::<Formatting>(request, Self::formatting),
            PrepareRenameRequest::METHOD => self.with::<PrepareRenameRequest>(request, Self::prepare_rename),
            Rename::METHOD => self.with::<Rename>(request, Self::rename),
            _ => {
                Response::new_err(request.id, ErrorCode::MethodNotFound as i32, format!("`{method}` is not supported"))
            }
        })
    }

    fn with<R: Asked>(&self, request: Request, work: impl FnOnce(&Self, &R::Params) -> Answer<R::Result>) -> Response {
        let refuse = |code: ErrorCode, why| Response::new_err(request.id.clone(), code as i32, why);
        match serde_json::from_value(request.params) {
            Err(error) => refuse(ErrorCode::InvalidParams, error.to_string()),
            Ok(params) => match work(self, &params) {
                Ok(result) => Response::new_ok(request.id, result),
                Err(why) => refuse(ErrorCode::RequestFailed, why),
            },
        }
    }

    /// Returns an open Lipz file and its project; `None` for settings, which only have diagnostics and their fixes.
    fn lipz_file(&self, uri: &Uri) -> Answer<Option<(&Document, &KnownProject)>> {
        let (document, known) = self.open_file(uri)?;
        let is_settings = document.path.as_deref().is_some_and(|path| path.ends_with(FILE_NAME));
        Ok((!is_settings).then_some((document, known)))
    }

    /// Returns an open file and its project.
    fn open_file(&self, uri: &Uri) -> Answer<(&Document, &KnownProject)> {
        let key = uri.as_str();
        let open = self.documents.get(key).zip(self.known(key));
        open.ok_or_else(|| format!("`{key}` is not open"))
    }

    fn completion(&self, params: &CompletionParams) -> Answer<Option<CompletionResponse>> {
        let asked = &params.text_document_position;
        let Some((document, known)) = self.lipz_file(&asked.text_document.uri)? else { return Ok(None) };
        let at = place::byte(&document.rope, asked.position);
        let items = completion::complete(document, known, at, self.client.has_snippets);
        Ok(Some(CompletionResponse::Array(items)))
    }

    fn hover(&self, params: &HoverParams) -> Answer<Option<Hover>> {
        let asked = &params.text_document_position_params;
        let Some((document, known)) = self.lipz_file(&asked.text_document.uri)? else { return Ok(None) };
        let at = place::byte(&document.rope, asked.position);
        Ok(hover::hover(document, known, at, self.client.has_pictures))
    }

    fn symbols(&self, params: &DocumentSymbolParams) -> Answer<Option<DocumentSymbolResponse>> {
        let found = self.lipz_file(&params.text_document.uri)?;
        Ok(found.map(|(document, known)| DocumentSymbolResponse::Nested(symbols::symbols(document, known))))
    }

    fn links(&self, params: &DocumentLinkParams) -> Answer<Option<Vec<DocumentLink>>> {
        let found = self.lipz_file(&params.text_document.uri)?;
        Ok(found.map(|(document, known)| links::links(document, known)))
    }

    fn actions(&self, params: &CodeActionParams) -> Answer<Option<CodeActionResponse>> {
        // Also those of settings.
        let (document, known) = self.open_file(&params.text_document.uri)?;
        let range = place::bytes(&document.rope, params.range);
        Ok(Some(actions::actions(document, known, range, params.context.only.as_deref())))
    }

    /// Formats a file. Invalid JSON is rejected, so that the editor shows why nothing changes.
    fn formatting(&self, params: &DocumentFormattingParams) -> Answer<Option<Vec<TextEdit>>> {
        let Some((document, known)) = self.lipz_file(&params.text_document.uri)? else { return Ok(None) };
        let parsed = lipz_file::parse(document.text.as_bytes());
        let Some(read) = parsed.document else {
            let why = parsed.diagnostics.first().map(|diagnostic| diagnostic.message.clone()).unwrap_or_default();
            return Err(format!("the file cannot be formatted: {why}"));
        };
        let default_locale = known.project.settings.options.get_default_locale();
        let after = format(&read, Style { default_locale, line_ending: LineEnding::detect(&document.text) });
        let is_same = after == document.text;
        Ok(Some(if is_same { Vec::new() } else { vec![actions::replacement(document, &after)] }))
    }

    fn prepare_rename(&self, asked: &TextDocumentPositionParams) -> Answer<Option<PrepareRenameResponse>> {
        let Some((document, _)) = self.lipz_file(&asked.text_document.uri)? else { return Ok(None) };
        let Some(name) = name_at(document, asked.position) else { return Ok(None) };
        let range = convert::range(&document.rope, name.span, document.mark_bytes());
        Ok(Some(PrepareRenameResponse::RangeWithPlaceholder { range, placeholder: name.text }))
    }

    fn rename(&self, params: &RenameParams) -> Answer<Option<WorkspaceEdit>> {
        let asked = &params.text_document_position;
        let Some((document, known)) = self.lipz_file(&asked.text_document.uri)? else { return Ok(None) };
        let name =
            name_at(document, asked.position).ok_or("the cursor is not on a character, prop or action of an event")?;
        let files =
            self.documents.values().filter_map(|document| Some((path_name(document.path.as_deref()?), document)));
        rename::rename(known, &files.collect(), &name, &params.new_name).map(Some)
    }
}

fn name_at(document: &Document, position: lsp_types::Position) -> Option<rename::NamedSpan> {
    let at = place::byte(&document.rope, position).checked_sub(document.mark_bytes())?;
    rename::name_at(&document.text, at)
}
