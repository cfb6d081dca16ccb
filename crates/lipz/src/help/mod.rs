//! The command line of `lipz` and its help, with commands grouped by users.

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod reference;

use crate::args::Arguments;
use crate::commands::GROUPS;
use crate::console;
use clap::builder::Styles;
use clap::{Command, CommandFactory, FromArgMatches};
use std::fmt::Write;

/// The help of `help`, which clap adds only while parsing.
const HELP_ABOUT: &str = "Print this list, or the help of a command";

/// Parses the command line, or returns the error of clap.
pub(crate) fn parse() -> Result<Arguments, clap::Error> {
    let mut lipz = command_line();
    let matches = lipz.try_get_matches_from_mut(std::env::args_os())?;
    Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut lipz))
}

fn command_line() -> Command {
    let lipz = Arguments::command();
    // clap lists commands without groups.
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n{}\n{}:\n{{options}}{{after-help}}",
        groups(&lipz, console::width()),
        heading(lipz.get_styles(), "Options"),
    );
    lipz.help_template(template)
}

/// Returns the commands with their descriptions, in lines of at most `width` columns.
fn groups(lipz: &Command, width: usize) -> String {
    let styles = lipz.get_styles();
    let names = || GROUPS.iter().flat_map(|(_, names)| names.iter());
    let longest = names().map(|name| name.len()).max().unwrap_or(0);
    let indent = " ".repeat(longest + 4);
    let mut text = String::new();
    for (title, names) in GROUPS {
        let _ = writeln!(text, "\n{}:", heading(styles, title));
        for name in *names {
            let name = name.to_ascii_lowercase();
            let about = lipz.find_subcommand(&name).and_then(Command::get_about).map(ToString::to_string);
            let about = about.unwrap_or_else(|| HELP_ABOUT.to_owned());
            let room = textwrap::Options::new(width.max(indent.len() + 20) - indent.len());
            let lines = textwrap::wrap(&about, room).join(&format!("\n{indent}"));
            let blanks = " ".repeat(longest - name.len());
            let literal = styles.get_literal();
            let _ = writeln!(text, "  {literal}{name}{literal:#}{blanks}  {lines}");
        }
    }
    text
}

fn heading(styles: &Styles, title: &str) -> String {
    let style = styles.get_header();
    format!("{style}{title}{style:#}")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn each_command_is_in_the_list_once_with_all_that_it_does() {
        let mut lipz = command_line();
        let list = lipz.render_help().to_string();
        lipz.build();
        for command in lipz.get_subcommands() {
            let entries = list.lines().filter(|line| {
                let name = line.strip_prefix("  ").and_then(|line| line.split(' ').next());
                name == Some(command.get_name())
            });
            assert_eq!(entries.count(), 1, "{} in {list}", command.get_name());
            let about = command.get_about().unwrap().to_string();
            let flowing = list.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(command.get_name() == "help" || flowing.contains(&about), "{about} in {list}");
        }
    }

    #[test]
    fn the_list_fits_a_narrow_terminal() {
        let list = groups(&Arguments::command(), 50);
        let plain = anstream::adapter::strip_str(&list).to_string();
        assert!(plain.lines().all(|line| line.chars().count() <= 50), "{plain}");
    }
}
