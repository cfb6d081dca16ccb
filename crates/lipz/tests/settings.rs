//! `lipz.toml` and command-line flags: their precedence, their effects, and the page about them.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_compiler::settings::{Content, Setting, TABLES, Table};
use lipz_diagnostics::{Code, Severity};
use lipz_testkit::font::font;
use std::fs;
use support::{Comparison, Scene, lipz, repository};

const CLIP: &str = r#"{ "text": "Aye.", "events": "feels nervous" }"#;
const UNEVEN: &str = r#"{ "visemes": "A|M", "text_en-us": "Hello,|{softly} dear|Amy.", "events": "feels sad" }"#;

fn project() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\noutput = \"build/game.lipzbank\"\ndefault-locale = \"en-us\"\n");
    scene.write("voices/act1/aye.lipz", CLIP);
    scene
}

/// Returns the codes in a run's output, in order.
fn codes(stderr: &str) -> Vec<&str> {
    stderr.lines().filter_map(|line| line.split_once("[LZ")?.1.split_once(']')).map(|(code, _)| code).collect()
}

#[test]
fn a_project_needs_no_arguments() {
    let scene = project();
    for folder in ["", "voices", "voices/act1"] {
        let folder = scene.path().join(folder);
        let checked = lipz(&folder, ["check"]);
        assert_eq!((checked.code, checked.stdout.as_str()), (0, "1 file checked\n"), "{}", checked.stderr);
        assert_eq!(codes(&checked.stderr), ["0502", "0702"], "the default locale applies");
        assert_eq!(lipz(&folder, ["pack"]).code, 0);
        let list = lipz(&folder, ["inspect".as_ref(), scene.path().join("build/game.lipzbank").as_os_str()]);
        assert_eq!(list.code, 0, "{}", list.stderr);
    }
    let list = lipz(scene.path(), ["inspect", "build/game.lipzbank", "--show", "clips"]);
    assert!(list.stdout.starts_with("act1/aye "), "{}", list.stdout);
    let inside = lipz(&scene.path().join("voices"), ["check"]);
    assert!(inside.stderr.contains("--> ../voices/act1/aye.lipz:1:3"), "{}", inside.stderr);
    let packed = lipz(&scene.path().join("voices"), ["pack"]);
    let expected = "1 clip packed into ../build/game.lipzbank";
    assert!(packed.stdout.starts_with(expected), "{}", packed.stdout);
    assert!(packed.stdout.ends_with("\nwith the settings of ../lipz.toml\n"), "{}", packed.stdout);
    assert_eq!(lipz(scene.path(), ["pack"]).stdout.lines().count(), 1, "the settings file is not named");
}

#[test]
fn the_file_of_the_source_holds_wherever_the_command_runs() {
    let scene = project();
    scene.write("other/clip.lipz", CLIP);
    let elsewhere = tempfile::tempdir().unwrap();
    let voices = scene.path().join("voices");
    let absolute = lipz(elsewhere.path(), ["check".as_ref(), voices.as_os_str()]);
    assert_eq!((absolute.code, codes(&absolute.stderr)), (0, vec!["0502", "0702"]), "{}", absolute.stderr);
    let pattern = lipz(elsewhere.path(), ["check".into(), format!("{}/**/*.lipz", voices.display())]);
    assert_eq!((pattern.code, codes(&pattern.stderr)), (0, vec!["0502", "0702"]), "{}", pattern.stderr);
    // The nearest file takes precedence. Files elsewhere use the settings of the current folder.
    scene.write("other/lipz.toml", "default-locale = \"de-de\"\nlints.unknown-emotion = \"allow\"\n");
    let nearer = lipz(scene.path(), ["check", "other"]);
    assert!(nearer.stderr.contains("`text_de-de`"), "{}", nearer.stderr);
    assert_eq!(codes(&nearer.stderr), ["0502"]);
    fs::write(elsewhere.path().join("delivery.lipz"), CLIP).unwrap();
    let delivery = elsewhere.path().join("delivery.lipz");
    let delivered = lipz(scene.path(), ["check".as_ref(), delivery.as_os_str()]);
    assert_eq!((delivered.code, codes(&delivered.stderr)), (0, vec!["0502", "0702"]), "{}", delivered.stderr);
}

#[test]
fn flags_win_over_the_file() {
    let scene = project();
    let check = |arguments: &str| {
        let run = lipz(scene.path(), ["check"].into_iter().chain(arguments.split(' ')));
        (run.code, codes(&run.stderr).join(" "), run.stderr)
    };
    assert!(check("--config default-locale=de-de").2.contains("`text_de-de`"));
    assert_eq!(check("--allow text-without-locale,unknown-emotion").1, "");
    assert_eq!(check("--allow warnings --deny LZ0702").0, 1, "later flags take precedence");
    assert_eq!(check("--deny LZ0702 --allow warnings").1, "0502", "an error by default is not one of the warnings");
    let without = check("voices --no-config");
    assert_eq!((without.0, without.1.as_str()), (1, "0502 0702"));
    fs::write(scene.path().join("release.toml"), "sources = [\"voices\"]\nextended-locales = true\n").unwrap();
    assert_eq!(check("--config release.toml --config default-locale=es-419").0, 0);
    let refused = check("--config release.toml --config default-locale=es-419 --config extended-locales=false");
    assert_eq!(refused.0, 2);
    assert!(refused.2.contains("`es-419` is not a locale of the form ll-cc"), "{}", refused.2);
    let packed = |arguments: &[&str]| {
        scene.prepare(&[&["pack", "-o", "b.lipzbank"], arguments].concat());
        fs::read(scene.path().join("b.lipzbank")).unwrap().len()
    };
    let (plain, small) = (packed(&[]), packed(&["--config", "strip=true"]));
    fs::write(scene.path().join("lipz.toml"), "strip = true\ndefault-locale = \"en-us\"").unwrap();
    assert!(small < plain);
    assert_eq!((packed(&[]), packed(&["--config", "strip=false"])), (small, plain));
}

#[test]
fn levels_in_the_file() {
    let scene = project();
    let levels = |lints: &str| {
        scene.write("lipz.toml", format!("default-locale = \"en-us\"\n[lints]\n{lints}\n"));
        let run = lipz(scene.path(), ["check"]);
        (run.code, codes(&run.stderr).join(" "))
    };
    assert_eq!(levels("warnings = \"deny\""), (1, "0502 0702".into()));
    assert_eq!(
        levels("warnings = \"deny\"\nunknown-emotion = \"allow\""),
        (0, "0502".into()),
        "names take precedence over groups"
    );
    assert_eq!(levels("LZ0502 = \"allow\"\nLZ0702 = \"allow\""), (0, String::new()));
    fs::create_dir(scene.path().join("empty")).unwrap();
    scene.write("lipz.toml", "lints.no-sources = \"allow\"");
    let run = lipz(scene.path(), ["check", "empty"]);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "0 files checked\n", ""));
}

#[test]
fn levels_for_some_of_the_files() {
    let mut scene = Scene::new();
    let smug = r#"{ "text_en-us": "Aye.", "events": "feels smug", "note": 1 }"#;
    for name in ["voices/new.lipz", "voices/old/a.lipz", "voices/old/act1/b.lipz"] {
        scene.write(name, smug);
    }
    let check = |scene: &Scene, folder: &str, lints: &str, arguments: &[&str]| {
        scene.write("lipz.toml", format!("default-locale = \"en-us\"\nlints.unknown-element = \"allow\"\n{lints}\n"));
        let run = lipz(&scene.path().join(folder), ["check"].iter().chain(arguments));
        (run.code, run.stderr.matches("[LZ0702]").count(), run.stderr.matches("error[").count())
    };
    assert_eq!(check(&scene, "", "", &["voices"]), (0, 3, 0));
    let old = "[lints.\"voices/old/**\"]\nunknown-emotion = \"allow\"";
    assert_eq!(check(&scene, "", old, &["voices"]), (0, 1, 0));
    assert_eq!(check(&scene, "voices", old, &["."]), (0, 1, 0), "from a different folder");
    assert_eq!(check(&scene, "voices/old", old, &["act1"]), (0, 0, 0));
    assert_eq!(check(&scene, "", &old.replace("**", "*.lipz"), &["voices"]), (0, 2, 0), "a star matches no folder");
    assert_eq!(check(&scene, "", old, &["voices", "--deny", "unknown-emotion"]), (1, 3, 3), "flags take precedence");
    let denied = format!("{old}\n[lints.\"voices/old/act1/*\"]\nLZ0702 = \"deny\"");
    assert_eq!(check(&scene, "", &denied, &["voices"]), (1, 2, 1), "the last pattern counts");
    // The same for a lint that is allowed by default, in files that are clean without it.
    scene
        .write("voices/old/script.lipz", r#"{ "fps": 24, "visemes": "A", "text_en-us": "Aye.", "events": "jump(3)" }"#);
    scene.write("lipz.toml", "default-locale = \"en-us\"\n[lints.\"voices/old/**\"]\nother-events = \"warn\"\n");
    let others = lipz(scene.path(), ["check", "voices"]);
    assert!(others.stderr.contains("[LZ0707]"), "{}", others.stderr);
    fs::remove_file(scene.path().join("voices/old/script.lipz")).unwrap();
    // There is no bank if a file has an error, and none is reused from the previous levels.
    let pack = ["pack", "voices", "-o", "b.lipzbank", "--cache", "b.cache", "--quiet"];
    check(&scene, "", old, &["voices"]);
    scene.prepare(&pack);
    check(&scene, "", &denied, &["voices"]);
    let denied = lipz(scene.path(), pack);
    assert_eq!((denied.code, denied.stderr.matches("error[LZ0702]").count()), (1, 1), "{}", denied.stderr);
    scene.write("lipz.toml", "[lints.\"voices/***\"]\nunknown-emotion = \"allow\"\n");
    scene.expect("LZ1004-setting-value-file-pattern", &["check", "voices"]);
    scene.write("lipz.toml", "[lints.\"voices/**\"]\nunknown-emotoin = \"allow\"\nLZ0101 = \"alow\"\n");
    scene.expect("LZ1005-unknown-lint-of-files", &["check", "voices"]);
    scene.finish(2);
}

#[test]
fn elements_that_differ_in_segments_are_joined() {
    let mut scene = Scene::new();
    scene.write("voices/uneven.lipz", UNEVEN);
    scene.expect("LZ0601-segment-count-warned", &["check", "voices", "--quiet", "--warn", "segment-count"]);
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank", "--allow", "LZ0601"]);
    let json = lipz(scene.path(), ["inspect", "b.lipzbank", "uneven", "--output-format", "json"]);
    assert!(json.stdout.contains("\"Hello, dear Amy.\""), "{}", json.stdout);
    scene.prepare(&["unpack", "b.lipzbank", "-o", "out"]);
    let unpacked = fs::read_to_string(scene.path().join("out/uneven.lipz")).unwrap();
    assert!(unpacked.contains("\"Hello,|{softly} dear|Amy.\""), "{unpacked}");
    scene.prepare(&["pack", "out", "-o", "again.lipzbank", "--allow", "LZ0601"]);
    let bytes = |name| fs::read(scene.path().join(name)).unwrap();
    assert_eq!(bytes("b.lipzbank"), bytes("again.lipzbank"));

    scene.write("voices/uneven.lipz", r#"{ "text": "Aye." }"#);
    let warned = ["check", "voices", "--quiet", "--warn", "text-without-locale"];
    scene.expect("LZ0502-text-without-locale-warned", &warned);
    scene.finish(2);
}

#[test]
fn keys_count_from_the_root_wherever_the_command_runs() {
    let scene = project();
    scene.write("lipz.toml", "root = \"voices\"\noutput = \"b.lipzbank\"\ndefault-locale = \"en-us\"\n");
    for (folder, source) in [("", "voices/act1"), ("voices", "act1"), ("voices/act1", "."), ("voices/act1", "aye.lipz")]
    {
        let run = lipz(&scene.path().join(folder), ["pack", source]);
        assert_eq!(run.code, 0, "{folder}: {}", run.stderr);
        let list = lipz(scene.path(), ["inspect", "b.lipzbank", "--show", "clips"]);
        assert!(list.stdout.starts_with("act1/aye "), "{folder} {source}: {}", list.stdout);
    }
}

#[test]
fn without_sources_and_settings() {
    let mut scene = Scene::new();
    let none = lipz(scene.path(), ["check"]);
    assert_eq!((none.code, none.stdout.as_str()), (2, ""));
    assert!(none.stderr.contains("no sources are named") && none.stderr.contains("lipz init"), "{}", none.stderr);
    scene.write("voices/aye.lipz", "{ \"text_en-us\": \"Aye.\" }");
    let no_bank = lipz(scene.path(), ["pack", "voices"]);
    assert_eq!(no_bank.code, 2);
    assert!(no_bank.stderr.contains("--output"), "{}", no_bank.stderr);
    scene.expect("LZ1007-settings-unreadable-missing", &["check", "voices", "--config", "lipz.tmol"]);
    scene.expect("LZ1007-settings-unreadable-folder", &["check", "--config", "voices"]);
    scene.finish(2);
    for lint in ["unkown-emotion", "foreign-code"] {
        let run = lipz(".".as_ref(), ["check", "x", "--allow", lint]);
        assert_eq!(run.code, 2);
        let help = if lint == "foreign-code" { "cannot be lowered" } else { "did you mean `unknown-emotion`?" };
        assert!(run.stderr.contains(help), "{}", run.stderr);
    }
}

/// Returns the settings of a table as rows: name, default, effect.
fn rows(table: &Table) -> Vec<[String; 3]> {
    match &table.content {
        Content::Settings(settings) => {
            let row = |setting: &Setting| [setting.name, setting.default, setting.about].map(str::to_owned);
            settings.iter().map(row).collect()
        }
        Content::Map(map) => {
            let examples = map.examples.iter().map(|example| format!("`{example}`")).collect::<Vec<_>>();
            let about = format!("for example {}", examples.join(", "));
            vec![[map.name.into(), map.default.into(), about]]
        }
    }
}

/// Returns the settings of a table with their example values.
fn examples(table: &Table) -> Vec<(String, String)> {
    match &table.content {
        Content::Settings(settings) => {
            settings.iter().map(|setting| (setting.name.to_owned(), setting.example.to_owned())).collect()
        }
        Content::Map(map) => {
            let parts = map.examples.iter().map(|example| example.split_once(" = ").unwrap());
            parts.map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
        }
    }
}

#[test]
fn every_setting_can_be_set_on_the_command_line() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", r#"{ "text_en-us": "Aye." }"#);
    scene.write("terms.csv", "en-us,de-de\n");
    scene.write("fonts/game.ttf", font(500, &[]));
    // A width in pixels needs a font and its size.
    scene.write("lipz.toml", "[text]\nfont = \"fonts/game.ttf\"\nfont-pixels = 32\n");
    let check = |assignment: String| lipz(scene.path(), ["check", "voices", "--quiet", "--config", &assignment]);
    let mut count = 0;
    for table in TABLES {
        for (name, value) in examples(table) {
            let key = if table.name.is_empty() { name } else { format!("{}.{name}", table.name) };
            let run = check(format!("{key}={value}"));
            assert!(!run.stderr.contains("[LZ10") && !run.stderr.contains("[LZ16"), "{key}: {}", run.stderr);
            // A shell removes quotes. Without them, digits are a number.
            let unquoted = value.trim_matches('"');
            if unquoted.parse::<f64>().is_err() || unquoted == value {
                assert_eq!(check(format!("{key} = {unquoted}")).stderr, run.stderr, "{key}");
            }
            count += 1;
            let wrong = check(format!("{key}=[[1]]"));
            assert_eq!((wrong.code, wrong.stdout.as_str()), (2, ""), "{key}");
            assert!(wrong.stderr.contains("--> --config:1:"), "{key}: {}", wrong.stderr);
        }
    }
    assert!(count > 60, "{count}");
}

/// Returns a paragraph in lines of a page, which break only at spaces outside of inline code.
fn wrapped(paragraph: &str) -> String {
    // Each second part is code, whose spaces are hidden from the wrapping.
    let parts = paragraph.split('`').enumerate();
    let parts: Vec<String> =
        parts.map(|(index, part)| if index % 2 == 1 { part.replace(' ', "\u{a0}") } else { part.to_owned() }).collect();
    let options = textwrap::Options::new(100)
        .break_words(false)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit)
        .word_separator(textwrap::WordSeparator::AsciiSpace)
        .word_splitter(textwrap::WordSplitter::NoHyphenation);
    textwrap::fill(&parts.join("`"), options).replace('\u{a0}', " ")
}

#[test]
fn the_page_shows_every_setting_and_lint() {
    let mut made = String::new();
    for table in TABLES {
        let title = if table.name.is_empty() { "Above the first table".into() } else { format!("`[{}]`", table.name) };
        let about = wrapped(table.about);
        made += &format!("\n### {title}\n\n{about}\n\n| setting | default | meaning |\n| --- | --- | --- |\n");
        for [name, default, about] in rows(table) {
            made += &format!("| `{name}` | {default} | {about} |\n");
        }
    }
    made += "\n### Lints\n\nThe lints whose level you can set. All other diagnostics are errors, whatever the settings say.\n\n";
    made += "| code | name | default | reports that |\n| --- | --- | --- | --- |\n";
    for code in Code::ALL.iter().filter(|code| code.can_be_lowered()) {
        let level = match code.default_severity() {
            _ if code.is_allowed_by_default() => "allow",
            Severity::Error => "deny",
            _ => "warn",
        };
        made += &format!("| {code} | `{}` | {level} | {} |\n", code.name(), code.summary());
    }
    let page = fs::read_to_string(repository().join("docs/reference/settings.md")).unwrap();
    let (before, rest) = page.split_once("cargo test -p lipz -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end -->").unwrap();
    let mut comparison = Comparison::default();
    comparison
        .compare("docs/reference/settings.md", &format!("{before}cargo test -p lipz -->\n{made}\n<!-- end -->{after}"));
    comparison.finish(1);
}

#[test]
fn packing_again_with_a_cache() {
    let scene = project();
    scene.write("lipz.toml", "sources = [\"voices\"]\noutput = \"b.lipzbank\"\ncache = \"build/b.cache\"\n");
    scene.write("voices/act1/aye.lipz", r#"{ "text_en-us": "Aye." }"#);
    let pack = |arguments: &[&str]| {
        let run = lipz(scene.path(), ["pack", "--timings"].iter().chain(arguments));
        assert_eq!(run.code, 0, "{}", run.stderr);
        let mut lines = run.stdout.lines();
        (lines.next().unwrap().to_owned(), lines.next_back().unwrap().trim().to_owned())
    };
    let spared = |count| format!("{count} of 1 clip recalled from the bank");
    let first = pack(&[]);
    assert!(first.0.starts_with("1 clip packed into b.lipzbank ("), "{}", first.0);
    assert_eq!(first.1, spared(0));
    let again = pack(&[]);
    assert!(again.0.starts_with("1 clip unchanged in b.lipzbank ("), "{}", again.0);
    assert_eq!(again.1, spared(1));
    assert_eq!(pack(&["--cache", "other.cache"]), first);
    assert_eq!(pack(&["--config", "split-locales=true"]).1, spared(0));
    assert_eq!(pack(&[]), first, "the bank has changed");
    assert_eq!(pack(&[]), again);

    let refused = lipz(scene.path(), ["pack", "--cache", "lipz.toml"]);
    assert_eq!((refused.code, codes(&refused.stderr)), (2, vec!["0904"]), "{}", refused.stderr);
    assert!(refused.stderr.contains("`lipz.toml` is not a lipz cache and is not overwritten"), "{}", refused.stderr);
}

#[test]
fn patterns_that_match_nothing_are_reported() {
    let mut scene = Scene::new();
    let clip = r#"{ "fps": 24, "visemes": "MAEO", "text_en-us": "Good evening." }"#;
    for name in ["voices/act1/mayor.lipz", "voices/act1/cutscenes/end.lipz", "voices/de/act2/mayor.lipz"] {
        scene.write(name, clip);
    }
    scene.write("takes/readme.txt", "");
    let settings = |dubs: &str, lints: &str| {
        format!(
            "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[voices]\nde-de = \"de/{{key}}\"\n\
             [dubs]\n\"{dubs}\" = \"lip-sync\"\n[lints]\nwarnings = \"allow\"\nunused-pattern = \"warn\"\n\
             [lints.\"{lints}\"]\nunknown-emotion = \"allow\"\n"
        )
    };
    scene.write("lipz.toml", settings("act1/cutscene/**", "voices/act3/**"));
    scene.expect("LZ1008-unused-pattern", &["check", "--quiet"]);
    // In the keys of dubs, the pattern would have no effect.
    scene.write("lipz.toml", settings("de/**", "voices/**"));
    let found = lipz(scene.path(), ["check"]).stderr;
    assert!(found.contains("`de/**` in [dubs]") && !found.contains("`voices/**`"), "{found}");
    // Levels apply to other files too.
    for lints in ["voices/act1/*", "./voices/**/end.lipz", "takes/**", "takes/*.txt"] {
        scene.write("lipz.toml", settings("act1/cutscenes/**", lints));
        assert_eq!(lipz(scene.path(), ["check", "--quiet"]).stderr, "", "{lints}");
    }
    // A part of the project does not show whether a pattern matches.
    scene.write("lipz.toml", settings("act1/cutscene/**", "voices/act3/**"));
    assert_eq!(lipz(scene.path(), ["check", "voices/act1", "--quiet"]).stderr, "");
    assert_eq!(lipz(scene.path(), ["check", "--quiet", "--allow", "unused-pattern"]).stderr, "");
    scene.finish(1);
}
