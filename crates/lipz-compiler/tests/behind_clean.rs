//! A file has the same diagnostics after a clean file as alone. The fast pass over clean files starts with the second
//! file.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_compiler::{Compiler, Input, Options};
use std::path::Path;

/// A file with the elements of most files, in the locales of the fixtures.
const CLEAN: &[u8] =
    br#"{ "visemes": "MA|E-", "text_en-us": "Hi|there.", "text_de-de": "Na|du.", "fps": 24, "viseme_type": "blair" }"#;

#[test]
fn diagnostics_of_bad_files_do_not_depend_on_the_file_before() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/bad");
    let compiler = Compiler::new(Options::new().default_locale("en-us").unwrap().threads(1));
    let reports = |inputs: &[Input]| compiler.check(inputs).reports;
    let mut compared = 0;
    let files = |folder: &Path| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    for path in files(&fixtures).chain(files(&fixtures.join("with-flags"))) {
        if path.extension().is_none_or(|extension| extension != "lipz") {
            continue;
        }
        let bytes = std::fs::read(&path).unwrap();
        let bad = || Input::from_bytes("b", bytes.as_slice());
        // Twice, because the pass remembers the elements of the last file.
        let clean = ["a1", "a2"].map(|key| Input::from_bytes(key, CLEAN));
        let alone = reports(&[bad()]);
        let [first, second] = clean;
        assert_eq!(reports(&[first, second, bad()]), alone, "{}", path.display());
        compared += usize::from(!alone.is_empty());
    }
    assert!(compared > 100, "{compared} files with diagnostics");
}
