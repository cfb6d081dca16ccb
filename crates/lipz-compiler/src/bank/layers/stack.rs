//! A base and its patches for tools: opened, checked and merged.

use super::merge;
use crate::bank::dialogue::patches;
use crate::bank::verify::verify;
use lipz_bank::files::{DialogueFile, FileKind};
use lipz_bank::{Bank, Dialogue, Error, ErrorKind};
use lipz_diagnostics::{Code, Diagnostic, Report};

/// A bank or a set with patches on top of it, merged: byte for byte the bank that packing all of their sources together
/// would make.
///
/// ```
/// use lipz_compiler::{Compiler, Input, Stack, StackBelow};
/// let aye = |text: &str| [Input::from_bytes("aye", format!(r#"{{ "text_en-us": "{text}" }}"#))];
/// let compiler = Compiler::default();
/// let base = compiler.compile(&aye("Aye.")).into_bank()?;
/// let over = StackBelow::new(Stack::open([("base", &base)]).map_err(|report| report.to_string())?);
/// let patch = compiler.compile_over(&aye("Aye, aye."), &over).into_bank()?;
/// let stack = Stack::open([("base", &base), ("patch", &patch)]).map_err(|report| report.to_string())?;
/// assert_eq!(stack.into_bank(), compiler.compile(&aye("Aye, aye.")).into_bank()?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Stack {
    pub(crate) whole: Vec<u8>,
    /// Checksums of the base and of the patches, from the lowest up. For a set, that of its index.
    pub(crate) checksums: Vec<u64>,
}

impl Stack {
    /// Opens and verifies files, each with its name for messages, and merges them into one bank. They are a bank, or
    /// the index of a set and its banks, followed by patches.
    ///
    /// # Errors
    /// If a file is damaged or does not match those before it, or if the base is a patch.
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

    /// Merges a verified dialogue, which may have text banks. Messages call its base `name`.
    ///
    /// # Errors
    /// If its base is a patch, if a bank of its set is missing, or if it is too large for one bank.
    pub fn of(name: &str, dialogue: &Dialogue<'_>) -> Result<Stack, Report> {
        refuse_part(name, dialogue)?;
        let is_there = |number| dialogue.file(number).is_some_and(|file| file.kind() != FileKind::Absent);
        if !(0..dialogue.file_count()).all(is_there) {
            let diagnostic = Diagnostic::new(Code::BankRefused, "a bank of the set is missing");
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

    /// Returns the bank of the whole stack.
    pub fn bank(&self) -> &[u8] {
        &self.whole
    }

    /// Returns the bank of the whole stack.
    pub fn into_bank(self) -> Vec<u8> {
        self.whole
    }
}

/// Returns the dialogue of verified files, with their names for messages.
///
/// # Errors
/// If a file does not match those before it, or if the base of several files is a patch. The report includes the
/// remedy.
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

/// Verifies a file, which comes after `files`.
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
    Report::about(name, diagnostic.help("name complete .lipzbank files; pack damaged ones again"))
}

/// Returns the report about a file that does not match those before it.
fn misfit(name: &str, kind: ErrorKind, bank: Option<&Bank<'_>>) -> Report {
    let help = match kind {
        ErrorKind::OtherBase => {
            "before it, name the banks that it was packed over, in order; `lipz inspect` shows their checksums"
        }
        ErrorKind::NotALayer => "name one bank or set first, and then the patches, which were packed with `--over`",
        ErrorKind::LayerCount => "name at least one bank, and at most 15 patches, which were packed with `--over`",
        ErrorKind::OtherBank => "copy all files of the set again, or link it again with `lipz shard link`",
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
