//! Names from earlier versions and from other tools, with their equivalents in lipz.

use crate::shared::subtitle_formats::SubtitleFormatArgument;
use crate::shared::text_formats::TextFormatArgument;
use clap::ValueEnum;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use lipz_compiler::settings::{Content, TABLES};
use lipz_interop::formats;

/// Commands, with their equivalents.
const COMMANDS: &[(&str, &str)] = &[
    ("accept", "`lipz approve`"),
    ("babble", "`lipz print babble`"),
    ("build", "`lipz pack`"),
    ("compile", "`lipz pack`"),
    ("completions", "`lipz print completions`"),
    ("extract", "`lipz unpack`"),
    ("face", "`lipz convert --write-curves`"),
    ("fallout", "`lipz check --fallout-heads`"),
    ("format", "`lipz fmt`"),
    ("info", "`lipz inspect`"),
    ("link", "`lipz shard link`"),
    ("lint", "`lipz check`"),
    ("man", "`lipz print man`"),
    ("maps", "`lipz print maps`"),
    ("recogniser", "`lipz import recogniser`"),
    ("schema", "`lipz print schema`"),
    ("stats", "`lipz inspect --show stats`"),
    ("subtitles", "`lipz export subtitles` or `lipz import subtitles`"),
    ("texts", "`lipz export texts` or `lipz import texts`"),
    ("validate", "`lipz check`"),
    ("version", "`lipz --version`"),
];

/// Options, with their equivalents.
const OPTIONS: &[(&str, &str)] = &[
    ("--audio-cache", "`--config audio.cache=FILE`"),
    ("--audio-length", "`--file-rate`"),
    ("--bank", "`--config output=BANK`"),
    ("--clear", "the shell's `clear` before `lipz watch`"),
    ("--csv", "`--as csv`"),
    ("--curve", "`--write-curves=NAME`"),
    ("--dry-run", "`--diff`"),
    ("--export", "`--output FOLDER`"),
    ("--extended-locales", "`--config extended-locales=true`"),
    ("--file-fps", "`--file-rate`"),
    ("--force", "`--overwrite` for files that exist, `--discard-edits` for edits that would be lost"),
    ("--format", "`--output-format`"),
    ("--hidden", "`--config hidden=true`"),
    ("--html", "`--as html`"),
    ("--json", "`--output-format json`"),
    ("--key", "a pattern of files, as in `lipz approve 'voices/act1/*'`"),
    ("--keys", "`--config face.keys=words`"),
    ("--lipz", "a program `lipz` in the PATH of the engine"),
    ("--list", "`lipz inspect --show clips`, or `lipz explain` without a code"),
    ("--min-state", "`--state`"),
    ("--missing", "`--show missing --locale LOCALE`"),
    ("--name", "the name after the file: `lipz print babble settings.xml NAME`"),
    ("--new-texts", "the stack NEW+TEXTS, as in `dialogue.lipzbank+dialogue.de-de.lipztexts`"),
    ("--no-cache", "to delete the file of `--cache`, which is made again"),
    ("--old-texts", "the stack OLD+TEXTS, as in `dialogue.lipzbank+dialogue.de-de.lipztexts`"),
    ("--plan", "`lipz shard pack PLAN SHARD` or `lipz shard sync PLAN SHARD`"),
    ("--report", "`--output-format json`"),
    ("--replace", "`--overwrite`"),
    ("--root", "`--config root=FOLDER`"),
    ("--shape", "the format: unity, godot, unreal or yarn instead of csv"),
    ("--shard", "`lipz shard pack PLAN SHARD` or `lipz shard sync PLAN SHARD`"),
    ("--stale", "`--show stale --locale LOCALE`"),
    ("--statistics", "`--show stats`"),
    ("--sync", "`lipz shard plan sync`"),
    ("--text-format", "`--stdin-filename NAME.po`"),
    ("--text", "`--script FILE`"),
    ("--texts", "the stack BANK+TEXTS, as in `dialogue.lipzbank+dialogue.de-de.lipztexts`"),
    ("--threads", "`--jobs`"),
    ("--units-per-second", "`--file-rate`"),
    ("--voices", "`--show voices`"),
];

/// Returns the help for a command line that clap refuses because of an old or foreign name.
pub(crate) fn help(error: &clap::Error) -> Option<String> {
    let named = |kind| match error.get(kind) {
        Some(ContextValue::String(name)) => Some(name.as_str()),
        _ => None,
    };
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            named(ContextKind::InvalidSubcommand).and_then(|name| instead_of_command(name, parent(error).as_deref()))
        }
        ErrorKind::UnknownArgument => named(ContextKind::InvalidArg).and_then(instead_of_option),
        _ => None,
    }
    .map(|instead| format!("did you mean {instead}?"))
}

/// Returns the first-level command that refuses an unknown command below it.
fn parent(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::StyledStr(usage)) = error.get(ContextKind::Usage) else { return None };
    usage.to_string().split_whitespace().skip_while(|word| *word != "lipz").nth(1).map(str::to_owned)
}

/// Returns the equivalent of an unknown command below `parent`.
fn instead_of_command(name: &str, parent: Option<&str>) -> Option<String> {
    if let Some((_, instead)) = COMMANDS.iter().find(|(old, _)| *old == name) {
        return Some((*instead).to_owned());
    }
    let (export, import) = commands_of_format(name)?;
    let quoted = |command: String| format!("`{command}`");
    match (parent, export.map(quoted), import.map(quoted)) {
        (Some("export"), export, _) => export,
        (Some("import"), _, import) => import,
        (_, Some(export), Some(import)) => Some(format!("{export} or {import}")),
        (_, export, import) => export.or(import),
    }
}

/// Returns the commands that export and import a format, as far as lipz writes and reads it.
fn commands_of_format(name: &str) -> Option<(Option<String>, Option<String>)> {
    if TextFormatArgument::from_str(name, false).is_ok() {
        return Some((Some(format!("lipz export texts {name}")), Some("lipz import texts FILE".to_owned())));
    }
    if SubtitleFormatArgument::from_str(name, false).is_ok() {
        return Some((Some(format!("lipz export subtitles {name}")), Some("lipz import subtitles FILE".to_owned())));
    }
    let format = formats::find(name)?;
    let command = |direction: &str| format!("lipz {direction} visemes {name}");
    Some((format.write.map(|_| command("export")), format.read.map(|_| command("import"))))
}

fn instead_of_option(option: &str) -> Option<String> {
    let option = option.split('=').next().unwrap_or(option);
    if let Some((_, instead)) = OPTIONS.iter().find(|(old, _)| *old == option) {
        return Some((*instead).to_owned());
    }
    setting(option.strip_prefix("--")?).map(|key| format!("`--config {key}=VALUE`, or the setting in lipz.toml"))
}

/// Returns the key of the setting that replaced the option of this name.
fn setting(option: &str) -> Option<String> {
    let is_it = |names: &str| names.split(", ").any(|name| name == option);
    TABLES.iter().find_map(|table| {
        let name = match &table.content {
            Content::Settings(settings) => settings.iter().find(|setting| is_it(setting.flat_name))?.name,
            Content::Map(map) => is_it(map.flat_name).then_some(map.name)?,
        };
        Some(if table.name.is_empty() { name.to_owned() } else { format!("{}.{name}", table.name) })
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::args::Arguments;
    use clap::{CommandFactory, Parser};
    use std::collections::BTreeSet;

    /// The commands and options of the version before 0.1.0.
    const OLD: &str = include_str!("renamed/old_names.txt");

    fn answer(line: &str) -> Option<String> {
        help(&Arguments::try_parse_from(line.split(' ')).unwrap_err())
    }

    fn current() -> (BTreeSet<String>, BTreeSet<String>) {
        fn add(command: &clap::Command, names: &mut BTreeSet<String>, options: &mut BTreeSet<String>) {
            options.extend(command.get_arguments().filter_map(|argument| Some(format!("--{}", argument.get_long()?))));
            for command in command.get_subcommands() {
                names.insert(command.get_name().to_owned());
                add(command, names, options);
            }
        }
        let (mut names, mut options) = Default::default();
        let mut lipz = Arguments::command();
        lipz.build();
        add(&lipz, &mut names, &mut options);
        (names, options)
    }

    #[test]
    fn each_old_name_is_there_or_is_answered_with_the_new_one() {
        let (commands, options) = current();
        for old in OLD.lines().filter(|line| !line.starts_with('#')) {
            let is_known = match old.strip_prefix("--") {
                Some(_) => options.contains(old) || instead_of_option(old).is_some(),
                None => commands.contains(old) || instead_of_command(old, None).is_some(),
            };
            assert!(is_known, "{old}");
        }
    }

    #[test]
    fn new_names_that_are_answered_are_there() {
        let (commands, options) = current();
        let answers = COMMANDS.iter().chain(OPTIONS).map(|(_, instead)| *instead);
        for word in answers.flat_map(|answer| answer.split(['`', ' ', '=', ':'])) {
            assert!(!word.starts_with("--") || options.contains(word) || word == "--version", "{word}");
        }
        for (_, instead) in COMMANDS {
            let command = instead.split(' ').nth(1).unwrap().trim_matches('`');
            assert!(commands.contains(command) || command == "--version", "{instead}");
        }
    }

    #[test]
    fn slips_on_a_command_line() {
        assert_eq!(answer("lipz stats d.lipzbank").unwrap(), "did you mean `lipz inspect --show stats`?");
        for (line, instead) in [
            ("lipz import rhubarb-tsv a.tsv -o v", "`lipz import visemes rhubarb-tsv`"),
            ("lipz export moho voices", "`lipz export visemes moho`"),
            ("lipz import po a.po", "`lipz import texts FILE`"),
            ("lipz import srt a.srt", "`lipz import subtitles FILE`"),
            ("lipz export po", "`lipz export texts po`"),
            ("lipz export unity", "`lipz export texts unity`"),
            ("lipz export vtt", "`lipz export subtitles vtt`"),
            ("lipz po", "`lipz export texts po` or `lipz import texts FILE`"),
            ("lipz ovr", "`lipz import visemes ovr`"),
        ] {
            assert_eq!(answer(line).unwrap(), format!("did you mean {instead}?"));
        }
        assert_eq!(answer("lipz export ovr"), None, "lipz only imports this format");
        assert_eq!(answer("lipz check --format json").unwrap(), "did you mean `--output-format`?");
        assert!(answer("lipz pack --max-lines 3").unwrap().contains("`--config text.lines=VALUE`"));
        assert!(answer("lipz pack --min-coverage=90").unwrap().contains("`--config coverage.LOCALE=VALUE`"));
        assert_eq!(answer("lipz chekc"), None);
    }
}
