//! `lipz unpack`: a bank to source files.

use crate::args::Unpack;
use crate::bank_file::with_bank;
use crate::{Outcome, console, render};
use lipz::Code;
use lipz_bank::Bank;
use lipz_compiler::unpack;

pub(crate) fn run(arguments: &Unpack) -> Outcome {
    with_bank(&arguments.bank, |path, bank| unpack_into(path, bank, arguments))
}

fn unpack_into(path: &str, bank: &Bank<'_>, arguments: &Unpack) -> Outcome {
    let bar = console::progress_bar(bank.clip_count(), arguments.quiet);
    let unpacked = unpack(bank, &arguments.output, arguments.force, &|count| bar.inc(count));
    bar.finish_and_clear();
    match unpacked {
        Ok(unpacked) => {
            if arguments.quiet {
                return Outcome::Clean;
            }
            let form = if unpacked.is_exact { "" } else { " (display forms: the bank was stripped)" };
            let files = console::counted(unpacked.files, "file");
            console::print(&format!("{files} unpacked into {}{form}\n", console::path(&arguments.output)))
        }
        Err(mut reports) => {
            for report in &mut reports {
                if report.source.path.is_empty() {
                    path.clone_into(&mut report.source.path);
                }
            }
            render::findings(&reports);
            let failed =
                reports.iter().flat_map(|report| &report.diagnostics).any(|found| found.code == Code::OutputFailed);
            if failed { Outcome::Failed } else { Outcome::Findings }
        }
    }
}
