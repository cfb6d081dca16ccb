//! Bank files on disk, and messages about files that are not banks.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::input_file::{self, CHECK_SPELLING};
use crate::shared::stdio;
use lipz_bank::{Bank, Error, ErrorKind};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_host::FileBytes;
use lipz_layout::{FORMAT_MAJOR, FORMAT_MINOR, Header, MAGIC, SET_MAGIC};
use std::io;
use std::mem::offset_of;
use std::path::{Path, PathBuf};

/// The maximum length of a bank, because its offsets have 32 bits.
const LONGEST_BANK: u64 = u32::MAX as u64;

const NAME_A_BANK: &str = "name a .lipzbank file; `lipz pack` packs one from Lipz files";

/// The help where a text bank is named instead of a bank.
const NAME_TEXTS: &str = "name the bank that it belongs to before it: BANK+TEXTS";

const NAME_SET_FIRST: &str = "name the index of the set first, before its patches";

const LINK_AGAIN: &str = "copy all files of the set again, or link it again: lipz shard link";

/// The bytes of a bank, and its name in messages.
pub(crate) struct BankFile {
    pub(crate) name: String,
    /// The path; empty for standard input and for a bank in memory.
    path: PathBuf,
    bytes: FileBytes,
}

impl BankFile {
    /// Returns the path of the file; `None` for standard input and for a bank in memory.
    pub(crate) fn path(&self) -> Option<&Path> {
        Some(self.path.as_path()).filter(|path| !path.as_os_str().is_empty())
    }

    /// Returns the bytes of the file.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Whether it has the header of a text bank.
    pub(crate) fn is_text_bank(&self) -> bool {
        Bank::open(self.bytes()).is_err_and(|error| error.kind() == ErrorKind::TextsOnly)
    }

    /// Reads the file at `path`, or standard input. Reports errors.
    pub(crate) fn read(path: &Path, reporter: &mut Reporter) -> Result<BankFile, Abort> {
        if stdio::is_meant(path) {
            let bytes = stdio::read(LONGEST_BANK + 1).map(FileBytes::from);
            return BankFile::of_bytes(stdio::input_name(), Path::new(""), bytes, CHECK_SPELLING, reporter);
        }
        BankFile::of_bytes(console::path(path), path, FileBytes::read(path), CHECK_SPELLING, reporter)
    }

    /// Reads the file at `path`, a bank of the set with this name. Reports errors.
    pub(crate) fn of_set(path: &Path, set: &str, reporter: &mut Reporter) -> Result<BankFile, Abort> {
        let help = format!("copy all banks of `{set}`, or link the set again");
        BankFile::of_bytes(console::path(path), path, FileBytes::read(path), &help, reporter)
    }

    fn of_bytes(
        name: String,
        path: &Path,
        bytes: io::Result<FileBytes>,
        help: &str,
        reporter: &mut Reporter,
    ) -> Result<BankFile, Abort> {
        match bytes {
            Ok(bytes) => Ok(BankFile { name, path: path.to_owned(), bytes }),
            Err(error) => {
                let helps = [help, "name the bank in it"];
                let diagnostic = input_file::refused(Code::BankRefused, &name, &error, helps);
                Err(reporter.fail(Report::about(name, diagnostic)))
            }
        }
    }

    /// Creates a bank in memory.
    pub(crate) fn made(name: String, bytes: Vec<u8>) -> BankFile {
        BankFile { name, path: PathBuf::new(), bytes: bytes.into() }
    }

    /// Returns the verified bank. Reports damage.
    pub(crate) fn bank(&self, reporter: &mut Reporter) -> Result<Bank<'_>, Abort> {
        let opened = Bank::open(&self.bytes).map_err(|error| (Code::BankRefused, error));
        let verified = opened.and_then(|bank| verified(bank).map_err(|error| (Code::BankDamaged, error)));
        verified.map_err(|(code, error)| {
            reporter.refuse(vec![Report::about(self.name.as_str(), refused(code, error, &self.bytes))])
        })
    }
}

/// Verifies the bank, including its statements about banks below it.
fn verified(bank: Bank<'_>) -> Result<Bank<'_>, Error> {
    let bank = bank.verify()?;
    bank.verified_layer()?;
    Ok(bank)
}

/// Returns the diagnostic for a file that fails to open or verify as a bank.
pub(crate) fn refused(code: Code, error: Error, bytes: &[u8]) -> Diagnostic {
    let kind = error.kind();
    let place = format!("bank error {}, at byte {} of {}", kind as u8, error.offset_bytes(), bytes.len());
    let diagnostic = Diagnostic::new(code, kind.message()).note(place);
    let update = "update lipz, or pack the bank again with this version";
    match kind {
        ErrorKind::UnsupportedVersion => diagnostic
            .note(format!("the bank has format {}, but this lipz reads {FORMAT_MAJOR}.{FORMAT_MINOR}", version(bytes)))
            .help(update),
        ErrorKind::SectionUnknown => diagnostic.help(update),
        ErrorKind::NotABank if bytes.starts_with(&SET_MAGIC) => diagnostic.help(NAME_SET_FIRST),
        ErrorKind::NotABank => diagnostic.help(NAME_A_BANK),
        ErrorKind::TooShort if !bytes.starts_with(&MAGIC) => diagnostic.help(NAME_A_BANK),
        ErrorKind::TextsOnly => diagnostic.help(NAME_TEXTS),
        ErrorKind::OtherClips => diagnostic.help("use the texts that were packed with this bank, or pack both again"),
        ErrorKind::OtherBank => diagnostic.help(LINK_AGAIN),
        ErrorKind::TextMode => diagnostic.help("copy it again in binary mode"),
        _ => diagnostic.help("copy the bank again, or pack it again"),
    }
}

/// Returns the format version from the header: `2.0`.
fn version(bytes: &[u8]) -> String {
    let number = |at: usize| match bytes.get(at..at + 2) {
        Some(&[low, high]) => u16::from_le_bytes([low, high]).to_string(),
        _ => "?".to_owned(),
    };
    format!("{}.{}", number(offset_of!(Header, format_major)), number(offset_of!(Header, format_minor)))
}
