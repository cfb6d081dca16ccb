//! The files of the crates with wings, each with the first sentence of its comment.

use super::read;
use super::table::FLOORS;
use crate::Failure;
use std::fmt::Write;

/// Returns a tree of folders and files for each crate, with wings in their order.
///
/// # Errors
/// If a source cannot be read.
pub(in super::super) fn map() -> Result<String, Failure> {
    let mut text = String::new();
    for floor in FLOORS {
        let files = read(floor)?.files;
        let about = |file: &str| files.get(file).cloned().flatten().unwrap_or_default();
        let _ = writeln!(text, "{}: {}", floor.name, about("lib.rs"));
        for wing in floor.wings {
            let folder = format!("{wing}/");
            let mut of_wing: Vec<&str> = files.keys().map(String::as_str).collect();
            of_wing.retain(|file| file.starts_with(&folder) || file.strip_suffix(".rs") == Some(wing));
            // A folder comes before its files.
            of_wing.sort_by_key(|file| file.replace("mod.rs", ""));
            for file in of_wing {
                let shown = file.trim_end_matches("mod.rs");
                let depth = shown.trim_end_matches('/').matches('/').count() + 1;
                let name = shown.trim_end_matches('/').rsplit('/').next().unwrap_or_default();
                let slash = if shown.ends_with('/') { "/" } else { "" };
                let _ = writeln!(text, "{}{name}{slash}: {}", "  ".repeat(depth), about(file));
            }
        }
    }
    Ok(text)
}
