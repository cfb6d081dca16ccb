//! The recipes for continuous integration, run with the finished packages: GitHub, GitLab and pre-commit.

use super::commands::{output, printed};
use crate::Failure;
use crate::dist::Packages;
use crate::dist::build::tool;
use crate::dist::contents::read;
use crate::dist::wheel::VERSION;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// The recipes.
const FOLDER: &str = "packages/ci";

/// A Lipz file without problems, and one with a warning.
const GOOD: &str = "{\n  \"visemes\" :     \"MAAAEO----\",\n  \"text_en-us\" :  \"Mayor?\",\n  \"viseme_type\" : \"blair\",\n  \"fps\" :         24\n}\n";
const BAD: &str = "{\n  \"visemes\" :     \"MAAAEO----|MAA\",\n  \"text_en-us\" :  \"Mayor?\",\n  \"viseme_type\" : \"blair\",\n  \"fps\" :         24\n}\n";

/// Writes a project with both files, and returns the paths of the good and of the bad file.
fn project(folder: &Path) -> Result<[PathBuf; 2], Failure> {
    let files = [("good.lipz", GOOD), ("bad.lipz", BAD)].map(|(name, text)| (folder.join(name), text));
    fs::create_dir_all(folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    let settings = (folder.join("lipz.toml"), "sources = [\".\"]\n");
    for (path, text) in files.iter().chain([&settings]) {
        fs::write(path, text).map_err(|error| format!("`{}`: {error}", path.display()))?;
    }
    Ok(files.map(|(path, _)| path))
}

/// Fails with the output of a command that ended in an unexpected way.
fn unexpected(what: &str, output: &Output) -> Failure {
    let [printed, errors] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    format!("{what} ended with {}: {printed}{errors}", output.status)
}

/// A server of the archives on this machine, ended when dropped.
struct Server {
    process: Child,
    address: String,
}

impl Server {
    fn start(folder: &Path) -> Result<Server, Failure> {
        let mut python = Command::new("python3");
        python.args(["-u", "-m", "http.server", "--bind", "127.0.0.1", "--directory"]).arg(folder).arg("0");
        let mut process = python
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("python3 cannot be run: {error}"))?;
        let mut line = String::new();
        if let Some(printed) = process.stdout.take() {
            BufReader::new(printed).read_line(&mut line).map_err(|error| format!("http.server: {error}"))?;
        }
        // Serving HTTP on 127.0.0.1 port 8000 (http://127.0.0.1:8000/) ...
        let address = line.split_once("(").and_then(|(_, rest)| rest.split_once("/)")).map(|(address, _)| address);
        let server = |address: &str| Server { process, address: address.to_owned() };
        address.map(server).ok_or_else(|| format!("http.server printed `{line}`"))
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It has no state.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Runs the step of the action, with the published checksum, a right one and wrong ones.
pub(super) fn github(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    if !has_program("curl") {
        return skip("curl");
    }
    let [good, bad] = project(&folder.join("project"))?;
    let releases = folder.join("releases");
    let release = releases.join("download").join(format!("v{VERSION}"));
    fs::create_dir_all(&release).map_err(|error| format!("`{}`: {error}", release.display()))?;
    let name = packages.archive.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let sum = format!("{name}.sha256");
    let line = read(&packages.archive.with_file_name(&sum))?;
    let copy = |bytes: &[u8], name: &str| {
        fs::write(release.join(name), bytes).map_err(|error| format!("`{}`: {error}", release.display()))
    };
    copy(&read(&packages.archive)?, &name)?;
    copy(&line, &sum)?;
    let server = Server::start(&releases)?;
    let path = folder.join("path");
    let step = |arguments: &str, checksum: &str| {
        let mut run = Command::new(workspace_root().join(FOLDER).join("github-action/run.sh"));
        run.env("RUNNER_OS", "Linux").env("RUNNER_ARCH", "X64").env("RUNNER_TEMP", folder).env("GITHUB_PATH", &path);
        run.env("LIPZ_VERSION", VERSION).env("LIPZ_ARGS", arguments).env("LIPZ_CHECKSUM", checksum);
        output(run.env("LIPZ_RELEASES", &server.address).current_dir(folder.join("project")))
    };
    let check = |file: &Path| format!("check --output-format github {}", file.display());
    let right = String::from_utf8_lossy(&line).split(' ').next().unwrap_or_default().to_owned();
    for (arguments, checksum, code, expected) in [
        (String::new(), "", 0, ""),
        (check(&good), &*right, 0, ""),
        (check(&bad), "", 1, "::error "),
        (check(&good), &"0".repeat(64), 1, "and not 0000"),
    ] {
        let output = step(&arguments, checksum)?;
        if output.status.code() != Some(code) || !String::from_utf8_lossy(&output.stdout).contains(expected) {
            return Err(unexpected(&format!("the action with `{arguments}` and checksum `{checksum}`"), &output));
        }
    }
    if !String::from_utf8_lossy(&read(&path)?).contains(&name.replace(".tar.gz", "")) {
        return Err("the action does not put lipz on the PATH".to_owned());
    }
    // The published checksum does not fit, either.
    copy(line.to_ascii_uppercase().as_slice(), &sum)?;
    let output = step("", "")?;
    if output.status.code() != Some(1) {
        return Err(unexpected("the action with a wrong published checksum", &output));
    }
    println!("GitHub action: checks files, and rejects wrong checksums");
    Ok(())
}

/// Runs the command of the recipe for GitLab with an installed program.
pub(super) fn gitlab(program: &Path, folder: &Path) -> Result<(), Failure> {
    let recipe =
        String::from_utf8_lossy(&read(&workspace_root().join(FOLDER).join("gitlab/lipz.gitlab-ci.yml"))?).into_owned();
    let page =
        String::from_utf8_lossy(&read(&workspace_root().join("docs/guides/continuous-integration.md"))?).into_owned();
    let lines = || recipe.lines().filter_map(|line| line.trim().strip_prefix("- "));
    let Some(line) = lines().find(|line| line.starts_with("lipz ")) else {
        return Err("the recipe for GitLab does not run lipz".to_owned());
    };
    if !lines().any(|line| line.ends_with(&format!("lipz=={VERSION}"))) || !lines().all(|line| page.contains(line)) {
        return Err("the recipe for GitLab is for a different version, or differs from the page".to_owned());
    }
    project(folder)?;
    let folders = program.parent().into_iter().map(Path::to_owned).chain([PathBuf::from("/usr/bin"), "/bin".into()]);
    let path = std::env::join_paths(folders).map_err(|error| error.to_string())?;
    let output = output(Command::new("sh").args(["-c", line]).env("PATH", path).current_dir(folder))?;
    let report: serde_json::Value = serde_json::from_slice(&read(&folder.join("gl-code-quality-report.json"))?)
        .map_err(|error| format!("the report for GitLab: {error}"))?;
    let file = report[0]["location"]["path"].as_str().unwrap_or_default();
    if output.status.code() != Some(1) || !file.ends_with("bad.lipz") {
        return Err(unexpected(&format!("`{line}`, which reports `{report}`,"), &output));
    }
    println!("GitLab: the report names {file}");
    Ok(())
}

/// Runs the hooks of pre-commit in a repository with a good and a bad file. Installs the wheel, and setuptools from
/// the network.
pub(super) fn pre_commit(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    let Some(pre_commit) = tool("pre-commit") else {
        return skip("pre-commit: `.ci/install --all`");
    };
    let (hooks, work) = (folder.join("hooks"), folder.join("work"));
    fs::create_dir_all(&hooks).map_err(|error| format!("`{}`: {error}", hooks.display()))?;
    for name in [".pre-commit-hooks.yaml", "pyproject.toml"] {
        let text = read(&workspace_root().join(FOLDER).join("pre-commit").join(name))?;
        fs::write(hooks.join(name), text).map_err(|error| format!("`{name}`: {error}"))?;
    }
    let [good, bad] = project(&work)?;
    for repository in [&hooks, &work] {
        for arguments in [
            &["init", "--quiet"][..],
            &["add", "."],
            &["-c", "user.name=lipz", "-c", "user.email=lipz@example.com", "commit", "--quiet", "-m", "hooks"],
        ] {
            printed(Command::new("git").args(arguments).current_dir(repository))?;
        }
    }
    let packages = packages.wheel.parent().unwrap_or(Path::new("."));
    for (hook, file, is_passed) in [("lipz-check", &good, true), ("lipz-check", &bad, false), ("lipz-fmt", &good, true)]
    {
        let mut run = Command::new(&pre_commit);
        run.arg("try-repo").arg(&hooks).arg(hook).arg("--verbose").arg("--files").arg(file).current_dir(&work);
        run.env("PIP_FIND_LINKS", packages).env("PRE_COMMIT_HOME", folder.join("cache"));
        let output = output(&mut run)?;
        let printed = String::from_utf8_lossy(&output.stdout);
        if output.status.success() != is_passed || (!is_passed && !printed.contains("bad.lipz:")) {
            return Err(unexpected(&format!("the hook {hook} for {}", file.display()), &output));
        }
    }
    println!("pre-commit: lipz-check passes the good file and fails the bad one");
    Ok(())
}
