//! A language server for Lipz files: diagnostics while typing, fixes, completion, hover, rename.
//!
//! [`serve`] implements the Language Server Protocol 3.17 over any two streams. After each change, it checks the text
//! of the open file with the rules of `lipz-compiler`. Problems that require the whole project are found by a function
//! of the caller when you pause typing: `lipz lsp` passes the function of `lipz check`.
//!
//! ```no_run
//! use lipz_lsp::{CheckedProject, serve};
//! use std::io::{BufReader, stdin, stdout};
//! // A server that looks at single files only.
//! serve(BufReader::new(stdin()), stdout(), |_project, _unsaved| CheckedProject::default())?;
//! # Ok::<(), std::io::Error>(())
//! ```
//!
//! This crate does not contain rules or printing. Those are parts of `lipz`.

mod actions;
mod check;
mod completion;
mod context;
mod convert;
mod document;
mod halves;
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

pub use project::{CheckedProject, Project};
pub use server::serve;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
