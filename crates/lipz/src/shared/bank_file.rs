//! Bank files on disk, and what to say when they are not banks.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::stdio;
use lipz_bank::{Bank, Error, ErrorKind};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_host::FileBytes;
use lipz_layout::{FORMAT_MAJOR, FORMAT_MINOR, Header, MAGIC, SET_MAGIC};
use std::io;
use std::mem::offset_of;
use std::path::{Path, PathBuf};

/// The most bytes that a bank has: its offsets have 32 bits.
const LONGEST_BANK: u64 = u32::MAX as u64;

const NAME_A_BANK: &str = "name a .lipzbank file; `lipz pack` packs one from Lipz files";

/// Not all commands read texts.
const NAME_TEXTS: &str = "name the bank that it belongs to; commands that read texts take this file with --texts";

const NAME_SET_FIRST: &str = "name the index of a set first, before the banks that were packed over it";

const LINK_AGAIN: &str = "copy all files of the set again, or link it again: lipz link";

/// The bytes of a bank, and how messages name it.
pub(crate) struct BankFile {
    pub(crate) name: String,
    /// Where it is; empty for standard input and for a bank that was made in memory.
    path: PathBuf,
    bytes: FileBytes,
}

impl BankFile {
    /// Where the file is; nowhere for standard input and for a bank that was made in memory.
    pub(crate) fn path(&self) -> Option<&Path> {
        Some(self.path.as_path()).filter(|path| !path.as_os_str().is_empty())
    }

    /// The bytes of the file.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Reads the file at `path`, or standard input. Reports why that is not possible.
    pub(crate) fn read(path: &Path, reporter: &mut Reporter) -> Result<BankFile, Abort> {
        if stdio::is_meant(path) {
            let bytes = stdio::read(LONGEST_BANK + 1).map(FileBytes::from);
            return BankFile::of_bytes(stdio::input_name(), Path::new(""), bytes, CHECK_SPELLING, reporter);
        }
        BankFile::of_bytes(console::path(path), path, FileBytes::read(path), CHECK_SPELLING, reporter)
    }

    /// Reads the file at `path`, a bank of the set with this name. Reports why that is not possible.
    pub(crate) fn of_set(path: &Path, set: &str, reporter: &mut Reporter) -> Result<BankFile, Abort> {
        let help = format!("`{set}` names it: copy a set with all of its banks, or link it again");
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
                let diagnostic = unreadable(&name, &error, help);
                Err(reporter.fail(Report::about(name, diagnostic)))
            }
        }
    }

    /// A bank that was made in memory.
    pub(crate) fn made(name: String, bytes: Vec<u8>) -> BankFile {
        BankFile { name, path: PathBuf::new(), bytes: bytes.into() }
    }

    /// The bank, verified. Reports what is wrong with it.
    pub(crate) fn bank(&self, reporter: &mut Reporter) -> Result<Bank<'_>, Abort> {
        let opened = Bank::open(&self.bytes).map_err(|error| (Code::BankRefused, error));
        let verified = opened.and_then(|bank| verified(bank).map_err(|error| (Code::BankDamaged, error)));
        verified.map_err(|(code, error)| {
            reporter.refuse(vec![Report::about(self.name.as_str(), refused(code, error, &self.bytes))])
        })
    }
}

/// The bank, verified with what it says about banks below it.
fn verified(bank: Bank<'_>) -> Result<Bank<'_>, Error> {
    let bank = bank.verify()?;
    bank.verified_layer()?;
    Ok(bank)
}

/// The help for a file that you named, and that is not there.
const CHECK_SPELLING: &str = "check the spelling of the path";

/// The diagnostic for a file that cannot be read; `help` is for one that is not there.
fn unreadable(shown: &str, error: &io::Error, help: &str) -> Diagnostic {
    let diagnostic = |what: &str| Diagnostic::new(Code::BankRefused, format!("`{shown}` {what}"));
    match error.kind() {
        io::ErrorKind::NotFound => diagnostic("does not exist").help(help),
        io::ErrorKind::IsADirectory => diagnostic("is a folder").help("name the bank in it"),
        _ => diagnostic(&format!("cannot be read: {error}")),
    }
}

/// The diagnostic for a file that does not open or verify as a bank.
pub(crate) fn refused(code: Code, error: Error, bytes: &[u8]) -> Diagnostic {
    let kind = error.kind();
    let place = format!("bank error {}, at byte {} of {}", kind as u8, error.offset_bytes(), bytes.len());
    let diagnostic = Diagnostic::new(code, kind.message()).note(place);
    let update = "update lipz, or pack the bank again with this one";
    match kind {
        ErrorKind::UnsupportedVersion => diagnostic
            .note(format!("the bank has {}, this lipz reads {FORMAT_MAJOR}.{FORMAT_MINOR}", version(bytes)))
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

/// The format version in the header, `2.0`.
fn version(bytes: &[u8]) -> String {
    let number = |at: usize| match bytes.get(at..at + 2) {
        Some(&[low, high]) => u16::from_le_bytes([low, high]).to_string(),
        _ => "?".to_owned(),
    };
    format!("{}.{}", number(offset_of!(Header, format_major)), number(offset_of!(Header, format_minor)))
}
