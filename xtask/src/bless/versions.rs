//! The version of the workspace in the manifests of packages, and on the pages that name it.

use crate::Failure;
use crate::paths::workspace_root;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The manifest that also has a whole number, by which Unreal compares versions.
const WITH_NUMBER: (&str, &str) = ("packages/lipz-unreal/Lipz.uplugin", "\"Version\": ");

/// Files, and the texts before the version. Without such texts, every version in the file is that of lipz.
const FILES: [(&str, &[&str]); 20] = [
    ("docs/guides/blender.md", &["lipz-blender-"]),
    ("docs/guides/c.md", &["liblipz-v", "liblipz.so."]),
    ("docs/guides/continuous-integration.md", &[]),
    ("docs/guides/install.md", &["lipz-v"]),
    ("editors/vscode/package.json", &["\n  \"version\": \""]),
    ("editors/vscode/package-lock.json", &["\n  \"version\": \"", "\"name\": \"lipz\",\n      \"version\": \""]),
    (
        "firmware/Cargo.lock",
        &[
            "\"lipz-bank\"\nversion = \"",
            "\"lipz-layout\"\nversion = \"",
            "\"lipz-testkit\"\nversion = \"",
            "\"lipz-types\"\nversion = \"",
        ],
    ),
    (
        "fuzz/Cargo.lock",
        &[
            "\"lipz-bank\"\nversion = \"",
            "\"lipz-compiler\"\nversion = \"",
            "\"lipz-diagnostics\"\nversion = \"",
            "\"lipz-file\"\nversion = \"",
            "\"lipz-interop\"\nversion = \"",
            "\"lipz-layout\"\nversion = \"",
            "\"lipz-speech\"\nversion = \"",
            "\"lipz-sync\"\nversion = \"",
            "\"lipz-testkit\"\nversion = \"",
            "\"lipz-texts\"\nversion = \"",
            "\"lipz-types\"\nversion = \"",
        ],
    ),
    (
        "packages/bevy_lipz/Cargo.lock",
        &[
            "\"bevy_lipz\"\nversion = \"",
            "\"bevy_lipz_recordings\"\nversion = \"",
            "\"lipz-bank\"\nversion = \"",
            "\"lipz-layout\"\nversion = \"",
            "\"lipz-types\"\nversion = \"",
        ],
    ),
    ("packages/bevy_lipz/Cargo.toml", &["\nversion = \"", "lipz-bank\", version = \""]),
    ("packages/bevy_lipz/recordings/Cargo.toml", &["\nversion = \""]),
    ("packages/ci/github-action/action.yml", &[]),
    ("packages/ci/gitlab/lipz.gitlab-ci.yml", &[]),
    ("packages/ci/pre-commit/pyproject.toml", &[]),
    ("packages/lipz-blender/README.md", &["lipz-blender-"]),
    ("packages/lipz-blender/lipz/blender_manifest.toml", &["\nversion = \""]),
    ("packages/lipz-unity/package.json", &["\n  \"version\": \""]),
    ("packages/lipz-unreal/Lipz.uplugin", &["\"VersionName\": \""]),
    ("packages/lipz-unreal/Source/ThirdParty/lipz/README.md", &["liblipz-v"]),
    ("packages/lipz-web/package.json", &["\n  \"version\": \""]),
];

/// Returns the files with this version.
pub(super) fn with_version() -> Result<Vec<(&'static str, String)>, Failure> {
    let with_version = |(path, before): &(&'static str, &[&str])| {
        let text =
            std::fs::read_to_string(workspace_root().join(path)).map_err(|error| format!("`{path}`: {error}"))?;
        let text = changed(&text, before, VERSION).map_err(|error| format!("`{path}`: {error}"))?;
        Ok((*path, if *path == WITH_NUMBER.0 { with_number(&text, VERSION) } else { text }))
    };
    FILES.iter().map(with_version).collect()
}

/// Returns the text with a different version after each of the texts, or everywhere.
fn changed(text: &str, before: &[&str], version: &str) -> Result<String, Failure> {
    if let Some(missing) = before.iter().find(|before| !text.contains(*before)) {
        return Err(format!("lacks {missing:?}"));
    }
    let (mut changed, mut rest, mut count) = (String::new(), text, 0);
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (skipped, found) = rest.split_at(start);
        changed.push_str(skipped);
        let end = found.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(found.len());
        // A full stop may end a sentence.
        let number = found[..end].trim_end_matches('.');
        let is_version = number.split('.').count() == 3;
        if is_version && (before.is_empty() || before.iter().any(|before| changed.ends_with(before))) {
            changed.push_str(version);
            count += 1;
        } else {
            changed.push_str(number);
        }
        rest = &found[number.len()..];
    }
    if count < before.len().max(1) { Err("lacks a version".to_owned()) } else { Ok(changed + rest) }
}

/// Returns the text with the number of a version: 10,203 for 1.2.3.
fn with_number(text: &str, version: &str) -> String {
    let number = version.split('.').fold(0, |number, part| number * 100 + part.parse().unwrap_or(0));
    let Some((before, after)) = text.split_once(WITH_NUMBER.1) else { return text.to_owned() };
    format!("{before}{}{number}{}", WITH_NUMBER.1, after.trim_start_matches(|c: char| c.is_ascii_digit()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn only_the_version_of_lipz_changes() {
        let text = "schema = \"1.0.0\"\nversion = \"0.1.0\"\nbevy = \"0.1.0\"\n";
        let expected = "schema = \"1.0.0\"\nversion = \"0.2.0\"\nbevy = \"0.1.0\"\n";
        assert_eq!(changed(text, &["\nversion = \""], "0.2.0").unwrap(), expected);
        assert_eq!(changed("lipz 0.1.0. Then v0.1.0, 3.12", &[], "1.0.0").unwrap(), "lipz 1.0.0. Then v1.0.0, 3.12");
    }

    #[test]
    fn unreal_compares_numbers() {
        assert_eq!(with_number("{ \"Version\": 7, \"A\": 1 }", "1.2.3"), "{ \"Version\": 10203, \"A\": 1 }");
    }

    #[test]
    fn a_file_without_the_version_is_an_error() {
        assert!(changed("version = \"0.1\"", &["version = \""], "0.2.0").is_err());
        assert!(changed("name = \"lipz\"", &["version = \""], "0.2.0").is_err());
        assert!(changed("python 3.12", &[], "0.2.0").is_err());
    }
}
