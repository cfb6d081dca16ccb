//! The files of takes, found by number or by name.

use crate::console;
use lipz_compiler::key::folded;
use lipz_compiler::settings::{sound_rank, without_extension};
use lipz_diagnostics::{DiagnosticsError, escape};
use lipz_sync::Recordings;
use std::collections::{BTreeSet, HashMap};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Words before the number of a take.
const TAKE_WORDS: [&str; 3] = ["take", "tk", "t"];

/// The most takes of a line that a message names.
const NAMED: usize = 5;

/// The sound files below a folder, and the lines that they are takes of.
pub(super) struct TakeFiles {
    folder: PathBuf,
    files: Vec<TakeFile>,
    /// By the name and number of a take: the indices of its files.
    by_number: HashMap<(String, u32), Vec<usize>>,
    /// By the last part of a path: the indices of files.
    by_name: HashMap<String, Vec<usize>>,
    /// By the last part of a key: the folders of all clips with it.
    scenes: HashMap<String, BTreeSet<String>>,
}

/// A sound file.
struct TakeFile {
    path: PathBuf,
    /// The path below the folder, as it is shown.
    shown: String,
    /// The same without extension, for comparison.
    name: String,
}

/// The reason why a take was not found.
pub(super) struct NoTake {
    pub(super) message: String,
    pub(super) help: String,
}

impl TakeFiles {
    /// Finds all sound files below a folder. `keys` are those of all clips.
    pub(super) fn below<'k>(
        folder: &Path,
        keys: impl IntoIterator<Item = &'k str>,
    ) -> Result<TakeFiles, DiagnosticsError> {
        let found = Recordings::below(folder)?;
        let file = |(name, path): (&str, &Path)| TakeFile {
            path: path.to_owned(),
            shown: path.strip_prefix(folder).unwrap_or(path).to_string_lossy().replace('\\', "/"),
            name: folded(name),
        };
        let mut files = TakeFiles {
            folder: folder.to_owned(),
            files: found.all_files().map(file).collect(),
            by_number: HashMap::new(),
            by_name: HashMap::new(),
            scenes: HashMap::new(),
        };
        for (at, file) in files.files.iter().enumerate() {
            let stem = last(&file.name);
            files.by_name.entry(stem.to_owned()).or_default().push(at);
            if let Some((line, number)) = take_of(stem) {
                files.by_number.entry((line.to_owned(), number)).or_default().push(at);
            }
        }
        for key in keys.into_iter().map(folded) {
            files.scenes.entry(last(&key).to_owned()).or_default().insert(scene(&key).to_owned());
        }
        Ok(files)
    }

    /// Returns the file of a clip's take: `cell` is its number, or the name or path of a file.
    pub(super) fn find(&self, cell: &str, key: &str) -> Result<PathBuf, NoTake> {
        let (compared, number) = (folded(key), number_in(cell));
        let found: Vec<&TakeFile> = match number {
            Some(number) => self.of_number(last(&compared), number, scene(&compared)),
            None => self.named(cell),
        };
        let what = match number {
            Some(number) => format!("take {number} of {}", escape::quoted(key)),
            None => format!("the take {} of {}", escape::quoted(cell), escape::quoted(key)),
        };
        let folder = console::path(&self.folder);
        match found.as_slice() {
            [only] => Ok(only.path.clone()),
            [] => Err(NoTake {
                message: format!("{what} is missing in {folder}"),
                help: self.help_for(key, number, &folder),
            }),
            several => Err(NoTake {
                message: format!("{what} may be {}", listed(several)),
                help: format!("write the path of the file below {folder}, with its extension, into the cell"),
            }),
        }
    }

    /// Returns the files of a take. Those in the folder of the line's scene come first, and those in the folder of a
    /// different line with the same name do not count.
    fn of_number(&self, line: &str, number: u32, own: &str) -> Vec<&TakeFile> {
        let found = self.by_number.get(&(line.to_owned(), number)).into_iter().flatten();
        let found: Vec<&TakeFile> = found.filter_map(|at| self.files.get(*at)).collect();
        // The folders of `x/act1` also end with `act1`.
        let scenes = self.scenes.get(line);
        let scene_of = |file: &TakeFile| {
            let scenes = scenes.into_iter().flatten().filter(|scene| file.is_in(scene));
            scenes.max_by_key(|scene| scene.len())
        };
        let (of_scene, others): (Vec<&TakeFile>, Vec<&TakeFile>) =
            found.into_iter().partition(|file| scene_of(file).is_some_and(|scene| scene == own));
        if !of_scene.is_empty() {
            return of_scene;
        }
        others.into_iter().filter(|file| scene_of(file).is_none()).collect()
    }

    /// Returns the files whose path below the folder, or the end of it, is this name, with or without extension.
    fn named(&self, cell: &str) -> Vec<&TakeFile> {
        let slashed = cell.replace('\\', "/");
        let name = folded(without_extension(slashed.trim_start_matches("./")));
        let at = self.by_name.get(last(&name)).into_iter().flatten();
        // Without an extension that is one of a sound, all files with the name are meant.
        let extension = sound_rank(Path::new(&slashed)).and(Path::new(&slashed).extension());
        let is_meant = |file: &&TakeFile| extension.is_none_or(|meant| has_extension(&file.path, meant));
        let files: Vec<&TakeFile> = at.filter_map(|at| self.files.get(*at)).filter(is_meant).collect();
        let exact: Vec<&TakeFile> = files.iter().filter(|file| file.name == name).copied().collect();
        if !exact.is_empty() {
            return exact;
        }
        let is_end = |file: &&TakeFile| file.name.strip_suffix(&name).is_some_and(|rest| rest.ends_with('/'));
        files.into_iter().filter(is_end).collect()
    }

    /// Returns the help for a missing take of a line.
    fn help_for(&self, key: &str, number: Option<u32>, folder: &str) -> String {
        let line = folded(last(key));
        let is_of_line = |file: &&TakeFile| take_of(last(&file.name)).is_some_and(|(name, _)| name == line);
        let known: Vec<&TakeFile> = self.files.iter().filter(is_of_line).collect();
        match number {
            _ if !known.is_empty() => format!("the folder has these takes of the line: {}", listed(&known)),
            Some(number) => {
                let name = escape::text(last(key));
                format!(
                    "name the file `{name}_{number}`, with the extension of a recording, or write its name into the cell"
                )
            }
            None => format!("copy the file into {folder}, or correct the cell"),
        }
    }
}

impl TakeFile {
    /// Whether the file is in the folder of a scene.
    fn is_in(&self, scene: &str) -> bool {
        let folder = self::scene(&self.name);
        !scene.is_empty() && folder.strip_suffix(scene).is_some_and(|rest| rest.is_empty() || rest.ends_with('/'))
    }
}

/// Returns the first few paths for a message.
fn listed(files: &[&TakeFile]) -> String {
    let names: Vec<String> = files.iter().take(NAMED).map(|file| format!("`{}`", escape::text(&file.shown))).collect();
    match files.len().saturating_sub(NAMED) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}

fn has_extension(path: &Path, extension: &OsStr) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(extension))
}

/// Returns the last part of a path or key.
fn last(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// Returns the folder of a path or key; empty if it has none.
fn scene(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

fn is_separator(character: char) -> bool {
    matches!(character, '_' | '-' | ' ' | '.' | '(' | ')' | '#')
}

/// Returns the line and the number of a take from the name of its file, in lower case: `mayor_3`, `mayor-take03`. A
/// number without a separator belongs to the name of the line: `line12`.
fn take_of(stem: &str) -> Option<(&str, u32)> {
    let stem = stem.trim_end_matches(is_separator);
    let before = stem.trim_end_matches(|digit: char| digit.is_ascii_digit());
    let number = stem.get(before.len()..)?.parse().ok()?;
    let rest = before.trim_end_matches(is_separator);
    let ends_in_separator = |text: &str| text.ends_with(is_separator);
    let with_word = TAKE_WORDS.iter().find_map(|word| rest.strip_suffix(word).filter(|line| ends_in_separator(line)));
    let line = match with_word {
        Some(line) => line,
        None => Some(before).filter(|before| ends_in_separator(before))?,
    };
    Some((line.trim_end_matches(is_separator), number))
}

/// Returns the number of a take that a cell states: `3`, `3.0`, `take 3`, `#3`.
fn number_in(cell: &str) -> Option<u32> {
    let cell = cell.trim().to_lowercase();
    let whole = cell.trim_end_matches('0').strip_suffix('.').unwrap_or(&cell);
    let cell = if whole.is_empty() { &cell } else { whole };
    let rest = TAKE_WORDS.iter().find_map(|word| cell.strip_prefix(word)).unwrap_or(cell);
    let rest = rest.trim_matches(is_separator);
    let is_number = !rest.is_empty() && rest.bytes().all(|digit| digit.is_ascii_digit());
    // A negative number is a mistake.
    let is_negative = cell.starts_with('-');
    if is_number && !is_negative { rest.parse().ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_takes_of_lines_in_all_usual_names() {
        for stem in ["mayor_3", "mayor-take03", "mayor 3", "mayor.t3", "mayor (3)", "mayor_tk-3", "mayor #3"] {
            assert_eq!(take_of(stem), Some(("mayor", 3)), "{stem}");
        }
        assert_eq!(take_of("line_12"), Some(("line", 12)), "not take 2 of `line_1`");
        assert_eq!(take_of("line_1_2"), Some(("line_1", 2)));
        for stem in ["mayor", "mayor3", "intake3", "mayor_x", "3"] {
            assert_eq!(take_of(stem), None, "{stem}");
        }
    }

    #[test]
    fn cells_state_numbers_in_several_ways() {
        for cell in ["3", " 3 ", "3.0", "3.00", "03", "(3)", "take 3", "Take3", "T3", "#3"] {
            assert_eq!(number_in(cell), Some(3), "{cell}");
        }
        for cell in ["-3", "3.5", "mayor_3", "3/4", "", "t", "99999999999"] {
            assert_eq!(number_in(cell), None, "{cell}");
        }
    }
}
