//! A language server for Lipz files: diagnostics while they are written, fixes, completion, hover, rename.
//!
//! [`serve`] speaks the Language Server Protocol 3.17 with an editor, over any two streams. What is wrong with the text of
//! an open file is looked for after each change, by the checks of `lipz-compiler`; what needs the whole project
//! is found by a function of the caller, as soon as the editor pauses: `lipz lsp` gives it what `lipz check` does.
//!
//! ```no_run
//! use lipz_lsp::{Checked, serve};
//! use std::io::{BufReader, stdin, stdout};
//! // A server that looks at single files only.
//! serve(BufReader::new(stdin()), stdout(), |_project, _unsaved| Checked::default())?;
//! # Ok::<(), std::io::Error>(())
//! ```
//!
//! What is not here: rules, and printing (`lipz`).

mod actions;
mod check;
mod completion;
mod context;
mod convert;
mod document;
mod hover;
mod links;
mod place;
mod project;
mod rename;
mod server;
mod symbols;
mod timing;
mod transport;
mod uri;
mod words;

pub use project::{Checked, Project};
pub use server::serve;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
