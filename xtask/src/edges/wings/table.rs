//! The wings of crates, lowest first.

/// A crate with wings, which are the modules that its `lib.rs` declares.
pub(super) struct Floor {
    /// The name of the crate.
    pub(super) name: &'static str,
    /// Its wings, lowest first. A wing may import those below it.
    pub(super) wings: &'static [&'static str],
}

/// The maximal number of files that import each other in a circle.
pub(super) const LARGEST_CIRCLE: usize = 3;

pub(super) const FLOORS: &[Floor] = &[
    Floor {
        name: "lipz-compiler",
        wings: &[
            "util", "files", "sources", "project", "clip", "locales", "check", "bank", "run", "views", "edit", "build",
        ],
    },
    Floor { name: "lipz-sync", wings: &["threads", "recordings", "record", "job", "lints", "train", "shard"] },
    Floor {
        name: "lipz-texts",
        wings: &["plural", "exchange", "formats", "merge", "record", "lint", "progress", "script"],
    },
];
