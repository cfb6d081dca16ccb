//! Letter-to-sound rules as a decision tree: the phones of a letter by the letters around it.
//!
//! Each node tests the neighbour with the most information about the phones, and stores the most frequent phones for
//! unseen neighbours. `crates/lipz-speech/src/pronounce/english/letters.rs` reads the bytes and describes them.

use super::align::{Aligned, Sounds};
use crate::Failure;
use std::collections::BTreeMap;

/// The positions of neighbours that a node may test.
pub(super) const NEIGHBOURS: [isize; 10] = [1, -1, 2, -2, 3, -3, 4, -4, 5, -5];
/// The letter outside of a word.
const OUTSIDE: u8 = b'#';
/// The number of occurrences below which a neighbour makes no rule.
const LEAST_SEEN: usize = 3;

/// The packed tree, and the same for use here.
#[derive(Debug)]
pub(super) struct Tree {
    pub(super) bytes: Vec<u8>,
    sounds: Vec<Sounds>,
    roots: BTreeMap<u8, Node>,
}

#[derive(Debug)]
struct Node {
    /// The most frequent phones, an index in the table.
    sounds: u8,
    /// The neighbour that is tested, and the next nodes; empty for a leaf.
    neighbour: usize,
    next: BTreeMap<u8, Node>,
}

/// One letter in a word of the dictionary.
struct Place<'w> {
    word: &'w [u8],
    at: usize,
    sounds: u8,
}

fn neighbour(word: &[u8], at: usize, neighbour: usize) -> u8 {
    let place = at.checked_add_signed(NEIGHBOURS[neighbour]);
    place.and_then(|place| word.get(place)).copied().unwrap_or(OUTSIDE)
}

/// Learns the rules from aligned words.
pub(super) fn learn(words: &[Aligned]) -> Result<Tree, Failure> {
    let mut seen: BTreeMap<&Sounds, usize> = BTreeMap::new();
    for sounds in words.iter().flat_map(|word| &word.sounds) {
        *seen.entry(sounds).or_default() += 1;
    }
    let mut frequent: Vec<(&Sounds, usize)> = seen.into_iter().filter(|(_, count)| *count >= 20).collect();
    frequent.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
    frequent.truncate(usize::from(u8::MAX));
    let sounds: Vec<Sounds> = frequent.into_iter().map(|(sounds, _)| sounds.clone()).collect();
    let number: BTreeMap<&Sounds, u8> = sounds.iter().zip(0..).collect();

    let mut places: BTreeMap<u8, Vec<Place<'_>>> = BTreeMap::new();
    for word in words {
        let numbers: Option<Vec<u8>> = word.sounds.iter().map(|sounds| number.get(sounds).copied()).collect();
        let Some(numbers) = numbers else { continue };
        for (at, sounds) in numbers.into_iter().enumerate() {
            places.entry(word.letters[at]).or_default().push(Place { word: &word.letters, at, sounds });
        }
    }
    let roots: BTreeMap<u8, Node> =
        places.into_iter().map(|(letter, places)| (letter, grow(&places, &mut Vec::new()))).collect();
    let bytes = write(&sounds, &roots)?;
    Ok(Tree { bytes, sounds, roots })
}

/// Returns the node for these places, after the neighbours `asked` on the path.
fn grow(places: &[Place<'_>], asked: &mut Vec<usize>) -> Node {
    let mut counts = [0_usize; 256];
    for place in places {
        counts[usize::from(place.sounds)] += 1;
    }
    // The first of the most frequent ones. The table is ordered by total frequency.
    let best = (0..=u8::MAX).rev().max_by_key(|sounds| counts[usize::from(*sounds)]).unwrap_or_default();
    let leaf = Node { sounds: best, neighbour: 0, next: BTreeMap::new() };
    if counts[usize::from(best)] == places.len() {
        return leaf;
    }
    // The test with the least mixed results (Gini): the sum over results of Σ count² / count.
    let mut question = None;
    for candidate in (0..NEIGHBOURS.len()).filter(|candidate| !asked.contains(candidate)) {
        let purity = purity(places, candidate);
        if question.is_none_or(|(_, best)| purity > best) {
            question = Some((candidate, purity));
        }
    }
    let Some((question, _)) = question else { return leaf };
    let mut answers: BTreeMap<u8, Vec<Place<'_>>> = BTreeMap::new();
    for place in places {
        let answer = neighbour(place.word, place.at, question);
        answers.entry(answer).or_default().push(Place { word: place.word, at: place.at, sounds: place.sounds });
    }
    asked.push(question);
    let mut next = BTreeMap::new();
    for (answer, places) in answers {
        if places.len() < LEAST_SEEN {
            continue;
        }
        let node = grow(&places, asked);
        // A node with the same result as this one is omitted.
        if !node.next.is_empty() || node.sounds != best {
            next.insert(answer, node);
        }
    }
    asked.pop();
    Node { sounds: best, neighbour: question, next }
}

/// Returns the purity of the phones after a test: the sum over its results of Σ count² / count. Computed in whole
/// numbers until the last step, in a fixed order, and therefore the same everywhere.
fn purity(places: &[Place<'_>], question: usize) -> f64 {
    let mut pairs: Vec<(u8, u8)> =
        places.iter().map(|place| (neighbour(place.word, place.at, question), place.sounds)).collect();
    pairs.sort_unstable();
    let mut sum = 0.0;
    for answer in pairs.chunk_by(|one, two| one.0 == two.0) {
        let squares: usize = answer.chunk_by(|one, two| one == two).map(|same| same.len() * same.len()).sum();
        sum += squares as f64 / answer.len() as f64;
    }
    sum
}

impl Tree {
    /// Applies the rules to a word.
    pub(super) fn phones(&self, word: &[u8]) -> Vec<u8> {
        let mut phones = Vec::new();
        for at in 0..word.len() {
            let Some(mut node) = self.roots.get(&word[at]) else { continue };
            while let Some(next) = node.next.get(&neighbour(word, at, node.neighbour)) {
                node = next;
            }
            phones.extend_from_slice(&self.sounds[usize::from(node.sounds)]);
        }
        phones
    }
}

/// Writes the table of phones, the roots of `'` and `a` to `z`, then the nodes.
fn write(sounds: &[Sounds], roots: &BTreeMap<u8, Node>) -> Result<Vec<u8>, Failure> {
    let mut bytes = b"LZLS".to_vec();
    bytes.push(u8::try_from(sounds.len()).map_err(|_| "too many phones")?);
    for sounds in sounds {
        // A missing phone is 255.
        bytes.push(sounds.first().copied().unwrap_or(u8::MAX));
        bytes.push(sounds.get(1).copied().unwrap_or(u8::MAX));
    }
    let table = bytes.len();
    bytes.resize(table + 27 * 3, 0);
    for (slot, letter) in [b'\''].into_iter().chain(b'a'..=b'z').enumerate() {
        let Some(node) = roots.get(&letter) else { return Err(format!("no word has a `{}`", char::from(letter))) };
        let at = write_node(node, &mut bytes)?;
        bytes[table + slot * 3..table + slot * 3 + 3].copy_from_slice(&at);
    }
    Ok(bytes)
}

/// Writes the nodes after a node, then the node itself. Returns its offset.
fn write_node(node: &Node, bytes: &mut Vec<u8>) -> Result<[u8; 3], Failure> {
    let mut next = Vec::new();
    for (answer, child) in &node.next {
        if child.next.is_empty() {
            next.extend_from_slice(&[*answer | 0x80, child.sounds]);
        } else {
            next.push(*answer);
            next.extend_from_slice(&write_node(child, bytes)?);
        }
    }
    let at = u32::try_from(bytes.len()).ok().filter(|at| *at < 1 << 24).ok_or("the tree is too large")?.to_le_bytes();
    let neighbour = u8::try_from(node.neighbour).unwrap_or_default();
    let count = u8::try_from(node.next.len()).map_err(|_| "a node with too many answers")?;
    bytes.extend_from_slice(&[node.sounds, neighbour, count]);
    bytes.append(&mut next);
    Ok([at[0], at[1], at[2]])
}
