//! Diagnostics of lipz: problems in dialogue, their positions and severities, and advice.
//!
//! A [`Diagnostic`] concerns one position in one file; a [`Report`] has all diagnostics of a file, with its text. Each
//! comes from a rule with a stable [`Code`], which has a [page](Code::page). A project may set different [`Levels`] for
//! rules. `Display` is for logs; [`render`] shows reports to people, editors, code scanning and build systems:
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
//! The fields contain all data for an editor: [`Source::line_column`] converts offsets to positions, and
//! [`Fix::apply_all`] applies certain changes.
//!
//! The crate does no I/O and runs everywhere. The checks are in the crates with the data that they check: `lipz-file`,
//! `lipz-compiler`, `lipz-interop`. The command `lipz` prints, and chooses exit codes.
//!
//! # Features
//!
//! * `human` (on by default): [`render::human`] and [`render::HumanStyle`], text with the marked source.
//! * `json`: [`render::json`], [`render::sarif`] and [`render::gitlab`], documents for programs.

mod baseline;
pub mod bound;
mod code;
mod diagnostic;
mod error;
pub mod escape;
mod fix;
mod levels;
pub mod render;
mod report;
pub mod reports;
mod source;
pub mod suggest;

pub use baseline::Baseline;
pub use code::{Code, UnknownCode};
pub use diagnostic::{Applicability, Diagnostic, Fix, Label, Severity};
pub use error::DiagnosticsError;
pub use fix::FixedText;
pub use levels::Levels;
pub use report::Report;
pub use source::{LineColumn, Source, Span};

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
