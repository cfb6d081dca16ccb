//! What several commands use: arguments in common, and the files that they are about.

pub(crate) mod audio_flags;
pub(crate) mod bank_file;
pub(crate) mod bank_or_sources;
pub(crate) mod characters;
pub(crate) mod dialogue_files;
pub(crate) mod existing;
pub(crate) mod format_examples;
pub(crate) mod formats;
pub(crate) mod inputs;
pub(crate) mod lint_flags;
pub(crate) mod locales;
pub(crate) mod output_file;
pub(crate) mod patterns;
pub(crate) mod project_flags;
pub(crate) mod rewriting;
pub(crate) mod script_file;
pub(crate) mod set_file;
pub(crate) mod settings_file;
pub(crate) mod shard_step;
pub(crate) mod sources;
pub(crate) mod stack;
pub(crate) mod stdio;
pub(crate) mod text_banks;
pub(crate) mod text_record;
