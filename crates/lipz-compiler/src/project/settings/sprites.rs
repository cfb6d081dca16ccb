//! `[sprites]`: the images of characters' mouths for previews.

use super::Sprites;
use super::reading::{SettingsReader, inside};
use super::value::NamedValue;

/// The placeholder of the viseme code in a path.
const CODE: &str = "{code}";
/// The separator of the path of a sheet and its codes.
const SHEET: char = '#';
/// The extensions of images that browsers show.
const EXTENSIONS: [&str; 6] = ["svg", "png", "jpg", "jpeg", "webp", "gif"];

impl SettingsReader<'_> {
    /// Reads the images of the character `name`: a path with `{code}`, or a sheet with its codes.
    pub(super) fn sprites(&mut self, name: &str, value: &NamedValue<'_>) {
        let Some(text) = value.text(&mut self.diagnostics) else { return };
        let (path, codes) = match text.split_once(SHEET) {
            Some((path, codes)) => (path, Some(codes)),
            None => (text, None),
        };
        let extension = path.rsplit_once('.').map(|(_, extension)| extension.to_ascii_lowercase());
        if !extension.is_some_and(|extension| EXTENSIONS.contains(&extension.as_str())) {
            let help = format!("name files with one of these extensions: {}", EXTENSIONS.join(", "));
            return self.refuse(value, "is not an image", &help);
        }
        let sprites = match codes {
            None if path.contains(CODE) => Sprites::Files(inside(self.folder, path)),
            Some(codes) if !codes.is_empty() && !path.contains(CODE) => {
                Sprites::Sheet(inside(self.folder, path), codes.to_owned())
            }
            _ => {
                let help =
                    "write a path with {code}, or a sheet with its codes from left to right: mouths.png#-MAOESUFLW";
                return self.refuse(value, "names neither an image per viseme nor the codes of a sheet", help);
            }
        };
        self.settings.sprites.insert(name.to_owned(), sprites);
    }
}
