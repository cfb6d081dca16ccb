//! The recordings that chosen takes become.

use super::takes::TakeFiles;
use crate::console;
use lipz_compiler::Voices;
use lipz_compiler::key::folded;
use lipz_compiler::settings::sound_rank;
use lipz_diagnostics::{Code, Diagnostic, Severity, escape};
use lipz_sync::Recordings;
use lipz_texts::ChosenTake;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A take, and the recording that it becomes.
pub(super) struct Copy {
    pub(super) take: PathBuf,
    pub(super) recording: PathBuf,
}

/// The places of takes and of recordings.
pub(super) struct TakePlaces<'s> {
    pub(super) folder: &'s Path,
    pub(super) voices: Voices,
    /// The locale of the voice; `None` for that of the originals.
    pub(super) voice: Option<String>,
    pub(super) recordings: Recordings,
    pub(super) files: TakeFiles,
    /// The keys of all clips, by their folded form.
    pub(super) keys: HashMap<String, &'s str>,
}

impl TakePlaces<'_> {
    /// Returns the file of a take, and the path of its recording.
    pub(super) fn copy(&self, take: &ChosenTake) -> Result<Copy, Box<Diagnostic>> {
        let written = take.key.text.trim();
        let Some(original) = self.keys.get(&folded(written)).copied() else {
            let message = format!("the project has no clip {}", escape::quoted(written));
            let found = Diagnostic::at(Code::UnknownTextKey, take.key.span, message);
            let mut found = found.help("correct the key if the clip was renamed after the export");
            found.severity = Severity::Error;
            return Err(Box::new(found));
        };
        let refused = |message: String, help: String| {
            Box::new(Diagnostic::at(Code::UnusableTake, take.name.span, message).help(help))
        };
        let key = match &self.voice {
            None => Some(original.to_owned()),
            Some(voice) => self.voices.dub_of(original, voice),
        };
        let key = key.ok_or_else(|| {
            let message = format!("{} has no dub in this voice", escape::quoted(original));
            refused(message, "correct the patterns in [voices] of lipz.toml".to_owned())
        })?;
        let file = self.files.find(take.name.text.trim(), original).map_err(|why| refused(why.message, why.help))?;
        let recording = self.recording(&key, &file);
        if !has_same_extension(&recording, &file) {
            let (take, recording) = (console::path(&file), console::path(&recording));
            let message = format!("the take `{take}` cannot become the recording `{recording}`");
            return Err(refused(message, "convert the take to the format of the recording".to_owned()));
        }
        Ok(Copy { take: file, recording })
    }

    /// Returns the path of a clip's recording: the existing one, or that of the project's patterns.
    fn recording(&self, key: &str, take: &Path) -> PathBuf {
        if let Some(existing) = self.recordings.find(key) {
            return existing.to_owned();
        }
        let place = self.folder.join(self.recordings.place(key));
        if sound_rank(&place).is_some() {
            return place;
        }
        let mut path = place.into_os_string();
        path.push(".");
        path.push(take.extension().unwrap_or_default());
        path.into()
    }
}

fn has_same_extension(one: &Path, other: &Path) -> bool {
    let extensions = one.extension().zip(other.extension());
    extensions.is_some_and(|(one, other)| one.eq_ignore_ascii_case(other))
}

/// The takes and recordings so far, each with the key of its line.
#[derive(Default)]
pub(super) struct Chosen {
    by_recording: HashMap<PathBuf, PathBuf>,
    by_take: HashMap<PathBuf, String>,
}

impl Chosen {
    /// Returns the copy, or `None` if it repeats one. Refuses a second take of a line, and a second line of a take.
    pub(super) fn add(&mut self, copy: Copy, take: &ChosenTake) -> Result<Option<Copy>, Box<Diagnostic>> {
        let refused = |message: String| {
            let found = Diagnostic::at(Code::UnusableTake, take.name.span, message);
            Err(Box::new(found.help("delete one of the two")))
        };
        let key = escape::quoted(&take.key.text);
        match self.by_recording.get(&copy.recording) {
            Some(first) if *first == copy.take => return Ok(None),
            Some(first) => {
                return refused(format!("two takes of {key} are chosen, this one and `{}`", console::path(first)));
            }
            None => {}
        }
        if let Some(other) = self.by_take.insert(copy.take.clone(), take.key.text.clone()) {
            let (file, other) = (console::path(&copy.take), escape::quoted(&other));
            return refused(format!("the take `{file}` is chosen for {key} and for {other}"));
        }
        self.by_recording.insert(copy.recording.clone(), copy.take.clone());
        Ok(Some(copy))
    }
}
