//! `lipz pack --over`: a layer over other banks.

use super::Pack;
use super::destination::{Destination, Split};
use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::stdio;
use lipz_bank::Bank;
use lipz_compiler::{Over, Stack};
use std::io::{self, IsTerminal};
use std::path::Path;

/// Where the layer goes that the arguments ask for, and what it lies over. Reports what is wrong with that.
pub(super) fn destination(
    arguments: &Pack,
    output: &Path,
    split: Split,
    reporter: &mut Reporter,
) -> Result<Destination, Abort> {
    if split.locales {
        let tip = "pack it with `--split-locales=false`; the texts of a locale that the shipped bank lacks are a download of \
                   their own: those of `lipz pack --split-locales` without `--over`";
        return Err(reporter.usage("a layer is not split by locale", tip));
    }
    if split.voices {
        let tip = "pack the originals and each voice over its own banks, with `--split-voices=false`: docs/guides/patches.md shows it";
        return Err(reporter.usage("a layer is not split by voice", tip));
    }
    let is_printed = stdio::is_meant(output);
    if is_printed && arguments.depfile.is_some() {
        return Err(reporter.usage("standard output has no name for a depfile", "name a file with `--output`"));
    }
    if is_printed && io::stdout().is_terminal() {
        return Err(reporter.usage("a bank is not for a terminal", "name a file, or send standard output to one"));
    }
    let named = DialogueFiles::open_all(&arguments.over, reporter)?;
    if !is_printed {
        named.refuse_output(("the bank below", "the layer"), output, reporter)?;
    }
    if let Some(depfile) = &arguments.depfile {
        named.refuse_output(("the bank below", "the depfile"), depfile, reporter)?;
    }
    let files = named.verified(reporter)?;
    let dialogue = named.dialogue(&files, reporter)?;
    let stack = Stack::of(&named.name, &dialogue).map_err(|report| reporter.refuse(vec![report]))?;
    let over = Over::new(stack).keep_others(arguments.keep_others);
    Ok(Destination::Layer((!is_printed).then(|| output.to_owned()), Box::new(over)))
}

/// What a layer changes.
pub(super) fn summary(bank: &[u8]) -> String {
    let Ok(bank) = Bank::open(bank) else { return String::new() };
    let changed = console::counted(bank.clip_count(), "new or changed clip");
    let removed = bank.layer().map_or(0, |layer| layer.removed_clips().count());
    match removed {
        0 => changed,
        removed => format!("{changed} and {}", console::counted(removed, "removal")),
    }
}
