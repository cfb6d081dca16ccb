//! Babble profiles from settings and viewers to banks, and the diagnostics about wrong ones.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_bank::babble::Babble;
use lipz_bank::{Bank, Fps};
use support::{Scene, lipz};

/// Returns a setting in a viewer's format.
fn setting(name: &str, typed_value: &str) -> String {
    format!(
        "    <key>{name}</key>\n    <map>\n      <key>Comment</key>\n      <string>Babble</string>\n      \
         <key>Persist</key>\n      <integer>1</integer>\n      <key>Value</key>\n      {typed_value}\n    </map>\n"
    )
}

fn settings(all: &[(&str, &str)]) -> String {
    let all: String = all.iter().map(|(name, value)| setting(name, value)).collect();
    format!(
        "<?xml version=\"1.0\" ?>\n<llsd>\n  <map>\n{}{all}  </map>\n</llsd>\n",
        setting("UIScale", "<real>1</real>")
    )
}

const VIEWERS_OWN: &str = "\
[babble]
ooh = \"1247898743223344444443200000\"
aah = \"257998776531013446642343\"
ooh-power-transfer = \"0012345566778899\"
aah-power-transfer = \"0000123456789\"
rate = 24
";

/// Runs `lipz print babble` on a file.
fn babble(file: &str) -> (i32, String, String) {
    let scene = Scene::new();
    scene.write("settings.xml", file);
    let run = lipz(scene.path(), ["print", "babble", "settings.xml"]);
    (run.code, run.stdout, run.stderr)
}

/// Returns the diagnostics about a file with one wrong setting.
fn refused(all: &[(&str, &str)]) -> String {
    let (code, stdout, stderr) = babble(&settings(all));
    assert_eq!((code, stdout.as_str()), (1, ""), "{stderr}");
    stderr
}

#[test]
fn settings_that_cannot_be_read_are_named() {
    let scene = Scene::new();
    scene.write("user_settings/settings.xml", "");
    for (path, message) in
        [("settings.xml", "`settings.xml` does not exist"), ("user_settings", "`user_settings` is a folder")]
    {
        let run = lipz(scene.path(), ["print", "babble", path]);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""));
        assert!(run.stderr.starts_with(&format!("error[LZ0001]: {message}\n")), "{}", run.stderr);
    }
}

#[test]
fn a_viewer_with_defaults_has_the_built_in_profile() {
    let file = settings(&[("LipSyncEnabled", "<boolean>1</boolean>")]);
    assert_eq!(babble(&file), (0, VIEWERS_OWN.into(), String::new()));
}

#[test]
fn a_viewers_profile_goes_through_settings_into_the_bank() {
    let scene = Scene::new();
    let own = [
        ("LipSyncEnabled", "<boolean>1</boolean>"),
        ("LipSyncOohAahRate", "<real>12.5</real>"),
        ("LipSyncOoh", "<string>09</string>"),
        ("LipSyncAah", "<string>9</string>"),
        ("LipSyncOohPowerTransfer", "<string>5</string>"),
        ("LipSyncAahPowerTransfer", "<string>0009</string>"),
    ];
    scene.write("settings.xml", settings(&own));
    scene.write("voices/hello.lipz", r#"{ "text_en-us": "Hello." }"#);
    let toml = lipz(scene.path(), ["print", "babble", "settings.xml", "robot"]);
    assert_eq!((toml.code, toml.stderr.as_str()), (0, ""));
    scene.write("lipz.toml", format!("sources = [\"voices\"]\n[babble]\nrate = 30\n{}", toml.stdout));
    assert_eq!(lipz(scene.path(), ["pack", "-o", "voices.lipzbank"]).code, 0);
    let bytes = std::fs::read(scene.path().join("voices.lipzbank")).unwrap();
    let bank = Bank::open(&bytes).and_then(Bank::verify).unwrap();
    let robot = bank.babble("robot").unwrap();
    assert_eq!((robot.ooh(), robot.aah(), robot.rate()), (&b"09"[..], &b"9"[..], Fps::new(25, 2).unwrap()));
    assert_eq!((robot.ooh_power_transfer(), robot.aah_power_transfer()), (&b"5"[..], &b"0009"[..]));
    let own = bank.default_babble();
    assert_eq!((own.rate(), own.ooh()), (Fps::whole(30), Babble::DEFAULT.ooh()));
    assert!(bank.babbles().map(|babble| babble.name()).eq(["default", "robot"]));
    let shown = lipz(scene.path(), ["inspect", "voices.lipzbank"]).stdout;
    assert!(shown.contains("\n  BABL "), "{shown}");
    assert!(
        shown.ends_with(
            "\n  babble robot, 12.500 digits a second\n  ooh          09  power 5\n  aah          9  power 0009\n"
        ),
        "{shown}"
    );
    assert_eq!(lipz(scene.path(), ["pack", "--config", "split-locales=true", "-o", "base.lipzbank"]).code, 0);
    let bytes = std::fs::read(scene.path().join("base.lipzbank")).unwrap();
    assert_eq!(Bank::open(&bytes).and_then(Bank::verify).unwrap().babble("robot"), Some(robot));
}

#[test]
fn wrong_settings_of_a_viewer_are_marked() {
    let found = refused(&[("LipSyncOoh", "<string>12a4</string>")]);
    let expected = "error[LZ1401]: `LipSyncOoh` contains `a`, which is not a digit\n  --> settings.xml:20:17\n";
    assert!(found.starts_with(expected), "{found}");
    assert!(found.contains("<string>12a4</string>") && found.contains("\n   |                 ^\n"), "{found}");
    for (name, value, start) in [
        ("LipSyncAah", "<string />", "error[LZ1401]: `LipSyncAah` is empty\n"),
        ("LipSyncAah", "<string>1&#50;x</string>", "error[LZ1401]: `LipSyncAah` contains `x`, which is not a digit\n"),
        ("LipSyncOohAahRate", "<real>0</real>", "error[LZ1402]: `LipSyncOohAahRate` is outside 1 to 1000\n"),
        ("LipSyncOohAahRate", "<real>nan</real>", "error[LZ1402]: "),
        ("LipSyncOohAahRate", "<real>-24</real>", "error[LZ1402]: "),
        (
            "LipSyncAah",
            "<integer>257</integer>",
            "error[LZ1404]: `LipSyncAah` has the type integer, but must be a string of digits\n",
        ),
        (
            "LipSyncEnabled",
            "<string>yes</string>",
            "error[LZ1404]: `LipSyncEnabled` has the type string, but must be 0 or 1\n",
        ),
        ("LipSyncOoh", "", "error[LZ1404]: `LipSyncOoh` has no value\n"),
    ] {
        let found = refused(&[(name, value)]);
        assert!(found.starts_with(start), "{value}: {found}");
        assert!(found.contains("--> settings.xml:"), "{found}");
    }
    let (code, stdout, stderr) = babble(&settings(&[("LipSyncEnabled", "<integer>0</integer>")]));
    assert_eq!((code, stdout.as_str()), (0, VIEWERS_OWN));
    assert!(stderr.starts_with("warning[LZ1405]: lip sync is off"), "{stderr}");
}

#[test]
fn other_files_are_refused() {
    for (file, start) in [
        ("<settings/>", "error[LZ1403]: `settings.xml` is not LLSD: it starts with <settings>\n"),
        ("<llsd><array/></llsd>", "error[LZ1403]: `settings.xml` is not LLSD: no <map> of settings in <array>\n"),
        ("<llsd/>", "error[LZ1403]: `settings.xml` is not LLSD: no <map> of settings in <llsd>\n"),
        ("{}", "error[LZ1403]: `settings.xml` is not XML: "),
        ("<!DOCTYPE a [<!ENTITY b \"c\">]><llsd><map/></llsd>", "error[LZ1403]: `settings.xml` is not XML: "),
    ] {
        let (code, stdout, stderr) = babble(file);
        assert_eq!((code, stdout.as_str()), (1, ""));
        assert!(stderr.starts_with(start), "{stderr}");
    }
    let whole = settings(&[("LipSyncOoh", "<string>1234</string>")]);
    for length in 0..whole.len() - "</llsd>\n".len() {
        let (code, stdout, stderr) = babble(&whole[..length]);
        assert_eq!((code, stdout.as_str()), (1, ""), "{length}: {stderr}");
    }
    let missing = lipz(Scene::new().path(), ["print", "babble", "settings.xml"]);
    assert_eq!(missing.code, 2, "{}", missing.stderr);
}

#[test]
fn wrong_profiles_of_a_project_are_marked() {
    for (toml, start, caret) in [
        (
            "ooh = \"12a4\"",
            "error[LZ1401]: `babble.ooh` contains `a`, which is not a digit\n --> lipz.toml:2:10\n",
            "         ^\n",
        ),
        ("aah = \"\"", "error[LZ1401]: `babble.aah` is empty\n --> lipz.toml:2:7\n", "      ^^\n"),
        (
            "robot = { ooh-power-transfer = \"1٣\" }",
            "error[LZ1401]: `babble.robot.ooh-power-transfer` contains `٣`, ",
            "^\n",
        ),
        ("rate = 0", "error[LZ1402]: `babble.rate` is outside 1 to 1000\n --> lipz.toml:2:8\n", "       ^\n"),
        ("robot.rate = -24.0", "error[LZ1402]: `babble.robot.rate` is outside 1 to 1000\n", "^^^^^\n"),
        ("ohh = \"1\"", "error[LZ1002]: `ohh` is not a setting of a babble profile\n", "^^^\n"),
        ("robot.speed = 1", "error[LZ1002]: `speed` is not a setting of a babble profile\n", "^^^^^\n"),
        ("ooh = 123", "error[LZ1003]: `babble.ooh` is a number, not a string of digits\n", "^^^"),
        ("rate = \"24\"", "error[LZ1003]: `babble.rate` is a string, not a number\n", "^^^^"),
        ("\"\" = { rate = 24 }", "error[LZ1004]: a babble profile has a name that is empty or too long\n", "^^\n"),
    ] {
        let scene = Scene::new();
        scene.write("lipz.toml", format!("[babble]\n{toml}\n"));
        scene.write("hello.lipz", r#"{ "text_en-us": "Hello." }"#);
        let run = lipz(scene.path(), ["check"]);
        assert!(run.code != 0 && run.stderr.starts_with(start), "{toml}: {}", run.stderr);
        assert!(run.stderr.contains(caret), "{toml}: {}", run.stderr);
    }
}

#[test]
fn settings_without_lip_sync_are_told() {
    let mut scene = Scene::new();
    scene.write("settings_per_account.xml", settings(&[]));
    let run = lipz(scene.path(), ["print", "babble", "settings_per_account.xml"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, VIEWERS_OWN));
    let printed = support::Outcome { stdout: String::new(), ..run };
    scene.expect_outcome("LZ1406-no-lip-sync-settings", &printed);
    scene.finish(1);
}
