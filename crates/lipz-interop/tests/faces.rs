//! Curves and phones of imports: their accuracy, and how they get into existing clips.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

use lipz_diagnostics::Code;
use lipz_file::{Document, Value, curve, phones};
use lipz_interop::{ImportOptions, ImportedClip, MergeOptions, formats, import};

fn imported(format: &str, bytes: &str, options: &ImportOptions<'_>) -> ImportedClip {
    let mut imported = import(formats::find(format).unwrap(), bytes.as_bytes(), options);
    assert!(!imported.clips.is_empty(), "{:?}", imported.diagnostics);
    imported.clips.remove(0)
}

/// Returns the value of a curve at the start of each frame, in thousandths.
fn values(document: &Document<'_>, name: &str, frames: usize) -> Vec<i32> {
    let Some(Value::Other(value)) = document.get(curve::ELEMENT).map(|element| &element.value) else {
        return Vec::new();
    };
    let curves = curve::parse(value, &mut Vec::new()).unwrap();
    let Some(curve) = curves.iter().find(|curve| curve.name.text == name) else { return Vec::new() };
    let at = |frame: u32| {
        let next = curve.keys.iter().position(|key| key.frame >= frame);
        let Some(next) = next else { return curve.keys.last().unwrap().value.thousandths() };
        let (after, before) = (curve.keys[next], curve.keys[next.saturating_sub(1)]);
        match after.frame == before.frame {
            true => after.value.thousandths(),
            false => before
                .value
                .towards(after.value, (frame - before.frame).into(), (after.frame - before.frame).into())
                .thousandths(),
        }
    };
    (0..u32::try_from(frames).unwrap()).map(at).collect()
}

/// Weights that no straight line approximates.
fn weights(frames: usize) -> Vec<f64> {
    (0..frames).map(|frame| ((frame * frame * 37) % 1001) as f64 / 1000.0).collect()
}

#[test]
fn every_weight_is_exact_at_the_rate_of_the_file() {
    let weights = weights(90);
    let rows = weights.iter().enumerate().map(|(frame, weight)| {
        format!("0:0:{}:{:02}.{:03},2,{weight:.4},{:.4}\n", frame / 30, frame % 30, (frame * 7) % 100, 1.0 - weight)
    });
    let csv = format!("Timecode,BlendShapeCount,JawOpen,EyeLookUpLeft\n{}", rows.collect::<String>());
    let clip = imported("live-link", &csv, &ImportOptions::new());
    let expected: Vec<i32> = weights.iter().map(|weight| (weight * 1000.0).round() as i32).collect();
    assert_eq!(clip.frames, 90);
    assert_eq!(values(&clip.document, "jawOpen", 90), expected);
    assert_eq!(
        values(&clip.document, "eyeLookUpLeft", 90),
        expected.iter().map(|value| 1000 - value).collect::<Vec<_>>()
    );
    let slower = imported("live-link", &csv, &ImportOptions::new().rate(lipz_file::rate::parse("24")));
    assert!(
        slower.remarks.iter().any(|remark| remark.contains("differ from the file by at most 0.")),
        "{:?}",
        slower.remarks
    );
}

#[test]
fn weights_that_are_always_0_have_curves_too() {
    let csv = "sil,PP,FF,TH,DD,kk,CH,SS,nn,RR,aa,E,ih,oh,ou\n0.9,0,0,0,0,0,0,0,0,0,0.1,0,0,0,0\n";
    let clip = imported("ovr", csv, &ImportOptions::new());
    let of = |name| values(&clip.document, name, 1);
    assert_eq!((of("sil"), of("aa"), of("PP")), (vec![900], vec![100], vec![0]));
    assert_eq!(clip.remarks, ["15 weights become curves, rounded to thousandths"]);
}

#[test]
fn curves_of_a_new_take_replace_those_with_their_names() {
    let json = r#"[{"time":0,"jawOpen":0.5},{"time":0.1,"jawOpen":0.75}]"#;
    let clip = imported("arkit-json", json, &ImportOptions::new().file_rate(lipz_file::rate::parse("10")));
    let existing = br#"{ "visemes": "-A", "fps": 10, "curves": { "jawOpen": "0:0.1", "joy": "0:2" } }"#;
    let existing = lipz_file::parse(existing).document.unwrap();
    let merged = clip.merge(&existing, &MergeOptions::new());
    assert!(merged.diagnostics.is_empty(), "{:?}", merged.diagnostics);
    assert_eq!(values(&merged.document, "jawOpen", 2), [500, 750]);
    assert_eq!(values(&merged.document, "joy", 1), [2000]);

    let broken = br#"{ "visemes": "-A", "fps": 10, "curves": { "jawOpen": "0:0.1 x" } }"#;
    let broken = lipz_file::parse(broken).document.unwrap();
    let merged = clip.merge(&broken, &MergeOptions::new());
    let codes: Vec<Code> = merged.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
    assert_eq!(codes, [Code::ImportKept], "keys that cannot be read stay");
}

#[test]
fn phones_follow_the_recording() {
    let anno = "phn 0 100 0 x\nphn 100 200 90 B\nphn 200 300 90 AA\n";
    let clip = imported("annosoft", anno, &ImportOptions::new().rate(lipz_file::rate::parse("10")));
    assert_eq!(clip.document.string(phones::ELEMENT), Some("sil@0 B@100 AA@200"));
    let existing = br#"{ "visemes": "-MO", "fps": 10, "phones": "sil@0 B@90 AO@210" }"#;
    let existing = lipz_file::parse(existing).document.unwrap();
    let merged = clip.merge(&existing, &MergeOptions::new());
    assert_eq!(merged.document.string(phones::ELEMENT), Some("sil@0 B@100 AA@200"));

    let take = |tsv| imported("rhubarb-tsv", tsv, &ImportOptions::new().rate(lipz_file::rate::parse("10")));
    let merged = take("0.00\tX\n0.10\tA\n0.20\tD\n0.30\tX\n").merge(&existing, &MergeOptions::new());
    let codes: Vec<Code> = merged.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
    assert_eq!((codes, merged.document.get(phones::ELEMENT)), (vec![Code::PhonesRemoved], None));
    let same = take("0.00\tX\n0.10\tA\n0.20\tE\n0.30\tE\n");
    let visemes = same.document.string("visemes").unwrap().to_owned();
    let unchanged = format!(r#"{{ "visemes": "{visemes}", "fps": 10, "phones": "sil@0 B@90 AO@210" }}"#);
    let unchanged = lipz_file::parse(unchanged.as_bytes()).document.unwrap();
    let merged = same.merge(&unchanged, &MergeOptions::new());
    assert!(merged.diagnostics.is_empty() && merged.document.get(phones::ELEMENT).is_some());
}

/// Memory follows the size of the file, even if each frame names another shape or times are far apart.
#[test]
fn faces_with_too_many_values_are_refused() {
    let refused = |format: &str, bytes: &str| {
        let imported = import(formats::find(format).unwrap(), bytes.as_bytes(), &ImportOptions::new());
        let codes: Vec<Code> = imported.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
        assert!(imported.clips.is_empty() && codes == [Code::ForeignValue], "{codes:?}");
    };
    let frames: String = (0..1_200).map(|frame| format!("{{\"s{frame}\":1}},")).collect();
    refused("arkit-json", &format!("[{frames}{{}}]"));
    let shapes: String = (0..100).map(|shape| format!("\"s{shape}\":0.5,")).collect();
    let frame = |time: u32| format!("{{{shapes}\"time\":{time}}}");
    refused("arkit-json", &format!("{{\"fps\":60,\"frames\":[{},{}]}}", frame(0), frame(60_000_000)));
}
