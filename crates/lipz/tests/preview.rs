//! `lipz preview` as its own page sees it: its responses.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Value, json};
use std::fs;
use std::time::Duration;
use support::preview::{MAYOR, Preview, change, project};
use support::{Scene, lipz};

#[test]
fn the_page_gets_the_bank_that_a_game_gets() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
    let page = preview.get("");
    assert_eq!(page.status, 200);
    assert!(page.head.contains("frame-ancestors 'none'"), "{}", page.head);
    let list = preview.get("api/clips").json();
    let keys: Vec<&str> = list["clips"].as_array().unwrap().iter().map(|clip| clip["key"].as_str().unwrap()).collect();
    assert_eq!(keys, ["act1/mayor", "act1/otto"]);
    assert_eq!(list["clips"][1]["is_left_out"], true, "it has an error: {list}");
    assert_eq!(list["clips"][1]["errors"], 1);
    let clip = preview.get("api/clip?key=act1%2Fotto").json();
    assert_eq!(clip["diagnostics"][0]["code"], "LZ0601", "{clip}");
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    assert_eq!(lipz(scene.path(), ["pack", "voices", "-o", "a.lipzbank"]).code, 0);
    assert_eq!(preview.get("api/bank").body, fs::read(scene.path().join("a.lipzbank")).unwrap());
    assert_eq!(preview.get("api/clip?key=nobody").status, 404);
    assert_eq!(preview.get("api/sound?key=act1%2Fmayor").status, 404);
    assert_eq!(preview.get("../../../../etc/passwd").status, 404);
    assert_eq!(preview.get("web/lipz.wasm").body.get(..4), Some(&b"\0asm"[..]));
}

/// Characters come from events, from `{speaker: …}` in texts, from words of keys, and for dubs from their originals.
/// The same applies to a bank.
#[test]
fn the_list_knows_who_is_in_a_clip() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[registry]\ncharacters = [\"Ivo\", \"Old_Man\", \"mara\", \"otto\"]\n[voices]\nen-us = \"en/{key}\"\nde-de = \"de/{key}\"\n");
    let clip = |text: &str, events: &str| {
        format!(r#"{{ "visemes": "MA--|EO--", "fps": 24, "text_en-us": "{text}", "events": "{events}" }}"#)
    };
    scene.write("voices/en/one.lipz", clip("{speaker: Mara} Hi.|Well.", "otto feels sad|"));
    scene.write("voices/en/otto/two.lipz", clip("Hi.|{speaker:} {speaker: Ärzte} Well.", "|"));
    scene.write("voices/en/three-IVO_x.lipz", clip("Hi.|Ivory.", "|"));
    scene.write("voices/en/ivory.lipz", clip("Hi.|Well.", "|"));
    scene.write("voices/en/old-man_the-queen.lipz", clip("Hi.|Well.", "old-mill feels sad|"));
    scene.write("voices/en/old_mill-man/queen.lipz", clip("Hi.|Well.", "|"));
    scene.write("voices/en/queen.lipz", clip("{speaker: The Queen} Hi.|Well.", "|"));
    scene.write("voices/de/one.lipz", r#"{ "visemes": "MA--|EO--", "fps": 24 }"#);
    scene.write("voices/en/broken-mara.lipz", "{");
    let of = |preview: &Preview| {
        let list = preview.get("api/clips").json();
        let row = |clip: &Value| format!("{} {}", clip["key"].as_str().unwrap(), clip["characters"]);
        list["clips"].as_array().unwrap().iter().map(row).collect::<Vec<_>>()
    };
    let found = of(&Preview::start(&scene, &[]));
    let expected = [
        r#"de/one ["mara","otto"]"#,
        r#"en/broken-mara ["mara"]"#,
        "en/ivory null",
        r#"en/old-man_the-queen ["Old_Man","The Queen","old-mill"]"#,
        r#"en/old_mill-man/queen ["old-mill"]"#,
        r#"en/one ["mara","otto"]"#,
        r#"en/otto/two ["otto","Ärzte"]"#,
        r#"en/queen ["The Queen"]"#,
        r#"en/three-IVO_x ["Ivo"]"#,
    ];
    assert_eq!(found, expected);
    fs::remove_file(scene.path().join("voices/en/broken-mara.lipz")).unwrap();
    assert_eq!(lipz(scene.path(), ["pack", "-o", "a.lipzbank"]).code, 0);
    let of_bank = of(&Preview::start(&scene, &["a.lipzbank"]));
    assert_eq!(of_bank[0], r#"de/one ["Mara","otto"]"#, "only the text spells her name");
}

#[test]
fn of_a_clip_with_errors_what_is_right_is_shown() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
    let edit = json!({ "text_de-de": "Meister?", "text_fr-fr": "Maire ?|Maire !" });
    let answer = preview.post("api/draft", &change(MAYOR, &edit));
    let (document, bank) = answer.drafted();
    assert_eq!(document["diagnostics"][0]["code"], "LZ0601", "{document}");
    let bank = lipz_bank::Bank::open(bank).unwrap();
    let tags: Vec<&str> = bank.locales().map(|locale| bank.locale_tag(locale)).collect();
    assert_eq!(tags, ["en-us", "fr-fr"], "a text with too few segments is omitted");
    assert_eq!(bank.clip_by_key("act1/mayor").unwrap().segments().count(), 2);
    let answer = preview.post("api/draft", &change("{ \"visemes\": 1 ", &json!({})));
    assert_eq!(answer.drafted().0["result"], "refused", "no document, no draft");
}

const DUBBED: &str = "sources = [\"v\"]\nroot = \"v\"\ndefault-locale = \"en-us\"\n[voices]\nen-us = \"{key}\"\n\
                      de-de = \"de/{key}\"\n[lints]\nwarnings = \"deny\"\n";
const DUB: &str = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AAA-" }"#;

/// Returns a project with a dub whose original has these visemes.
fn dubbed(visemes: &str) -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", DUBBED);
    let rest = r#""text_en-us": "Aye!", "text_de-de": "Ja!""#;
    let original = format!(r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "{visemes}", {rest} }}"#);
    scene.write("v/aye.lipz", original);
    scene.write("v/de/aye.lipz", DUB);
    scene
}

#[test]
fn a_dub_is_packed_with_its_original() {
    let scene = dubbed("MA-");
    let preview = Preview::start(&scene, &[]);
    let edit = json!({ "key": "de/aye", "source": DUB, "elements": { "visemes": "EAA-" } });
    let answer = preview.post("api/draft", &edit);
    let (document, bank) = answer.drafted();
    assert_eq!(document["diagnostics"], json!([]));
    let bank = lipz_bank::Bank::open(bank).unwrap();
    let segment = bank.clip_by_key("de/aye").unwrap().segments().next().unwrap();
    assert_eq!(segment.text(bank.locale("de-de").unwrap()).unwrap().as_str(), "Ja!");
    assert_eq!(preview.post("api/save", &edit).json()["result"], "saved");
}

#[test]
fn a_dub_is_not_to_blame_for_its_original() {
    let scene = dubbed("M?-");
    let preview = Preview::start(&scene, &[]);
    let edit = json!({ "key": "de/aye", "source": DUB, "elements": { "visemes": "EAA-" } });
    let answer = preview.post("api/draft", &edit);
    let (document, bank) = answer.drafted();
    assert_eq!(document["diagnostics"], json!([]));
    let bank = lipz_bank::Bank::open(bank).unwrap();
    let segment = bank.clip_by_key("de/aye").unwrap().segments().next().unwrap();
    assert_eq!(segment.text(bank.locale("de-de").unwrap()).unwrap().as_str(), "Ja!", "its texts are right");
    let wrong = json!({ "key": "de/aye", "source": DUB, "elements": { "visemes": "E?A-" } });
    assert_eq!(preview.post("api/save", &wrong).json()["diagnostics"][0]["code"], "LZ0401", "its own errors count");
    assert_eq!(preview.post("api/save", &edit).json()["result"], "saved");
    assert!(fs::read_to_string(scene.path().join("v/de/aye.lipz")).unwrap().contains("EAA-"));
    // An original that is not valid JSON cannot be compared.
    scene.write("v/aye.lipz", "{ \"fps\": ");
    let source = fs::read_to_string(scene.path().join("v/de/aye.lipz")).unwrap();
    let edit = json!({ "key": "de/aye", "source": source, "elements": { "visemes": "OAA-" } });
    assert_eq!(preview.post("api/save", &edit).json()["result"], "saved");
}

#[test]
fn texts_in_files_of_their_own_are_shown() {
    let scene = project();
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    let file = MAYOR.replace("\"note\"", "\"text_de-de\": \"Meister?|Meister!\", \"note\"");
    scene.write("voices/act1/mayor.lipz", file);
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank", "--config", "split-locales=true"]);
    let preview = Preview::start(&scene, &["a.lipzbank+a.*.lipztexts"]);
    assert_eq!(preview.get("api/clips").json()["locales"], json!(["de-de", "en-us"]));
    let bytes = preview.get("api/bank").body;
    let bank = lipz_bank::Bank::open(&bytes).unwrap().verify().unwrap();
    let segment = bank.clip_by_key("act1/mayor").unwrap().segment(1).unwrap();
    assert_eq!(segment.text(bank.locale("de-de").unwrap()).unwrap().as_str(), "Meister!");
    let refused = lipz(scene.path(), ["preview", "voices+a.de-de.lipztexts"]);
    assert!(refused.code == 2 && refused.stderr.contains("`voices`"), "{refused:?}");
}

#[test]
fn of_one_file_the_rest_of_the_project_is_not_missed() {
    let scene = project();
    let samples = [0_i16; 8000];
    for name in ["mayor", "nobody"] {
        scene.write(&format!("recordings/act1/{name}.wav"), support::sound::wav(16_000, &samples));
    }
    let told = |source: &str| {
        let preview = Preview::start(&scene, &[source, "--config", "root=voices", "--audio", "recordings"]);
        // The first version is 0. If the recordings have been compared before the first request, no later change
        // follows.
        preview.get("api/changes?since=0");
        preview.get("api/clips").json()["diagnostics"].to_string()
    };
    assert!(told("voices").contains("LZ1702"));
    let single = told("voices/act1/mayor.lipz");
    assert!(!single.contains("LZ1702"), "{single}");
}

/// Returns a project with a recording of a sentence.
fn recorded() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n");
    scene.write("rec/bobby.wav", fs::read(support::repository().join("fixtures/speech/bobby.wav")).unwrap());
    scene.write("voices/bobby.lipz", "{ \"text_en-us\": \"Bobby ripped the ledger.\" }");
    scene
}

#[test]
fn the_phones_of_a_synced_clip_are_known() {
    let scene = recorded();
    let preview = Preview::start(&scene, &[]);
    assert_eq!(preview.get("api/phones?key=bobby").json(), json!([]), "nothing was synced");
    drop(preview);
    scene.prepare(&["sync", "--config", "sync.textgrids=grids", "--quiet"]);
    let phones = |options: &[&str]| Preview::start(&scene, options).get("api/phones?key=bobby").json();
    let heard = phones(&[]);
    let names: Vec<&str> = heard.as_array().unwrap().iter().map(|found| found["phone"].as_str().unwrap()).collect();
    assert!(names.starts_with(&["B", "AA"]) && names.contains(&"JH"), "{heard}");
    let grid = fs::read_to_string(scene.path().join("grids/bobby.TextGrid")).unwrap();
    let from_grid = grid.lines().filter(|line| line.trim() == "text = \"JH\"").count();
    assert_eq!(names.iter().filter(|name| **name == "JH").count(), from_grid, "as in the TextGrid");
    // Manual corrections take precedence.
    let settings = fs::read_to_string(scene.path().join("lipz.toml")).unwrap();
    scene.write("lipz.toml", settings + "[sync]\ntextgrids = \"grids\"\n");
    scene.write("grids/bobby.TextGrid", grid.replace("\"JH\"", "\"ZH\""));
    assert!(phones(&[]).to_string().contains("\"ZH\""));
    // An exported page contains them.
    assert_eq!(lipz(scene.path(), ["preview", "--output", "site"]).code, 0);
    let clip = fs::read_to_string(scene.path().join("site/data/clip-0.js")).unwrap();
    assert!(clip.contains(r#""phones":[{"phone":"B","#) && clip.contains("\"ZH\""), "{clip}");
    // Another take, which lipz has not analysed yet.
    scene.write("rec/bobby.wav", support::sound::voice(&[(true, 900)], 2));
    assert_eq!(phones(&[]), json!([]));
}

#[test]
fn recordings_are_named_on_the_command_line_too() {
    let scene = project();
    let samples: Vec<i16> = (0..8000).map(|at| if at % 80 < 40 { 900 } else { -900 }).collect();
    scene.write("recordings/act1/mayor.wav", support::sound::wav(16_000, &samples));
    let preview = Preview::start(&scene, &["voices", "--audio", "recordings"]);
    assert_eq!(preview.get("api/clips").json()["clips"][0]["has_sound"], true);
    assert_eq!(preview.get("api/sound?key=act1%2Fmayor").body.get(..4), Some(&b"RIFF"[..]));
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank"]);
    let bank = Preview::start(&scene, &["a.lipzbank", "--audio", "recordings"]);
    assert_eq!(bank.get("api/clips").json()["clips"][0]["has_sound"], true);
    assert_eq!(bank.get("api/clip?key=act1%2Fmayor").json()["has_sound"], true);
    assert_eq!(bank.get("api/sound?key=act1%2Fmayor").status, 200);
    assert_eq!(lipz(scene.path(), ["preview", "a.lipzbank", "--audio", "nowhere"]).code, 2);
}

#[test]
fn keys_with_spaces_and_signs_are_kept_apart() {
    let scene = Scene::new();
    for key in ["a b", "a+b", "ä&c"] {
        let file = format!(r#"{{ "visemes": "MA", "fps": 24, "text_en-us": "{key}" }}"#);
        scene.write(&format!("v/{key}.lipz"), file);
    }
    let preview = Preview::start(&scene, &["v"]);
    // As pages encode them, in both forms.
    for (query, key) in [("a+b", "a b"), ("a%20b", "a b"), ("a%2Bb", "a+b"), ("%C3%A4%26c", "ä&c")] {
        let clip = preview.get(&format!("api/clip?key={query}")).json();
        assert_eq!(clip["key"], key);
        assert_eq!(clip["elements"][1], json!(["text_en-us", key]), "{clip}");
    }
}

#[test]
fn a_retake_is_noticed() {
    let scene = project();
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.write("recordings/act1/mayor.wav", support::sound::wav(16_000, &[0; 8000]));
    let preview = Preview::start(&scene, &["voices", "--config", "root=voices", "--audio", "recordings"]);
    let settled = |mut version: u64| loop {
        let next = preview.get("api/clips").json()["version"].as_u64().unwrap();
        if next == version {
            return version;
        }
        version = next;
        std::thread::sleep(Duration::from_millis(1500));
    };
    let before = settled(u64::MAX);
    scene.write("recordings/act1/mayor.wav", support::sound::wav(16_000, &[0; 4000]));
    let changed = preview.get(&format!("api/changes?since={before}")).json()["version"].as_u64();
    assert_ne!(changed, Some(before), "the page hears of it");
}

#[test]
fn a_clip_shows_the_images_of_its_character() {
    let scene = Scene::new();
    let clip =
        |key: &str| scene.write(&format!("v/{key}.lipz"), r#"{ "visemes": "MA-", "fps": 24, "text_en-us": "Hi." }"#);
    ["mara-hello", "otto-hello", "crowd"].into_iter().for_each(clip);
    scene.write("art/A.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    scene.write("art/rest.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    scene.write("art/mara.png", [0x89, b'P', b'N', b'G', 0]);
    scene.write("art/secret.png", "not an image");
    let settings = |otto: &str| {
        let names = "[registry]\ncharacters = [\"mara\", \"Otto\"]\n";
        let sprites = "[sprites]\ndefault = \"art/{code}.svg\"\nmara = \"art/mara.png#-MA\"\n";
        scene.write("lipz.toml", format!("sources = [\"v\"]\n{names}{sprites}{otto}"));
    };
    settings("otto = \"art/secret.png#-MA\"\n");
    let preview = Preview::start(&scene, &[]);
    let sets = preview.get("api/sprites").json();
    assert_eq!(sets["mara"]["codes"], "-MA");
    let images = sets["default"]["images"].as_object().unwrap();
    assert_eq!(images.keys().collect::<Vec<_>>(), ["-", "A"]);
    assert!(images["A"].as_str().unwrap().starts_with("data:image/svg+xml;base64,"));
    assert!(sets.get("otto").is_none() && !sets.to_string().contains("bm90IGFu"), "other files stay out: {sets}");
    let list = preview.get("api/clips").json();
    assert!(list.to_string().contains("it is not an image"), "{list}");
    let of = |key: &str| preview.get(&format!("api/clip?key={key}")).json()["sprites"].clone();
    assert_eq!([of("mara-hello"), of("otto-hello"), of("crowd")], ["mara", "default", "default"]);
    drop(preview);
    settings("otto = \"art/rest.svg#-\"\n");
    assert_eq!(lipz(scene.path(), ["preview", "--output", "site"]).code, 0);
    let script = fs::read_to_string(scene.path().join("site/data/sprites.js")).unwrap();
    assert!(script.contains("\"otto\":{\"sheet\":\"data:image/svg+xml"), "{script}");
}
