//! Verifying a new bank with the reader.

use lipz_bank::Bank;
use lipz_diagnostics::{Code, Report};

/// Verifies a new bank. An error is a defect of this compiler, which should be found here rather than in a game.
pub(crate) fn verify(bank: &[u8]) -> Result<(), Report> {
    // Core's UTF-8 check would take longer than all other checks together.
    let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
    verified(Bank::open(bank).and_then(|bank| bank.verify_with(utf8).map(|_| ())))
}

/// Verifies a bank with zeros in place of the data of its clips.
pub(crate) fn verify_tables(tables: &[u8]) -> Result<(), Report> {
    verified(Bank::open(tables).and_then(|bank| bank.verify_tables()))
}

fn verified(found: Result<(), lipz_bank::Error>) -> Result<(), Report> {
    found.map_err(|error| {
        let message = format!("the new bank fails verification: {error}");
        let help = "report this bug of lipz together with the files that cause it";
        Report::failure("", Code::BankDamaged, message, help)
    })
}
