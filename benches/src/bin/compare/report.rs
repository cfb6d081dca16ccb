//! Tables in a Markdown file, between comments that name them.

use crate::Failure;
use std::path::Path;

/// Replaces the part between `<!-- table: NAME -->` and `<!-- end -->` in `file`.
pub(crate) fn write(file: &Path, name: &str, table: &str) -> Result<(), Failure> {
    let text = std::fs::read_to_string(file)?;
    let start = format!("<!-- table: {name} -->\n");
    let missing = || format!("`{}` has no place for the table `{name}`", file.display());
    let (before, rest) = text.split_once(&start).ok_or_else(missing)?;
    let (_, behind) = rest.split_once("<!-- end -->").ok_or_else(missing)?;
    Ok(std::fs::write(file, format!("{before}{start}{table}<!-- end -->{behind}"))?)
}
