//! Changing source files: certain fixes, conversion to other viseme types, and rewriting by tools.

mod conversion_edits;
mod convert;
mod fix;
mod rewrite;

pub use convert::ConvertedFile;
pub use fix::FixedFile;
pub use rewrite::rewrite_file;
