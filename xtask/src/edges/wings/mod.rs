//! The order of the wings of a crate: which files may import which.

mod circles;
mod imports;
mod map;
mod modules;
mod table;

use crate::Failure;
use crate::paths::workspace_root;
use circles::circles;
use modules::Sources;
use std::collections::BTreeSet;
use table::{FLOORS, Floor, LARGEST_CIRCLE};

pub(super) use map::map;

/// The result for the imports of a crate.
struct WingReport {
    /// Imports from one wing to another: pairs of files.
    between_wings: usize,
    /// The number of these that are against the order.
    against_order: usize,
    /// The number of files in the largest circle; 1 without circles.
    largest_circle: usize,
    /// The forbidden imports, as lines to print.
    refused: Vec<String>,
}

/// Returns a line with the numbers of each crate that has wings, and the forbidden imports.
///
/// # Errors
/// If a source cannot be read.
pub(super) fn check() -> Result<(Vec<String>, Vec<String>), Failure> {
    let (mut numbers, mut refused) = (Vec::new(), Vec::new());
    for floor in FLOORS {
        let WingReport { between_wings, against_order, largest_circle, refused: lines } = examine(&read(floor)?, floor);
        numbers.push(format!(
            "{}: {} wings, {between_wings} imports between them, {against_order} against their order, \
             {largest_circle} files in the largest circle",
            floor.name,
            floor.wings.len(),
        ));
        refused.extend(lines.into_iter().map(|line| format!("{}: {line}", floor.name)));
    }
    Ok((numbers, refused))
}

fn read(floor: &Floor) -> Result<Sources, Failure> {
    Sources::read(&workspace_root().join("crates").join(floor.name).join("src"))
        .map_err(|failure| format!("{}: {failure}", floor.name))
}

/// Returns the wing of a file: its first folder, or its own name.
fn wing(file: &str) -> &str {
    file.split('/').next().unwrap_or_default().trim_end_matches(".rs")
}

fn examine(sources: &Sources, floor: &Floor) -> WingReport {
    let mut refused = Vec::new();
    let wings: BTreeSet<&str> = sources.files.keys().map(|file| wing(file)).filter(|wing| *wing != "lib").collect();
    let unlisted = wings.iter().filter(|wing| !floor.wings.contains(wing));
    refused.extend(unlisted.map(|wing| format!("`{wing}` is not a wing: list it in xtask/src/edges/wings/table.rs")));
    let missing = floor.wings.iter().filter(|wing| !wings.contains(*wing));
    refused.extend(missing.map(|wing| format!("the wing `{wing}` is missing")));

    let imports = sources.imports();
    let through_lib = imports.of_crate.iter().filter(|(file, path)| {
        file != "lib.rs" && path.first().is_none_or(|name| !floor.wings.contains(&name.as_str()))
    });
    refused.extend(through_lib.map(|(file, path)| {
        format!("{file} imports `crate::{}` through lib.rs: import it from its wing", path.join("::"))
    }));

    let height = |file: &str| floor.wings.iter().position(|name| *name == wing(file));
    let pairs =
        || imports.files.iter().flat_map(|(from, files)| files.iter().map(move |to| (from.as_str(), to.as_str())));
    let against: Vec<(&str, &str)> =
        pairs().filter(|(from, to)| height(from) < height(to) && *from != "lib.rs").collect();
    refused.extend(
        against
            .iter()
            .map(|(from, to)| format!("{from} imports {to}: the wing `{}` is below `{}`", wing(from), wing(to))),
    );

    let circles = circles(&imports.files);
    let too_large = circles.iter().filter(|circle| circle.len() > LARGEST_CIRCLE);
    refused.extend(too_large.map(|circle| {
        let files: Vec<&str> = circle.iter().copied().collect();
        format!("{} files import each other, but {LARGEST_CIRCLE} may: {}", files.len(), files.join(", "))
    }));
    WingReport {
        between_wings: pairs().filter(|(from, to)| *from != "lib.rs" && wing(from) != wing(to)).count(),
        against_order: against.len(),
        largest_circle: circles.first().map_or(1, BTreeSet::len),
        refused,
    }
}

#[cfg(test)]
mod tests;
