//! The elements that are results of a recording, and that only fit each other.

use super::elements::{ElementVersions, is_same};

/// These elements.
const NAMES: [&str; 4] = ["visemes", "viseme_type", "fps", crate::phones::ELEMENT];

/// The changes of both sides to these elements.
pub(super) struct Changes {
    /// Whether each side has changed some of them, so that the changes may not fit each other.
    is_conflict: bool,
}

impl Changes {
    pub(super) fn of<'d, 's: 'd>(versions: impl Fn(&str) -> ElementVersions<'d, 's>) -> Changes {
        let all = NAMES.map(|name| (name, versions(name)));
        // Two sides that agree have not changed anything that the merge has to decide.
        let differs = || all.iter().filter(|(_, of)| !is_same(of.ours, of.theirs));
        let ours = differs().any(|(_, of)| of.is_changed_by_us());
        let theirs = differs().any(|(_, of)| of.is_changed_by_them());
        // Visemes that were corrected by hand can be merged by segment.
        let is_only_visemes = differs().all(|(name, _)| *name == "visemes");
        Changes { is_conflict: ours && theirs && !is_only_visemes }
    }

    pub(super) fn is_conflict(&self, name: &str) -> bool {
        self.is_conflict && NAMES.contains(&name)
    }
}
