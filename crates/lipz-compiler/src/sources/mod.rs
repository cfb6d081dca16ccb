//! Conversion of the sources that a user names to inputs: Lipz files with their keys.

pub(crate) mod discover;
mod input;
pub mod key;
mod list;
pub(crate) mod walk;

pub use discover::{discover, discover_with_reports, is_pattern, resolved_below};
pub use input::{Content, Input, Inputs};
