//! docs/reference/commands.md, generated from the commands, and the limits of their help.

use crate::args::Arguments;
use crate::commands::GROUPS;
use clap::{Arg, Command, CommandFactory};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

/// The page.
const PAGE: &str = "docs/reference/commands.md";

/// The start of the page, which applies to all commands.
const HEAD: &str = include_str!("reference_head.md");

/// Options that most commands share, in the order of the page.
const COMMON: [&str; 10] =
    ["quiet", "jobs", "config", "no-config", "stdin-filename", "allow", "warn", "deny", "output-format", "color"];

/// The most lines of `-h`.
const SHORT_HELP_LINES: usize = 50;

/// The most options with different names in all commands together. This leaves room for later features.
const MOST_OPTIONS: usize = 70;

/// The most top-level commands.
const MOST_COMMANDS: usize = 24;

/// Returns the command line in the form that clap completes.
fn lipz() -> Command {
    let mut lipz = Arguments::command();
    lipz.build();
    lipz
}

/// Returns the commands without subcommands, with their full names.
fn leaves(lipz: &Command) -> Vec<(String, &Command)> {
    fn add<'c>(command: &'c Command, name: &str, leaves: &mut Vec<(String, &'c Command)>) {
        let mut below = command.get_subcommands().filter(|command| command.get_name() != "help").peekable();
        if below.peek().is_none() {
            leaves.push((name.to_owned(), command));
        }
        below.for_each(|command| add(command, &format!("{name} {}", command.get_name()), leaves));
    }
    let mut leaves = Vec::new();
    for name in GROUPS.iter().flat_map(|(_, names)| names.iter()).filter(|name| **name != "help") {
        let name = name.to_ascii_lowercase();
        let command = lipz.get_subcommands().find(|command| command.get_name() == name).unwrap();
        add(command, &name, &mut leaves);
    }
    leaves
}

/// Returns all commands, also those with commands below them, except `lipz` itself and `help`.
fn all(command: &Command) -> Vec<&Command> {
    let below = command.get_subcommands().filter(|command| command.get_name() != "help");
    below.flat_map(|command| std::iter::once(command).chain(all(command))).collect()
}

/// Returns the options that are not hidden.
fn options(command: &Command) -> impl Iterator<Item = &Arg> {
    command.get_arguments().filter(|argument| argument.get_long().is_some() && !argument.is_hide_set())
}

/// Returns an option as it appears on a command line: `-o, --output <FILE>`.
fn spelling(option: &Arg) -> String {
    let short = option.get_short().map(|short| format!("-{short}, ")).unwrap_or_default();
    let values = option.get_value_names().unwrap_or_default();
    let takes_values = option.get_action().takes_values();
    let values = values.iter().filter(|_| takes_values).map(|name| format!(" <{name}>")).collect::<String>();
    format!("{short}--{}{values}", option.get_long().unwrap_or_default())
}

/// Returns text escaped for Markdown, except for code.
fn escaped(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(number, part)| match number % 2 {
        0 => part.replace('*', "\\*").replace('<', "\\<"),
        _ => format!("`{part}`"),
    });
    parts.collect()
}

/// Returns text escaped for a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// Returns the complete help of an argument in one line, with its default and values.
fn help(argument: &Arg) -> String {
    let text = argument.get_long_help().or(argument.get_help()).map(ToString::to_string).unwrap_or_default();
    let paragraphs = text.split("\n\n").map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
    let mut text = escaped(&paragraphs.collect::<Vec<_>>().join(". "));
    let values: Vec<String> =
        argument.get_possible_values().iter().map(|value| format!("`{}`", value.get_name())).collect();
    let takes_values = argument.get_action().takes_values();
    if !values.is_empty() && takes_values && !argument.is_hide_possible_values_set() {
        let _ = write!(text, "{} One of {}", if text.ends_with('.') { "" } else { "." }, values.join(", "));
    }
    let default: Vec<_> = argument.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if !default.is_empty() && takes_values && !argument.is_hide_default_value_set() {
        let _ = write!(text, " [default: `{}`]", default.join(","));
    }
    text
}

/// Returns text in lines of a page, which break only at spaces.
fn wrapped_text(text: &str) -> String {
    let options = textwrap::Options::new(100)
        .break_words(false)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation);
    textwrap::fill(text, options)
}

fn paragraphs(text: &str) -> String {
    let wrapped = text.split("\n\n").map(|paragraph| {
        let paragraph = escaped(&paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
        wrapped_text(&paragraph) + "\n\n"
    });
    wrapped.collect()
}

/// Returns a command with its arguments and examples.
fn section(name: &str, command: &Command) -> String {
    let about = command.get_long_about().or(command.get_about()).map(ToString::to_string).unwrap_or_default();
    let mut text = format!("### lipz {name}\n\n{}", paragraphs(&about));
    let usage = command.clone().render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ").split_whitespace().collect::<Vec<_>>().join(" ");
    let usage = if usage.starts_with("lipz") { usage } else { format!("lipz {usage}") };
    let _ = writeln!(text, "```text\n{usage}\n```\n");
    let is_own = |option: &&Arg| {
        let long = option.get_long().unwrap_or_default();
        !COMMON.contains(&long) && long != "help"
    };
    let positional = command.get_positionals().map(|argument| {
        let name = argument.get_value_names().and_then(<[_]>::first).map(ToString::to_string).unwrap_or_default();
        (format!("<{name}>"), help(argument))
    });
    let own = options(command).filter(is_own).map(|option| (spelling(option), help(option)));
    let rows: Vec<(String, String)> = positional.chain(own).collect();
    if !rows.is_empty() {
        text.push_str("| argument | meaning |\n| --- | --- |\n");
        for (spelling, help) in rows {
            let _ = writeln!(text, "| `{}` | {} |", cell(&spelling), cell(&help));
        }
        text.push('\n');
    }
    let common: Vec<String> = COMMON
        .iter()
        .filter(|name| options(command).any(|option| option.get_long() == Some(**name)))
        .filter(|name| !matches!(**name, "color" | "output-format"))
        .map(|name| format!("`--{name}`"))
        .collect();
    if !common.is_empty() {
        let listed = format!("[Common options](#common-options): {}.", common.join(", "));
        let _ = writeln!(text, "{}\n", wrapped_text(&listed));
    }
    let after = command.get_after_long_help().or(command.get_after_help()).map(ToString::to_string);
    if let Some(after) = after {
        let _ = writeln!(text, "```text\n{}\n```\n", after.trim());
    }
    text
}

/// Returns the whole page.
fn page() -> String {
    let lipz = lipz();
    let leaves = leaves(&lipz);
    let mut text = HEAD.to_owned();
    for (title, names) in GROUPS.iter().filter(|(title, _)| *title != "Help") {
        let _ = writeln!(text, "\n**{title}**\n\n| command | description |\n| --- | --- |");
        let is_of_group = |name: &str| names.iter().any(|of| name.split(' ').next() == Some(&of.to_ascii_lowercase()));
        for (name, command) in leaves.iter().filter(|(name, _)| is_of_group(name)) {
            let about = cell(&escaped(&command.get_about().map(ToString::to_string).unwrap_or_default()));
            let _ = writeln!(text, "| [`lipz {name}`](#lipz-{}) | {about} |", name.replace(' ', "-"));
        }
    }
    text.push_str("\n## Common options\n\n| option | meaning |\n| --- | --- |\n");
    let all: BTreeMap<&str, &Arg> = leaves
        .iter()
        .flat_map(|(_, command)| options(command))
        .filter_map(|option| Some((option.get_long()?, option)))
        .collect();
    for option in COMMON.iter().filter_map(|name| all.get(name)) {
        let _ = writeln!(text, "| `{}` | {} |", cell(&spelling(option)), cell(&help(option)));
    }
    text.push_str("\n## Reference\n\n");
    text.extend(leaves.iter().map(|(name, command)| section(name, command)));
    text.trim_end().to_owned() + "\n"
}

#[test]
fn the_page_of_commands_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(PAGE);
    let page = page();
    if env::var_os("LIPZ_BLESS").is_some() {
        fs::write(path, page).unwrap();
    } else {
        assert!(fs::read_to_string(path).unwrap() == page, "{PAGE} is not current: run `cargo xtask bless lipz`");
    }
}

#[test]
fn short_help_fits_a_screen() {
    let lipz = lipz();
    for (name, command) in leaves(&lipz) {
        let help = command.clone().term_width(100).render_help().to_string();
        let lines = help.lines().count();
        assert!(lines <= SHORT_HELP_LINES, "`lipz {name} -h` has {lines} lines");
    }
}

#[test]
fn options_and_commands_are_few() {
    let lipz = lipz();
    let leaves = leaves(&lipz);
    let names: BTreeSet<&str> =
        leaves.iter().flat_map(|(_, command)| options(command)).filter_map(Arg::get_long).collect();
    assert!(names.len() <= MOST_OPTIONS, "{}: {names:?}", names.len());
    let first = lipz.get_subcommands().count();
    assert!(first <= MOST_COMMANDS, "{first}");
}

#[test]
fn common_options_have_the_same_help() {
    let lipz = lipz();
    let mut helps: BTreeMap<&str, String> = BTreeMap::new();
    for (name, command) in leaves(&lipz) {
        let has = |long: &str| options(command).any(|option| option.get_long() == Some(long));
        assert_eq!(has("config"), has("no-config"), "lipz {name}");
        for option in options(command) {
            let long = option.get_long().unwrap();
            if COMMON.contains(&long) {
                let help = help(option);
                assert_eq!(*helps.entry(long).or_insert_with(|| help.clone()), help, "lipz {name} --{long}");
            }
        }
    }
}

#[test]
fn help_is_short_and_does_not_end_with_a_full_stop() {
    let lipz = lipz();
    for command in all(&lipz) {
        let name = command.get_bin_name().unwrap_or_default();
        for argument in command.get_arguments() {
            let text = argument.get_help().map(ToString::to_string).unwrap_or_default();
            let id = argument.get_id();
            assert!(!text.is_empty() && !text.ends_with('.'), "{name} {id}: {text}");
            assert!(text.chars().count() <= 130, "{name} {id}: {text}");
        }
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        assert!(!about.is_empty() && !about.ends_with('.'), "{name}: {about}");
        assert!(about.chars().count() <= 80, "{name}: {about}");
    }
}
