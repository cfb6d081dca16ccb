//! Files of translators: a project, and what a delivery does with it.

use super::{Outcome, Scene, lipz};
use std::fs;
use std::path::Path;

/// Returns a project of one clip with a German text.
pub(crate) fn project() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    scene.write(
        "voices/otto.lipz",
        "{ \"visemes\": \"MA|EO\", \"text_en-us\": \"Good evening.|You?\", \"text_de-de\": \"Guten Abend.|Du?\" }\n",
    );
    scene
}

pub(crate) fn export(folder: &Path, format: &str, name: &str) {
    let written = lipz(folder, ["export", "texts", format, "--locale", "de-de", "-o", name]);
    assert_eq!((written.code, written.stderr.as_str()), (0, ""));
}

pub(crate) fn import(folder: &Path, names: &[&str]) -> Outcome {
    lipz(folder, ["import", "texts"].iter().chain(names))
}

/// Replaces a text in a file, and requires that it is there.
pub(crate) fn replace(folder: &Path, name: &str, from: &str, to: &str) {
    let text = fs::read_to_string(folder.join(name)).unwrap();
    assert!(text.contains(from), "{name} has no {from}: {text}");
    fs::write(folder.join(name), text.replace(from, to)).unwrap();
}
