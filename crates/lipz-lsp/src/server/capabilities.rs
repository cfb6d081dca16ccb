//! The capabilities of the editor and of the server.

use crate::uri;
use lsp_types::{
    CodeActionKind, CodeActionOptions, CodeActionProviderCapability, CompletionOptions, DocumentLinkOptions,
    HoverProviderCapability, InitializeParams, InitializeResult, OneOf, RenameOptions, ServerCapabilities, ServerInfo,
    TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
};
use serde_json::Value;
use std::path::PathBuf;

/// The folders and capabilities of the editor.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct Client {
    /// The open folders.
    pub(super) folders: Vec<PathBuf>,
    pub(super) has_snippets: bool,
    /// Whether it can report changes of files by other programs, on request.
    pub(super) watches_files: bool,
    /// Whether it shows pictures in hovers.
    pub(super) has_pictures: bool,
}

/// Returns the editor's description of itself, and the answer. Invalid parameters are ignored.
pub(super) fn agree(params: &Value) -> (Client, InitializeResult) {
    let params: InitializeParams = serde_json::from_value(params.clone()).unwrap_or_default();
    let result = InitializeResult {
        capabilities: server(),
        server_info: Some(ServerInfo { name: "lipz".to_owned(), version: Some(env!("CARGO_PKG_VERSION").to_owned()) }),
    };
    (client(&params), result)
}

#[allow(deprecated, reason = "older editors name one folder")]
fn client(params: &InitializeParams) -> Client {
    let folders = params.workspace_folders.iter().flatten().map(|folder| &folder.uri).chain(&params.root_uri);
    let text_document = params.capabilities.text_document.as_ref();
    let item = text_document.and_then(|text| text.completion.as_ref()?.completion_item.as_ref());
    let watching = params.capabilities.workspace.as_ref().and_then(|workspace| workspace.did_change_watched_files);
    let option = |name: &str| params.initialization_options.as_ref()?.get(name)?.as_bool();
    Client {
        folders: folders.filter_map(|uri| uri::path(uri.as_str())).collect(),
        has_snippets: item.and_then(|item| item.snippet_support).unwrap_or_default(),
        watches_files: watching.and_then(|watching| watching.dynamic_registration).unwrap_or_default(),
        has_pictures: option("pictures").unwrap_or_default(),
    }
}

fn server() -> ServerCapabilities {
    let sync = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::INCREMENTAL),
        save: Some(true.into()),
        ..TextDocumentSyncOptions::default()
    };
    let triggers = ["\"", " ", ",", "|", "+", "{"].map(str::to_owned).to_vec();
    ServerCapabilities {
        text_document_sync: Some(TextDocumentSyncCapability::Options(sync)),
        completion_provider: Some(CompletionOptions {
            trigger_characters: Some(triggers),
            ..CompletionOptions::default()
        }),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        document_formatting_provider: Some(OneOf::Left(true)),
        document_link_provider: Some(DocumentLinkOptions {
            resolve_provider: None,
            work_done_progress_options: Default::default(),
        }),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QUICKFIX, CodeActionKind::new(crate::actions::FIX_ALL)]),
            ..CodeActionOptions::default()
        })),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: Default::default(),
        })),
        ..ServerCapabilities::default()
    }
}
