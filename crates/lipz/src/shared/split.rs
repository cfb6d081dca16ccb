//! The parts of a bank in separate files.

use crate::Abort;
use crate::reporter::Reporter;
use lipz_compiler::Outputs;
use std::path::Path;

/// The parts of a bank that are written to separate files.
#[derive(Clone, Copy)]
pub(crate) struct Split {
    /// The texts of each locale.
    pub(crate) locales: bool,
    /// The dubs of each voice.
    pub(crate) voices: bool,
}

impl Split {
    /// Refuses to split both texts and dubs.
    pub(crate) fn refuse_both(self, reporter: &mut Reporter) -> Result<(), Abort> {
        if self.locales && self.voices {
            let tip = "set one of `split-locales` and `split-voices` to false";
            return Err(reporter.usage("a bank cannot be split both by locale and by voice", tip));
        }
        Ok(())
    }

    /// Returns the output files of a bank.
    pub(crate) fn outputs(self, bank: &Path) -> Outputs {
        Outputs::new(bank).split_locales(self.locales).split_voices(self.voices)
    }
}
