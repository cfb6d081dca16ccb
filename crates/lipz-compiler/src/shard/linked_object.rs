//! An object that is linked: opened, and read when its clips are needed.

use super::export::{self, Export};
use super::shard_of_key;
use super::wire::WireReport;
use crate::cache::clips_of;
use crate::clip::Clips;
use crate::discover::display;
use crate::{Content, Input, Voices};
use lipz_bank::{Bank, Recording};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::collections::BTreeMap;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// An object that was opened.
#[derive(Clone, Debug)]
pub struct LinkedObject {
    pub(super) path: PathBuf,
    pub(super) checksum: u64,
    pub(super) export: Export,
}

/// What the clips of an object come with.
#[derive(Default)]
pub(super) struct Found {
    pub(super) clips: Clips,
    pub(super) recordings: BTreeMap<String, Recording>,
}

impl LinkedObject {
    pub(super) fn open(path: &Path) -> Result<LinkedObject, Report> {
        let name = display(path);
        let refuse = |message: String| {
            let help = "name the objects of a plan: what `lipz pack --shard` writes";
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

    /// The clips, of bytes that are verified first.
    pub(super) fn read(&self, voices: &Voices) -> Result<Found, Report> {
        let name = display(&self.path);
        let bytes = std::fs::read(&self.path).map_err(|error| {
            let message = format!("`{name}` cannot be read: {error}");
            Report::about(name.as_str(), Diagnostic::new(Code::UnreadableFile, message))
        })?;
        let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
        let verified = Bank::open(&bytes).and_then(|bank| bank.verify_with(utf8));
        let bank = verified.map_err(|error| self.damaged(&error.to_string()))?;
        if bank.checksum() != self.checksum {
            return Err(self.damaged("it was replaced meanwhile"));
        }
        if bank.clip_count() != self.export.names.len() {
            return Err(self.damaged("its export table is about other clips"));
        }
        let is_here = |key| {
            let shards = NonZero::new(self.export.shards);
            shards.is_some_and(|shards| shard_of_key(key, voices, shards) == self.export.shard)
        };
        if !bank.clips().all(|clip| is_here(clip.key())) {
            return Err(self.damaged("it has a clip of another shard"));
        }
        if !bank.locales().map(|locale| locale.tag()).eq(self.export.locales.iter().map(String::as_str)) {
            return Err(self.damaged("its export table names other locales"));
        }
        let recordings = bank.clips().filter_map(|clip| Some((clip.key().to_owned(), clip.recording()?))).collect();
        let clips = clips_of(bytes).ok_or_else(|| self.damaged("its clips cannot be read"))?;
        Ok(Found { clips, recordings })
    }

    /// The inputs of its clips, by their names: their contents are in the object.
    pub(super) fn inputs(&self, found: &Found) -> impl Iterator<Item = Input> {
        // Both are in the order of the keys.
        std::iter::zip(found.clips.iter(), &self.export.names).map(|(clip, name)| {
            let content = Content::Bytes { name: name.clone(), bytes: Vec::new() };
            Input { key: clip.key().to_owned(), content }
        })
    }

    /// What was reported when it was made.
    pub(super) fn reports(&self) -> Result<Vec<Report>, Report> {
        let reports = self.export.reports.iter().cloned().map(WireReport::into_report);
        reports.collect::<Option<_>>().ok_or_else(|| self.damaged("a diagnostic in it is none"))
    }

    pub(super) fn damaged(&self, why: &str) -> Report {
        let name = display(&self.path);
        let message = format!("the object `{name}` is damaged: {why}");
        Report::failure(name, Code::BankDamaged, message, "pack its shard again")
    }
}
