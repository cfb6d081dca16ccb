//! The task of a run, and the origin of its bank.

use crate::project::Options;
use crate::run::compile::Progress;
use crate::sources::Input;

/// The origin of a bank.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum BankOrigin {
    /// The old bank.
    Unchanged,
    /// The old bank with some new clips in it: see [`patch`](super::patch).
    Patched,
    /// Made from all clips, and not yet verified.
    New,
}

/// The input of a run.
pub(super) struct Task<'t> {
    pub(super) inputs: &'t [Input],
    pub(super) options: &'t Options,
    pub(super) progress: &'t Progress<'t>,
    /// Numbers of the inputs whose files may have changed since the previous run, if that is known. No other file is
    /// examined.
    pub(super) changed: Option<&'t [usize]>,
}
