//! Files on disk: reading, comparing, locking, and replacing them so that each is either the old or the new one.

pub(crate) mod file_eq;
#[cfg(feature = "cache")]
mod file_meta;
#[cfg(unix)]
mod last_folder;
pub(crate) mod lock;
pub(crate) mod output;
mod output_file;
pub(crate) mod path;
mod reader;
mod replacements;
pub(crate) mod temporary;

#[cfg(feature = "cache")]
pub(crate) use file_meta::FileMeta;
pub use output::replace_file;
pub use output_file::{OutputFile, Replace};
pub(crate) use reader::FileReader;
pub use replacements::Replacements;
