//! Combination of the pronunciations of several parts.

use crate::Phone;

/// The most pronunciations of one word. More take time, and are hardly ever spoken.
pub(super) const MOST: usize = 8;

/// Returns the pronunciations of a sequence of parts: first with the first pronunciation of each part, then with the
/// other pronunciations of one part at a time.
pub(super) fn sequence(parts: &[Vec<Vec<Phone>>]) -> Vec<Vec<Phone>> {
    let with = |other: Option<(usize, usize)>| {
        let choose = |(index, ways): (usize, &Vec<Vec<Phone>>)| {
            let way = other.filter(|(part, _)| *part == index).map_or(0, |(_, way)| way);
            ways.get(way).cloned().unwrap_or_default()
        };
        parts.iter().enumerate().flat_map(choose).collect::<Vec<Phone>>()
    };
    let mut all = vec![with(None)];
    for (part, ways) in parts.iter().enumerate() {
        for way in 1..ways.len() {
            if all.len() == MOST {
                return all;
            }
            add(&mut all, with(Some((part, way))));
        }
    }
    all
}

/// Adds a pronunciation, unless it is already present.
pub(super) fn add(all: &mut Vec<Vec<Phone>>, phones: Vec<Phone>) {
    if !all.contains(&phones) {
        all.push(phones);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Phone::{Aa, B, D, K};

    #[test]
    fn one_part_varies_at_a_time() {
        assert_eq!(sequence(&[]), [vec![]]);
        let parts = [vec![vec![B], vec![D]], vec![], vec![vec![Aa], vec![K]]];
        assert_eq!(sequence(&parts), [vec![B, Aa], vec![D, Aa], vec![B, K]]);
        assert_eq!(sequence(&vec![parts[0].clone(); 99]).len(), MOST);
    }
}
