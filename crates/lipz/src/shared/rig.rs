//! Rigs that the command line names.

use crate::reporter::{Abort, Reporter};
use lipz_compiler::Options;
use lipz_compiler::rigs::{self, WeightSpec};
use lipz_diagnostics::escape;

/// Returns the rig of the project with this name, or the built-in one.
pub(crate) fn named(
    name: &str,
    options: &Options,
    reporter: &mut Reporter,
) -> Result<(String, Vec<WeightSpec>), Abort> {
    match rigs::named(name, options.get_rigs()) {
        Ok(weights) => Ok((name.to_owned(), weights)),
        Err(tip) => Err(reporter.usage(format!("there is no rig {}", escape::quoted(name)), &tip)),
    }
}
