//! The recording of a clip in `lipz inspect`.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::inputs;
use crate::shared::settings_file::Project;
use lipz_compiler::inspect::ClipDetails;
use lipz_diagnostics::escape;
use lipz_sync::RecordedClip;
use serde::Serialize;
use std::fmt::Write;

/// Returns data about the recording of a clip, if its project has recordings.
pub(super) fn find(project: &Project, key: &str, reporter: &mut Reporter) -> Result<Option<RecordedClip>, Abort> {
    if project.settings.audio.folder.is_none() {
        return Ok(None);
    }
    let (inputs, _) = inputs::find(&project.settings);
    RecordedClip::find(&project.settings, &inputs, key).map_err(|report| reporter.fail(report))
}

/// Returns a text about the recording for people.
pub(super) fn text(recorded: &RecordedClip) -> String {
    let (path, seconds) = (escape::text(&recorded.path), recorded.length_us as f64 / 1e6);
    // Writing to a string cannot fail.
    let mut out = format!("\nrecording {path}, {seconds:.3} s\n  {}\n", recorded.state.describe());
    for (locale, path) in &recorded.dubs {
        let path = path.as_deref().map_or("not recorded".into(), |path| escape::text(path));
        let _ = writeln!(out, "  {}  {path}", escape::text(locale));
    }
    if !recorded.doubtful.is_empty() {
        out.push_str("  uncertain words (listen and check)\n");
    }
    for word in &recorded.doubtful {
        let _ = writeln!(out, "    {:>7.2} s  {}", word.start_us as f64 / 1e6, escape::text(&word.word));
    }
    out
}

/// A clip with its recording.
#[derive(Serialize)]
pub(super) struct WithRecording<'r, 'd> {
    #[serde(flatten)]
    pub(super) clip: &'r ClipDetails<'d>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) recorded: Option<Details<'r>>,
}

/// [`RecordedClip`], element by element.
#[derive(Serialize)]
pub(super) struct Details<'r> {
    path: &'r str,
    length_us: u64,
    state: &'static str,
    doubtful: Vec<WordRow<'r>>,
    dubs: Vec<Dub<'r>>,
}

#[derive(Serialize)]
struct WordRow<'r> {
    start_us: u64,
    word: &'r str,
}

#[derive(Serialize)]
struct Dub<'r> {
    locale: &'r str,
    path: Option<&'r str>,
}

impl<'r> From<&'r RecordedClip> for Details<'r> {
    fn from(recorded: &'r RecordedClip) -> Details<'r> {
        let RecordedClip { path, length_us, state, doubtful, dubs, .. } = recorded;
        Details {
            path,
            length_us: *length_us,
            state: state.name(),
            doubtful: doubtful.iter().map(|found| WordRow { start_us: found.start_us, word: &found.word }).collect(),
            dubs: dubs.iter().map(|(locale, path)| Dub { locale, path: path.as_deref() }).collect(),
        }
    }
}
