//! Import of the fixtures: `NAME.expected` next to each contains its clips and diagnostics. `LIPZ_BLESS=1` rewrites
//! these files.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_file::format::{Style, format};
use lipz_interop::{ImportOptions, formats, import};
use std::fmt::Write;
use std::fs;
use support::{every_fixture, fixtures};

#[test]
fn every_fixture_becomes_what_is_expected() {
    let blessing = std::env::var_os("LIPZ_BLESS").is_some();
    let mut differences = Vec::new();
    for (of, file, bytes) in every_fixture() {
        let options = ImportOptions::new().locale("en-us");
        let imported = import(of, &bytes, &options);
        let mut text = String::new();
        for diagnostic in &imported.diagnostics {
            writeln!(text, "{}[{}]: {}", diagnostic.severity, diagnostic.code, diagnostic.message).unwrap();
        }
        for clip in &imported.clips {
            writeln!(text, "{} by {}, {} frames", clip.name.as_deref().unwrap_or("clip"), clip.map, clip.frames)
                .unwrap();
            text += &format(&clip.document, Style::default());
        }
        let expected = file.with_extension(format!("{}.expected", file.extension().unwrap().to_str().unwrap()));
        if blessing {
            fs::write(expected, text).unwrap();
        } else if fs::read_to_string(&expected).unwrap_or_default() != text {
            differences.push(format!("{}:\n{text}", expected.display()));
        }
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

#[test]
fn every_imported_format_has_a_fixture_and_its_tables() {
    for of in formats::ALL {
        assert!(
            of.read.is_none() || !fixtures(of).is_empty(),
            "fixtures/interop/{}: put a file of the tool there",
            of.name
        );
        for map in of.maps {
            assert!(lipz_interop::find_map(map).is_some(), "{}: src/map/built_in.rs has no table `{map}`", of.name);
        }
    }
}

#[test]
fn text_and_shapes_have_the_same_segments() {
    let tsv = b"0.00\tX\n0.20\tB\n1.00\tX\n1.50\tD\n2.60\tX\n3.00\tX\n";
    let of = formats::find("rhubarb-tsv").unwrap();
    let segments = |text, segments| {
        let options = ImportOptions::new().text(text).locale("en-us").segments(segments);
        let document = import(of, tsv, &options).clips.remove(0).document;
        (document.string("visemes").unwrap().find('|'), document.string("text_en-us").unwrap().to_owned())
    };
    use lipz_interop::Segments::{None, Pauses, Phrases, Sentences};
    let divided = (Some(36), "Let me think...|It was you!".to_owned());
    for way in [Pauses, Sentences] {
        assert_eq!(segments("Let me think... It was you!", way), divided);
    }
    assert_eq!(segments("Let me think... | It was you!", None), divided, "marks in the text count always");
    for way in [None, Phrases] {
        assert_eq!(segments("Let me think... It was you!", way).0, Option::None);
    }
}

/// Shapes that could not be read are not also reported as missing.
#[test]
fn a_file_of_another_format_is_only_told_so() {
    for (name, bytes) in [("rhubarb-tsv", "{ \"mouthCues\": [] }"), ("moho", "// Pamela"), ("polly", "0.00\tX\n")] {
        let imported = import(formats::find(name).unwrap(), bytes.as_bytes(), &ImportOptions::default());
        let codes: Vec<_> = imported.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
        assert_eq!((codes, imported.clips.len()), (vec![lipz_diagnostics::Code::ForeignSyntax], 0), "{name}");
    }
}
