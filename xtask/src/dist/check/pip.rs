//! The wheel: its metadata, and its installation into an empty environment.

use super::commands::{answers, printed, quickly};
use crate::Failure;
use crate::dist::Packages;
use crate::dist::build::tool;
use crate::tools::skip;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Checks the wheel with the tools of the registry.
pub(super) fn metadata(packages: &Packages) -> Result<(), Failure> {
    // Their pinned versions are for Linux. The release workflow checks the wheels of all systems.
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let (Some(twine), Some(auditwheel)) = (tool("twine"), tool("auditwheel")) else {
        return skip("twine and auditwheel: `.ci/install --all`");
    };
    print!("{}", printed(Command::new(twine).args(["check", "--strict"]).arg(&packages.wheel))?);
    if !packages.platform.is_linux() {
        return Ok(());
    }
    let shown = printed(Command::new(auditwheel).arg("show").arg(&packages.wheel))?;
    // Lines are wrapped anywhere.
    let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    let processor = packages.platform.target.split('-').next().unwrap_or_default();
    let fits = format!("is consistent with the following platform tag: \"manylinux_2_17_{processor}\"");
    if !shown.contains(&fits) {
        return Err(format!("auditwheel: {shown}"));
    }
    println!("auditwheel: {fits}");
    Ok(())
}

/// Installs the wheel into an empty environment, and runs the program and the module. Returns the path of the program.
pub(super) fn install(packages: &Packages, folder: &Path) -> Result<PathBuf, Failure> {
    printed(Command::new("python3").args(["-m", "venv"]).arg(folder))?;
    let programs = folder.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let in_environment = |name: &str| {
        let mut command = Command::new(programs.join(format!("{name}{}", std::env::consts::EXE_SUFFIX)));
        // Without Rust.
        command.env("PATH", &programs);
        command
    };
    let mut install = in_environment("python");
    // Without the network, so that the time is that of the installation.
    install.args(["-m", "pip", "install", "--quiet", "--no-index", "--disable-pip-version-check"]);
    quickly("pip", install.arg(&packages.wheel))?;
    answers("pip", || in_environment("lipz"), folder)?;
    let module = || {
        let mut command = in_environment("python");
        command.args(["-m", "lipz"]);
        command
    };
    answers("python -m lipz", module, folder)?;
    // The reader, and the mark that it has types.
    let imports = "import lipz.reader, pathlib; assert pathlib.Path(lipz.__file__).with_name('py.typed').is_file()";
    printed(in_environment("python").args(["-c", imports]))?;
    for file in ["man/man1/lipz.1", "bash-completion/completions/lipz"] {
        if !folder.join("share").join(file).is_file() {
            return Err(format!("the wheel does not install `share/{file}`"));
        }
    }
    Ok(programs.join(packages.platform.program()))
}
