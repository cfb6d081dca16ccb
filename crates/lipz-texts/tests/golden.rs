//! The expected exchange files: `fixtures/texts`. `LIPZ_BLESS=1` rewrites them.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_texts::{Collect, Division, Exchange, Format, Shape, State, Unit, WriteOptions, write};
use std::fs;
use std::path::Path;

/// Returns two clips: several segments with everything that a file may contain, and a minimal one.
fn exchange() -> Exchange {
    let clips = [
        (
            "act1/mayor",
            r#"{ "fps": 24, "visemes": "MAAAEO----|MAAAAEEO--|", "events": "|points door|",
                 "text_en-us": "{speaker: Mara} Mayor? |{louder} \"Mayor\"!\nOpen up. |",
                 "text_de-de": "Herr Bürgermeister? |{louder} Bürgermeister!\nMacht auf. |" }"#,
        ),
        ("formula", r#"{ "text_en-us": "- No; nothing, \\o/", "text_fr-fr": "=Rien" }"#),
    ];
    let collect = Collect::new("en-us", ["de-de", "fr-fr"]).limits(Some(74), Some(17.0));
    let unit = |(key, file): &(&str, &str)| -> Unit {
        let document = lipz_file::parse(file.as_bytes()).document.unwrap();
        let mut unit = collect.unit(key, &document, &mut Vec::new()).unwrap();
        unit.file = Some(format!("voices/{key}.lipz"));
        unit.recording = Some(format!("recordings take 2/{key}.wav"));
        unit
    };
    let mut units: Vec<Unit> = clips.iter().map(unit).collect();
    units[0].note = Some("The mayor is deaf.\nSo she shouts.".into());
    units[0].translations[0].made_from = Some(vec!["Sir?".into(), "{louder} Sir!".into(), String::new()]);
    units[1].translations[1].state = State::Reviewed;
    Exchange { source_locale: "en-us".into(), locales: vec!["de-de".into(), "fr-fr".into()], units }
}

#[test]
fn files_are_as_they_were() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/texts");
    let is_blessing = std::env::var_os("LIPZ_BLESS").is_some();
    let ways = [
        ("clips", Format::Po, WriteOptions::new()),
        ("unreal", Format::Po, WriteOptions::new().namespace(Some("Dialogue".into()))),
        ("segments", Format::Po, WriteOptions::new().division(Division::Segment)),
        ("xliff-2.1", Format::Xliff, WriteOptions::new()),
        ("xliff-1.2", Format::Xliff12, WriteOptions::new()),
        ("all", Format::Json, WriteOptions::new()),
        ("sheet", Format::Csv, WriteOptions::new()),
        ("sheet-segments", Format::Csv, WriteOptions::new().division(Division::Segment)),
        ("unity", Format::Csv, WriteOptions::new().shape(Shape::Unity)),
        ("godot", Format::Csv, WriteOptions::new().shape(Shape::Godot).raw_cells(true)),
        ("unreal", Format::Csv, WriteOptions::new().shape(Shape::Unreal)),
        ("yarn", Format::Csv, WriteOptions::new().shape(Shape::Yarn)),
    ];
    for (name, format, options) in ways {
        let written = write(format, &exchange(), &options);
        assert_eq!(written.diagnostics, []);
        for file in written.files {
            let locale = file.locale.map(|locale| format!(".{locale}")).unwrap_or_default();
            let path = folder.join(format!("{name}{locale}.{}", format.extension()));
            if is_blessing {
                fs::write(&path, &file.bytes).unwrap();
            }
            let expected = fs::read(&path).unwrap_or_default();
            let shown = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            assert!(file.bytes == expected, "{}:\n{}", path.display(), shown(&file.bytes));
        }
    }
}
