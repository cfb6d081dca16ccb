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
    Rule { name: "lipz-bank", direct: Some(&["zerocopy"]), transitive: Some(&[READER]) },
    Rule {
        name: "lipz",
        direct: Some(&[
            "icu_locale_core",
            "isolang",
            "lipz-bank",
            "memchr",
            "rust_iso3166",
            "serde",
            "serde_json",
            "simdutf8",
            "strsim",
            "unicode-segmentation",
            "unicode-width",
        ]),
        transitive: Some(&[READER, LIPZ_FILES, &["lipz-bank"]]),
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
            "lipz",
            "lipz-bank",
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
            READER,
            LIPZ_FILES,
            UNICODE_DATA,
            FILES,
            TOML,
            CACHE,
            &["foldhash", "lipz", "lipz-bank", "unicode-normalization", "tinyvec"],
        ]),
    },
    Rule {
        name: "lipz-host",
        direct: Some(&["lipz-bank", "memmap2", "self_cell"]),
        transitive: Some(&[READER, &["lipz-bank", "libc", "memmap2", "self_cell"]]),
    },
    Rule { name: "lipz-capi", direct: Some(&["lipz-bank"]), transitive: Some(&[READER, &["lipz-bank"]]) },
    Rule {
        name: "lipz-interop",
        direct: Some(&[
            "csv",
            "encoding_rs",
            "hound",
            "lipz",
            "roxmltree",
            "serde",
            "serde_json",
            "toml",
            "unicode-segmentation",
        ]),
        transitive: Some(&[
            READER,
            LIPZ_FILES,
            TOML,
            &["cfg-if", "csv", "csv-core", "encoding_rs", "hound", "lipz", "lipz-bank", "roxmltree", "ryu"],
        ]),
    },
    // What a game carries; its build script uses the compiler.
    Rule {
        name: "dialogue-player",
        direct: Some(&["lipz-bank", "lipz-compiler"]),
        transitive: Some(&[READER, &["lipz-bank"]]),
    },
    // The ends of the graph: no crate has to carry what these use.
    Rule { name: "lipz-benches", direct: None, transitive: None },
    Rule { name: "lipz-fuzz", direct: None, transitive: None },
    Rule { name: "lipz-cli", direct: None, transitive: None },
    Rule { name: "xtask", direct: None, transitive: None },
];

/// Crates that talk to a person or a terminal: not for libraries.
pub(super) const COMMAND_LINE_ONLY: &[&str] = &["annotate-snippets", "anstream", "clap", "indicatif"];

/// Who may depend on them.
pub(super) const COMMAND_LINE_USERS: &[&str] = &["lipz-cli", "xtask"];

/// zerocopy and its derive, which runs while compiling.
const READER: &[&str] = &["zerocopy", "zerocopy-derive", "proc-macro2", "quote", "syn", "unicode-ident"];

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
