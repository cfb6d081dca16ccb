//! The settings file of a new project: every setting, explained and commented out.

use super::table::{Content, TABLES, Table};
use std::fmt::Write;

const HEAD: &str = "\
# Settings of a lipz project. Lines that start with `#` and a space are explanations; remove the `#`
# of a setting to change it. Options on the command line override the settings in this file. Paths
# start in the folder of this file. docs/reference/settings.md describes every setting.
";

/// The width of an explanation in columns.
const WIDTH: usize = 100;

/// Returns a settings file with every setting at its default, or with an example, commented out with `#`. Those in
/// `set` have the given values. Each entry consists of table (empty for the first settings), name and value, in TOML.
pub fn template(set: &[(&str, &str, &str)]) -> String {
    let mut text = HEAD.to_owned();
    for table in TABLES {
        push_table(&mut text, table, set);
    }
    text
}

/// Returns a settings file with only the values in `set`, in TOML: table (empty for the first settings), name, value.
pub fn short_template(set: &[(&str, &str, &str)]) -> String {
    let mut text = "# Settings of a lipz project. `lipz print settings` explains all of them.\n".to_owned();
    for table in TABLES {
        let mut values = set.iter().filter(|(of, ..)| *of == table.name).peekable();
        if values.peek().is_some() && !table.name.is_empty() {
            let _ = write!(text, "\n[{}]\n", table.name);
        }
        for (_, name, value) in values {
            let _ = writeln!(text, "{name} = {value}");
        }
    }
    text
}

fn push_table(text: &mut String, table: &Table, set: &[(&str, &str, &str)]) {
    text.push('\n');
    push_comment(text, table.about);
    if !table.name.is_empty() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "[{}]", table.name);
    }
    match &table.content {
        Content::Settings(settings) => {
            for setting in *settings {
                text.push('\n');
                push_comment(text, &format!("{} Default: {}.", setting.about, setting.default));
                let is_it = |(of, name, _): &&(&str, &str, &str)| (*of, *name) == (table.name, setting.name);
                let _ = match set.iter().find(is_it) {
                    Some((_, name, value)) => writeln!(text, "{name} = {value}"),
                    None => writeln!(text, "#{} = {}", setting.name, setting.example),
                };
            }
        }
        Content::Map(map) => {
            push_comment(text, &format!("Default: {}.", map.default));
            for example in map.examples {
                let name = example.split(" = ").next().unwrap_or_default();
                let _ = match set.iter().find(|(of, setting, _)| (*of, *setting) == (table.name, name)) {
                    Some((_, name, value)) => writeln!(text, "{name} = {value}"),
                    None => writeln!(text, "#{example}"),
                };
            }
        }
    }
}

/// Adds an explanation, wrapped if it is long.
fn push_comment(text: &mut String, comment: &str) {
    let mut column = 0;
    for word in comment.split(' ') {
        if column > 0 && column + 1 + word.chars().count() > WIDTH {
            text.push('\n');
            column = 0;
        }
        if column == 0 {
            text.push('#');
            column = 1;
        }
        text.push(' ');
        text.push_str(word);
        column += 1 + word.chars().count();
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::settings::Settings;

    fn read(text: &str) -> Settings {
        Settings::parse(text, "lipz.toml", "").unwrap()
    }

    #[test]
    fn the_template_changes_nothing() {
        let (written, empty) = (read(&template(&[])), read(""));
        assert_eq!(format!("{written:?}"), format!("{empty:?}"));
        let (written, set) = (read(&template(&[("", "strip", "true")])), read("strip = true"));
        assert_eq!(format!("{written:?}"), format!("{set:?}"));
        for template in [template, short_template] {
            let set = template(&[("audio", "folder", "\"here\""), ("face", "keys", "\"words\"")]);
            let (written, set) = (read(&set), read("[audio]\nfolder = \"here\"\n[face]\nkeys = \"words\""));
            assert_eq!(format!("{written:?}"), format!("{set:?}"));
        }
    }

    #[test]
    fn every_setting_is_there_and_can_be_uncommented() {
        let uncommented: String = template(&[])
            .lines()
            .map(|line| line.strip_prefix('#').filter(|rest| !rest.starts_with(' ')).unwrap_or(line).to_owned() + "\n")
            .collect();
        read(&uncommented);
        for table in TABLES {
            assert!(table.name.is_empty() || uncommented.contains(&format!("\n[{}]\n", table.name)), "{}", table.name);
            let settings = match table.content {
                Content::Settings(settings) => settings,
                Content::Map(_) => &[],
            };
            for setting in settings {
                let line = format!("\n{} = {}\n", setting.name, setting.example);
                assert!(uncommented.contains(&line), "{}", setting.name);
                let is_default = setting.default == setting.example;
                assert!(is_default || !matches!(setting.example, "true" | "false"), "{}", setting.name);
            }
        }
    }
}
