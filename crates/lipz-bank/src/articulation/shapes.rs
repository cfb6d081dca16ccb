//! Articulation of clips that have only visemes: each run of equal shapes is a sound.

use super::blend::Blend;
use super::query_time::MOST_US;
use crate::{Clip, Time};
use lipz_layout::{CLASS_CLOSED_LIPS, CLASS_LIP_ON_TEETH, PhoneTargetRecord};
use lipz_types::{Position, Viseme, VisemeType};

/// Adds the shapes that matter at a time.
pub(super) fn add_near<T: Time>(clip: &Clip<'_>, time: T, blend: &mut Blend) {
    let (fps, viseme_type) = match (clip.stored_fps(), clip.viseme_type()) {
        (Some(fps), Some(viseme_type)) if time.has_begun() => (fps, viseme_type),
        _ => return,
    };
    let Position { frame, sixteen_bits } = time.position(fps);
    let frame_us = fps.start_of_frame_us(1).clamp(1, LONGEST_FRAME_US) as u32;
    let reach = MOST_US.checked_div(frame_us).unwrap_or(0).wrapping_add(1);
    let first = frame.saturating_sub(reach);
    let codes = clip.frames();
    let codes = codes.get(..frame.saturating_add(reach) as usize).unwrap_or(codes);
    let mut codes = codes.get(first as usize..).unwrap_or(&[]);
    // Frames with their fractions in 16 bits, of at most a second: less than 2^20 for each frame in reach.
    let frames_us = |count: usize| (count as u32).wrapping_mul(frame_us) as i32;
    let passed_us = (frame_us.wrapping_mul(u32::from(sixteen_bits) >> 4) >> 12) as i32;
    let mut start_us = frames_us(frame.wrapping_sub(first) as usize).wrapping_add(passed_us).wrapping_neg();
    while let Some(code) = codes.first() {
        let length = codes.iter().position(|other| other != code).unwrap_or(codes.len());
        let end_us = start_us.wrapping_add(frames_us(length));
        if *code != Viseme::REST.code() {
            blend.add(start_us, end_us, targets(*code, viseme_type));
        }
        start_us = end_us;
        codes = codes.get(length..).unwrap_or(&[]);
    }
}

/// The length of a frame at the lowest rate.
const LONGEST_FRAME_US: u64 = 1_000_000;

/// The targets of Preston Blair's shapes: the averages of the phones that have them in his chart.
static SHAPES: [PhoneTargetRecord; 9] = [
    shape([22, 50, 15, 20, 70, 0, 20], [7, 6, 5], 0),
    shape([25, 0, 5, 0, 0, 0, 0], [7, 10, 5], CLASS_CLOSED_LIPS),
    shape([20, 15, 0, 0, 0, 0, 0], [7, 10, 5], CLASS_LIP_ON_TEETH),
    shape([85, 85, 5, 10, 0, 0, 10], [10; 3], 0),
    shape([40, 65, 5, 50, 0, 0, 0], [10; 3], 0),
    shape([60, 55, 50, 0, 0, 0, 40], [10, 10, 15], 0),
    shape([28, 32, 70, 0, 0, 0, 40], [10, 14, 15], 0),
    shape([20, 15, 90, 0, 0, 0, 40], [7, 14, 15], 0),
    shape([35, 55, 5, 0, 100, 20, 0], [7, 6, 5], 0),
];

const fn shape(percent: [u8; 7], strength_tenths: [u8; 3], class: u8) -> PhoneTargetRecord {
    PhoneTargetRecord { percent, strength_tenths, class, second: 0 }
}

/// The codes of [`SHAPES`]: those of Blair's shapes, and of the nearest shapes of Toon Boom.
const BLAIR: &[u8] = b"SMFAEOUWL";
const TOON_BOOM: &[u8] = b"BAGDCEF";

/// The targets of RMS's codes from 0 to 9, which move jaw and lips alike.
static LEVELS: [PhoneTargetRecord; 10] =
    [level(0), level(11), level(22), level(33), level(44), level(55), level(66), level(77), level(88), level(100)];

const fn level(percent: u8) -> PhoneTargetRecord {
    shape([percent, percent, 0, 0, 0, 0, 0], [10; 3], 0)
}

/// Returns the targets of a shape.
fn targets(code: u8, viseme_type: VisemeType) -> &'static PhoneTargetRecord {
    let index_in = |codes: &[u8]| codes.iter().position(|other| *other == code).unwrap_or(0);
    let (targets, index) = match viseme_type {
        VisemeType::Blair => (&SHAPES[..], index_in(BLAIR)),
        VisemeType::ToonBoom => (&SHAPES[..], index_in(TOON_BOOM)),
        VisemeType::Rms => (&LEVELS[..], usize::from(code.wrapping_sub(b'0'))),
    };
    targets.get(index).unwrap_or(&SHAPES[0])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // tests
mod tests {
    extern crate std;

    use super::*;
    use std::string::String;
    use std::vec::Vec;

    /// The targets of shapes are part of the format, because readers in other languages have them, too.
    #[test]
    fn the_table_of_the_format_has_all_shapes() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/reference/bank-format.md");
        let page = std::fs::read_to_string(page).unwrap();
        let (_, table) = page.split_once("| Blair | Toon Boom |").unwrap();
        let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
        let numbers =
            |cell: &str| -> Vec<u8> { cell.split(',').map(|number| number.trim().parse().unwrap()).collect() };
        let (mut blair, mut toon_boom, mut count) = (String::new(), String::new(), 0);
        for (row, shape) in rows.zip(&SHAPES) {
            let cells: Vec<&str> = row.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
            blair.push_str(cells[1]);
            toon_boom.push_str(cells[2]);
            assert_eq!(
                (numbers(cells[3]), numbers(cells[4])),
                (shape.percent.to_vec(), shape.strength_tenths.to_vec())
            );
            let class = match cells[5] {
                "CLASS_CLOSED_LIPS" => CLASS_CLOSED_LIPS,
                "CLASS_LIP_ON_TEETH" => CLASS_LIP_ON_TEETH,
                _ => 0,
            };
            assert_eq!(class, shape.class, "{row}");
            count += 1;
        }
        assert_eq!((count, blair.as_bytes(), toon_boom.as_bytes()), (SHAPES.len(), BLAIR, TOON_BOOM));
    }
}
