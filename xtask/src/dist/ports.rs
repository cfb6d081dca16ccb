//! The archives of the readers for engines. They are the same on all platforms, because they contain only sources.

use super::archive::{Entry, checksum_line, tar_gz, zip};
use super::contents::read;
use super::wheel::VERSION;
use super::write;
use crate::Failure;
use crate::paths::workspace_root;
use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;

/// Where links of a README lead that leave its folder.
const REPOSITORY: &str = "https://github.com/lipz/lipz/blob/main";

/// Folders for tests, and the cache of Python.
const SKIPPED: [&str; 3] = ["test", "test~", "__pycache__"];

/// Both licences, if an engine does not prescribe a single file.
const LICENCES: [(&str, &str); 2] = [("LICENSE-APACHE", "LICENSE-APACHE"), ("LICENSE-MIT", "LICENSE-MIT")];

/// An archive for an engine.
struct Archive {
    /// The name before the version, and the extension.
    name: [&'static str; 2],
    /// The folder in the archive.
    folder: &'static str,
    /// Files and folders of this repository, and their paths below `folder`.
    parts: &'static [(&'static str, &'static str)],
    /// A manifest below `folder`, with the text that contains the version.
    manifest: Option<(&'static str, &'static str)>,
    /// Paths in the archive that the engine or the guide needs.
    needed: &'static [&'static str],
}

static ARCHIVES: [Archive; 6] = [
    Archive {
        name: ["lipz-godot-v", "zip"],
        folder: "",
        parts: &[("packages/lipz-godot/README.md", "addons/lipz/README.md"), ("packages/lipz-godot/addons", "addons")],
        manifest: None,
        needed: &["addons/lipz/lipz_player.gd", "addons/lipz/icon.svg"],
    },
    Archive {
        name: ["lipz-lua-v", "zip"],
        folder: "lipz-lua/",
        parts: &[("packages/lipz-lua/README.md", "README.md"), ("packages/lipz-lua/lipz", "lipz")],
        manifest: None,
        needed: &["lipz-lua/lipz/init.lua", "lipz-lua/README.md"],
    },
    // With the files that `packages/lipz-blender/build.py` packs, for whose archive the tests of that package run.
    Archive {
        name: ["lipz-blender-", "zip"],
        folder: "",
        parts: &[("packages/lipz-blender/lipz", ""), ("packages/lipz-python/lipz/reader", "reader")],
        manifest: Some(("blender_manifest.toml", "\nversion = \"VERSION\"")),
        needed: &["__init__.py", "reader/__init__.py"],
    },
    Archive {
        name: ["lipz-renpy-v", "zip"],
        folder: "lipz-renpy/",
        parts: &[
            ("packages/lipz-renpy/README.md", "README.md"),
            ("packages/lipz-renpy/lipz.rpy", "game/lipz.rpy"),
            ("packages/lipz-renpy/sample", "sample"),
            ("packages/lipz-python/lipz/reader", "game/python-packages/lipz_reader"),
        ],
        manifest: None,
        needed: &["lipz-renpy/game/lipz.rpy", "lipz-renpy/game/python-packages/lipz_reader/__init__.py"],
    },
    // The format of Unity's packages is that of npm.
    Archive {
        name: ["com.lipz.reader-", "tgz"],
        folder: "package/",
        parts: &[("packages/lipz-unity", "")],
        manifest: Some(("package.json", "\"version\": \"VERSION\"")),
        needed: &["package/Runtime/Reader/Lipz.Reader.asmdef", "package/Samples~/Conversation/Conversation.cs"],
    },
    Archive {
        name: ["lipz-unreal-v", "zip"],
        folder: "Lipz/",
        parts: &[("packages/lipz-unreal", "")],
        manifest: Some(("Lipz.uplugin", "\"VersionName\": \"VERSION\"")),
        needed: &["Lipz/Source/Lipz/Lipz.Build.cs", "Lipz/Source/ThirdParty/lipz/README.md"],
    },
];

impl Archive {
    fn file_name(&self) -> String {
        let [name, extension] = self.name;
        format!("{name}{VERSION}.{extension}")
    }

    /// Returns the files, in the order of their paths.
    fn entries(&self) -> Result<Vec<Entry>, Failure> {
        let mut entries = Vec::new();
        for (from, to) in self.parts {
            add(&workspace_root().join(from), &format!("{}{to}", self.folder), &mut entries)?;
        }
        entries.sort_by(|a, b| a.path.cmp(&b.path));
        // Some folders contain the licences already, because users copy them from a checkout.
        if !entries.iter().any(|entry| entry.path.contains("LICENSE.md")) {
            for (from, to) in LICENCES {
                let path = format!("{}{to}", self.folder);
                if !entries.iter().any(|entry| entry.path == path) {
                    entries.push(Entry::file(path, read(&workspace_root().join(from))?));
                }
            }
        }
        Ok(entries)
    }

    fn bytes(&self) -> Result<Vec<u8>, Failure> {
        let entries = self.entries()?;
        let packed = if self.name[1] == "zip" { zip(&entries) } else { tar_gz(&entries) };
        packed.map_err(|error| format!("`{}`: {error}", self.file_name()))
    }

    /// Returns the problems of the packed archive.
    fn faults(&self, bytes: &[u8]) -> Result<Vec<String>, Failure> {
        let files = unpacked(bytes, self.name[1]).map_err(|error| format!("`{}`: {error}", self.file_name()))?;
        let text = |path: &str| files.iter().find(|file| file.0 == path).map(|file| file.1.as_str());
        let mut faults: Vec<String> = Vec::new();
        let mit = String::from_utf8_lossy(&read(&workspace_root().join("LICENSE-MIT"))?).trim().to_owned();
        let has_mit = |file: &(String, String)| file.0.contains("LICENSE") && file.1.contains(&mit);
        let has_apache = |file: &(String, String)| file.0.contains("LICENSE") && file.1.contains("Apache License");
        if !files.iter().any(has_mit) || !files.iter().any(has_apache) {
            faults.push("lacks a licence".to_owned());
        }
        faults.extend(self.needed.iter().filter(|path| text(path).is_none()).map(|path| format!("lacks `{path}`")));
        if let Some((path, version)) = self.manifest {
            let is_current = text(&format!("{}{path}", self.folder))
                .is_some_and(|text| text.contains(&version.replace("VERSION", VERSION)));
            faults.extend((!is_current).then(|| format!("`{path}` does not have the version {VERSION}")));
        }
        for (path, text) in &files {
            if path.split('/').any(|part| SKIPPED.contains(&part)) || !path.starts_with(self.folder) {
                faults.push(format!("has `{path}`"));
            }
            if path.ends_with("README.md") && text.contains("](..") {
                faults.push(format!("`{path}` has a link that leads out of the archive"));
            }
        }
        Ok(faults.into_iter().map(|fault| format!("{} {fault}", self.file_name())).collect())
    }
}

/// Adds a file, or all files of a folder, to `entries`.
fn add(from: &Path, to: &str, entries: &mut Vec<Entry>) -> Result<(), Failure> {
    let failed = |error: std::io::Error| format!("`{}`: {error}", from.display());
    if !from.is_dir() {
        let bytes = read(from)?;
        let is_page = to.ends_with("README.md");
        let bytes = if is_page { with_whole_links(&String::from_utf8_lossy(&bytes)).into_bytes() } else { bytes };
        entries.push(Entry::file(to.trim_start_matches('/'), bytes));
        return Ok(());
    }
    for entry in fs::read_dir(from).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name().to_string_lossy().into_owned();
        if !SKIPPED.contains(&name.as_str()) {
            let to = if to.is_empty() || to.ends_with('/') { format!("{to}{name}") } else { format!("{to}/{name}") };
            add(&from.join(&name), &to, entries)?;
        }
    }
    Ok(())
}

/// Returns a README of a package with links to this repository instead of links that leave its folder.
fn with_whole_links(text: &str) -> String {
    text.replace("](../../", &format!("]({REPOSITORY}/")).replace("](../", &format!("]({REPOSITORY}/packages/"))
}

/// Returns the paths and texts of an archive.
fn unpacked(bytes: &[u8], extension: &str) -> std::io::Result<Vec<(String, String)>> {
    let mut files = Vec::new();
    let mut add = |path: String, mut file: &mut dyn Read| -> std::io::Result<()> {
        let mut bytes = Vec::new();
        Read::read_to_end(&mut file, &mut bytes)?;
        files.push((path, String::from_utf8_lossy(&bytes).into_owned()));
        Ok(())
    };
    if extension == "zip" {
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes))?;
        for index in 0..archive.len() {
            let mut file = archive.by_index(index)?;
            let path = file.name()?.into_owned();
            add(path, &mut file)?;
        }
    } else {
        let mut archive = tar::Archive::new(flate2::read::GzDecoder::new(bytes));
        for file in archive.entries()? {
            let mut file = file?;
            add(file.path()?.to_string_lossy().into_owned(), &mut file)?;
        }
    }
    Ok(files)
}

/// Writes the archives with their checksums, and checks their contents.
pub(super) fn run(folder: &Path) -> Result<(), Failure> {
    let mut faults = Vec::new();
    for archive in &ARCHIVES {
        let (name, bytes) = (archive.file_name(), archive.bytes()?);
        faults.extend(archive.faults(&bytes)?);
        write(folder, &format!("{name}.sha256"), checksum_line(&name, &bytes).as_bytes())?;
        write(folder, &name, &bytes)?;
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::archive::Content;
    use super::*;

    #[test]
    fn archives_contain_what_engines_need() {
        for archive in &ARCHIVES {
            let bytes = archive.bytes().unwrap();
            assert_eq!(archive.faults(&bytes).unwrap(), [""; 0]);
            assert!(archive.bytes().unwrap() == bytes, "{} differs", archive.file_name());
        }
    }

    #[test]
    fn faults_of_archives_are_found() {
        let faults = |archive: &Archive, change: &dyn Fn(&mut Entry)| {
            let mut entries = archive.entries().unwrap();
            entries.iter_mut().for_each(change);
            archive.faults(&zip(&entries).unwrap()).unwrap().len()
        };
        let unreal = &ARCHIVES[5];
        assert_eq!(faults(unreal, &|_| ()), 0);
        let renamed =
            |name: &'static str, to: &'static str| move |entry: &mut Entry| entry.path = entry.path.replace(name, to);
        assert_eq!(faults(unreal, &renamed("LICENSE-MIT", "MIT")), 1);
        assert_eq!(faults(unreal, &renamed("Lipz.uplugin", "Old.uplugin")), 1);
        assert_eq!(faults(unreal, &renamed("Lipz.Build.cs", "Build.cs")), 1);
        assert_eq!(faults(unreal, &renamed("Lipz/LICENSE-MIT", "LICENSE-MIT")), 1);
        let with_link = |entry: &mut Entry| {
            if entry.path == "Lipz/README.md" {
                entry.content = Content::File(b"[a](../a.md)".to_vec());
            }
        };
        assert_eq!(faults(unreal, &with_link), 1);
    }

    #[test]
    fn links_lead_to_the_repository() {
        let text = "[a](../../docs/a.md#b) [c](../lipz-lua/README.md) [d](test)";
        let expected = format!("[a]({REPOSITORY}/docs/a.md#b) [c]({REPOSITORY}/packages/lipz-lua/README.md) [d](test)");
        assert_eq!(with_whole_links(text), expected);
    }
}
