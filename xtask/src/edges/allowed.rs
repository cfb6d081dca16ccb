//! The allowed dependencies of each crate of the workspace.
//!
//! A new name here is a decision. The reader goes into games and firmware, so every crate below it has to be audited by
//! its users: all of them are named. The other libraries run in build scripts, where every crate costs all users build
//! time. Their own dependencies are named, and all below these are counted.

/// The allowed dependencies of one crate, outside of its tests.
pub(super) struct Rule {
    pub(super) name: &'static str,
    /// Allowed crates in its manifest.
    pub(super) direct: &'static [&'static str],
    pub(super) below: Below,
}

/// The limit for crates below a crate, at any depth.
pub(super) enum Below {
    /// At most these, and zerocopy with its derive, which runs at compile time.
    Only(&'static [&'static str]),
    /// At most this many.
    AtMost(usize),
}

/// The crates on which nothing depends. They may use anything.
pub(super) const FREE: [&str; 4] = ["lipz", "lipz-benches", "lipz-testkit", "xtask"];

/// Crates for terminals, which libraries must not use.
pub(super) const COMMAND_LINE_ONLY: [&str; 3] = ["anstream", "clap", "indicatif"];

/// zerocopy and its derive.
pub(super) const ZEROCOPY: [&str; 6] = ["zerocopy", "zerocopy-derive", "proc-macro2", "quote", "syn", "unicode-ident"];

/// The reader and the crates below it.
const READER: &[&str] = &["lipz-bank", "lipz-layout", "lipz-types"];

pub(super) const RULES: &[Rule] = &[
    Rule { name: "lipz-types", direct: &[], below: Below::AtMost(0) },
    Rule { name: "lipz-layout", direct: &["lipz-types", "zerocopy"], below: Below::Only(&["lipz-types"]) },
    Rule { name: "lipz-bank", direct: &["lipz-layout", "lipz-types", "zerocopy"], below: Below::Only(READER) },
    Rule { name: "lipz-capi", direct: &["lipz-bank"], below: Below::Only(READER) },
    Rule {
        name: "lipz-host",
        direct: &["lipz-bank", "memmap2", "once_cell", "self_cell", "simdutf8"],
        below: Below::Only(&[
            "lipz-bank",
            "lipz-layout",
            "lipz-types",
            "libc",
            "memmap2",
            "once_cell",
            "self_cell",
            "simdutf8",
        ]),
    },
    Rule {
        name: "lipz-diagnostics",
        direct: &["annotate-snippets", "percent-encoding", "serde", "serde_json", "strsim"],
        below: Below::AtMost(5),
    },
    Rule {
        name: "lipz-file",
        direct: &[
            "lipz-diagnostics",
            "lipz-types",
            "memchr",
            "serde_core",
            "serde_json",
            "simdutf8",
            "unicode-segmentation",
            "unicode-width",
        ],
        below: Below::AtMost(12),
    },
    Rule {
        name: "lipz-compiler",
        direct: &[
            "anstyle",
            "bincode",
            "cap-std",
            "foldhash",
            "glob",
            "lipz-bank",
            "lipz-diagnostics",
            "lipz-file",
            "lipz-layout",
            "lipz-types",
            "memchr",
            "rayon",
            "rustix",
            "serde",
            "serde_json",
            "simdutf8",
            "tempfile",
            "textwrap",
            "toml",
            "twox-hash",
            "unicase",
            "unicode-ident",
            "unicode-normalization",
            "unicode-segmentation",
            "unicode-width",
            "walkdir",
            "zerocopy",
        ],
        below: Below::AtMost(32),
    },
    Rule {
        name: "lipz-interop",
        direct: &[
            "encoding_rs",
            "hound",
            "lipz-diagnostics",
            "lipz-file",
            "lipz-types",
            "roxmltree",
            "serde",
            "serde_json",
            "toml",
            "unicode-normalization",
            "unicode-segmentation",
        ],
        below: Below::AtMost(43),
    },
    Rule {
        name: "lipz-texts",
        direct: &[
            "csv",
            "encoding_rs",
            "icu_locale_core",
            "icu_plurals",
            "lipz-diagnostics",
            "lipz-file",
            "quick-xml",
            "read-fonts",
            "roxmltree",
            "rust_xlsxwriter",
            "serde",
            "serde_json",
            "sha2",
            "similar",
            "twox-hash",
            "unicode-normalization",
            "unicode-segmentation",
            "zip",
        ],
        below: Below::AtMost(63),
    },
    Rule {
        name: "lipz-speech",
        direct: &[
            "any_ascii",
            "half",
            "libm",
            "lipz-file",
            "lipz-types",
            "microfft",
            "symphonia",
            "twox-hash",
            "unicode-normalization",
            "unicode-segmentation",
            "wide",
        ],
        below: Below::AtMost(49),
    },
    Rule {
        name: "lipz-sync",
        direct: &[
            "lipz-bank",
            "lipz-compiler",
            "lipz-diagnostics",
            "lipz-file",
            "lipz-interop",
            "lipz-speech",
            "lipz-types",
            "serde",
            "serde_json",
            "twox-hash",
            "walkdir",
        ],
        below: Below::AtMost(110),
    },
    Rule {
        name: "lipz-lsp",
        direct: &[
            "crossbeam-channel",
            "lipz-compiler",
            "lipz-diagnostics",
            "lipz-file",
            "lipz-sync",
            "lipz-types",
            "lsp-server",
            "lsp-types",
            "ropey",
            "serde",
            "serde_json",
            "toml",
            "url",
        ],
        below: Below::AtMost(117),
    },
    // The crates in a game. Its build script uses the compiler.
    Rule { name: "dialogue-player", direct: &["lipz-bank", "lipz-compiler"], below: Below::Only(READER) },
    // Readers copy the examples, so these use only the crates that they demonstrate.
    Rule { name: "game-loop", direct: &["lipz-bank", "lipz-host"], below: Below::AtMost(14) },
    Rule {
        name: "hot-reload",
        direct: &["lipz-bank", "lipz-compiler", "lipz-host", "tempfile"],
        below: Below::AtMost(37),
    },
    Rule { name: "lip-sync-one-file", direct: &["lipz-speech"], below: Below::AtMost(50) },
    Rule { name: "bank-tool", direct: &["lipz-bank", "lipz-compiler", "lipz-host"], below: Below::AtMost(99) },
    Rule { name: "pack-in-memory", direct: &["lipz-bank", "lipz-compiler"], below: Below::AtMost(33) },
    Rule { name: "patch-and-text-bank", direct: &["lipz-host"], below: Below::AtMost(14) },
];
