//! The npm packages for `npx lipz`: `lipz` starts the program of an optional package for each platform.
//!
//! npm installs only the optional package that matches the machine, and runs no script while it does.

use super::archive::{Entry, tar_gz};
use super::contents::{Contents, read};
use super::platform::{PLATFORMS, Platform};
use super::wheel::{LICENCE, VERSION};
use crate::Failure;
use crate::paths::workspace_root;
use serde_json::{Map, Value, json};

/// The folder of the program in JavaScript.
const STARTER: &str = "packages/lipz-npm";

/// Returns the name of the archive that `npm pack` would write for a package.
pub(super) fn name(package: &str) -> String {
    format!("{}-{VERSION}.tgz", package.trim_start_matches('@').replace('/', "-"))
}

/// Returns the package `lipz`, which is the same for all platforms.
pub(super) fn starter(contents: &Contents) -> Result<Vec<u8>, Failure> {
    let platforms = PLATFORMS.iter().filter(|platform| platform.is_released);
    let optional: Map<String, Value> = platforms.map(|platform| (platform.npm_package(), VERSION.into())).collect();
    let mut manifest = manifest("lipz", "Compiles lip sync, subtitles and events of voice lines for games");
    manifest["bin"] = json!({ "lipz": "bin/lipz.js" });
    manifest["man"] = contents.manual.iter().map(|page| format!("man/{}", page.path)).collect();
    manifest["files"] = json!(["bin", "man", "completions", "LICENSE-*"]);
    manifest["engines"] = json!({ "node": ">=18" });
    manifest["optionalDependencies"] = Value::Object(optional);
    let program = read(&workspace_root().join(STARTER).join("bin/lipz.js"))?;
    let mut entries = vec![Entry::program("bin/lipz.js", program)];
    entries.extend(contents.manual.iter().map(|page| page.below("man")));
    entries.extend(contents.completions.iter().map(|completion| completion.below("completions")));
    // The notices are about the program, and next to it.
    entries.extend(contents.licences.iter().filter(|licence| licence.path.starts_with("LICENSE")).cloned());
    package(&manifest, &contents.readme, entries)
}

/// Returns the package with the program of a platform.
pub(super) fn program(platform: &Platform, contents: &Contents) -> Result<Vec<u8>, Failure> {
    let [system, processor] = platform.node;
    let about = format!("The command lipz for {system}-{processor}");
    let mut manifest = manifest(&platform.npm_package(), &about);
    manifest["os"] = json!([system]);
    manifest["cpu"] = json!([processor]);
    if platform.is_linux() {
        // npm can read this on Linux only. On Alpine, the starter prints other ways to install.
        manifest["libc"] = json!(["glibc"]);
    }
    manifest["files"] = json!(["bin", "LICENSE-*", "NOTICES.txt"]);
    manifest["preferUnplugged"] = true.into();
    let mut entries = vec![Entry::program(format!("bin/{}", platform.program()), contents.program.clone())];
    entries.extend(contents.licences.iter().cloned());
    let readme = format!(
        "# {}\n\n{about}. Install [`lipz`](https://www.npmjs.com/package/lipz) instead.\n",
        platform.npm_package()
    );
    package(&manifest, &readme, entries)
}

fn manifest(name: &str, about: &str) -> Value {
    json!({
        "name": name,
        "version": VERSION,
        "description": about,
        "license": LICENCE,
        "repository": { "type": "git", "url": "git+https://github.com/lipz/lipz.git" },
    })
}

/// Returns the archive of a package.
fn package(manifest: &Value, readme: &str, entries: Vec<Entry>) -> Result<Vec<u8>, Failure> {
    let manifest = format!("{manifest:#}\n");
    let mut all = vec![Entry::file("package.json", manifest), Entry::file("README.md", readme)];
    all.extend(entries);
    let all: Vec<Entry> = all.iter().map(|entry| entry.below("package")).collect();
    tar_gz(&all).map_err(|error| format!("the npm package: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn archives_are_named_as_by_npm() {
        assert_eq!(name("@lipz/cli-linux-x64"), format!("lipz-cli-linux-x64-{VERSION}.tgz"));
        assert_eq!(name("lipz"), format!("lipz-{VERSION}.tgz"));
    }
}
