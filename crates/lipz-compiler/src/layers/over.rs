//! Packing over a stack.

use super::between::between;
use super::content::Records;
use super::keep::Kept;
use super::stack::Stack;
use crate::compile::{Run, verify};
use crate::{Compiled, Compiler, Input, Options};
use lipz_bank::{Bank, Dialogue};
use lipz_diagnostics::{Code, Diagnostic, Report};

/// What a layer is packed over, and what becomes of clips that its sources do not have.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Over {
    stack: Stack,
    keeps_others: bool,
}

impl Over {
    /// A layer over `stack` whose sources are all of the dialogue: the clips that they do not have are removed. A patch.
    pub fn new(stack: Stack) -> Over {
        Over { stack, keeps_others: false }
    }

    /// Leaves clips that the sources do not have as they are below: for sources that are only an addition, such as those
    /// of a mod.
    #[must_use]
    pub fn keep_others(self, keeps_others: bool) -> Over {
        Over { keeps_others, ..self }
    }
}

impl Compiler<'_> {
    /// Checks `inputs` and makes a layer of them: it has what is new or changed, and says what is removed. Over its stack,
    /// it answers as the bank of `inputs` would; with [`Over::keep_others`], as that of `inputs` and of the clips below.
    ///
    /// A layer that changes nothing is an error (LZ2101), because whoever packs one expects a change. Over a bank without
    /// source records, a layer has none, either.
    pub fn compile_over(&self, inputs: &[Input], over: &Over) -> Compiled {
        self.run(|options| {
            if over.stack.checksums.len() > Dialogue::MAX_PATCHES {
                let message =
                    format!("there are {} layers already, and a program takes no more", Dialogue::MAX_PATCHES);
                let diagnostic = Diagnostic::new(Code::LayerMisfit, message);
                let help = "make one bank of some of them with `lipz merge`, or pack over the base alone";
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
                && let Err(report) = Kept::add_options(&old, &mut options)
            {
                return Compiled::refused(report);
            }
            let mut run = Run::read(inputs, &options, None, &self.progress);
            if over.keeps_others {
                run.keep(Kept::new(&old, inputs));
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

/// The layer that makes `whole` of the stack, or the report that there is nothing to do.
fn layer(
    old: &Bank<'_>,
    whole: &[u8],
    over: &Over,
    options: &Options,
) -> Result<(Option<Vec<u8>>, Option<Report>), Report> {
    let new = Bank::open(whole).and_then(Bank::verify);
    let new = new.map_err(|error| Report::failure("", Code::BankDamaged, error.kind().message(), "pack it again"))?;
    if let Some(layer) = between(old, &new, &over.stack.checksums)? {
        verify(&layer)?;
        return Ok((Some(layer), None));
    }
    let message = "the sources say just what the banks below say: a layer would change nothing";
    let diagnostic = Diagnostic::new(Code::LayerWithoutChange, message);
    let diagnostic =
        diagnostic.note("nothing was written").help("change the sources, or name the bank before the change");
    Err(report(diagnostic, options))
}

/// The report that a layer has no source records.
fn stripped(options: &Options) -> Report {
    let message = "the layer gets no source section: the bank below it has none";
    let diagnostic = Diagnostic::new(Code::LayerStripped, message);
    report(
        diagnostic.help("pack the base without `--strip` and `--split-locales`, or this layer with `--strip`"),
        options,
    )
}

/// A report about the layer, as the project has its levels.
fn report(diagnostic: Diagnostic, options: &Options) -> Report {
    let mut report = Report::about("", diagnostic);
    options.levels.apply(&mut report.diagnostics);
    report
}
