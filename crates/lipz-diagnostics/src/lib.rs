//! What lipz finds in dialogue: what is wrong, where, how bad it is, and what to do about it.
//!
//! A [`Diagnostic`] is about one place in one file; a [`Report`] has all diagnostics about a file,
//! with its text. Each comes from a rule with a stable [`Code`], which has a [page](Code::page).
//! [`render`] shows reports to people, editors, code scanning and build systems:
//!
//! ```
//! use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span};
//!
//! let text = r#"{ "visemes": "MAZ-" }"#;
//! let diagnostic = Diagnostic::at(Code::ForeignCode, Span::new(15, 16), "`Z` is not a blair code")
//!     .help("valid codes are - A M O S W E F L U");
//! let report = Report::new(Source::new("voices/mayor.lipz", text), vec![diagnostic]);
//! assert_eq!(
//!     report.to_string(),
//!     "voices/mayor.lipz:1:16: error[LZ0401]: `Z` is not a blair code\n  \
//!      help: valid codes are - A M O S W E F L U\n"
//! );
//! ```
//!
//! What is not here: the rules themselves (they are where the data is that they look at: `lipz-file`,
//! `lipz-compiler`, `lipz-interop`), printing and exit codes (`lipz`).

mod code;
mod diagnostic;
pub mod escape;
mod fix;
mod levels;
pub mod render;
mod report;
mod source;
pub mod suggest;

pub use code::{Code, UnknownCode};
pub use diagnostic::{Diagnostic, Fix, Label, Severity};
pub use fix::{Applied, apply};
pub use levels::{Levels, adjust, is_lowered};
pub use report::{Report, count, has_errors, sort};
pub use source::{LineColumn, Source, Span};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
