//! The dictionary, packed: words in order, each without the start shared with the one before, then its phones, unless
//! they match the rules. `crates/lipz-speech/src/pronounce/english/words.rs` reads the bytes and describes them.

use super::huffman::{Bits, Code};
use super::source::{PHONES, Words};
use super::tree::Tree;
use crate::Failure;

/// The number of words in a block. A search decodes one block.
const BLOCK: usize = 32;
/// The symbols of words: `'`, `.`, `a` to `z`, and the end.
const END_OF_WORD: usize = 28;
const LETTERS: usize = END_OF_WORD + 1;
/// The number of values for letters shared with the previous word.
const SHARED: usize = 32;
/// The symbols of pronunciations: the phones; "as in the rules"; the end; "another pronunciation follows".
const AS_RULES: usize = PHONES.len();
const END: usize = PHONES.len() + 1;
const ANOTHER: usize = PHONES.len() + 2;
const SOUNDS: usize = PHONES.len() + 3;

/// The symbols of one word.
struct Entry {
    shared: usize,
    letters: Vec<usize>,
    sounds: Vec<usize>,
}

pub(super) fn pack(words: &Words, tree: &Tree) -> Result<Vec<u8>, Failure> {
    let entries = entries(words, tree);
    let mut counts = (vec![0; SHARED], vec![0; LETTERS], vec![0; SOUNDS]);
    for entry in &entries {
        *counts.0.get_mut(entry.shared).ok_or("a word is too long")? += 1;
        entry.letters.iter().for_each(|letter| counts.1[*letter] += 1);
        entry.sounds.iter().for_each(|sound| counts.2[*sound] += 1);
    }
    let (shared, letters, sounds) = (Code::new(&counts.0), Code::new(&counts.1), Code::new(&counts.2));
    let mut bits = Bits::default();
    let mut blocks = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        if index.is_multiple_of(BLOCK) {
            blocks.push(u32::try_from(bits.count).map_err(|_| "too many words")?);
        }
        bits.push(&shared, entry.shared);
        entry.letters.iter().for_each(|letter| bits.push(&letters, *letter));
        entry.sounds.iter().for_each(|sound| bits.push(&sounds, *sound));
    }
    let number = |number: usize| u32::try_from(number).map_err(|_| "too many words");
    let mut bytes = b"LZDW".to_vec();
    bytes.extend_from_slice(&number(entries.len())?.to_le_bytes());
    bytes.extend_from_slice(&number(blocks.len())?.to_le_bytes());
    bytes.extend_from_slice(&checksum(words).to_le_bytes());
    for code in [&shared, &letters, &sounds] {
        bytes.extend_from_slice(&code.lengths);
    }
    blocks.iter().for_each(|block| bytes.extend_from_slice(&block.to_le_bytes()));
    bytes.append(&mut bits.bytes);
    Ok(bytes)
}

fn entries(words: &Words, tree: &Tree) -> Vec<Entry> {
    let mut before: &[u8] = b"";
    let mut entries = Vec::with_capacity(words.len());
    for (index, (word, all)) in words.iter().enumerate() {
        let word = word.as_bytes();
        let same = word.iter().zip(before).take_while(|(one, two)| one == two).count();
        let shared = if index.is_multiple_of(BLOCK) { 0 } else { same };
        let letters = word[shared..].iter().map(|letter| match letter {
            b'\'' => 0,
            b'.' => 1,
            letter => 2 + usize::from(letter - b'a'),
        });
        let letters = letters.chain([END_OF_WORD]).collect();
        let by_rules = tree.phones(word);
        let mut sounds = Vec::new();
        for (index, phones) in all.iter().enumerate() {
            if index > 0 {
                sounds.push(ANOTHER);
            }
            match *phones == by_rules {
                true => sounds.push(AS_RULES),
                false => sounds.extend(phones.iter().map(|phone| usize::from(*phone))),
            }
        }
        sounds.push(END);
        entries.push(Entry { shared, letters, sounds });
        before = word;
    }
    entries
}

/// Returns the FNV-1a hash of all words and phones, with which a test of lipz-speech checks that it reads the same
/// data.
fn checksum(words: &Words) -> u32 {
    let mut hash = 0x811c_9dc5_u32;
    let mut add = |byte: u8| hash = (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    for (word, all) in words {
        word.bytes().for_each(&mut add);
        for phones in all {
            add(0xff);
            phones.iter().copied().for_each(&mut add);
        }
        add(0xfe);
    }
    hash
}
