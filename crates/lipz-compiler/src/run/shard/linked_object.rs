//! An object for linking: opened, and read when its clips are needed.

use super::export::{self, ExportTable};
use super::object_clips::object_clips;
use super::shard_of_key;
use super::wire::WireReport;
use crate::clip::{ClipFile, Clips, SectionStarts};
use crate::files::FileMeta;
use crate::files::path::display;
use crate::project::Voices;
use crate::run::cache::section;
use crate::sources::{Content, Input};
use lipz_bank::{Bank, Recording};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_layout::Tag;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// The maximum length of a bank, because its offsets have 32 bits.
const MOST_BYTES: u64 = u32::MAX as u64;

/// An opened object.
#[derive(Clone, Debug)]
pub struct LinkedObject {
    pub(super) path: PathBuf,
    pub(super) checksum: u64,
    pub(super) export: ExportTable,
}

/// Clips, and the data about their recordings.
pub(super) type RecordedClips<C> = (C, BTreeMap<String, Recording>);

impl LinkedObject {
    pub(super) fn open(path: &Path) -> Result<LinkedObject, Report> {
        let name = display(path);
        let refuse = |message: String| {
            let help = "name the objects of a plan, which `lipz shard pack` writes";
            Report::failure(name.as_str(), Code::NoObject, message, help)
        };
        match export::read(path) {
            Ok(Ok((checksum, export))) => Ok(LinkedObject { path: path.to_owned(), checksum, export }),
            Ok(Err(why)) => Err(refuse(format!("`{name}` is not an object: {why}"))),
            Err(error) => {
                let message = format!("`{name}` cannot be read: {error}");
                Err(Report::about(name.as_str(), Diagnostic::new(Code::UnreadableFile, message)))
            }
        }
    }

    /// Returns the clips after verifying the bytes. Frames, texts and source records stay in the file, which is kept
    /// open or opened again. `room` is a buffer for its bytes.
    pub(super) fn read(
        &self,
        voices: &Voices,
        keep_open: bool,
        room: &mut Vec<u8>,
    ) -> Result<RecordedClips<Clips>, Report> {
        let (file, meta) = self.read_into(room)?;
        let bytes: &[u8] = room;
        let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
        let verified = Bank::open(bytes).and_then(|bank| bank.verify_with(utf8));
        let bank = verified.map_err(|error| self.damaged(&error.to_string()))?;
        self.check(&bank, voices)?;
        let recordings = bank.clips().filter_map(|clip| Some((clip.key().to_owned(), clip.recording()?))).collect();
        let start = |tag| section(bytes, tag).map_or(0, |section| section.start);
        let starts =
            SectionStarts { frames: start(Tag::FRAMES), texts: start(Tag::TEXTS), sources: start(Tag::SOURCES) };
        let file = ClipFile::new(self.path.clone(), keep_open.then_some(file), meta, starts);
        let clips = object_clips(bytes, &bank, file).ok_or_else(|| self.damaged("its clips cannot be read"))?;
        Ok((clips, recordings))
    }

    /// Reads the file, and returns it with its metadata before reading.
    fn read_into(&self, bytes: &mut Vec<u8>) -> Result<(File, FileMeta), Report> {
        let mut read = || {
            let file = File::open(&self.path)?;
            let metadata = file.metadata()?;
            bytes.clear();
            bytes.reserve_exact(metadata.len().min(MOST_BYTES) as usize);
            (&file).take(MOST_BYTES + 1).read_to_end(bytes)?;
            let meta = FileMeta::new(&metadata).ok_or_else(|| io::Error::other("its times cannot be read"))?;
            Ok((file, meta))
        };
        read().map_err(|error: io::Error| {
            let name = display(&self.path);
            let message = format!("`{name}` cannot be read: {error}");
            Report::about(name, Diagnostic::new(Code::UnreadableFile, message))
        })
    }

    /// Checks that a verified bank is the opened one, and belongs to its shard.
    fn check(&self, bank: &Bank<'_>, voices: &Voices) -> Result<(), Report> {
        if bank.checksum() != self.checksum {
            return Err(self.changed());
        }
        if bank.clip_count() != self.export.names.len() {
            return Err(self.damaged("its export table lists different clips"));
        }
        let is_here = |key| {
            let shards = NonZero::new(self.export.shards);
            shards.is_some_and(|shards| shard_of_key(key, voices, shards) == self.export.shard)
        };
        if !bank.clips().all(|clip| is_here(clip.key())) {
            return Err(self.damaged("it has a clip of a different shard"));
        }
        if !bank.locales().map(|locale| bank.locale_tag(locale)).eq(self.export.locales.iter().map(String::as_str)) {
            return Err(self.damaged("its export table lists different locales"));
        }
        Ok(())
    }

    /// Returns the inputs of its clips, as names only, because their contents are in the object.
    pub(super) fn inputs(&self, clips: &Clips) -> impl Iterator<Item = Input> {
        let by_key = Clips::by_key(std::slice::from_ref(clips));
        std::iter::zip(by_key, &self.export.names).map(|(clip, name)| {
            let content = Content::Bytes { name: name.clone(), bytes: Vec::new() };
            Input { key: clip.key().to_owned(), content }
        })
    }

    /// Returns the reports from making it.
    pub(super) fn reports(&self) -> Result<Vec<Report>, Report> {
        let reports = self.export.reports.iter().cloned().map(WireReport::into_report);
        reports.collect::<Option<_>>().ok_or_else(|| self.damaged("it contains an invalid diagnostic"))
    }

    /// Returns the report that it was modified since it was opened, or has become unreadable.
    pub(super) fn changed(&self) -> Report {
        let name = display(&self.path);
        let message = format!("the object `{name}` was changed during the link, or can no longer be read");
        Report::failure(name, Code::BankDamaged, message, "link again when no other program writes to it")
    }

    pub(super) fn damaged(&self, why: &str) -> Report {
        let name = display(&self.path);
        let message = format!("the object `{name}` is damaged: {why}");
        Report::failure(name, Code::BankDamaged, message, "pack its shard again")
    }
}
