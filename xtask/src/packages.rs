//! `cargo xtask packages`: builds every crate as it would be published.

use crate::Failure;
use crate::cargo::{self, Package};
use crate::paths::{target_folder, workspace_root};
use crate::tools::succeed;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The licences, which must be in every package.
const LICENCES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];

/// The keys that every manifest has.
const KEYS: [&str; 6] = ["categories", "description", "keywords", "license", "repository", "rust-version"];

/// The plugin for Bevy. It is in a separate workspace, and its test script compiles it and checks its files.
const PLUGIN: &str = "packages/bevy_lipz";

pub(crate) fn run() -> Result<(), Failure> {
    let mut packages = cargo::workspace()?;
    packages.retain(Package::is_published);
    let folder = target_folder().join("packages");
    let unpacked = unpack(&packages, &folder)?;
    let mut faults = Vec::new();
    for (package, folder) in packages.iter().zip(&unpacked) {
        let found = faults_in(folder)?;
        faults.extend(found.into_iter().map(|fault| format!("{}: {fault}", package.name)));
    }
    faults.extend(faults_in_plugin()?.into_iter().map(|fault| format!("{PLUGIN}: {fault}")));
    if !faults.is_empty() {
        return Err(faults.join("\n"));
    }
    compile(&packages, &unpacked, &folder)?;
    let mut publish = cargo::command();
    publish.args(["publish", "--workspace", "--dry-run", "--no-verify", "--allow-dirty", "--locked", "--quiet"]);
    succeed(publish.current_dir(workspace_root()), "cargo publish --dry-run")?;
    println!("{} crates can be published", packages.len());
    Ok(())
}

/// Compiles each package alone, with its default features, from its own contents and with the other unpacked packages.
/// `cargo publish` would do the same, but build all dependencies again. Here, they are shared with the checks of the
/// workspace, which have the same profiles and versions.
fn compile(packages: &[Package], unpacked: &[PathBuf], folder: &Path) -> Result<(), Failure> {
    let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
    let root = workspace_root();
    let text = fs::read_to_string(root.join("Cargo.toml")).map_err(failed)?;
    fs::write(folder.join("Cargo.toml"), manifest(packages, unpacked, &text)).map_err(failed)?;
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).map_err(failed)?;
    for package in packages {
        println!("{} as it would be published", package.name);
        let mut check = cargo::command();
        check.args(["check", "--quiet", "--package", &package.name, "--target-dir"]).arg(target_folder());
        succeed(check.current_dir(folder), &format!("cargo check of the package `{}`", package.name))?;
    }
    Ok(())
}

/// Returns a workspace of the packages, which depend on each other, with the profiles of `root`, a manifest.
fn manifest(packages: &[Package], unpacked: &[PathBuf], root: &str) -> String {
    let (mut members, mut patches) = (String::new(), String::new());
    for (package, path) in packages.iter().zip(unpacked) {
        members += &format!("{:?}, ", path.file_name().unwrap_or_default());
        patches += &format!("{} = {{ path = {:?} }}\n", package.name, path.file_name().unwrap_or_default());
    }
    let mut is_profile = false;
    let profiles = root.split_inclusive('\n').filter(|line| {
        is_profile = if line.starts_with('[') { line.starts_with("[profile.") } else { is_profile };
        is_profile
    });
    let profiles: String = profiles.collect();
    format!("[workspace]\nresolver = \"2\"\nmembers = [{members}]\n\n[patch.crates-io]\n{patches}\n{profiles}")
}

/// Makes the packages and unpacks them into `folder`. Returns the folder of each.
pub(crate) fn unpack(packages: &[Package], folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut make = cargo::command();
    make.args(["package", "--no-verify", "--allow-dirty", "--locked", "--quiet"]);
    for package in packages {
        make.args(["--package", &package.name]);
    }
    // Separate from simultaneous builds.
    make.arg("--target-dir").arg(folder);
    succeed(make.current_dir(workspace_root()), "cargo package")?;
    let unpack = |package: &Package| {
        let name = format!("{}-{}", package.name, package.version);
        let unpacked = folder.join(&name);
        if unpacked.exists() {
            fs::remove_dir_all(&unpacked).map_err(|error| format!("`{}`: {error}", unpacked.display()))?;
        }
        // `m`: packages have fixed times for any contents, and cargo only compiles files with new times.
        let mut tar = Command::new("tar");
        tar.arg("-xzmf").arg(folder.join("package").join(format!("{name}.crate"))).arg("-C").arg(folder);
        succeed(&mut tar, "tar").map(|()| unpacked)
    };
    packages.iter().map(unpack).collect()
}

/// Returns missing and superfluous files of a package.
fn faults_in(folder: &Path) -> Result<Vec<String>, Failure> {
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap_or_default();
    let mut faults = Vec::new();
    for name in LICENCES {
        let ours = fs::read_to_string(workspace_root().join(name)).map_err(|error| format!("`{name}`: {error}"))?;
        if read(name) != ours {
            faults.push(format!("no copy of `{name}`"));
        }
    }
    let readme = read("README.md");
    if readme.is_empty() {
        faults.push("no README.md".into());
    }
    faults.extend(dead_links(&readme));
    if folder.join("tests").exists() {
        faults.push("has tests, which need files of the repository: leave them out with `include`".into());
    }
    faults.extend(missing_keys(&read("Cargo.toml"), &[&KEYS[..], &["readme"]].concat()));
    faults.extend(missing_includes(&folder.join("src")).map_err(|error| format!("`{}`: {error}", folder.display()))?);
    Ok(faults)
}

/// Returns problems of the README and the manifest of the plugin for Bevy.
fn faults_in_plugin() -> Result<Vec<String>, Failure> {
    let read = |name: &str| {
        let path = workspace_root().join(PLUGIN).join(name);
        fs::read_to_string(&path).map_err(|error| format!("`{}`: {error}", path.display()))
    };
    Ok([dead_links(&read("README.md")?), missing_keys(&read("Cargo.toml")?, &KEYS)].concat())
}

/// Returns links of a README that would lead nowhere on crates.io.
fn dead_links(readme: &str) -> Vec<String> {
    let relative = links(readme).filter(|link| !link.starts_with("https://"));
    relative
        .map(|link| format!("the link `{link}` of README.md leads nowhere on crates.io: it needs a whole address"))
        .collect()
}

/// Returns keys that a manifest lacks.
fn missing_keys(manifest: &str, keys: &[&str]) -> Vec<String> {
    let is_missing = |key: &&&str| !manifest.lines().any(|line| line.starts_with(&format!("{key} = ")));
    keys.iter().filter(is_missing).map(|key| format!("Cargo.toml has no `{key}`")).collect()
}

/// Returns files that sources or the examples in their documentation include, but that are missing in the package.
fn missing_includes(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut faults = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            faults.extend(missing_includes(&path)?);
            continue;
        }
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let text = fs::read_to_string(&path)?;
        let included = text.split("include_").skip(1).filter_map(|rest| {
            let path = rest.strip_prefix("bytes!(\"").or_else(|| rest.strip_prefix("str!(\""))?;
            path.split('"').next()
        });
        let missing = included.filter(|file| !folder.join(file).exists());
        faults.extend(missing.map(|file| format!("{} includes `{file}`, not in the package", path.display())));
    }
    Ok(faults)
}

/// Returns the targets of links in Markdown.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_named() {
        let folder = crate::paths::temporary_folder().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        for name in LICENCES {
            write(name, &fs::read_to_string(workspace_root().join(name)).unwrap());
        }
        write("README.md", "# a\n[b](https://b.example/c.md), [d](../d.md)\n");
        write("Cargo.toml", "[package]\ncategories = []\ndescription = \"\"\nkeywords = []\nlicense = \"\"\n");
        fs::create_dir(folder.path().join("src")).unwrap();
        let faults = faults_in(folder.path()).unwrap();
        assert_eq!(faults.len(), 4, "{faults:?}");
        assert!(faults[0].contains("`../d.md`"), "{faults:?}");
        write("LICENSE-MIT", "../../LICENSE-MIT");
        fs::create_dir(folder.path().join("tests")).unwrap();
        fs::create_dir_all(folder.path().join("src/a")).unwrap();
        write(
            "src/lib.rs",
            "//! # include_bytes!(\"../LICENSE-MIT\");\n//! include_bytes!(concat!(env!(\"OUT_DIR\"), 1));\n",
        );
        write("src/a/mod.rs", "include_str!(\"../../../README.md\")\n");
        assert_eq!(faults_in(folder.path()).unwrap().len(), 7);
    }
}
