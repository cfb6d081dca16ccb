//! Images of characters' mouths, which the page shows instead of the drawn face.

use crate::shared::input_file::{self, unreadable};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lipz_compiler::settings::{Settings, Sprites};
use lipz_diagnostics::Report;
use lipz_types::VisemeType;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

/// The name of the images for characters without their own.
const DEFAULT: &str = "default";
/// The code of rest, and its name in paths.
const REST: (char, &str) = ('-', "rest");

/// The images of all characters, by name.
#[derive(Serialize, Default, Debug)]
#[serde(transparent)]
pub(super) struct SpriteSets(BTreeMap<String, SpriteSet>);

/// The images of a character, as data addresses.
#[derive(Serialize, Debug)]
#[serde(untagged)]
enum SpriteSet {
    /// An image per code.
    Images { images: BTreeMap<char, String> },
    /// One image, and its codes from left to right.
    Sheet { sheet: String, codes: String },
}

impl SpriteSets {
    /// Reads the images of a project. The reports are about images that are missing.
    pub(super) fn read(settings: &Settings) -> (SpriteSets, Vec<Report>) {
        let (mut sets, mut reports) = (BTreeMap::new(), Vec::new());
        for (name, sprites) in &settings.sprites {
            match read(sprites) {
                Ok(set) => _ = sets.insert(name.clone(), set),
                Err(report) => reports.push(*report),
            }
        }
        (SpriteSets(sets), reports)
    }

    /// Returns the name of the images for a clip with these characters, if there are any.
    pub(super) fn of(&self, characters: Option<&BTreeSet<String>>) -> Option<&str> {
        let own = characters.into_iter().flatten().find_map(|character| {
            self.0.keys().find(|name| *name != DEFAULT && name.to_lowercase() == character.to_lowercase())
        });
        own.or_else(|| self.0.keys().find(|name| *name == DEFAULT)).map(String::as_str)
    }
}

fn read(sprites: &Sprites) -> Result<SpriteSet, Box<Report>> {
    match sprites {
        Sprites::Sheet(path, codes) => {
            let sheet = image(path).map_err(|error| Box::new(unreadable(path, &error)))?;
            Ok(SpriteSet::Sheet { sheet, codes: codes.clone() })
        }
        Sprites::Files(pattern) => {
            let mut images = BTreeMap::new();
            let codes: BTreeSet<char> =
                VisemeType::ALL.iter().flat_map(|kind| kind.codes().chars()).chain([REST.0]).collect();
            for code in codes {
                let name = if code == REST.0 { REST.1.to_owned() } else { code.to_string() };
                let path = PathBuf::from(pattern.to_string_lossy().replace("{code}", &name));
                match image(&path) {
                    Ok(image) => _ = images.insert(code, image),
                    Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                    Err(error) => return Err(Box::new(unreadable(&path, &error))),
                }
            }
            if images.is_empty() {
                let error = io::Error::new(io::ErrorKind::NotFound, "there is no image for any viseme code or `rest`");
                return Err(Box::new(unreadable(pattern, &error)));
            }
            Ok(SpriteSet::Images { images })
        }
    }
}

/// Returns an image as a data address. Other files do not get into a page, whatever their names are.
fn image(path: &Path) -> io::Result<String> {
    let bytes = input_file::read(path)?;
    let media = media_type(&bytes).ok_or_else(|| io::Error::new(io::ErrorKind::InvalidData, "it is not an image"))?;
    Ok(format!("data:image/{media};base64,{}", STANDARD.encode(bytes)))
}

/// Returns the subtype of an image that browsers show.
fn media_type(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("png"),
        [0xFF, 0xD8, 0xFF, ..] => Some("jpeg"),
        [b'G', b'I', b'F', b'8', ..] => Some("gif"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Some("webp"),
        _ => std::str::from_utf8(bytes).ok().filter(|text| text.contains("<svg")).map(|_| "svg+xml"),
    }
}
