//! A sample command line for each format of other tools, for the help.

/// The direction of a conversion.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Import,
    Export,
}

/// The arguments after `lipz import visemes FORMAT` and `lipz export visemes FORMAT`.
const EXAMPLES: &[(&str, &str, Option<&str>)] = &[
    ("rhubarb-tsv", "recorded/*.tsv -o voices", Some("voices -o recorded")),
    ("rhubarb-json", "recorded/*.json -o voices", Some("voices -o recorded")),
    ("rhubarb-xml", "recorded/*.xml -o voices", None),
    ("moho", "recorded/*.dat --file-rate 24 -o voices", Some("voices -o switches")),
    ("papagayo", "projects/*.pgo --locale en-us -o voices", None),
    ("papagayo-ng", "projects/*.pg2 --locale en-us -o voices", None),
    ("pamela", "recorded/*.pam -o voices", Some("voices -o recorded")),
    ("kotor", "lips/*.lip -o voices", Some("voices -o lips")),
    ("bohemia", "sounds/*.lip -o voices", None),
    ("fallout", "speech/*.lip -o voices", Some("voices -o speech")),
    ("polly", "speech/*.marks --locale en-us -o voices", None),
    ("azure", "speech/*.json -o voices", None),
    ("cartesia", "speech/*.json -o voices", None),
    ("piper", "speech/*.json -o voices", None),
    ("annosoft", "speech/*.anno --locale en-us -o voices", None),
    ("live-link", "takes/*.csv --fps 30 -o voices", None),
    ("audio2face", "takes/*.json -o voices", None),
    ("arkit-json", "takes/*.json --file-rate 60 -o voices", None),
    ("gltf", "animations/*.vrma -o voices", None),
    ("ovr", "dumps/*.csv --file-rate 60 --fps 30 -o voices", None),
    ("textgrid", "aligned/*.TextGrid --fps 30 -o voices", Some("voices -o aligned")),
    ("lipz-txt", "audio/*.lipz.txt -o voices", None),
    ("lipz-editor", "old/*.json --locale en-us -o voices", None),
];

/// Returns the example for the format with this name.
pub(super) fn example(format: &str, direction: Direction) -> Option<String> {
    let (_, import, export) = EXAMPLES.iter().find(|(name, ..)| *name == format)?;
    Some(match direction {
        Direction::Import => format!("lipz import visemes {format} {import}"),
        Direction::Export => format!("lipz export visemes {format} {}", (*export)?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_interop::formats;

    #[test]
    fn every_format_has_its_examples() {
        for format in formats::ALL {
            let has = |direction| example(format.name, direction).is_some();
            let (read, write) = (format.read.is_some(), format.write.is_some());
            let found = (has(Direction::Import), has(Direction::Export));
            assert_eq!(found, (read, write), "EXAMPLES: import and export of `{}`", format.name);
        }
        assert_eq!(EXAMPLES.len(), formats::ALL.len());
    }
}
