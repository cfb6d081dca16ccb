//! `lipz check --baseline`: a file with the existing diagnostics of a project, which are not reported again.

use crate::Abort;
use crate::console::{self, counted};
use crate::reporter::Reporter;
use crate::shared::input_file;
use crate::shared::inputs::RunResult;
use crate::shared::output_file;
use crate::shared::text_record::from_root;
use clap::Args;
use lipz_diagnostics::{Baseline, Report, reports};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{env, io};

/// The options of the baseline.
#[derive(Args, Debug)]
pub(super) struct BaselineFlags {
    /// Hide the diagnostics recorded in FILE, and report only new ones
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,

    /// Record the current diagnostics in the file of --baseline
    #[arg(long, requires = "baseline")]
    write_baseline: bool,
}

impl BaselineFlags {
    /// Removes the diagnostics of the baseline from the reports of a run and adds problems of the baseline file; or
    /// writes the baseline. Returns a line for people about the result.
    pub(super) fn apply(&self, run: &mut RunResult<'_>, reporter: &mut Reporter) -> Result<String, Abort> {
        let Some(file) = &self.baseline else { return Ok(String::new()) };
        output_file::refuse_source(file, reporter)?;
        let text = match input_file::read_text(file) {
            Ok(text) => text,
            Err(error) if self.write_baseline && error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(reporter.fail(input_file::unreadable(file, &error))),
        };
        let names = BaselinePaths::new(file);
        let inputs: BTreeSet<String> = run.inputs.iter().map(|input| names.of(&input.name())).collect();
        let name = |path: &str| names.of(path);
        // A deleted file has no diagnostics either.
        let is_checked = |path: &str| inputs.contains(path) || !names.folder.join(path).exists();
        let (known, faults) = Baseline::parse(&text);
        let shown = console::path(file);
        if self.write_baseline {
            if !text.is_empty() && known == Baseline::default() && !faults.is_empty() {
                // It is not a baseline file.
                return Err(reporter.refuse(vec![Report::from_bytes(shown, text.as_bytes(), faults)]));
            }
            let mut written = Baseline::from_reports(&run.reports, name);
            written.keep(&known, |path| !is_checked(path));
            output_file::write(file, written.to_string().as_bytes(), reporter)?;
            written.pass_over(&mut run.reports, name);
            reports::sort(&mut run.reports);
            return Ok(format!("{} recorded in {shown}\n", counted(written.count(), "known diagnostic")));
        }
        let mut about = faults;
        about.extend(known.left_over(&run.reports, name, is_checked));
        let passed = known.pass_over(&mut run.reports, name);
        run.reports.push(Report::from_bytes(shown.clone(), text.as_bytes(), about));
        reports::sort(&mut run.reports);
        Ok(format!("{} hidden by {shown}\n", counted(passed, "known diagnostic")))
    }
}

/// File names in a baseline: paths relative to its folder, with `/`, regardless of the working directory.
struct BaselinePaths {
    current: PathBuf,
    folder: PathBuf,
}

impl BaselinePaths {
    fn new(baseline: &Path) -> BaselinePaths {
        let current = env::current_dir().unwrap_or_default();
        let mut folder = from_root(&current, baseline);
        folder.pop();
        BaselinePaths { current, folder }
    }

    /// Returns the name for the file at a path.
    fn of(&self, path: &str) -> String {
        let path = from_root(&self.current, Path::new(path));
        let below = path.strip_prefix(&self.folder).unwrap_or(&path);
        let parts = below.components().map(|part| part.as_os_str().to_string_lossy());
        let name = parts.collect::<Vec<_>>().join("/");
        if name.is_empty() { ".".to_owned() } else { name }
    }
}
