//! Compares the tables and vectors of `docs/reference/bank-format.md` with the code.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::curve::CurveValue;
use lipz_bank::{ClipId, ErrorKind};
use lipz_layout::{ClipRecord, KeyRecord, RECORDS, Tag, TypedEventRecord};
use lipz_testkit::golden::{DRAMA, SMALL, section, verified};
use zerocopy::FromBytes;

static PAGE: &str = include_str!("../../../docs/reference/bank-format.md");

/// Returns the cells of all rows of the first table with these columns after `heading`.
fn table(heading: &str, columns: &str) -> Vec<Vec<&'static str>> {
    let start = PAGE.find(&format!("\n{heading}\n")).unwrap_or_else(|| panic!("no heading {heading}"));
    let mut lines = PAGE[start..].lines().skip_while(|line| *line != columns);
    assert_eq!(lines.next(), Some(columns), "the table of {heading}");
    let cells =
        |line: &'static str| line.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`')).collect();
    let rows: Vec<_> = lines.skip(1).take_while(|line| line.starts_with('|')).map(cells).collect();
    assert!(!rows.is_empty(), "{heading}");
    rows
}

fn number(cell: &str) -> u64 {
    let parsed = match cell.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16),
        None => cell.parse(),
    };
    parsed.unwrap_or_else(|_| panic!("`{cell}` is no number"))
}

fn hex(cell: &str) -> u64 {
    assert_eq!(cell.len(), 16, "{cell}");
    u64::from_str_radix(cell, 16).expect("hexadecimal digits")
}

/// Compares the table of each record, and its total length, with the struct.
#[test]
fn records() {
    for record in RECORDS.into_iter().flatten().filter(|record| !record.name.ends_with("CurveKeyRecord")) {
        let rows = table(&format!("### {}", record.name), "| offset | size | name | meaning |");
        let (end, rows) = rows.split_last().expect("rows");
        assert_eq!((number(end[0]) as usize, end[2]), (record.length_bytes, "end"), "{}", record.name);
        let mut offset = 0;
        let mut described = rows.iter();
        for (name, length) in record.fields {
            let row = described.next().unwrap_or_else(|| panic!("no row for {name} of {}", record.name));
            assert_eq!((number(row[0]) as usize, number(row[1]) as usize, row[2]), (offset, *length, *name));
            offset += length;
        }
        assert_eq!((described.next(), offset), (None, record.length_bytes), "{}", record.name);
    }
}

/// Keys of curves have a table of their own.
#[test]
fn keys_of_curves() {
    let records = RECORDS.into_iter().flatten().filter(|record| record.name.ends_with("CurveKeyRecord"));
    let rows = table("### Keys of a curve", "| key | bytes | frame | value |");
    assert_eq!(records.clone().count(), rows.len());
    for (row, record) in rows.iter().zip(records) {
        let [("frame", frame), ("thousandths", value)] = *record.fields else { panic!("{record:?}") };
        let cells =
            [record.length_bytes.to_string(), format!("u{} at 0", frame * 8), format!("i{} at {frame}", value * 8)];
        assert_eq!(row[1..], cells);
    }
}

#[test]
fn header() {
    let row = &table("### Header", "| offset | size | name | meaning |")[0];
    let magic: Vec<String> = lipz_layout::MAGIC.iter().map(|byte| format!("{byte:02X}")).collect();
    assert!(row[3].starts_with(&magic.join(" ")), "{}", row[3]);
    assert_eq!(lipz_layout::CHECKED_FROM, 16);
}

#[test]
fn sections() {
    let row = |row: &Vec<&'static str>| (row[0], number(row[1]) as usize);
    let required: Vec<_> = table("### Sections", "| tag | entry bytes | contents |").iter().map(row).collect();
    let known = Tag::REQUIRED.map(|(tag, bytes)| (String::from_utf8(tag.0.to_vec()).expect("ASCII"), bytes));
    assert!(required.iter().map(|&(tag, bytes)| (tag.to_owned(), bytes)).eq(known));
    let of_set: Vec<_> = table("## Sets", "| tag | entry bytes | contents |").iter().map(row).collect();
    let known = Tag::SET.map(|(tag, bytes)| (String::from_utf8(tag.0.to_vec()).expect("ASCII"), bytes));
    assert!(of_set.iter().map(|&(tag, bytes)| (tag.to_owned(), bytes)).eq(known));
    let magic: Vec<String> = lipz_layout::SET_MAGIC.iter().map(|byte| format!("{byte:02X}")).collect();
    assert!(PAGE.contains(&format!("`{}`", magic.join(" "))));
    for section in Tag::OPTIONAL {
        let (tag, bytes) = (String::from_utf8(section.tag.0.to_vec()).expect("ASCII"), section.entry_bytes);
        assert!(
            PAGE.contains(&format!("\n| `{tag}` | {bytes} | ")),
            "docs/reference/bank-format.md has no row for the section {tag}"
        );
    }
}

/// The values between keys that the page lists.
#[test]
fn values_between_keys() {
    let number = |text: &str| (text.parse::<f64>().expect("a number") * 1000.0).round() as i32;
    let key = |cell: &str| {
        let (frame, value) = cell.strip_prefix("frame ").and_then(|cell| cell.split_once(": ")).expect("a key");
        (number(frame), CurveValue::from_thousandths(number(value)))
    };
    for row in table("### Keys of a curve", "| a | b | position in frames | value |") {
        let ((from, old), (to, new)) = (key(row[0]), key(row[1]));
        let found = old.towards(new, (number(row[2]) - from) as u64, (to - from) as u64);
        assert_eq!(found.thousandths(), number(row[3]), "{row:?}");
    }
}

#[test]
fn values() {
    let values = [
        ("FORMAT_MAJOR", u64::from(lipz_layout::FORMAT_MAJOR)),
        ("FORMAT_MINOR", u64::from(lipz_layout::FORMAT_MINOR)),
        ("SECTION_REQUIRED", u64::from(lipz_layout::SECTION_REQUIRED)),
        ("FLAG_VISEMES", u64::from(lipz_layout::FLAG_VISEMES)),
        ("NO_RATE", u64::from(lipz_layout::NO_RATE)),
        ("NO_RECORDING", lipz_layout::NO_RECORDING),
        ("MAX_INTEGER_FPS", u64::from(lipz_layout::MAX_INTEGER_FPS)),
        ("LOCALE_DEFAULT", u64::from(lipz_layout::LOCALE_DEFAULT)),
        ("NO_TEXT", u64::from(lipz_layout::NO_TEXT)),
        ("TEXT_FALLBACK", u64::from(lipz_layout::TEXT_FALLBACK)),
        ("TEXT_HAS_LENGTH", u64::from(lipz_layout::TEXT_HAS_LENGTH)),
        ("TEXT_OFFSET", u64::from(lipz_layout::TEXT_OFFSET)),
        ("NO_NAME", u64::from(lipz_layout::NO_NAME)),
        ("CURVE_WIDE", u64::from(lipz_layout::CURVE_WIDE)),
        ("PHONES_OFFSET", u64::from(lipz_layout::PHONES_OFFSET)),
        ("PHONES_ARE_CERTAIN", u64::from(lipz_layout::PHONES_ARE_CERTAIN)),
        ("PHONES_ARE_WIDE", u64::from(lipz_layout::PHONES_ARE_WIDE)),
        ("NO_INPUT", u64::from(lipz_layout::NO_INPUT)),
        ("CLASS_CLOSED_LIPS", u64::from(lipz_layout::CLASS_CLOSED_LIPS)),
        ("CLASS_LIP_ON_TEETH", u64::from(lipz_layout::CLASS_LIP_ON_TEETH)),
        ("CLASS_NARROW_JAW", u64::from(lipz_layout::CLASS_NARROW_JAW)),
        ("NO_DUB", u64::from(lipz_layout::NO_DUB)),
        ("DUB_OF", u64::from(lipz_layout::DUB_OF)),
        ("OTHER_DUB", u64::from(lipz_layout::OTHER_DUB)),
        ("DIRECT_SLOT", u64::from(lipz_layout::DIRECT_SLOT)),
        ("LAYER_BABBLE", u64::from(lipz_layout::LAYER_BABBLE)),
        ("LAYER_DEFAULT_LOCALE", u64::from(lipz_layout::LAYER_DEFAULT_LOCALE)),
        ("LAYER_FACES", u64::from(lipz_layout::LAYER_FACES)),
        ("LAYER_VOICES", u64::from(lipz_layout::LAYER_VOICES)),
        ("LAYER_ARTICULATION", u64::from(lipz_layout::LAYER_ARTICULATION)),
        ("LAYER_RIGS", u64::from(lipz_layout::LAYER_RIGS)),
        ("LAYER_NO_DUB", u64::from(lipz_layout::LAYER_NO_DUB)),
        ("LAYER_DUB", u64::from(lipz_layout::LAYER_DUB)),
        ("LAYER_OTHER_DUB", u64::from(lipz_layout::LAYER_OTHER_DUB)),
        ("LAYER_DUB_OF", u64::from(lipz_layout::LAYER_DUB_OF)),
        ("PART_CLIP", u64::from(lipz_layout::PART_CLIP)),
        ("PART_TEXTS", u64::from(lipz_layout::PART_TEXTS)),
        ("PART_ORIGINAL", u64::from(lipz_layout::PART_ORIGINAL)),
        ("NO_STAND_IN", u64::from(lipz_layout::NO_STAND_IN)),
    ];
    let described: Vec<_> = table("### ClipRecord", "| name | value |");
    assert!(described.iter().map(|row| (row[0], number(row[1]))).eq(values));
}

/// Writes and reads each verb of the page.
#[test]
fn verbs() {
    let typed = section(SMALL, Tag::TYPED_EVENTS);
    let records = <[TypedEventRecord]>::ref_from_bytes(&SMALL[typed]).expect("typed events");
    let bank = verified(SMALL);
    let far = bank.clip_by_key("act2/far").expect("the clip with all verbs");
    let events = far.segments().skip(1).flat_map(|segment| segment.events());
    let found: Vec<_> = records.iter().zip(events).map(|(record, event)| (record.verb, event.command.verb())).collect();
    let described = table("### TypedEventRecord", "| verb | is | object |");
    let described: Vec<_> = described.iter().map(|row| (number(row[0]) as u8, row[1])).collect();
    assert_eq!(found, described);
}

#[test]
fn errors() {
    let described = table("## Errors", "| number | kind | message |");
    let described: Vec<_> = described.iter().map(|row| (number(row[0]) as u8, row[1].to_owned(), row[2])).collect();
    let kinds = ErrorKind::ALL.iter().map(|&kind| (kind as u8, format!("{kind:?}"), kind.message()));
    assert_eq!(described, kinds.collect::<Vec<_>>(), "the table of docs/reference/bank-format.md and the kinds");
}

/// The inventory of phones.
#[test]
fn phones() {
    let described = table("## Phones", "| number | ARPAbet | IPA |");
    let described: Vec<_> = described.iter().map(|row| (number(row[0]) as u8, row[1], row[2])).collect();
    let known = lipz_types::Phone::all().map(|phone| match phone.number() {
        0 => (0, "sil", ""),
        number => (number, phone.arpabet().unwrap_or(""), phone.ipa()),
    });
    assert_eq!(described, known.collect::<Vec<_>>());
}

#[test]
fn clip_ids() {
    for row in table("## Clip ids", "| key | clip id |") {
        assert_eq!(ClipId::from_key(row[0]).get(), hex(row[1]), "{}", row[0]);
    }
}

#[test]
fn clip_index() {
    let columns = "| id | index_seed | spread | buckets | bucket | pilot | clips | slot |";
    for row in table("## Clip index", columns) {
        let spread = lipz_layout::spread(hex(row[0]), number(row[1]));
        let small = |column: usize| number(row[column]) as u32;
        assert_eq!(spread, hex(row[2]));
        assert_eq!(lipz_layout::bucket_of(spread, small(3)), small(4));
        assert_eq!(lipz_layout::slot_of(spread, small(5), small(6)), small(7));
    }
}

#[test]
fn checksum() {
    for row in table("## Checksum", "| bytes | checksum |") {
        let bytes: Vec<u8> = match row[0] {
            "(none)" => Vec::new(),
            "00 01 02 ... 1F" => (0..=0x1F).collect(),
            "00 01 02 ... 63" => (0..=0x63).collect(),
            listed => listed.split(' ').map(|byte| u8::from_str_radix(byte, 16).expect("a byte")).collect(),
        };
        assert_eq!(lipz_layout::checksum(&bytes), hex(row[1]), "{}", row[0]);
    }
}

/// Translates the pseudocode of the page to Rust, and applies it to banks of the compiler.
#[test]
fn fingerprint() {
    let mix = |value: u64, multiplier: u64| {
        let product = value.wrapping_mul(multiplier);
        product ^ (product >> 32)
    };
    for bytes in [SMALL, DRAMA] {
        let keys = <[KeyRecord]>::ref_from_bytes(&bytes[section(bytes, Tag::KEYS)]).expect("records");
        let clips = <[ClipRecord]>::ref_from_bytes(&bytes[section(bytes, Tag::CLIPS)]).expect("records");
        let fingerprint = keys.iter().zip(clips).fold(keys.len() as u64, |hash, (key, clip)| {
            let hash = mix(hash ^ key.id.get(), 0x9E37_79B9_7F4A_7C15);
            let segments = (u64::from(clip.segments_first.get()) << 32) + u64::from(key.segment_count.get());
            mix(hash ^ segments, 0x9FB2_1C65_1E98_DF25)
        });
        assert_eq!(verified(bytes).fingerprint(), fingerprint);
    }
}
