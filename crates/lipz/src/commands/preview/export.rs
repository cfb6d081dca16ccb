//! `lipz preview --output`: the page as a folder to open from a disk, including banks and recordings.
//!
//! Pages opened from a disk must not fetch files or import modules. Therefore, the page contains its modules as an
//! import map of data addresses, and its data are scripts.

use super::assets::{self, Asset};
use super::clip::ClipPage;
use super::hearing::Phones;
use super::listing::Listing;
use super::project_file;
use super::version::Version;
use crate::console;
use crate::interrupt::Files;
use crate::shared::input_file::unreadable;
use crate::shared::output_file::unwritable;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lipz_bank::Bank;
use lipz_diagnostics::{Code, Report};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The folder of the scripts with data.
const DATA: &str = "data";
/// The line of the served page that the embedded modules replace.
const START: &str = "    <script type=\"module\" src=\"page/main.js\"></script>\n";

/// Whether the folder may be written: if it is missing or empty, or contains an exported page.
pub(super) fn is_free(folder: &Path) -> bool {
    let is_export = folder.join(DATA).join("clips.js").is_file();
    is_export || fs::read_dir(folder).map_or(!folder.exists(), |mut entries| entries.next().is_none())
}

/// The contents of an exported page.
pub(super) struct ExportedPage {
    /// The numbers of its clips and of its recordings.
    pub(super) clips: usize,
    pub(super) sounds: usize,
    /// Recordings that are missing because they are not audio.
    pub(super) left_out: Vec<Report>,
}

/// Writes the page and all its files into a folder, and removes files of an older export that are not needed. Returns
/// its contents, or the problem.
pub(super) fn export(version: &Version, phones: &Phones, folder: &Path) -> Result<ExportedPage, Vec<Report>> {
    let mut export = PageExport { folder, files: Files::new(), written: BTreeSet::new() };
    let counts = export
        .data(version, phones)
        .and_then(|counts| export.page().map(|()| counts))
        .map_err(|report| vec![report])?;
    let unwritten = export.files.finish();
    if !unwritten.is_empty() {
        return Err(unwritten);
    }
    export.tidy();
    Ok(counts)
}

struct PageExport<'f> {
    folder: &'f Path,
    files: Files,
    written: BTreeSet<PathBuf>,
}

impl PageExport<'_> {
    fn data(&mut self, version: &Version, phones: &Phones) -> Result<ExportedPage, Report> {
        let listing = Listing::new(version, true);
        self.script("clips", &listing)?;
        self.script("bank", &STANDARD.encode(version.bank.as_slice()))?;
        let wasm = assets::named("web/lipz.wasm").map_or(&[][..], |asset| asset.bytes);
        self.script("sprites", version.sprites.as_ref())?;
        self.script("wasm", &STANDARD.encode(wasm))?;
        let (mut sounds, mut left_out) = (0, Vec::new());
        for (place, key) in listing.keys().enumerate() {
            let Some(clip) = ClipPage::new(version, key) else { continue };
            let heard = phones.get(key).map_or(&[][..], AsRef::as_ref);
            let mut has_sound = false;
            match version.recordings.find(key).map(|path| (path, project_file::open_recording(path))) {
                Some((path, Ok(mut file))) => {
                    let mut bytes = Vec::new();
                    file.read_to_end(&mut bytes).map_err(|error| unreadable(path, &error))?;
                    self.script(&format!("sound-{place}"), &STANDARD.encode(bytes))?;
                    has_sound = true;
                    sounds += 1;
                }
                Some((_, Err(report))) => left_out.push(report),
                None => {}
            }
            self.script(&format!("clip-{place}"), &clip.alone(heard, has_sound))?;
        }
        let clips = Bank::open(&version.bank).map_or(0, |bank| bank.clips().count());
        Ok(ExportedPage { clips, sounds, left_out })
    }

    /// Writes a script that passes a value to the page.
    fn script<T: Serialize>(&mut self, name: &str, value: &T) -> Result<(), Report> {
        let value = serde_json::to_string(value).unwrap_or_else(|_| "null".to_owned());
        let path = format!("{DATA}/{name}.js");
        self.write(&path, format!("lipzExport.take(\"{name}\", {value});\n").as_bytes())
    }

    fn page(&mut self) -> Result<(), Report> {
        for asset in assets::ALL.iter().filter(|asset| asset.path.ends_with(".css")) {
            self.write(asset.path, asset.bytes)?;
        }
        let text = |path| {
            assets::named(path).map_or_else(String::new, |asset| String::from_utf8_lossy(asset.bytes).into_owned())
        };
        let page = text("").replace(START, &scripts(&text("page/exported.js")));
        self.write("index.html", page.as_bytes())
    }

    fn write(&mut self, path: &str, bytes: &[u8]) -> Result<(), Report> {
        let path = self.folder.join(path);
        // The folder itself may be a link. One in it would lead to a file that is not part of the page.
        let inside = path.ancestors().take_while(|above| *above != self.folder);
        if let Some(link) = inside.filter(|above| above.is_symlink()).last() {
            let message = format!("`{}` is a link, and pages are not written through links", console::path(link));
            let help = "remove the link, or name a different folder";
            return Err(Report::failure(console::path(link), Code::OutputFailed, message, help));
        }
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
        }
        self.files.replace(&path, bytes)?;
        self.written.insert(path);
        Ok(())
    }

    /// Removes clips and recordings of an older page.
    fn tidy(&self) {
        let entries = fs::read_dir(self.folder.join(DATA)).into_iter().flatten().filter_map(Result::ok);
        for path in entries.map(|entry| entry.path()).filter(|path| !self.written.contains(path)) {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if (name.starts_with("clip-") || name.starts_with("sound-")) && name.ends_with(".js") {
                // Remaining files are harmless, because the page does not refer to them.
                let _ = fs::remove_file(&path);
            }
        }
    }
}

/// Returns the modules of the page, by path, and the code that starts them.
fn scripts(exported: &str) -> String {
    let modules = assets::ALL.iter().filter(|asset| asset.path.ends_with(".js") && asset.path != "page/exported.js");
    let address = |module: &Asset| format!("data:text/javascript;base64,{}", STANDARD.encode(bare(module)));
    let imports: BTreeMap<&str, String> = modules.map(|module| (module.path, address(module))).collect();
    let map = serde_json::json!({ "imports": imports });
    format!(
        "    <script>\n{exported}    </script>\n    <script type=\"importmap\">{map}</script>\n    \
         <script type=\"module\">import \"page/main.js\";</script>\n"
    )
}

/// Returns a module whose imports are paths below the page, because relative ones do not work in a data address.
fn bare(module: &Asset) -> String {
    let text = String::from_utf8_lossy(module.bytes);
    let folder = module.path.rsplit_once('/').map_or("", |(folder, _)| folder);
    let line = |line: &str| {
        let (before, rest) = line.rsplit_once(" from \"").filter(|(before, _)| is_import(before))?;
        let (path, after) = rest.split_once('"')?;
        Some(format!("{before} from \"{}\"{after}", resolved(folder, path)))
    };
    text.split_inclusive('\n').map(|text| line(text).unwrap_or_else(|| text.to_owned())).collect()
}

fn is_import(before: &str) -> bool {
    ["import ", "export {", "export *", "}"].iter().any(|start| before.starts_with(start))
}

/// Returns a path relative to a folder, without `.` and `..`.
fn resolved(folder: &str, path: &str) -> String {
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in path.split('/') {
        match part {
            "." => {}
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_import_leads_to_a_module_of_the_page() {
        let mut count = 0;
        for module in assets::ALL.iter().filter(|asset| asset.path.ends_with(".js")) {
            let text = bare(module);
            assert!(!text.contains("from \"."), "{}", module.path);
            let imports =
                text.lines().filter_map(|line| line.split_once(" from \"")).filter(|(before, _)| is_import(before));
            for path in imports.filter_map(|(_, path)| path.split('"').next()) {
                assert!(assets::named(path).is_some(), "{}: {path}", module.path);
                count += 1;
            }
        }
        assert!(count > 30, "{count}");
        assert!(String::from_utf8_lossy(assets::named("").unwrap().bytes).contains(START));
    }
}
