//! The settings file of a new project: every setting, explained and commented out.

use super::table::{Content, TABLES, Table};
use std::fmt::Write;

const HEAD: &str = "\
# Settings of a lipz project. Lines that start with `#` and a blank are explanations; remove the `#`
# of a setting to change it. Values here win over defaults, flags of the command line over values.
# Paths count from the folder of this file. docs/reference/settings.md describes every setting.
";

/// Columns of an explanation.
const WIDTH: usize = 100;

/// A settings file with every setting at its default, or with an example, behind `#`; those in `set` have the values that stand
/// there, in TOML: table (none for the first), name, value.
pub fn template(set: &[(&str, &str, &str)]) -> String {
    let mut text = HEAD.to_owned();
    for table in TABLES {
        push_table(&mut text, table, set);
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
                let _ = writeln!(text, "#{example}");
            }
        }
    }
}

/// An explanation, over several lines if it is long.
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
    use crate::settings::Settings;

    fn read(text: &str) -> Settings {
        Settings::parse(text, "lipz.toml", "").unwrap()
    }

    #[test]
    fn the_template_changes_nothing() {
        let (written, empty) = (read(&template(&[])), read(""));
        assert_eq!(format!("{written:?}"), format!("{empty:?}"));
        let (written, set) = (read(&template(&[("", "strip", "true")])), read("strip = true"));
        assert_eq!(format!("{written:?}"), format!("{set:?}"));
        let set = template(&[("audio", "folder", "\"here\"")]);
        let (written, set) = (read(&set), read("[audio]\nfolder = \"here\""));
        assert_eq!(format!("{written:?}"), format!("{set:?}"));
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
