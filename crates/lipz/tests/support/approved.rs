//! A project with one translated clip.

use super::{Scene, lipz};

/// Its only clip.
pub(crate) const MAYOR: &str = r#"{
  "visemes" :    "MAAAEO----|MAAAAEEO--",
  "text_en-us" : "Good evening, {name}.|Who goes there?",
  "text_de-de" : "Guten Abend, {name}. |Wer da?",
  "fps" :        24
}
"#;

/// Returns a project with one clip, whose translation is not approved yet.
pub(crate) fn project() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    scene.write("voices/mayor.lipz", MAYOR);
    scene
}

/// Returns the same project, with its translation approved.
pub(crate) fn approved() -> Scene {
    let scene = project();
    assert_eq!(lipz(scene.path(), ["approve", "--all", "--quiet"]).code, 0);
    scene
}
