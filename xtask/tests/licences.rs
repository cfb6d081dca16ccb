//! Folders that users copy into their projects contain the licences, as files and not as links.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::Path;

/// The folders with the same two files as the root of the repository.
const WITH_BOTH: [&str; 4] = ["lipz-lua/lipz", "lipz-python/lipz/reader", "lipz-renpy", "lipz-unreal"];

/// The files of engines whose packages have a single file with a fixed name.
const IN_ONE_FILE: [&str; 2] = ["lipz-godot/addons/lipz/LICENSE.md", "lipz-unity/LICENSE.md"];

#[test]
fn copied_folders_contain_the_licences() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let packages = root.join("packages");
    for folder in WITH_BOTH {
        for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
            let path = packages.join(folder).join(name);
            assert!(fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_file()), "{}", path.display());
            assert_eq!(fs::read(&path).unwrap(), fs::read(root.join(name)).unwrap(), "{}", path.display());
        }
    }
    let mit = fs::read_to_string(root.join("LICENSE-MIT")).unwrap();
    for path in IN_ONE_FILE {
        let text = fs::read_to_string(packages.join(path)).unwrap();
        assert!(text.contains(mit.trim()) && text.contains("Apache License 2.0"), "{path}");
    }
}
