//! The features of the command, with the crates that only they need.

/// A feature of the command.
pub(super) struct Feature {
    pub(super) name: &'static str,
    crates: &'static [&'static str],
}

/// Crates that are not in the list, or that several features need.
pub(super) const OTHER: &str = "shared and other";

pub(super) static FEATURES: [Feature; 8] = [
    Feature {
        name: "pack, check, inspect",
        crates: &[
            "lipz_bank",
            "lipz_compiler",
            "lipz_diagnostics",
            "lipz_file",
            "lipz_host",
            "lipz_layout",
            "lipz_types",
            "annotate_snippets",
            "bincode",
            "cap_std",
            "cap_primitives",
            "toml",
            "toml_parser",
            "walkdir",
            "winnow",
        ],
    },
    Feature {
        name: "command line",
        crates: &[
            "lipz",
            "anstream",
            "clap_builder",
            "clap_complete",
            "clap_mangen",
            "clap_lex",
            "indicatif",
            "console",
        ],
    },
    Feature {
        name: "lip sync",
        crates: &[
            "lipz_speech",
            "lipz_sync",
            "any_ascii",
            "libm",
            "microfft",
            "pinyin",
            "symphonia",
            "symphonia_bundle_flac",
            "symphonia_bundle_mp3",
            "symphonia_codec_adpcm",
            "symphonia_codec_pcm",
            "symphonia_codec_vorbis",
            "symphonia_common",
            "symphonia_core",
            "symphonia_format_ogg",
            "symphonia_format_riff",
            "symphonia_metadata",
        ],
    },
    Feature { name: "files of other tools", crates: &["lipz_interop", "roxmltree"] },
    Feature { name: "translators' files", crates: &["lipz_texts", "csv", "csv_core", "encoding_rs", "similar"] },
    Feature {
        name: "spreadsheets",
        crates: &["rust_xlsxwriter", "crc32fast", "flate2", "quick_xml", "zip", "zlib_rs", "zopfli"],
    },
    Feature {
        name: "editor server",
        crates: &["lipz_lsp", "icu_normalizer", "icu_properties", "idna", "lsp_server", "lsp_types", "ropey", "url"],
    },
    Feature { name: "preview and watch", crates: &["httparse", "jiff", "notify", "open", "pulldown_cmark"] },
];

/// Returns the feature that a crate belongs to.
pub(super) fn feature_of(name: &str) -> &'static str {
    FEATURES.iter().find(|feature| feature.crates.contains(&name)).map_or(OTHER, |feature| feature.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_is_a_dependency() {
        let lock = std::fs::read_to_string(crate::paths::workspace_root().join("Cargo.lock")).unwrap_or_default();
        for name in FEATURES.iter().flat_map(|feature| feature.crates) {
            let found = [name.to_string(), name.replace('_', "-")];
            assert!(found.iter().any(|name| lock.contains(&format!("\nname = \"{name}\"\n"))), "{name}");
        }
    }
}
