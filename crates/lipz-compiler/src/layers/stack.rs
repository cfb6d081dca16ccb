//! A base and the patches over it, as tools use them: opened, checked, and made one.

use super::merge;
use crate::compile::verify;
use crate::dialogue::patches;
use lipz_bank::files::{DialogueFile, FileKind};
use lipz_bank::{Bank, Dialogue, Error, ErrorKind};
use lipz_diagnostics::{Code, Diagnostic, Report};

/// A bank or a set with patches over it, and what they are together: the bank that would be packed from all of their
/// sources in one go, byte for byte.
///
/// ```
/// use lipz_compiler::{Compiler, Input, Over, Stack};
/// let aye = |text: &str| [Input::from_bytes("aye", format!(r#"{{ "text_en-us": "{text}" }}"#))];
/// let compiler = Compiler::default();
/// let base = compiler.compile(&aye("Aye.")).into_bank()?;
/// let over = Over::new(Stack::open([("base", &base)]).map_err(|report| report.to_string())?);
/// let patch = compiler.compile_over(&aye("Aye, aye."), &over).into_bank()?;
/// let stack = Stack::open([("base", &base), ("patch", &patch)]).map_err(|report| report.to_string())?;
/// assert_eq!(stack.into_bank(), compiler.compile(&aye("Aye, aye.")).into_bank()?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Stack {
    pub(super) whole: Vec<u8>,
    /// Checksums of the base, which of a set is that of its index, and of the patches, the lowest first.
    pub(super) checksums: Vec<u64>,
}

impl Stack {
    /// Opens and verifies files, each with the name that messages give it, and makes one bank of them: a bank, or the index of a
    /// set and its banks, and then patches.
    ///
    /// # Errors
    /// When one of them is damaged or does not fit those before it. The base must not be a patch.
    pub fn open<'f, B: AsRef<[u8]> + ?Sized + 'f>(
        files: impl IntoIterator<Item = (&'f str, &'f B)>,
    ) -> Result<Stack, Report> {
        let named: Vec<(&str, &[u8])> = files.into_iter().map(|(name, bytes)| (name, bytes.as_ref())).collect();
        let mut files: Vec<DialogueFile<'_>> = Vec::new();
        for (number, (name, bytes)) in named.iter().enumerate() {
            files.push(verified(name, bytes, &files, number)?);
        }
        let names: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
        let dialogue = dialogue_of(&names, &files)?;
        match named.as_slice() {
            [(name, bytes)] => {
                refuse_part(name, &dialogue)?;
                Stack::new(bytes.to_vec(), &dialogue)
            }
            _ => Stack::new(merge::merge(&dialogue)?, &dialogue),
        }
    }

    /// The same of a dialogue, which is verified and may have text banks. Messages call its base `name`.
    ///
    /// # Errors
    /// When its base is a patch, when a bank of its set is not there, and when it is too large for one bank.
    pub fn of(name: &str, dialogue: &Dialogue<'_>) -> Result<Stack, Report> {
        refuse_part(name, dialogue)?;
        let is_there = |number| dialogue.file(number).is_some_and(|file| file.kind() != FileKind::Absent);
        if !(0..dialogue.file_count()).all(is_there) {
            let diagnostic = Diagnostic::new(Code::BankRefused, "a bank of the set is not there");
            return Err(Report::about(name, diagnostic.help("open the set with all of its banks")));
        }
        Stack::new(merge::merge(dialogue)?, dialogue)
    }

    fn new(whole: Vec<u8>, dialogue: &Dialogue<'_>) -> Result<Stack, Report> {
        verify(&whole)?;
        let base = dialogue.file(0).map(DialogueFile::checksum);
        let mut patches: Vec<u64> = patches(dialogue).map(|(_, bank)| bank.checksum()).collect();
        patches.reverse();
        Ok(Stack { whole, checksums: base.into_iter().chain(patches).collect() })
    }

    /// The bank that the stack is as a whole.
    pub fn bank(&self) -> &[u8] {
        &self.whole
    }

    /// The bank that the stack is as a whole.
    pub fn into_bank(self) -> Vec<u8> {
        self.whole
    }
}

/// The dialogue of verified files, which messages call by these names.
///
/// # Errors
/// When one of them does not fit those before it, with the remedy. Under other banks, the base must not be a patch.
pub fn dialogue_of<'f>(names: &[&str], files: &'f [DialogueFile<'f>]) -> Result<Dialogue<'f>, Report> {
    let name = |number: usize| names.get(number).or(names.last()).copied().unwrap_or_default();
    if files.iter().filter_map(DialogueFile::bank).count() > 1 {
        files.first().map_or(Ok(()), |base| refuse_patch(name(0), base))?;
    }
    Dialogue::new(files).map_err(|error| {
        let number = error.file();
        misfit(name(number), error.error().kind(), files.get(number).and_then(DialogueFile::bank))
    })
}

/// Refuses a base that is a patch.
fn refuse_patch(name: &str, base: &DialogueFile<'_>) -> Result<(), Report> {
    match base.kind() {
        FileKind::Patch => Err(misfit(name, ErrorKind::OtherBase, base.bank())),
        _ => Ok(()),
    }
}

/// Refuses a dialogue that is not a whole bank.
pub(super) fn refuse_part(name: &str, dialogue: &Dialogue<'_>) -> Result<(), Report> {
    dialogue.file(0).map_or(Ok(()), |base| refuse_patch(name, base))
}

/// A file, verified, the one with this number behind `files`.
fn verified<'f>(
    name: &str,
    bytes: &'f [u8],
    files: &[DialogueFile<'f>],
    number: usize,
) -> Result<DialogueFile<'f>, Report> {
    let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
    let opened = DialogueFile::open(bytes, number).map_err(|error| (Code::BankRefused, error));
    let verified =
        opened.and_then(|file| file.verify_in(files, number, utf8).map_err(|error| (Code::BankDamaged, error)));
    verified.map_err(|(code, error)| refused(name, code, error, bytes))
}

fn refused(name: &str, code: Code, error: Error, bytes: &[u8]) -> Report {
    let place = format!("bank error {}, at byte {} of {}", error.kind().number(), error.offset_bytes(), bytes.len());
    let diagnostic = Diagnostic::new(code, error.kind().message()).note(place);
    Report::about(name, diagnostic.help("name .lipzbank files, copied whole; pack those that are damaged again"))
}

/// The report about a file that does not fit those before it.
fn misfit(name: &str, kind: ErrorKind, bank: Option<&Bank<'_>>) -> Report {
    let help = match kind {
        ErrorKind::OtherBase => {
            "name the banks that it was packed over, in their order, before it; `lipz inspect` shows their checksums"
        }
        ErrorKind::NotALayer => "name one bank or set first, and behind it those that were packed with `--over`",
        ErrorKind::LayerCount => "name at least one bank, and at most 15 that were packed with `--over`",
        ErrorKind::OtherBank => "copy all files of the set again, or link it again: lipz link",
        _ => "pack it again",
    };
    let mut diagnostic = Diagnostic::new(Code::LayerMisfit, kind.message()).help(help);
    if kind == ErrorKind::OtherBase {
        let over = bank.and_then(Bank::layer).into_iter().flat_map(|layer| layer.made_over());
        let over: Vec<String> = over.map(|checksum| format!("{checksum:016x}")).collect();
        diagnostic = diagnostic.note(format!("it was packed over {}", over.join(", ")));
    }
    Report::about(name, diagnostic)
}
