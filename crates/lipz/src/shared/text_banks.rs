//! The text banks of a bank that was split by locale: one argument for all commands that read banks.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::bank_file::BankFile;
use crate::shared::patterns;
use clap::Args;
use lipz_bank::{Bank, TextBank};
use lipz_diagnostics::escape;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// The text banks of the bank that a command reads.
#[derive(Args, Debug)]
pub(crate) struct TextBanks {
    /// Text banks of the bank, which comes before them: their locales are added to its own
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub(crate) texts: Vec<PathBuf>,
}

/// Files that are to be text banks of one bank.
pub(crate) struct TextFiles(Vec<BankFile>);

impl TextFiles {
    /// Reads the files. Reports which one cannot be read.
    pub(crate) fn open(paths: &[PathBuf], reporter: &mut Reporter) -> Result<TextFiles, Abort> {
        patterns::files(paths)
            .iter()
            .map(|path| BankFile::open(path, reporter))
            .collect::<Result<_, _>>()
            .map(TextFiles)
    }

    /// The text banks of `bank`, verified. Reports what is wrong with one of them.
    pub(crate) fn verified<'f>(&'f self, bank: &Bank<'_>, reporter: &mut Reporter) -> Result<Vec<TextBank<'f>>, Abort> {
        let texts = self.0.iter().map(|file| file.texts(bank, reporter)).collect::<Result<Vec<_>, _>>()?;
        let mut seen = BTreeSet::new();
        for locale in bank.locales().chain(texts.iter().flat_map(TextBank::locales)) {
            if !seen.insert(locale.tag().to_owned()) {
                let message = format!("the texts in `{}` are named twice", escape::text(locale.tag()));
                let tip = "name one text bank for each locale that the bank itself does not have";
                return Err(reporter.usage(message, tip));
            }
        }
        Ok(texts)
    }
}
