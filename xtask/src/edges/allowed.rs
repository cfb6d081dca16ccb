//! The allow-lists: what each crate of the workspace may depend on.
//!
//! A new name here is a decision. The reader goes into games and firmware, so each crate below it
//! is code that somebody else must audit; `lipz` is a library for other tools; the compiler runs in
//! build scripts, where every crate costs every user build time.

/// What one crate may depend on. `None` is anything.
pub(super) struct Rule {
    pub(super) name: &'static str,
    /// Crates that its manifest may name, outside of tests.
    pub(super) direct: Option<&'static [&'static str]>,
    /// Crates that may be below it: the lists together.
    pub(super) transitive: Option<&'static [&'static [&'static str]]>,
}

pub(super) const ALLOWED: &[Rule] = &[
    Rule { name: "lipz-types", direct: Some(&[]), transitive: Some(&[]) },
    Rule {
        name: "lipz-layout",
        direct: Some(&["lipz-types", "zerocopy"]),
        transitive: Some(&[ZEROCOPY, &["lipz-types"]]),
    },
    Rule {
        name: "lipz-bank",
        direct: Some(&["lipz-layout", "lipz-types", "zerocopy"]),
        transitive: Some(&[ZEROCOPY, READER]),
    },
    // Shown to people by default; what programs read is a feature.
    Rule {
        name: "lipz-diagnostics",
        direct: Some(&["annotate-snippets", "percent-encoding", "serde", "serde_json", "strsim"]),
        transitive: Some(&[&["annotate-snippets", "anstyle", "memchr", "strsim", "unicode-width"]]),
    },
    Rule {
        name: "lipz-file",
        direct: Some(&[
            "icu_locale_core",
            "isolang",
            "lipz-diagnostics",
            "lipz-types",
            "memchr",
            "rust_iso3166",
            "serde",
            "serde_json",
            "simdutf8",
            "unicode-segmentation",
            "unicode-width",
        ]),
        transitive: Some(&[LIPZ_FILES, MACROS, &["lipz-diagnostics", "lipz-types"]]),
    },
    Rule {
        name: "lipz-compiler",
        direct: Some(&[
            "bincode",
            "cap-std",
            "cap-tempfile",
            "foldhash",
            "glob",
            "icu_casemap",
            "icu_locale",
            "lipz-bank",
            "lipz-diagnostics",
            "lipz-file",
            "lipz-layout",
            "lipz-types",
            "memchr",
            "rayon",
            "rustix",
            "serde_json",
            "simdutf8",
            "tempfile",
            "toml",
            "twox-hash",
            "unicode-ident",
            "unicode-normalization",
            "unicode-width",
            "walkdir",
            "zerocopy",
        ]),
        transitive: Some(&[
            ZEROCOPY,
            READER,
            LIPZ_FILES,
            UNICODE_DATA,
            FILES,
            TOML,
            CACHE,
            &["foldhash", "lipz-diagnostics", "lipz-file", "unicode-normalization", "tinyvec"],
        ]),
    },
    Rule {
        name: "lipz-host",
        direct: Some(&["lipz-bank", "memmap2", "self_cell"]),
        transitive: Some(&[ZEROCOPY, READER, &["libc", "memmap2", "self_cell"]]),
    },
    Rule { name: "lipz-capi", direct: Some(&["lipz-bank"]), transitive: Some(&[ZEROCOPY, READER]) },
    Rule {
        name: "lipz-interop",
        direct: Some(&[
            "csv",
            "encoding_rs",
            "hound",
            "lipz-diagnostics",
            "lipz-file",
            "lipz-types",
            "roxmltree",
            "serde",
            "serde_json",
            "toml",
            "unicode-segmentation",
        ]),
        transitive: Some(&[
            LIPZ_FILES,
            MACROS,
            TOML,
            &[
                "cfg-if",
                "csv",
                "csv-core",
                "encoding_rs",
                "hound",
                "lipz-diagnostics",
                "lipz-file",
                "lipz-types",
                "roxmltree",
                "ryu",
            ],
        ]),
    },
    // What a game carries; its build script uses the compiler.
    Rule {
        name: "dialogue-player",
        direct: Some(&["lipz-bank", "lipz-compiler"]),
        transitive: Some(&[ZEROCOPY, READER]),
    },
    // The ends of the graph: no crate has to carry what these use.
    Rule { name: "lipz-benches", direct: None, transitive: None },
    Rule { name: "lipz-testkit", direct: None, transitive: None },
    Rule { name: "lipz", direct: None, transitive: None },
    Rule { name: "xtask", direct: None, transitive: None },
];

/// Crates that talk to a person or a terminal: not for libraries.
pub(super) const COMMAND_LINE_ONLY: &[&str] = &["anstream", "clap", "indicatif"];

/// Who may depend on them.
pub(super) const COMMAND_LINE_USERS: &[&str] = &["lipz", "lipz-benches", "xtask"];

/// zerocopy and its derive, which runs while compiling.
const ZEROCOPY: &[&str] = &["zerocopy", "zerocopy-derive", "proc-macro2", "quote", "syn", "unicode-ident"];

/// What procedural macros use.
const MACROS: &[&str] = &["proc-macro2", "quote", "syn", "unicode-ident"];

/// The reader itself, and what it is built on.
const READER: &[&str] = &["lipz-bank", "lipz-layout", "lipz-types"];

/// serde_json, icu_locale_core, isolang, rust_iso3166 and what they use; strsim for suggestions.
const LIPZ_FILES: &[&str] = &[
    "displaydoc",
    "fastrand",
    "icu_locale_core",
    "isolang",
    "itoa",
    "litemap",
    "memchr",
    "phf",
    "phf_generator",
    "phf_macros",
    "phf_shared",
    "rust_iso3166",
    "serde",
    "serde_core",
    "serde_derive",
    "serde_json",
    "simdutf8",
    "siphasher",
    "strsim",
    "tinystr",
    "unicode-segmentation",
    "unicode-width",
    "writeable",
    "zmij",
];

/// icu_casemap, icu_locale and what they use.
const UNICODE_DATA: &[&str] = &[
    "icu_casemap",
    "icu_casemap_data",
    "icu_collections",
    "icu_locale",
    "icu_locale_data",
    "icu_locale_fallback",
    "icu_locale_fallback_data",
    "icu_properties",
    "icu_properties_data",
    "icu_provider",
    "potential_utf",
    "stable_deref_trait",
    "synstructure",
    "utf8_iter",
    "yoke",
    "yoke-derive",
    "zerofrom",
    "zerofrom-derive",
    "zerotrie",
    "zerovec",
    "zerovec-derive",
];

/// toml and what it uses.
const TOML: &[&str] = &["serde_spanned", "toml", "toml_datetime", "toml_parser", "winnow"];

/// bincode and twox-hash, which only the cache of the compiler uses, and what they use.
const CACHE: &[&str] = &["bincode", "bincode_derive", "twox-hash", "unty", "virtue"];

/// Finding, reading and writing files, on several threads: cap-std, cap-tempfile, glob, rayon,
/// tempfile, walkdir and what they use.
const FILES: &[&str] = &[
    "ambient-authority",
    "bitflags",
    "cap-primitives",
    "cap-std",
    "cap-tempfile",
    "cfg-if",
    "crossbeam-deque",
    "crossbeam-epoch",
    "crossbeam-utils",
    "either",
    "fs-set-times",
    "getrandom",
    "glob",
    "io-extras",
    "io-lifetimes",
    "ipnet",
    "libc",
    "linux-raw-sys",
    "maybe-owned",
    "once_cell",
    "rayon",
    "rayon-core",
    "rustix",
    "rustix-linux-procfs",
    "same-file",
    "tempfile",
    "uuid",
    "walkdir",
];
