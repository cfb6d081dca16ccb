//! The English dictionary: 126,000 words of the CMU Pronouncing Dictionary, which are looked up in packed form.
//!
//! `data/english/words.bin`: `LZDW`; the numbers of words and blocks and a checksum of all words, four bytes each; the
//! lengths of three canonical Huffman codes, a byte per symbol; for each block the offset of its first bit, four bytes;
//! then bits, from the highest in each byte. A block has 32 words in alphabetical order. A word consists of the number
//! of letters that it shares with the one before (absent in the first of a block), the other letters, an end symbol,
//! and its pronunciations. A pronunciation is a list of phones, or one symbol if the rules of `letters.rs` produce the
//! same; one symbol separates pronunciations, and another ends them. `cargo xtask speech-dictionary` writes the file.

use super::letters;
use crate::Phone;
use std::cmp::Ordering;
use std::sync::LazyLock;

static BYTES: &[u8] = include_bytes!("../../../data/english/words.bin");

/// The size of the header: the name of the format, and three numbers.
const HEADER: usize = 16;
const SHARED: usize = 32;
const LETTERS: [u8; 28] = *b"'.abcdefghijklmnopqrstuvwxyz";
const PHONES: usize = 39;
/// The symbols after the phones.
const AS_RULES: usize = PHONES;
const END: usize = PHONES + 1;
const ANOTHER: usize = PHONES + 2;
const BLOCK: usize = 32;

static CODES: LazyLock<[Code; 3]> = LazyLock::new(|| {
    let mut at = HEADER;
    [SHARED, LETTERS.len() + 1, PHONES + 3].map(|symbols| {
        at += symbols;
        Code::new(BYTES.get(at - symbols..at).unwrap_or_default())
    })
});

/// Returns all pronunciations of a word in lower case, the most common first, or none if the dictionary does not
/// contain it.
pub(crate) fn find(word: &str) -> Vec<Vec<Phone>> {
    let word = word.as_bytes();
    // Find the last block whose first word is not after this word.
    let (mut low, mut high) = (0, number(8));
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        match Reader::new(middle).next().is_some_and(|first| first.letters.as_slice() <= word) {
            true => low = middle,
            false => high = middle,
        }
    }
    let mut reader = Reader::new(low);
    for _ in 0..BLOCK {
        let Some(entry) = reader.next() else { break };
        match entry.letters.as_slice().cmp(word) {
            Ordering::Less => {}
            Ordering::Equal => return entry.pronunciations(),
            Ordering::Greater => break,
        }
    }
    Vec::new()
}

/// Reads a number of the header, or the offset of a block.
fn number(at: usize) -> usize {
    let bytes = BYTES.get(at..at + 4).and_then(|bytes| <[u8; 4]>::try_from(bytes).ok());
    bytes.map_or(0, |bytes| u32::from_le_bytes(bytes) as usize)
}

/// A word with the symbols of its pronunciations.
#[derive(Debug, Default, Clone)]
struct WordEntry {
    letters: Vec<u8>,
    sounds: Vec<usize>,
}

impl WordEntry {
    fn pronunciations(&self) -> Vec<Vec<Phone>> {
        let one = |symbols: &[usize]| match symbols {
            [AS_RULES] => letters::phones(std::str::from_utf8(&self.letters).unwrap_or_default()),
            phones => phones.iter().filter_map(|phone| Phone::ALL.get(*phone).copied()).collect(),
        };
        self.sounds.split(|symbol| *symbol == ANOTHER).map(one).collect()
    }
}

/// Reads entries from the start of a block on.
struct Reader {
    bit: usize,
    entry: WordEntry,
}

impl Reader {
    fn new(block: usize) -> Reader {
        let blocks = HEADER + SHARED + LETTERS.len() + 1 + PHONES + 3;
        let bits = blocks + 4 * number(8);
        Reader { bit: 8 * bits + number(blocks + 4 * block), entry: WordEntry::default() }
    }

    fn next(&mut self) -> Option<&WordEntry> {
        let [shared, letters, sounds] = &*CODES;
        let shared = shared.read(&mut self.bit)?;
        self.entry.letters.truncate(shared);
        while let Some(letter) = LETTERS.get(letters.read(&mut self.bit)?) {
            self.entry.letters.push(*letter);
        }
        self.entry.sounds.clear();
        loop {
            match sounds.read(&mut self.bit)? {
                END => return Some(&self.entry),
                symbol => self.entry.sounds.push(symbol),
            }
        }
    }
}

/// A canonical Huffman code: shorter codes come first, and codes of equal length are sorted by symbol.
struct Code {
    /// The symbols, sorted by code.
    symbols: Vec<usize>,
    /// The number of codes of each length, which is the index.
    counts: [usize; 33],
}

impl Code {
    fn new(lengths: &[u8]) -> Code {
        let mut symbols: Vec<usize> = (0..lengths.len()).collect();
        symbols.sort_by_key(|symbol| lengths.get(*symbol));
        let mut counts = [0; 33];
        for length in lengths {
            if let Some(count) = counts.get_mut(usize::from(*length)) {
                *count += 1;
            }
        }
        Code { symbols, counts }
    }

    /// Reads the symbol at `bit` and advances it, or returns `None` at the end of the data.
    fn read(&self, bit: &mut usize) -> Option<usize> {
        let (mut code, mut first, mut before) = (0, 0, 0);
        for count in self.counts.iter().skip(1) {
            let byte = BYTES.get(*bit / 8)?;
            code = code << 1 | usize::from(byte >> (7 - *bit % 8) & 1);
            *bit += 1;
            first <<= 1;
            if code < first + count {
                return self.symbols.get(before + code - first).copied();
            }
            first += count;
            before += count;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(word: &str) -> Vec<String> {
        let join = |phones: Vec<Phone>| phones.iter().map(|phone| phone.name()).collect::<Vec<_>>().join(" ");
        find(word).into_iter().map(join).collect()
    }

    #[test]
    fn words_have_all_their_pronunciations() {
        assert_eq!(said("either"), ["IY DH ER", "AY DH ER"]);
        assert_eq!(said("read"), ["R EH D", "R IY D"]);
        assert_eq!(said("the"), ["DH AH", "DH IY"]);
        assert_eq!(said("a"), ["AH", "EY"]);
        assert_eq!(said("zywicki"), ["Z IH W IH K IY"]);
        assert_eq!(said("'em"), ["AH M"]);
        assert_eq!(said("a.m."), ["EY EH M"]);
    }

    #[test]
    fn what_is_not_in_the_dictionary_is_not_found() {
        for word in ["", "'", "aa", "zzzz", "hello there", "Hello", "ünlü", "~"] {
            assert_eq!(find(word), Vec::<Vec<Phone>>::new(), "{word}");
        }
    }

    /// The checksum covers the content of the dictionary, not the packed bytes, so a match proves that they are read as
    /// `xtask` wrote them.
    #[test]
    fn every_word_is_read_as_it_was_written() {
        let mut hash = 0x811c_9dc5_u32;
        let mut add = |byte: u8| hash = (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        let (mut reader, mut words) = (Reader::new(0), 0);
        let mut before = Vec::new();
        while words < number(4) {
            let entry = reader.next().expect("a word");
            assert!(before < entry.letters, "in order");
            before.clone_from(&entry.letters);
            entry.letters.iter().copied().for_each(&mut add);
            for phones in entry.pronunciations() {
                add(0xff);
                phones.iter().for_each(|phone| add(u8::try_from(phone.index()).unwrap_or_default()));
            }
            add(0xfe);
            words += 1;
        }
        assert_eq!(words, 125_040);
        assert_eq!(hash as usize, number(12));
    }
}
