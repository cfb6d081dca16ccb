//! Dubs that are older than what their original says.

use crate::clip::Clip;
use crate::facts::content_hash;
use crate::recordings::shown;
use crate::sync::hashes::text_hash;
use crate::{Line, OriginalThen, Recordings, spoken_text};
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::Document;
use std::fs::File;

/// The clip of which another one is a dub.
pub(super) struct Original<'a> {
    pub(super) input: &'a Input,
    pub(super) document: &'a Document<'a>,
}

/// Reports a dub of which the record knows that its original was another recording, or had another text, when it was made.
pub(super) fn check(
    settings: &Settings,
    clip: &Clip<'_>,
    original: &Original<'_>,
    recordings: &Recordings,
    known: &[Line],
) -> Option<Diagnostic> {
    let key = &original.input.key;
    let then: Vec<OriginalThen> = known.iter().filter_map(|line| line.original).collect();
    let (visemes, _) = (clip.visemes?, then.first()?);
    let path = recordings.find(key);
    let sound = path.and_then(|path| File::open(path).and_then(content_hash).ok()).unwrap_or(0);
    let spoken = spoken_text(settings, recordings.locale(key), original.document);
    let text = text_hash(spoken);
    let then: Vec<OriginalThen> = then.into_iter().map(|then| then.renewed(spoken)).collect();
    // A recording that is not there, or was not, tells nothing: another lint misses it.
    let is_same = |then: &OriginalThen| then.sound == sound || then.sound == 0 || path.is_none();
    if then.iter().any(|then| is_same(then) && then.text == text) {
        return None;
    }
    let is_same_sound = then.iter().any(is_same);
    let message = match is_same_sound {
        true => "the text of the original has changed since the dub was made",
        false => "the original was recorded again after the dub was made",
    };
    let name = escape::text(&original.input.name()).into_owned();
    let note = match path.filter(|_| !is_same_sound) {
        Some(path) => format!("its recording is `{}`", escape::text(&shown(path))),
        None => format!("it is `{name}`"),
    };
    Some(
        Diagnostic::at(Code::DubOutOfDate, visemes.span(), message)
            .note(note)
            .help("record the dub again; if it still says the same, make its mouth again by force, which records that"),
    )
}
