//! The answers of a bank as a string.

use super::answers::write_answers;
use lipz_bank::Bank;

/// Everything that `bank` answers, one fact a line, in the order of keys and tags.
pub(crate) fn dump(bank: &Bank<'_>) -> String {
    let mut out = String::new();
    write_answers(bank, &mut out).expect("a string takes everything");
    out
}
