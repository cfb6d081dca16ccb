//! The files that a command line names as a bank: a bank, or a base with patches, a set, and text banks next to them.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::bank_file::{BankFile, refused};
use crate::shared::set_file::SetFile;
use crate::shared::{output_file, patterns, stack};
use lipz_bank::files::{DialogueFile, FileKind};
use lipz_bank::{Bank, Dialogue, Error, ErrorKind};
use lipz_compiler::dialogue_of;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The contents of a dialogue's files, in order.
pub(crate) struct DialogueFiles {
    /// The name of the dialogue in messages.
    pub(crate) name: String,
    files: Vec<BankFile>,
    /// Whether text banks are allowed among them.
    may_have_texts: bool,
}

impl DialogueFiles {
    /// Reads the files that `path` names: a bank, the index of a set, or several of the form `base+patch+texts`.
    /// Reports unreadable files.
    pub(crate) fn open(path: &Path, reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        let mut opened = DialogueFiles::of(&stack::paths(path), reporter)?;
        if let [file] = opened.files.as_slice() {
            file.name.clone_into(&mut opened.name);
        } else {
            opened.name = console::path(path);
        }
        Ok(opened)
    }

    /// Reads the files that several paths name, each of which can name several files.
    pub(crate) fn open_all(paths: &[PathBuf], reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        let paths: Vec<PathBuf> = paths.iter().flat_map(|path| stack::paths(path)).collect();
        DialogueFiles::of(&paths, reporter)
    }

    /// Reads the files like `open_all`, but refuses text banks.
    pub(crate) fn open_banks(paths: &[PathBuf], reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        let files = DialogueFiles::open_all(paths, reporter)?;
        Ok(DialogueFiles { may_have_texts: false, ..files })
    }

    fn of(paths: &[PathBuf], reporter: &mut Reporter) -> Result<DialogueFiles, Abort> {
        let mut files = Vec::new();
        for (number, path) in patterns::files(paths).iter().enumerate() {
            match if number == 0 { SetFile::open(path, reporter)? } else { None } {
                Some(set) => files.extend(set.into_files(reporter)?),
                None => files.push(BankFile::read(path, reporter)?),
            }
        }
        let name = files.first().map_or(String::new(), |file| file.name.clone());
        Ok(DialogueFiles { name, files, may_have_texts: true })
    }

    /// Creates a dialogue from a bank that was made in memory or read before.
    pub(crate) fn one(file: BankFile) -> DialogueFiles {
        DialogueFiles { name: file.name.clone(), files: vec![file], may_have_texts: false }
    }

    /// Returns the files under the name that the user knows: for a bank of a set, that of the index.
    pub(crate) fn named(self, name: &str) -> DialogueFiles {
        DialogueFiles { name: name.to_owned(), ..self }
    }

    /// Opens and verifies the files. Reports the first that is damaged or of the wrong kind.
    pub(crate) fn verified(&self, reporter: &mut Reporter) -> Result<Vec<DialogueFile<'_>>, Abort> {
        let mut files: Vec<DialogueFile<'_>> = Vec::new();
        for (number, file) in self.files.iter().enumerate() {
            let opened = match self.is_texts(file, number) {
                false => bank(file, &files, number),
                true => texts(file, &files, number),
            };
            files.push(opened.map_err(|report| reporter.refuse(vec![report]))?);
        }
        self.refuse_twice(&files, reporter)?;
        Ok(files)
    }

    /// Returns the dialogue, whose texts and events can be counted and compared. Refuses a forged bank in which they would
    /// take minutes.
    pub(crate) fn bounded_dialogue<'f>(
        &self,
        files: &'f [DialogueFile<'f>],
        reporter: &mut Reporter,
    ) -> Result<Dialogue<'f>, Abort> {
        let dialogue = self.dialogue(files, reporter)?;
        if lipz_compiler::stats::is_bounded(&dialogue) {
            return Ok(dialogue);
        }
        let name = escape::text(&self.name).into_owned();
        let message = format!("`{name}` repeats more texts and events than can be counted");
        let help = "pack the bank again from its sources with `lipz pack`";
        Err(reporter.fail(Report::failure(name, Code::BankDamaged, message, help)))
    }

    /// Returns the dialogue of these files. Reports the file that does not match those before it.
    pub(crate) fn dialogue<'f>(
        &self,
        files: &'f [DialogueFile<'f>],
        reporter: &mut Reporter,
    ) -> Result<Dialogue<'f>, Abort> {
        let names: Vec<&str> = self.files.iter().map(|file| file.name.as_str()).collect();
        let dialogue = dialogue_of(&names, files).map_err(|report| reporter.refuse(vec![report]))?;
        let mut patches = BTreeSet::new();
        let is_again = |file: &DialogueFile<'_>| file.kind() == FileKind::Patch && !patches.insert(file.checksum());
        match files.iter().position(is_again) {
            Some(number) => {
                let diagnostic = Diagnostic::new(Code::LayerMisfit, "the stack contains this patch twice");
                let report = Report::about(names[number], diagnostic.help("name each bank once"));
                Err(reporter.refuse(vec![report]))
            }
            None => Ok(dialogue),
        }
    }

    /// Refuses an output that is one of the files, including those that only the index of a set names.
    pub(crate) fn refuse_output(
        &self,
        (file, output): (&str, &str),
        path: &Path,
        reporter: &mut Reporter,
    ) -> Result<(), Abort> {
        for own in self.files.iter().filter_map(BankFile::path) {
            output_file::refuse_same(&[(file, own), (output, path)], reporter)?;
        }
        Ok(())
    }

    /// Whether to read a file as a text bank. The first one is always a bank.
    fn is_texts(&self, file: &BankFile, number: usize) -> bool {
        self.may_have_texts && number > 0 && file.is_text_bank()
    }

    /// Returns the bytes of a single bank.
    pub(crate) fn bytes(&self) -> Option<&[u8]> {
        match self.files.as_slice() {
            [file] => Some(file.bytes()),
            _ => None,
        }
    }

    /// Refuses a second text bank for a locale.
    fn refuse_twice(&self, files: &[DialogueFile<'_>], reporter: &mut Reporter) -> Result<(), Abort> {
        let texts: Vec<_> =
            self.files.iter().enumerate().filter(|(number, file)| self.is_texts(file, *number)).collect();
        let Some(bank) = files.iter().find_map(DialogueFile::bank).filter(|_| !texts.is_empty()) else { return Ok(()) };
        let own = bank.locales().map(|locale| bank.locale_tag(locale).to_owned());
        let of_texts = texts.into_iter().flat_map(|(number, file)| tags_of(file, &files[..number]));
        let own: BTreeSet<String> = own.collect();
        let mut seen = BTreeSet::new();
        for tag in of_texts {
            let shown = escape::text(&tag).into_owned();
            let message = match (own.contains(&tag), seen.insert(tag)) {
                (true, _) => format!("the bank itself already contains the texts in `{shown}`"),
                (false, false) => format!("the texts in `{shown}` are named twice"),
                (false, true) => continue,
            };
            let tip = "name one text bank for each locale that the bank itself does not contain";
            return Err(reporter.usage(message, tip));
        }
        Ok(())
    }
}

/// Returns the locales of a text bank of one of these banks.
pub(crate) fn tags_of(file: &BankFile, banks: &[DialogueFile<'_>]) -> Vec<String> {
    let mut banks = banks.iter().filter_map(DialogueFile::bank).copied();
    let with_texts = banks.find_map(|mut bank| bank.open_texts_unverified(file.bytes()).ok().map(|()| bank));
    let tags = with_texts.iter().flat_map(|bank| bank.locales().map(|locale| bank.locale_tag(locale).to_owned()));
    tags.collect()
}

/// Opens and verifies a file as a bank or the index of a set.
fn bank<'f>(file: &'f BankFile, files: &[DialogueFile<'f>], number: usize) -> Result<DialogueFile<'f>, Report> {
    let bytes = file.bytes();
    let because = |code: Code| move |error: Error| about(file, code, error);
    let is_set = number == 0 && SetFile::is_index(bytes);
    let opened = if is_set { None } else { Some(Bank::open(bytes).map_err(because(Code::BankRefused))?) };
    // Check a patch's statements about the banks below it last.
    let damage = |error| opened.and_then(|bank| bank.verify().err()).unwrap_or(error);
    let opened = DialogueFile::open(bytes, number).map_err(|error| because(Code::BankDamaged)(damage(error)))?;
    verify(opened, files, number).map_err(because(Code::BankDamaged))
}

/// Opens and verifies a file as a text bank.
pub(crate) fn texts<'f>(
    file: &'f BankFile,
    files: &[DialogueFile<'f>],
    number: usize,
) -> Result<DialogueFile<'f>, Report> {
    let bytes = file.bytes();
    let opened = DialogueFile::open(bytes, number).map_err(|error| about(file, Code::BankRefused, error))?;
    if opened.kind() != FileKind::Texts {
        let diagnostic = Diagnostic::new(Code::BankRefused, "the file is not a text bank");
        let help = "name the .lipztexts files that `lipz pack --config split-locales=true` writes next to a bank";
        return Err(Report::about(file.name.as_str(), diagnostic.help(help)));
    }
    verify(opened, files, number).map_err(|error| {
        let code = if error.kind() == ErrorKind::OtherClips { Code::BankRefused } else { Code::BankDamaged };
        about(file, code, error)
    })
}

fn about(file: &BankFile, code: Code, error: Error) -> Report {
    Report::about(file.name.as_str(), refused(code, error, file.bytes()))
}

fn verify<'f>(file: DialogueFile<'f>, files: &[DialogueFile<'f>], number: usize) -> Result<DialogueFile<'f>, Error> {
    file.verify_in(files, number, |bytes| std::str::from_utf8(bytes).ok())
}
