//! The wings of crates, lowest first, and the exceptions to their order.

/// A crate with wings, which are the modules that its `lib.rs` declares.
pub(super) struct Floor {
    /// The name of the crate.
    pub(super) name: &'static str,
    /// Its wings, lowest first. A wing may import those below it.
    pub(super) wings: &'static [&'static str],
    /// Imports against the order.
    pub(super) exceptions: &'static [Exception],
}

/// An import against the order of the wings.
pub(super) struct Exception {
    /// The importing file, below `src`.
    pub(super) from: &'static str,
    /// The imported file.
    pub(super) to: &'static str,
    /// The reason to keep it.
    pub(super) reason: &'static str,
}

/// The maximal number of exceptions in a crate.
pub(super) const MOST_EXCEPTIONS: usize = 6;

/// The maximal number of files that import each other in a circle.
pub(super) const LARGEST_CIRCLE: usize = 3;

pub(super) const FLOORS: &[Floor] = &[
    Floor {
        name: "lipz-compiler",
        wings: &[
            "util", "files", "sources", "project", "clip", "locales", "check", "bank", "run", "views", "edit", "build",
        ],
        exceptions: &[],
    },
    Floor {
        name: "lipz-sync",
        wings: &["threads", "recordings", "record", "job", "lints", "train", "shard"],
        exceptions: &[],
    },
    Floor {
        name: "lipz-texts",
        wings: &["exchange", "formats", "merge", "record", "lint", "progress"],
        exceptions: &[],
    },
];
