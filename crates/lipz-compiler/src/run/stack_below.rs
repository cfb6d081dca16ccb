//! Packing on top of a stack.

use crate::bank::Stack;
use crate::bank::layers::{KeptClips, Records, between};
use crate::bank::verify::verify;
use crate::project::Options;
use crate::run::compile::CompileRun;
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use lipz_bank::{Bank, Dialogue};
use lipz_diagnostics::{Code, Diagnostic, Report};

/// The banks below a layer, and the treatment of clips that its sources lack.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StackBelow {
    stack: Stack,
    keeps_others: bool,
}

impl StackBelow {
    /// Creates a patch on top of `stack`, with sources of the whole dialogue: clips that they lack are removed.
    pub fn new(stack: Stack) -> StackBelow {
        StackBelow { stack, keeps_others: false }
    }

    /// Keeps clips that the sources lack as they are below, for sources that are only an addition, such as those of a
    /// mod.
    #[must_use]
    pub fn keep_others(self, keeps_others: bool) -> StackBelow {
        StackBelow { keeps_others, ..self }
    }
}

impl Compiler<'_> {
    /// Checks `inputs` and makes a layer from them, with new and changed clips and a list of removed ones. On top of
    /// its stack, it returns the same answers as the bank of `inputs`; with [`StackBelow::keep_others`], as that of `inputs`
    /// and the clips below.
    ///
    /// A layer that changes nothing is an error (LZ2101), because a change was expected. On top of a bank without
    /// source records, a layer has none either.
    pub fn compile_over(&self, inputs: &[Input], over: &StackBelow) -> Compiled {
        self.compile_in_pool(|options| {
            if over.stack.checksums.len() > Dialogue::MAX_PATCHES {
                let message = format!("the stack already has {} patches, which is the maximum", Dialogue::MAX_PATCHES);
                let diagnostic = Diagnostic::new(Code::LayerMisfit, message);
                let help = "merge some of them with `lipz merge`, or pack over the base alone";
                return Compiled::refused(Report::about("", diagnostic.help(help)));
            }
            let old = match Bank::open(&over.stack.whole).and_then(Bank::verify) {
                Ok(old) => old,
                Err(error) => {
                    return Compiled::refused(Report::failure("", Code::BankDamaged, error.kind().message(), ""));
                }
            };
            let mut options = options.clone();
            let mut reports = Vec::new();
            if Records::of(&old).are_stripped() && !options.strip {
                options.strip = true;
                reports.push(stripped(&options));
            }
            if over.keeps_others
                && let Err(report) = KeptClips::add_options(&old, &mut options)
            {
                return Compiled::refused(report);
            }
            let mut run = CompileRun::read(inputs, &options, None, &self.progress);
            if over.keeps_others {
                run.keep(KeptClips::new(&old, inputs));
            }
            let mut compiled = run.compare_dubs(inputs, &options).make(inputs, &options, verify);
            if let Some(whole) = compiled.bank.take() {
                match layer(&old, &whole, over, &options) {
                    Ok((bank, report)) => {
                        compiled.bank = bank;
                        reports.extend(report);
                    }
                    Err(report) => reports.push(report),
                }
            }
            compiled.reports.extend(reports.into_iter().filter(|report| !report.diagnostics.is_empty()));
            compiled
        })
    }
}

/// Returns the layer that turns the stack into `whole`, or the report that there are no changes.
fn layer(
    old: &Bank<'_>,
    whole: &[u8],
    over: &StackBelow,
    options: &Options,
) -> Result<(Option<Vec<u8>>, Option<Report>), Report> {
    let new = Bank::open(whole).and_then(Bank::verify);
    let new = new.map_err(|error| Report::failure("", Code::BankDamaged, error.kind().message(), "pack it again"))?;
    if let Some(layer) = between(old, &new, &over.stack.checksums)? {
        verify(&layer)?;
        return Ok((Some(layer), None));
    }
    let message = "the sources match the banks below, so a patch would change nothing";
    let diagnostic = Diagnostic::new(Code::LayerWithoutChange, message);
    let diagnostic =
        diagnostic.note("nothing was written").help("change the sources, or name the bank from before the change");
    Err(report(diagnostic, options))
}

/// Returns the report that a layer has no source records.
fn stripped(options: &Options) -> Report {
    let message = "the patch has no source section because the bank below it has none";
    let diagnostic = Diagnostic::new(Code::LayerStripped, message);
    report(
        diagnostic.help("pack the base without `--config strip=true` and `--config split-locales=true`, or this patch with `--config strip=true`"),
        options,
    )
}

/// Returns a report about the layer, at the project's levels.
fn report(diagnostic: Diagnostic, options: &Options) -> Report {
    let mut report = Report::about("", diagnostic);
    options.levels.apply(&mut report.diagnostics);
    report
}
