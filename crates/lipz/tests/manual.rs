//! Shell completions and manual pages contain every command and option.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Stdio};
use support::{commands, lipz, repository, tree};

/// Returns the help of a command, such as `import visemes`.
fn help(command: &str) -> String {
    lipz(&repository(), command.split(' ').chain(["--help"])).stdout
}

/// Returns all commands, including those below others, such as `import` and `import visemes`.
fn all_commands() -> Vec<String> {
    let with_below = |command: String| {
        let help = help(&command);
        let list = help.split("\nCommands:\n").nth(1).unwrap_or_default().split("\n\n").next().unwrap_or_default();
        let below = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
        let below = below.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help");
        let below: Vec<String> = below.map(|name| format!("{command} {name}")).collect();
        std::iter::once(command).chain(below)
    };
    commands().into_iter().flat_map(with_below).collect()
}

/// Returns the long options in `lipz COMMAND --help`.
fn options(command: &str) -> BTreeSet<String> {
    let help = help(command);
    let list = help.split("Options:\n").nth(1).unwrap().to_owned();
    let words = list.lines().filter(|line| line.trim_start().starts_with('-')).flat_map(str::split_whitespace);
    let options = words.filter(|word| word.starts_with("--"));
    options.map(|word| word.trim_end_matches(',').split(['=', '[']).next().unwrap().to_owned()).collect()
}

#[test]
fn commands_that_make_no_bank_do_not_list_flags_about_banks() {
    for flag in ["--over", "--keep-others", "--depfile", "--timings"] {
        assert!(options("pack").contains(flag), "{flag}");
        for command in ["check", "convert"] {
            assert!(!options(command).contains(flag), "{command} {flag}");
        }
    }
}

#[test]
fn completions_know_every_command_and_option() {
    let all = all_commands();
    assert!(commands().len() >= 9 && all.contains(&"import visemes".to_owned()), "{all:?}");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = lipz(&repository(), ["print", "completions", shell]);
        assert_eq!((script.code, script.stderr.as_str()), (0, ""), "{shell}");
        for command in &all {
            assert!(command.split(' ').all(|word| script.stdout.contains(word)), "{shell}: {command}");
            for option in options(command) {
                // fish writes options without their hyphens.
                assert!(script.stdout.contains(option.trim_start_matches('-')), "{shell}: {command} {option}");
            }
        }
    }
    assert_eq!(lipz(&repository(), ["print", "completions", "tcsh"]).code, 2);
}

#[test]
fn the_completions_of_bash_are_bash() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("lipz.bash");
    fs::write(&script, lipz(&repository(), ["print", "completions", "bash"]).stdout).unwrap();
    // Without bash, there is nothing to check.
    if let Ok(status) = Command::new("bash").arg("-n").arg(&script).stderr(Stdio::inherit()).status() {
        assert!(status.success());
    }
}

#[test]
fn every_command_has_a_manual_page_with_its_options() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let written = lipz(folder, ["print", "man", "-o", "man/man1"]);
    let all = all_commands();
    let page = |command: &str| format!("man/man1/lipz-{}.1", command.replace(' ', "-"));
    let count = all.len() + 1;
    assert_eq!((written.code, written.stdout), (0, format!("{count} pages written into man/man1\n")));
    let mut expected: Vec<String> = all.iter().map(|command| page(command)).collect();
    expected.extend(["man", "man/man1", "man/man1/lipz.1"].map(String::from));
    expected.sort();
    assert_eq!(tree(folder), expected, "exactly these files");
    let read = |file: &str| fs::read_to_string(folder.join(file)).unwrap().replace("\\-", "-");
    assert!(expected.contains(&"man/man1/lipz-import-visemes.1".to_owned()));
    for command in &all {
        let page = read(&page(command));
        assert!(page.contains(&format!("lipz {command}")) && page.contains("Example"), "{command}: {page}");
        for option in options(command) {
            assert!(page.contains(&option), "{command} {option}: {page}");
        }
    }
    for file in expected.iter().filter(|file| file.ends_with(".1")) {
        for reference in read(file).split_whitespace().filter_map(|word| word.strip_suffix("(1)")) {
            assert!(expected.contains(&format!("man/man1/{reference}.1")), "{file} refers to {reference}");
        }
    }
    let quiet = lipz(folder, ["print", "man", "-o", "man/man1", "--quiet"]);
    assert_eq!((quiet.code, quiet.stdout.as_str(), quiet.stderr.as_str()), (0, "", ""));
    fs::write(folder.join("file"), "").unwrap();
    let refused = lipz(folder, ["print", "man", "-o", "file"]);
    assert_eq!((refused.code, refused.stderr.contains("error[LZ0904]")), (2, true), "{}", refused.stderr);
}
