//! The pages about codes, the README and `lipz explain`: the examples show what the pages state.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod support;

use lipz_diagnostics::Code;
use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag};
use serde_json::Value;
use support::{Scene, lipz, repository};

/// A fenced block of a page: its info string and its text.
struct Block {
    info: String,
    text: String,
}

/// Returns the blocks of a page.
fn blocks(page: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut is_open = false;
    for event in Parser::new(page) {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                is_open = true;
                blocks.push(Block { info: info.into_string(), text: String::new() });
            }
            Event::Text(text) if is_open => blocks.last_mut().unwrap().text.push_str(&text),
            Event::End(_) => is_open = false,
            _ => {}
        }
    }
    blocks
}

/// Returns the arguments in `json flags="--config default-locale=en-us"`.
fn flags(info: &str) -> Vec<&str> {
    let flags = info.split_once("flags=\"").and_then(|(_, rest)| rest.split_once('"'));
    flags.map_or("", |(flags, _)| flags).split_whitespace().collect()
}

/// Whether `lipz check` reports `code` for the file.
fn finds(code: Code, block: &Block) -> bool {
    let scene = Scene::new();
    scene.write("example.lipz", &block.text);
    let arguments = ["check", "example.lipz", "--output-format", "json"].into_iter().chain(flags(&block.info));
    let outcome = lipz(scene.path(), arguments);
    let document: Value = serde_json::from_str(&outcome.stdout).unwrap_or_else(|_| panic!("{code}: {outcome:?}"));
    document["diagnostics"].as_array().unwrap().iter().any(|found| found["code"] == code.number())
}

#[test]
fn examples_have_the_diagnostic_and_fixed_ones_have_not() {
    let mut wrong = Vec::new();
    let mut checked = 0;
    for &code in Code::ALL {
        let (example, fix) = code.page().split_once("**Fix.**").unwrap();
        for (part, is_found) in [(example, true), (fix, false)] {
            for block in blocks(part).iter().filter(|block| block.info.starts_with("json")) {
                checked += 1;
                if finds(code, block) != is_found {
                    wrong.push(format!("{code}: found is {} for\n{}", !is_found, block.text));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(checked > 50, "{checked} examples");
}

#[test]
fn every_page_has_an_example_and_transcripts_show_the_code() {
    for &code in Code::ALL {
        let (example, _) = code.page().split_once("**Fix.**").unwrap();
        let blocks = blocks(example);
        assert!(!blocks.is_empty(), "{code} has no example");
        for block in blocks.iter().filter(|block| block.info == "text") {
            let shown = format!("{}[{code}]: ", code.default_severity());
            assert!(block.text.contains(&shown), "{code}:\n{}", block.text);
        }
    }
}

#[test]
fn explain_takes_numbers_and_names() {
    let page = lipz(&repository(), ["explain", "LZ0401"]);
    assert_eq!((page.code, page.stderr.as_str()), (0, ""));
    assert!(page.stdout.starts_with("LZ0401 foreign-code (error by default)\n"), "{}", page.stdout);
    assert!(page.stdout.contains("\n\nWhy. There is no mouth shape"), "{}", page.stdout);
    assert!(page.stdout.contains("\n      \"visemes\": \"MAXEO-\"\n"), "{}", page.stdout);
    for same in ["lz0401", "foreign-code", "Foreign-Code", "[LZ0401]", "error[LZ0401]:"] {
        assert_eq!(lipz(&repository(), ["explain", same]).stdout, page.stdout, "{same}");
    }
}

#[test]
fn explain_shows_every_code_within_the_width() {
    for code in Code::ALL {
        let page = lipz(&repository(), ["explain", code.number()]);
        assert_eq!(page.code, 0);
        for line in page.stdout.lines() {
            let is_block = line.starts_with("    ");
            assert!(is_block || line.chars().count() <= 100, "{code}: {line}");
            assert!(is_block || !line.contains("**") && !line.contains("```"), "{code}: {line}");
        }
    }
}

#[test]
fn explain_lists_the_codes() {
    let list = lipz(&repository(), ["explain"]);
    assert_eq!((list.code, list.stderr.as_str()), (0, ""));
    for code in Code::ALL {
        let starts = |line: &str| line.starts_with(&format!("  {code}  {} ", code.name()));
        assert_eq!(list.stdout.lines().filter(|line| starts(line)).count(), 1, "{code}");
    }
}

#[test]
fn explain_says_what_was_probably_meant() {
    let near = lipz(&repository(), ["explain", "forein_code"]);
    assert_eq!((near.code, near.stdout.as_str()), (2, ""));
    assert_eq!(
        near.stderr,
        "error[LZ1604]: no rule is called `forein_code`\n |\n = help: did you mean `foreign-code`?\n\n1 error\n"
    );
    let far = lipz(&repository(), ["explain", "LZ9999"]);
    assert_eq!((far.code, far.stdout.as_str()), (2, ""));
    assert!(far.stderr.contains(" = help: list the rules with `lipz explain`\n"), "{}", far.stderr);
}

#[test]
fn the_diagnostic_in_the_readme_is_that_of_its_file() {
    let readme = std::fs::read_to_string(repository().join("README.md")).unwrap();
    let blocks = blocks(&readme);
    let [file, diagnostic, timeline, ..] = blocks.as_slice() else { panic!("no examples") };
    let scene = Scene::new();
    scene.write("voices/act1/mayor.lipz", &file.text);
    let outcome = lipz(scene.path(), ["check", "voices"]);
    assert_eq!((outcome.code, outcome.stderr), (1, format!("{}\n1 error in 1 file\n", diagnostic.text)));
    let formatted = lipz(scene.path(), ["fmt", "voices", "--check"]);
    assert_eq!(formatted.code, 0, "it is in its canonical layout");
    scene.write("voices/act1/mayor.lipz", file.text.replace("Meister? Meister!", "Meister?|Meister!"));
    let shown = lipz(scene.path(), ["inspect", "voices/act1/mayor.lipz", "--locale", "en-us"]);
    assert_eq!(shown.stdout.split("\n\n").nth(1), Some(timeline.text.trim_end()), "{shown:?}");
}

/// A fresh checkout packs the fixtures, shows a clip and runs its tests with Rust alone.
#[test]
fn the_readme_has_the_commands_for_a_checkout() {
    let read = |path: &str| std::fs::read_to_string(repository().join(path)).unwrap();
    let mut blocks = blocks(&read("README.md"));
    blocks.retain(|block| block.info == "bash");
    let [pack, test] = blocks.as_slice() else { panic!("{} blocks of bash", blocks.len()) };
    let (pack, inspect) = pack.text.trim().split_once(" && ").unwrap();
    let [_, "xtask", "pack", sources, "-o", bank] = pack.split(' ').collect::<Vec<_>>()[..] else { panic!("{pack}") };
    let [_, "xtask", "inspect", inspected, clip] = inspect.split(' ').collect::<Vec<_>>()[..] else {
        panic!("{inspect}")
    };
    assert_eq!(inspected, bank);
    assert!(repository().join(sources).join(clip).with_extension("lipz").is_file(), "{sources} has {clip}");
    assert!(read(".ci/run").lines().any(|line| line.starts_with(test.text.trim())), "{}", test.text);
}

#[test]
fn the_commands_for_the_first_hour_lead_to_a_face() {
    let page = std::fs::read_to_string(repository().join("docs/start/getting-started.md")).unwrap();
    assert!(page.lines().count() <= 40, "it is for one sitting");
    let scene = Scene::new();
    let mut folder = scene.path().to_owned();
    let mut ran = 0;
    for block in blocks(&page).iter().filter(|block| block.info == "sh") {
        for line in block.text.lines() {
            let line = line.split(" #").next().unwrap();
            let mut words = shell_words(line);
            match words.remove(0).as_str() {
                "pip" => {}
                "cd" => folder.push(&words[0]),
                // A recording of speech.
                "arecord" => {
                    let voice = std::fs::read(repository().join("fixtures/speech/bobby.wav")).unwrap();
                    std::fs::write(folder.join(words.last().unwrap()), voice).unwrap();
                }
                "lipz" => {
                    let run = lipz(&folder, &words);
                    assert_eq!(run.code, 0, "{line}: {run:?}");
                    assert!(!run.stderr.contains("warning"), "{line}: nothing trips up a newcomer: {run:?}");
                    ran += 1;
                }
                other => panic!("{other} is not known here"),
            }
        }
    }
    assert!(ran >= 6, "{ran} commands");
    let shown = lipz(&folder, ["inspect", "dialogue.lipzbank", "bobby"]).stdout;
    let timeline = blocks(&page).into_iter().find(|block| block.text.contains("▁")).unwrap();
    assert_eq!(
        shown.split("\n\n").nth(1),
        Some(timeline.text.trim_end()),
        "the page shows the results of its commands"
    );
}

/// Splits a shell command into words. Double quotes enclose strings.
fn shell_words(line: &str) -> Vec<String> {
    let parts = line.split('"').enumerate().flat_map(|(index, part)| match index % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    parts.collect()
}
