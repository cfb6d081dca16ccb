//! Code that several commands use: common arguments, and the files that they name.

pub(crate) mod audio_flag;
pub(crate) mod bank_file;
pub(crate) mod bank_or_sources;
pub(crate) mod characters;
pub(crate) mod dialogue_files;
pub(crate) mod existing_file;
pub(crate) mod format_examples;
pub(crate) mod formats;
pub(crate) mod inputs;
pub(crate) mod lint_flags;
pub(crate) mod locales;
pub(crate) mod output_file;
pub(crate) mod patterns;
pub(crate) mod rewrite_mode;
pub(crate) mod script_file;
pub(crate) mod set_file;
pub(crate) mod settings_file;
pub(crate) mod sources;
pub(crate) mod stack;
pub(crate) mod stdin_file;
pub(crate) mod stdio;
pub(crate) mod subtitle_formats;
pub(crate) mod text_formats;
pub(crate) mod text_record;
pub(crate) mod translations;
pub(crate) mod values;
