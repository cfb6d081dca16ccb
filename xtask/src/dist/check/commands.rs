//! The commands that every installed program must answer: its version, and a bank with known bytes.

use crate::Failure;
use crate::dist::contents::read;
use crate::dist::wheel::VERSION;
use crate::paths::workspace_root;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// Dialogue, the golden bank made from it, and the options as in fixtures/banks/README.md.
const DIALOGUE: &str = "fixtures/drama";
const BANK: &str = "fixtures/banks/v1/drama.lipzbank";
const OPTIONS: [&str; 4] = ["--config", "default-locale=en-us", "--config", "emotions.curves=values"];

/// How long an installation may take on an idle machine.
const MOST_TIME: Duration = Duration::from_secs(5);

/// Checks an installed program. `folder` is for its output.
pub(super) fn answers(name: &str, run: impl Fn() -> Command, folder: &Path) -> Result<(), Failure> {
    let version = printed(run().arg("--version"))?;
    if version.trim() != format!("lipz {VERSION}") {
        return Err(format!("{name}: the version is `{}`", version.trim()));
    }
    let bank = folder.join("packed.lipzbank");
    let mut pack = run();
    pack.args(["pack", DIALOGUE, "--output"]).arg(&bank).args(OPTIONS).current_dir(workspace_root());
    printed(&mut pack)?;
    if read(&bank)? != read(&workspace_root().join(BANK))? {
        return Err(format!("{name}: the bank of `{DIALOGUE}` is not `{BANK}`"));
    }
    println!("{name}: lipz {VERSION} packs `{DIALOGUE}` into the golden bank");
    Ok(())
}

/// Runs an installation, which must be quick.
pub(super) fn quickly(name: &str, install: &mut Command) -> Result<(), Failure> {
    let start = Instant::now();
    printed(install)?;
    let (time, most) = (start.elapsed(), MOST_TIME.mul_f64(processes_per_core()));
    println!("{name}: installed in {:.1} s", time.as_secs_f64());
    if time > most {
        return Err(format!("{name}: takes {:.1} s, and the limit is {:.1} s", time.as_secs_f64(), most.as_secs_f64()));
    }
    Ok(())
}

/// Returns how many processes share a core, at least 1: on a busy machine, an installation waits for the others.
fn processes_per_core() -> f64 {
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load: f64 = load.split(' ').next().and_then(|load| load.parse().ok()).unwrap_or(0.0);
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    f64::max(1.0, load / f64::from(u32::try_from(cores).unwrap_or(1)))
}

/// Returns the output of a command that must succeed.
pub(super) fn printed(command: &mut Command) -> Result<String, Failure> {
    let output = output(command)?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => {
            let [printed, errors] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
            Err(format!("{command:?} ended with {}: {printed}{errors}", output.status))
        }
    }
}

pub(super) fn output(command: &mut Command) -> Result<Output, Failure> {
    command.output().map_err(|error| format!("{command:?} cannot be run: {error}"))
}
