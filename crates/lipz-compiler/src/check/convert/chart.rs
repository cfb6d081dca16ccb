//! The codes of the mouth charts that show the same shape.

use lipz_bank::VisemeType;

/// Codes of Blair's and Toon Boom's charts with the same description (Lipz specification, "Toon Boom Viseme Codes" and
/// "Blair Viseme Codes").
const SAME: [(u8, u8); 8] = [
    (b'-', b'-'), // resting
    (b'M', b'A'), // M, B, and P
    (b'S', b'B'), // most consonants
    (b'E', b'C'), // E
    (b'A', b'D'), // A and I
    (b'O', b'E'), // O
    (b'W', b'F'), // W and Q
    (b'F', b'G'), // F and V
];

/// The two shapes that Toon Boom's chart "doesn't include separately", with their nearest shapes: L is a consonant, and
/// U is made with the rounded lips of W.
pub(super) const MERGED: [(u8, u8); 2] = [(b'L', b'B'), (b'U', b'F')];

/// Returns the code of type `to` for the shape that `code` shows in type `from`, or `None` if there is no such code,
/// because loudness is not a shape.
pub(super) fn counterpart(code: u8, from: VisemeType, to: VisemeType) -> Option<u8> {
    if from == to || code == b'-' {
        return Some(code);
    }
    let mut same = SAME.into_iter();
    match (from, to) {
        (VisemeType::Blair, VisemeType::ToonBoom) => {
            same.chain(MERGED).find(|(blair, _)| *blair == code).map(|(_, toonboom)| toonboom)
        }
        (VisemeType::ToonBoom, VisemeType::Blair) => {
            same.find(|(_, toonboom)| *toonboom == code).map(|(blair, _)| blair)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use VisemeType::{Blair, Rms, ToonBoom};

    #[test]
    fn every_shape_has_a_counterpart() {
        let all = |from: VisemeType, to| -> String {
            from.codes().bytes().filter_map(|code| counterpart(code, from, to)).map(char::from).collect()
        };
        assert_eq!(all(Blair, ToonBoom), "-DAEBFCGBF");
        assert_eq!(all(ToonBoom, Blair), "-MSEAOWF");
        for code in ToonBoom.codes().bytes() {
            let there_and_back = counterpart(code, ToonBoom, Blair).and_then(|code| counterpart(code, Blair, ToonBoom));
            assert_eq!(there_and_back, Some(code));
        }
    }

    #[test]
    fn loudness_is_no_shape() {
        for (from, to) in [(Rms, Blair), (Rms, ToonBoom), (Blair, Rms), (ToonBoom, Rms)] {
            let converted: Vec<u8> = from.codes().bytes().filter_map(|code| counterpart(code, from, to)).collect();
            assert_eq!(converted, b"-", "only rest is the same");
        }
    }
}
