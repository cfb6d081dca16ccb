//! `lipz pack --over`: a layer on top of other banks.

use super::PackArguments;
use super::destination::Destination;
use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::split::Split;
use crate::shared::stdio;
use lipz_bank::Bank;
use lipz_compiler::{Stack, StackBelow};
use std::path::Path;

/// Returns the destination of the requested layer and the banks below it. Reports their problems.
pub(super) fn destination(
    arguments: &PackArguments,
    output: &Path,
    split: Split,
    reporter: &mut Reporter,
) -> Result<Destination, Abort> {
    if split.locales {
        let tip = "pack it with `--config split-locales=false`; to ship a new locale, run `lipz pack --config split-locales=true` \
                   without `--over`";
        return Err(reporter.usage("a patch cannot be split by locale", tip));
    }
    if split.voices {
        let tip = "pack the originals and each voice over their own banks with `--config split-voices=false` (docs/guides/patches.md)";
        return Err(reporter.usage("a patch cannot be split by voice", tip));
    }
    let is_printed = stdio::is_meant(output);
    if is_printed && arguments.depfile.is_some() {
        return Err(reporter.usage("a depfile needs an output file", "name a file with `--output`"));
    }
    if is_printed {
        stdio::refuse_terminal(reporter)?;
    }
    let named = DialogueFiles::open_banks(&arguments.over, reporter)?;
    if !is_printed {
        named.refuse_output(("the bank below", "the patch"), output, reporter)?;
    }
    if let Some(depfile) = &arguments.depfile {
        named.refuse_output(("the bank below", "the depfile"), depfile, reporter)?;
    }
    let files = named.verified(reporter)?;
    let dialogue = named.dialogue(&files, reporter)?;
    let stack = Stack::of(&named.name, &dialogue).map_err(|report| reporter.refuse(vec![report]))?;
    let over = StackBelow::new(stack).keep_others(arguments.keep_others);
    Ok(Destination::Layer((!is_printed).then(|| output.to_owned()), Box::new(over)))
}

/// Returns a summary of a layer's changes.
pub(super) fn summary(bank: &[u8]) -> String {
    let Ok(bank) = Bank::open(bank) else { return String::new() };
    let changed = console::counted(bank.clip_count(), "new or changed clip");
    let removed = bank.layer().map_or(0, |layer| layer.removed_clips().count());
    match removed {
        0 => changed,
        removed => format!("{changed} and {}", console::counted(removed, "removal")),
    }
}
