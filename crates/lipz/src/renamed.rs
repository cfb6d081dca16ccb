//! Names from earlier versions and from other tools, with their equivalents in lipz.

use crate::shared::subtitle_formats::SubtitleFormatArgument;
use crate::shared::text_formats::TextFormatArgument;
use clap::ValueEnum;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use lipz_compiler::settings::find_flat;
use lipz_interop::formats;

/// Commands, with the commands that replaced them.
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

/// Options, with the options that replaced them in backticks, or with a sentence that starts with a verb.
const OPTIONS: &[(&str, &str)] = &[
    ("--audio-length", "`--file-rate`"),
    ("--bank", "`--config output=BANK`"),
    ("--clear", "run `clear` before `lipz watch`"),
    ("--csv", "`--as csv`"),
    ("--curve", "`--write-curves=NAME`"),
    ("--dry-run", "`--diff`"),
    ("--export", "`--output FOLDER`"),
    ("--file-fps", "`--file-rate`"),
    ("--force", "`--overwrite` for files that exist, `--discard-edits` for edits that would be lost"),
    ("--format", "`--output-format`"),
    ("--html", "`--as html`"),
    ("--json", "`--output-format json`"),
    ("--key", "name files, as in `lipz approve 'voices/act1/*'`"),
    ("--keys", "`--config face.keys=words`"),
    ("--lipz", "add the folder of `lipz` to the PATH of each machine"),
    ("--list", "`lipz inspect --show clips`, or `lipz explain` without a code"),
    ("--min-state", "`--state`"),
    ("--missing", "`--show missing --locale LOCALE`"),
    ("--name", "put the name after the file: `lipz print babble settings.xml NAME`"),
    ("--new-texts", "add the texts to the bank: NEW+TEXTS"),
    ("--no-cache", "delete the file of `--cache`; lipz creates it again"),
    ("--old-texts", "add the texts to the bank: OLD+TEXTS"),
    ("--plan", "`lipz shard pack PLAN SHARD` or `lipz shard sync PLAN SHARD`"),
    ("--report", "`--output-format json`"),
    ("--replace", "`--overwrite`"),
    ("--shape", "use the format unity, godot, unreal or yarn instead of csv"),
    ("--shard", "`lipz shard pack PLAN SHARD` or `lipz shard sync PLAN SHARD`"),
    ("--stale", "`--show stale --locale LOCALE`"),
    ("--statistics", "`--show stats`"),
    ("--sync", "`lipz shard plan sync`"),
    ("--text-format", "`--stdin-filename NAME.po`"),
    ("--text", "`--script FILE`"),
    ("--texts", "add the texts to the bank: BANK+TEXTS"),
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
    .map(|instead| match instead.starts_with('`') {
        true => format!("did you mean {instead}?"),
        false => instead,
    })
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
    let (table, name) = find_flat(option)?;
    Some(if table.name.is_empty() { name.to_owned() } else { format!("{}.{name}", table.name) })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::args::Arguments;
    use clap::{Command, CommandFactory, Parser};
    use lipz_compiler::settings::{Content, TABLES};
    use std::collections::BTreeSet;

    /// The commands and options of the version before 0.1.0.
    const OLD: &str = include_str!("renamed/old_names.txt");

    fn answer(line: &str) -> Option<String> {
        help(&Arguments::try_parse_from(line.split(' ')).unwrap_err())
    }

    fn current() -> (BTreeSet<String>, BTreeSet<String>) {
        fn add(command: &Command, names: &mut BTreeSet<String>, options: &mut BTreeSet<String>) {
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

    /// Checks the command of a line such as `lipz check --jobs 2`, its options there, and its settings. A line without a
    /// command may have the options of any command.
    fn check(lipz: &Command, line: &str) {
        let mut words = line.split(' ').peekable();
        let mut command = None;
        if words.next_if_eq(&"lipz").is_some() {
            let mut found = lipz;
            while let Some(below) = words.peek().and_then(|word| found.find_subcommand(word)) {
                found = below;
                words.next();
            }
            let is_whole = !found.has_subcommands() || words.peek().is_none_or(|word| word.starts_with("--"));
            assert!(is_whole, "{line}");
            command = Some(found);
        }
        let (_, all) = current();
        while let Some(word) = words.next() {
            let Some(option) = word.strip_prefix("--") else { continue };
            let (option, value) = option.split_once('=').map_or((option, None), |(name, value)| (name, Some(value)));
            let is_there = command.map_or(all.contains(&format!("--{option}")), |command| {
                command.get_arguments().any(|argument| argument.get_long() == Some(option))
            });
            assert!(is_there, "{line}");
            if option == "config" {
                let key = value.or_else(|| words.next()).unwrap().split('=').next().unwrap();
                let (table, name) = key.rsplit_once('.').unwrap_or(("", key));
                let table = TABLES.iter().find(|known| known.name == table).unwrap();
                let is_there = match &table.content {
                    Content::Settings(settings) => settings.iter().any(|setting| setting.name == name),
                    Content::Map(map) => {
                        map.name == name || map.examples.iter().any(|line| line.split(" = ").next() == Some(name))
                    }
                };
                assert!(is_there, "{line}");
            }
        }
    }

    #[test]
    fn new_names_that_are_answered_are_there() {
        let mut lipz = Arguments::command();
        lipz.build();
        let answers = COMMANDS.iter().chain(OPTIONS).map(|(_, instead)| (*instead).to_owned());
        let settings = OLD.lines().filter_map(instead_of_option);
        let mut count = 0;
        for answer in answers.chain(settings) {
            for line in answer.split('`').skip(1).step_by(2) {
                check(&lipz, line);
                count += 1;
            }
        }
        assert!(count > 50, "{count}");
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
        assert!(answer("lipz check --root voices").unwrap().contains("`--config root=VALUE`"));
        let sentence = "delete the file of `--cache`; lipz creates it again";
        assert_eq!(answer("lipz pack --no-cache").unwrap(), sentence, "not a name");
        assert_eq!(answer("lipz chekc"), None);
    }
}
