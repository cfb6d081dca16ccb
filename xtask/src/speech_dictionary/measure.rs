//! Measures the rules: learnt from nine tenths of the dictionary, tested on the remaining tenth.

use super::source::{PHONES, Words};
use super::{align, pack, tree};
use crate::Failure;

/// The sums of errors for one kind of unit.
#[derive(Default)]
struct Errors {
    wrong: usize,
    all: usize,
}

impl Errors {
    fn percent(&self) -> f64 {
        100.0 * self.wrong as f64 / self.all.max(1) as f64
    }
}

pub(super) fn report(words: &Words) -> Result<String, Failure> {
    let (mut learnt, mut tried) = (Words::new(), Words::new());
    for (index, (word, all)) in words.iter().enumerate() {
        let part = if index % 10 == 0 { &mut tried } else { &mut learnt };
        part.insert(word.clone(), all.clone());
    }
    let tree = tree::learn(&align::align(&learnt))?;
    let (mut phones, mut visemes, mut exact) = (Errors::default(), Errors::default(), Errors::default());
    for (word, all) in &tried {
        let made = tree.phones(word.as_bytes());
        let best = |made: &[u8], of: &dyn Fn(&[u8]) -> Vec<u8>| {
            let made = of(made);
            all.iter().map(|right| (distance(&made, &of(right)), of(right).len())).min().unwrap_or_default()
        };
        let (wrong, length) = best(&made, &|phones| phones.to_vec());
        phones.wrong += wrong;
        phones.all += length;
        exact.wrong += usize::from(wrong > 0);
        exact.all += 1;
        let (wrong, length) = best(&made, &shapes);
        visemes.wrong += wrong;
        visemes.all += length;
    }
    Ok(format!(
        "rules: {} bytes; on {} other words: {:.1} % of phones wrong, {:.1} % of mouth shapes, \
         {:.1} % of words\nall words packed with these rules: {} bytes\n",
        tree.bytes.len(),
        exact.all,
        phones.percent(),
        visemes.percent(),
        exact.percent(),
        pack::pack(words, &tree)?.len(),
    ))
}

/// Returns the coarse mouth shapes of phones (closed, lip on teeth, round, open, tongue up, narrow), with equal
/// neighbours merged.
fn shapes(phones: &[u8]) -> Vec<u8> {
    let shape = |phone: &u8| match PHONES[usize::from(*phone)] {
        "B" | "M" | "P" => b'M',
        "F" | "V" => b'F',
        "AO" | "OW" | "OY" | "UH" | "UW" | "W" => b'O',
        "AA" | "AE" | "AH" | "AW" | "AY" | "EH" | "ER" | "EY" | "IH" | "IY" => b'A',
        "L" => b'L',
        _ => b'S',
    };
    let mut shapes: Vec<u8> = phones.iter().map(shape).collect();
    shapes.dedup();
    shapes
}

/// Returns the number of insertions, deletions and changes between two sequences.
fn distance(one: &[u8], two: &[u8]) -> usize {
    let mut row: Vec<usize> = (0..=two.len()).collect();
    for (at, from) in one.iter().enumerate() {
        let mut diagonal = at;
        row[0] = at + 1;
        for (place, to) in two.iter().enumerate() {
            let changed = diagonal + usize::from(from != to);
            diagonal = row[place + 1];
            row[place + 1] = changed.min(diagonal + 1).min(row[place] + 1);
        }
    }
    row.last().copied().unwrap_or_default()
}
