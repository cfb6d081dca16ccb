//! The files of a bank: the bank itself, or a base with a text bank for each locale next to it.

use crate::bank::layers::VoiceBanks;
use crate::bank::split::WholeBank;
use crate::files::lock::Lock;
use crate::files::{OutputFile, Replace, Replacements};
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use lipz_bank::Bank;
use lipz_diagnostics::Report;
use std::collections::HashSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// The suffix of text banks, after their locale.
const TEXTS_EXTENSION: &str = ".lipztexts";
/// The suffix of banks of voices, after their locale.
const VOICES_EXTENSION: &str = ".lipzbank";

/// The output files of a bank: one, or also one for each locale, and optionally a cache.
///
/// ```
/// use lipz_compiler::{Compiler, Input, Outputs};
/// # let folder = tempfile::tempdir()?;
/// # let folder = folder.path();
/// let file = r#"{ "text_en-us": "Mayor!", "text_de-de": "Meister!" }"#;
/// let outputs = Outputs::new(folder.join("dialogue.lipzbank")).split_locales(true);
/// let written = outputs.pack(&Compiler::default(), &[Input::from_bytes("act1/mayor", file)]).into_bank()?;
/// let names: Vec<_> = written.files.iter().filter_map(|file| file.path.file_name()?.to_str()).collect();
/// assert_eq!(names, ["dialogue.lipzbank", "dialogue.de-de.lipztexts", "dialogue.en-us.lipztexts"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Outputs {
    bank: PathBuf,
    is_split: bool,
    is_split_by_voice: bool,
    cache: Option<PathBuf>,
}

/// The files of a run.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct DeliveredFiles {
    /// The bank first, then the text banks, sorted by locale.
    pub files: Vec<OutputFile>,
    /// Text banks of locales that the bank lacks. They stay, because their removal is the user's decision.
    pub stale: Vec<PathBuf>,
}

impl From<OutputFile> for DeliveredFiles {
    fn from(file: OutputFile) -> DeliveredFiles {
        DeliveredFiles { files: vec![file], stale: Vec::new() }
    }
}

impl Outputs {
    /// Creates an output to the file `bank`.
    pub fn new(bank: impl Into<PathBuf>) -> Outputs {
        Outputs { bank: bank.into(), is_split: false, is_split_by_voice: false, cache: None }
    }

    /// Packs the texts of each locale into a text bank next to the bank: `dialogue.en-us.lipztexts` for
    /// `dialogue.lipzbank`. Split banks have no cache.
    #[must_use]
    pub fn split_locales(mut self, is_split: bool) -> Outputs {
        self.is_split = is_split;
        self
    }

    /// Packs the dubs of each voice into a separate bank next to the bank, as a layer on top of it:
    /// `dialogue.de-de.lipzbank` for `dialogue.lipzbank`. Such banks have no cache, and are not split by locale.
    #[must_use]
    pub fn split_voices(mut self, is_split: bool) -> Outputs {
        self.is_split_by_voice = is_split;
        self
    }

    /// Whether the bank is split into several files.
    fn has_parts(&self) -> bool {
        self.is_split || self.is_split_by_voice
    }

    /// Stores data about the Lipz files in the file `cache`, like [`Compiler::pack_cached`].
    #[cfg(feature = "cache")]
    #[must_use]
    pub fn cache(mut self, cache: Option<PathBuf>) -> Outputs {
        self.cache = cache;
        self
    }

    /// Makes the bank and writes its files.
    pub fn pack(&self, compiler: &Compiler<'_>, inputs: &[Input]) -> Compiled<DeliveredFiles> {
        let compiled = match &self.cache {
            _ if self.has_parts() => return self.deliver_compiled(compiler, compiler.compile(inputs), Replace::Always),
            #[cfg(feature = "cache")]
            Some(cache) => compiler.pack_cached(inputs, &self.bank, cache),
            _ => compiler.pack(inputs, &self.bank),
        };
        compiled.map(DeliveredFiles::from)
    }

    /// Makes the bank with the previous run from `memory`, initially that of the cache. If `changed` names the files
    /// that can have changed since then, no others are examined, as with [`Compiler::compile_changed`]. Only changed
    /// files are written.
    #[cfg(feature = "cache")]
    pub fn pack_again(
        &self,
        compiler: &Compiler<'_>,
        inputs: &[Input],
        changed: Option<&[usize]>,
        memory: &mut crate::run::Memory,
    ) -> Compiled<DeliveredFiles> {
        if self.has_parts() {
            let compiled = compiler.compile_changed(inputs, changed, memory);
            return self.deliver_compiled(compiler, compiled, Replace::IfDifferent);
        }
        if let (Some(cache), true) = (&self.cache, memory.is_empty()) {
            match crate::run::Memory::read_beside(cache) {
                Ok(read) => *memory = read,
                Err(report) => return Compiled::refused(report),
            }
        }
        compiler.pack_changed(inputs, changed, &self.bank, memory).map(DeliveredFiles::from)
    }

    fn deliver_compiled(
        &self,
        compiler: &Compiler<'_>,
        compiled: Compiled,
        replace: Replace,
    ) -> Compiled<DeliveredFiles> {
        compiled.and_then(|bank| compiler.write_guarded(&self.bank, || self.deliver(&bank, replace)))
    }

    /// Writes the memory to the cache, if there is one.
    ///
    /// # Errors
    /// Those of [`Memory::write`](crate::Memory::write).
    #[cfg(feature = "cache")]
    pub fn remember(&self, memory: &crate::run::Memory) -> Result<(), Report> {
        self.used_cache().map_or(Ok(()), |cache| memory.write(cache))
    }

    #[cfg(feature = "cache")]
    fn used_cache(&self) -> Option<&Path> {
        self.cache.as_deref().filter(|_| !self.has_parts())
    }

    /// Writes the files of `bank`. The base of a split bank is written last, so that a reader that finds it also finds
    /// its texts. Concurrent runs that write the files of a split bank to the same path are serialised.
    ///
    /// # Errors
    /// Those of [`replace_file`](crate::replace_file); and if `bank` is damaged, or if another run has been writing the
    /// files for half a minute.
    pub fn deliver(&self, bank: &[u8], replace: Replace) -> Result<DeliveredFiles, Report> {
        if !self.has_parts() {
            return Ok(OutputFile::write(&self.bank, bank, replace)?.into());
        }
        // Commands delay an interrupt until the files are written.
        let _lock = Lock::wait_briefly(&self.bank)?;
        if self.is_split_by_voice {
            return self.deliver_voices(bank, replace);
        }
        let whole = WholeBank::open(bank)?;
        let staged = StagedFiles::new(replace);
        let mut files = Vec::new();
        // One at a time, because together they would take as much memory as the bank.
        for locale in whole.locales() {
            let path = self.bank.with_extension(format!("{}{TEXTS_EXTENSION}", whole.tag(locale)));
            files.push(staged.add(&path, &whole.text_bank(locale)?)?);
        }
        let stale = stale(&self.bank, TEXTS_EXTENSION, &files);
        files.insert(0, staged.add(&self.bank, &whole.base()?)?);
        staged.finish()?;
        Ok(DeliveredFiles { files, stale })
    }

    /// Writes the banks of voices, and then the bank below them.
    fn deliver_voices(&self, bank: &[u8], replace: Replace) -> Result<DeliveredFiles, Report> {
        let split = VoiceBanks::from_bytes(bank)?;
        let staged = StagedFiles::new(replace);
        let add = |path: &Path, bytes: &[u8]| {
            let clip_count = Bank::open(bytes).ok().map(|bank| bank.clip_count());
            Ok::<OutputFile, Report>(OutputFile { clip_count, ..staged.add(path, bytes)? })
        };
        let mut files = Vec::new();
        for (tag, bytes) in &split.voices {
            files.push(add(&self.bank.with_extension(format!("{tag}{VOICES_EXTENSION}")), bytes)?);
        }
        let is_locale = |name: &str| split_tag(name).is_some();
        let mut stale = stale(&self.bank, VOICES_EXTENSION, &files);
        stale.retain(|path| path.file_stem().and_then(OsStr::to_str).is_some_and(is_locale));
        files.insert(0, add(&self.bank, &split.base)?);
        staged.finish()?;
        Ok(DeliveredFiles { files, stale })
    }
}

/// The files of a split bank. All of them are written to temporary files before the first is renamed, because they fit
/// only each other.
struct StagedFiles {
    files: Replacements,
    replace: Replace,
}

impl StagedFiles {
    fn new(replace: Replace) -> StagedFiles {
        StagedFiles { files: Replacements::default(), replace }
    }

    fn add(&self, path: &Path, bytes: &[u8]) -> Result<OutputFile, Report> {
        let is_new = self.replace.is_due(path, bytes);
        if is_new {
            self.files.replace(path, bytes)?;
        }
        Ok(OutputFile { is_new, ..OutputFile::new(path, bytes.len()) })
    }

    /// Renames them in the order in which they were added.
    fn finish(self) -> Result<(), Report> {
        self.files.finish().into_iter().next().map_or(Ok(()), Err)
    }
}

/// Returns the locale at the end of a name.
fn split_tag(name: &str) -> Option<&str> {
    let (_, tag) = name.rsplit_once('.')?;
    let (language, country) = tag.split_once('-')?;
    let is_code = |code: &str| matches!(code.len(), 2..=4) && code.bytes().all(|byte| byte.is_ascii_lowercase());
    (is_code(language) && is_code(country)).then_some(tag)
}

/// Returns the files with this extension next to the bank at `path` that are not among those written now.
fn stale(path: &Path, extension: &str, written: &[OutputFile]) -> Vec<PathBuf> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (Some(stem), Ok(files)) = (path.file_stem(), fs::read_dir(folder)) else { return Vec::new() };
    let is_text_bank = |name: &OsStr| {
        let rest = name.as_encoded_bytes().strip_prefix(stem.as_encoded_bytes());
        rest.is_some_and(|rest| {
            rest.starts_with(b".") && rest.ends_with(extension.as_bytes()) && rest != extension.as_bytes()
        })
    };
    let written: HashSet<&OsStr> = written.iter().filter_map(|file| file.path.file_name()).collect();
    let names = files.filter_map(|file| Some(file.ok()?.file_name()));
    let stale = names.filter(|name| is_text_bank(name) && !written.contains(name.as_os_str()));
    let mut stale: Vec<PathBuf> = stale.map(|name| path.with_file_name(name)).collect();
    stale.sort();
    stale
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bank(locales: &[&str]) -> Vec<u8> {
        let texts: Vec<String> = locales.iter().map(|tag| format!("\"text_{tag}\": \"Aye.\"")).collect();
        let file = format!("{{ {} }}", texts.join(", "));
        Compiler::default().compile(&[Input::from_bytes("aye", file)]).into_bank().unwrap()
    }

    #[test]
    fn text_banks_of_locales_that_are_gone_are_named_and_stay() {
        let folder = tempfile::tempdir().unwrap();
        let outputs = Outputs::new(folder.path().join("b.lipzbank")).split_locales(true);
        outputs.deliver(&bank(&["de-de", "en-us"]), Replace::Always).unwrap();
        let again = outputs.deliver(&bank(&["en-us"]), Replace::Always).unwrap();
        assert_eq!(again.stale, [folder.path().join("b.de-de.lipztexts")]);
        assert!(again.stale[0].exists() && again.files.len() == 2);
    }

    #[test]
    fn the_files_of_a_split_bank_are_those_of_one_run() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.lipzbank");
        let (first, second) = (bank(&["de-de", "en-us"]), bank(&["en-us", "fr-fr"]));
        let outputs = Outputs::new(&path).split_locales(true);
        let held = Lock::wait(&path).unwrap();
        std::thread::scope(|scope| {
            let waiting = scope.spawn(|| outputs.deliver(&second, Replace::Always));
            std::thread::sleep(std::time::Duration::from_millis(100));
            assert!(!waiting.is_finished() && fs::read_dir(folder.path()).unwrap().count() == 1, "only the lock");
            fs::write(folder.path().join("b.en-us.lipztexts"), &first).unwrap();
            drop(held);
            assert_eq!(waiting.join().unwrap().unwrap().files.len(), 3);
        });
        let base = fs::read(&path).unwrap();
        let texts = fs::read(folder.path().join("b.en-us.lipztexts")).unwrap();
        assert!(Bank::open(&base).unwrap().verify().unwrap().open_texts(&texts).is_ok());
    }

    /// Text banks fit only one bank, so that none is replaced if one of the files cannot be.
    #[test]
    fn the_files_of_a_split_bank_are_replaced_together_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.lipzbank");
        let texts = folder.path().join("b.en-us.lipztexts");
        fs::write(&texts, "old").unwrap();
        fs::create_dir(&path).unwrap();
        let refused = Outputs::new(&path).split_locales(true).deliver(&bank(&["en-us"]), Replace::Always).unwrap_err();
        assert!(refused.to_string().contains("b.lipzbank"), "{refused}");
        assert_eq!(fs::read(&texts).unwrap(), b"old");
        let names = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
        assert_eq!(names.filter(|name| name.to_string_lossy().ends_with("tmp")).count(), 0);
    }

    #[test]
    fn equal_files_are_left_alone_only_if_that_is_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let outputs = Outputs::new(folder.path().join("b.lipzbank"));
        let bank = bank(&["en-us"]);
        let is_new = |replace| outputs.deliver(&bank, replace).unwrap().files[0].is_new;
        assert_eq!([Replace::IfDifferent, Replace::IfDifferent, Replace::Always].map(is_new), [true, false, true]);
    }
}
