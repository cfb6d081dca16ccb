//! The capacity of a bank's fields.

use lipz_diagnostics::{Code, Report};

/// Returns a number for a 32-bit field of the bank, or the diagnostic that it is too large.
pub(crate) fn fit(number: usize, what: &str) -> Result<u32, Report> {
    u32::try_from(number).map_err(|_| too_large(what))
}

pub(crate) fn too_large(what: &str) -> Report {
    Report::failure(
        "",
        Code::BankTooLarge,
        format!("the {what} of the bank exceed the range of its offsets"),
        "make several banks, such as one per act or per language",
    )
}
