//! The files of takes, found by number or by name.

use crate::console;
use lipz_compiler::settings::sound_rank;
use lipz_diagnostics::escape;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Words before the number of a take in the name of its file.
const TAKE_WORDS: [&str; 3] = ["take", "tk", "t"];

/// The sound files below a folder, sorted by path.
pub(super) struct TakeFiles {
    folder: PathBuf,
    paths: Vec<PathBuf>,
}

/// The reason why a take was not found.
pub(super) struct NoTake {
    pub(super) message: String,
    pub(super) help: String,
}

impl TakeFiles {
    /// Finds all sound files below a folder.
    pub(super) fn below(folder: &Path) -> io::Result<TakeFiles> {
        let (mut paths, mut folders) = (Vec::new(), vec![folder.to_owned()]);
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder)? {
                let entry = entry?;
                // Links are not followed, so that they cannot lead into a circle.
                match entry.file_type()? {
                    kind if kind.is_dir() => folders.push(entry.path()),
                    kind if kind.is_file() && sound_rank(&entry.path()).is_some() => paths.push(entry.path()),
                    _ => {}
                }
            }
        }
        paths.sort_unstable();
        Ok(TakeFiles { folder: folder.to_owned(), paths })
    }

    /// Returns the file of a clip's take: `take` is its number, or the name or path of a file.
    pub(super) fn find(&self, take: &str, key: &str) -> Result<PathBuf, NoTake> {
        let number = take.trim_end_matches(".0").parse::<u32>().ok();
        let line = key.rsplit('/').next().unwrap_or(key);
        let found: Vec<&PathBuf> = match number {
            Some(number) => self.paths.iter().filter(|path| is_take(path, line, number)).collect(),
            None => self.paths.iter().filter(|path| self.is_named(path, take)).collect(),
        };
        // Lines in different folders may have the same name.
        let scene = key.rsplit_once('/').map(|(scene, _)| scene);
        let of_scene: Vec<&PathBuf> = found.iter().filter(|path| self.is_in(path, scene)).copied().collect();
        let what = match number {
            Some(number) => format!("take {number} of {}", escape::quoted(key)),
            None => format!("the take {} of {}", escape::quoted(take), escape::quoted(key)),
        };
        match (found.as_slice(), of_scene.as_slice()) {
            ([only], _) | (_, [only]) => Ok((*only).clone()),
            ([], _) => Err(NoTake {
                message: format!("{what} is missing in {}", console::path(&self.folder)),
                help: format!(
                    "name the file `{}_{take}`, with the extension of a recording, or write the name of the file into the cell",
                    escape::text(line)
                ),
            }),
            ([first, second, ..], _) => Err(NoTake {
                message: format!("{what} may be `{}` or `{}`", console::path(first), console::path(second)),
                help: "write the path of the file into the cell".to_owned(),
            }),
        }
    }

    /// Whether a path, or the end of it, has this name, with or without extension.
    fn is_named(&self, path: &Path, name: &str) -> bool {
        let below = path.strip_prefix(&self.folder).unwrap_or(path);
        let name = Path::new(name);
        below.ends_with(name) || below.with_extension("").ends_with(name)
    }

    /// Whether a path is in the folder of a scene.
    fn is_in(&self, path: &Path, scene: Option<&str>) -> bool {
        let folder = path.strip_prefix(&self.folder).unwrap_or(path).parent();
        scene.zip(folder).is_some_and(|(scene, folder)| folder.ends_with(scene))
    }
}

/// Whether a file is the take of a line with this number: `mayor_3.wav`, `mayor-take03.wav`.
fn is_take(path: &Path, line: &str, number: u32) -> bool {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().to_lowercase();
    let Some(rest) = stem.strip_prefix(&line.to_lowercase()) else { return false };
    let is_separator = |character: char| matches!(character, '_' | '-' | ' ' | '.' | '(' | ')');
    let rest = rest.trim_matches(is_separator);
    let digits = TAKE_WORDS.iter().find_map(|word| rest.strip_prefix(word)).unwrap_or(rest);
    digits.trim_start_matches(is_separator).parse() == Ok(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_are_found_by_number_in_all_usual_names() {
        for name in
            ["mayor_3.wav", "Mayor-take03.flac", "mayor 3.ogg", "mayor.t3.wav", "mayor (3).mp3", "mayor_tk-3.wav"]
        {
            assert!(is_take(Path::new(name), "mayor", 3), "{name}");
            assert!(!is_take(Path::new(name), "mayor", 13), "{name}");
        }
        for name in ["mayor.wav", "mayor_x3.wav", "major_3.wav", "mayor-2-3.wav"] {
            assert!(!is_take(Path::new(name), "mayor", 3), "{name}");
        }
    }
}
