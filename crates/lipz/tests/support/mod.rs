//! Runs the command `lipz` and compares its output with files.
#![allow(dead_code, reason = "each test program uses a part of this")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test stops at the first surprise")]

pub(crate) mod approved;
pub(crate) mod delivery;
pub(crate) mod editor;
pub(crate) mod forge;
pub(crate) mod preview;
pub(crate) mod sound;

use similar::TextDiff;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Returns the folder of the repository, to which the paths of fixtures are relative.
pub(crate) fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().to_owned()
}

/// The result of a run of the command.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    pub(crate) code: i32,
}

impl Outcome {
    /// Returns the contents for an `.expected` file: standard error, then the exit code.
    pub(crate) fn expectation(&self) -> String {
        format!("{}exit code: {}\n", self.stderr, self.code)
    }
}

impl From<Output> for Outcome {
    fn from(output: Output) -> Outcome {
        Outcome {
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
            code: output.status.code().expect("ended by a signal"),
        }
    }
}

/// Returns the schema of SARIF 2.1.0 from the standard.
pub(crate) fn sarif_schema() -> jsonschema::Validator {
    let schema = include_str!("../schemas/sarif-2.1.0.json");
    jsonschema::validator_for(&serde_json::from_str(schema).unwrap()).unwrap()
}

/// Fails unless the document is SARIF.
pub(crate) fn assert_sarif(document: &serde_json::Value) {
    let errors: Vec<String> =
        sarif_schema().iter_errors(document).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:#?}");
}

/// Returns the commands in `lipz --help`.
pub(crate) fn commands() -> Vec<String> {
    let help = lipz(&repository(), ["--help"]).stdout;
    let list = help.split("Usage: ").nth(1).unwrap().split("\nOptions:\n").next().unwrap();
    let names = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help");
    names.map(str::to_owned).collect()
}

/// Runs `lipz` in `folder`, without a terminal: plain text, 100 columns.
pub(crate) fn lipz<S: AsRef<std::ffi::OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = S>) -> Outcome {
    let output = Command::new(env!("CARGO_BIN_EXE_lipz"))
        .args(arguments)
        .current_dir(folder)
        .env_remove("CLICOLOR_FORCE")
        .env("NO_COLOR", "1")
        .output();
    Outcome::from(output.unwrap())
}

/// Returns the PATH for programs that call `lipz` by its name. The command is in the folder `bin` of the scene because
/// the path of this checkout may contain spaces.
#[cfg(unix)]
pub(crate) fn path_with_lipz(scene: &Scene) -> String {
    let bin = scene.path().join("bin");
    fs::create_dir_all(&bin).unwrap();
    if !bin.join("lipz").exists() {
        std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_lipz"), bin.join("lipz")).unwrap();
    }
    format!("{}:{}", bin.display(), std::env::var("PATH").unwrap())
}

/// Makes further runs of `lipz` interruptible. A process that was started in the background ignores interrupts, and one
/// that `nohup` started ignores hang-ups. Its children inherit this, but not the handlers that this process installs.
#[cfg(unix)]
pub(crate) fn make_interruptible() {
    use signal_hook::consts::{SIGHUP, SIGINT};
    use signal_hook::flag;
    use std::sync::{Arc, Once};
    static HANDLER: Once = Once::new();
    HANDLER.call_once(|| {
        for signal in [SIGHUP, SIGINT] {
            flag::register_conditional_shutdown(signal, 1, Arc::new(true.into())).unwrap();
        }
    });
}

/// Runs `lipz` in `folder` with `input` on standard input.
pub(crate) fn with_input(folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lipz"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that refuses its input does not read all of it.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

/// Whether expected files are written instead of compared.
pub(crate) fn is_blessing() -> bool {
    std::env::var_os("LIPZ_BLESS").is_some_and(|value| value == "1")
}

/// Collects differences, so that one run shows the differences of all fixtures.
#[derive(Default)]
pub(crate) struct Comparison {
    differences: Vec<String>,
    compared: usize,
}

impl Comparison {
    /// Compares `actual` with the file at `path` below the repository; with `LIPZ_BLESS=1`, writes
    /// the file instead.
    pub(crate) fn compare(&mut self, path: &str, actual: &str) {
        self.compared += 1;
        let file = repository().join(path);
        if is_blessing() {
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(&file, actual).unwrap();
            return;
        }
        let Ok(expected) = fs::read_to_string(&file) else {
            self.differences.push(format!("{path} does not exist; the command printed:\n{actual}"));
            return;
        };
        if expected != actual {
            let diff = TextDiff::from_lines(expected.as_str(), actual);
            self.differences.push(diff.unified_diff().context_radius(4).header(path, "printed now").to_string());
        }
    }

    /// Fails with all differences. `at_least` guards against comparing nothing.
    pub(crate) fn finish(self, at_least: usize) {
        let count = self.differences.len();
        assert!(
            count == 0,
            "{count} of {} outputs differ:\n\n{}\nRead them; if they are right, run `LIPZ_BLESS=1 cargo test -p lipz`.",
            self.compared,
            self.differences.join("\n")
        );
        assert!(self.compared >= at_least, "only {} outputs were compared, not {at_least}", self.compared);
    }
}

/// Returns the files with this extension in a folder of the repository, without subfolders, as sorted paths relative to
/// the repository.
pub(crate) fn files(folder: &str, extension: &str) -> Vec<String> {
    let mut files: Vec<String> = fs::read_dir(repository().join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| Path::new(name).extension().is_some_and(|found| found == extension))
        .map(|name| format!("{folder}/{name}"))
        .collect();
    files.sort();
    files
}

/// Writes a file below `folder`, and creates missing folders.
pub(crate) fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, bytes).unwrap();
}

/// Returns everything below `folder` as sorted paths, for checks that nothing was written or left behind.
pub(crate) fn tree(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            found.push(path.strip_prefix(folder).unwrap().to_string_lossy().replace('\\', "/"));
            if path.is_dir() && !path.is_symlink() {
                open.push(path);
            }
        }
    }
    found.sort();
    found
}

/// A temporary folder in which a test creates inputs that cannot be in the repository.
pub(crate) struct Scene {
    folder: tempfile::TempDir,
    comparison: Comparison,
}

impl Scene {
    pub(crate) fn new() -> Scene {
        Scene { folder: tempfile::tempdir().unwrap(), comparison: Comparison::default() }
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file below the folder.
    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        write(self.path(), name, bytes);
    }

    /// Runs a command that must succeed.
    pub(crate) fn prepare(&self, arguments: &[&str]) {
        let outcome = lipz(self.path(), arguments);
        assert_eq!(outcome.code, 0, "{arguments:?}: {}", outcome.stderr);
    }

    /// Runs a command in the folder and compares its output with `fixtures/bad/generated/NAME.expected`. The folder has
    /// a different name in every run, so that a message with this name or the random name of a temporary file differs.
    pub(crate) fn expect(&mut self, name: &str, arguments: &[&str]) {
        let outcome = lipz(self.path(), arguments);
        self.expect_outcome(name, &outcome);
    }

    /// The same for a run that was started differently.
    pub(crate) fn expect_outcome(&mut self, name: &str, outcome: &Outcome) {
        assert_eq!(outcome.stdout, "", "{name}");
        self.comparison.compare(&format!("fixtures/bad/generated/{name}.expected"), &outcome.expectation());
    }

    /// Fails with all differences.
    pub(crate) fn finish(self, at_least: usize) {
        self.comparison.finish(at_least);
    }
}
