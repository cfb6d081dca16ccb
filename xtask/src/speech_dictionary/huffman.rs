//! Huffman codes in their canonical form: only the lengths of the codes are written.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The code of each symbol.
#[derive(Debug)]
pub(super) struct Code {
    /// The number of bits of each symbol.
    pub(super) lengths: Vec<u8>,
    codes: Vec<u32>,
}

impl Code {
    /// Returns the shortest code for symbols with these frequencies. Every symbol gets a code, even with a frequency of
    /// 0.
    pub(super) fn new(counts: &[u64]) -> Code {
        // Nodes: the symbols, then the pairs. For each node its parent, to count the steps to the root.
        let mut parents = vec![0_usize; counts.len()];
        let mut heap: BinaryHeap<Reverse<(u64, usize)>> =
            counts.iter().enumerate().map(|(symbol, count)| Reverse((count.max(&1).to_owned(), symbol))).collect();
        while let (Some(Reverse(one)), Some(Reverse(two))) = (heap.pop(), heap.pop()) {
            let pair = parents.len();
            parents.push(0);
            parents[one.1] = pair;
            parents[two.1] = pair;
            heap.push(Reverse((one.0 + two.0, pair)));
            if heap.len() == 1 {
                break;
            }
        }
        let root = parents.len() - 1;
        let depth = |mut node: usize| {
            let mut depth = 0;
            while node != root {
                node = parents[node];
                depth += 1;
            }
            depth
        };
        let lengths: Vec<u8> = (0..counts.len()).map(depth).collect();
        // Canonical: shorter codes first, then by symbol.
        let mut order: Vec<usize> = (0..counts.len()).collect();
        order.sort_by_key(|symbol| (lengths[*symbol], *symbol));
        let mut codes = vec![0; counts.len()];
        let (mut next, mut length) = (0_u32, 0);
        for symbol in order {
            next <<= lengths[symbol] - length;
            length = lengths[symbol];
            codes[symbol] = next;
            next += 1;
        }
        Code { lengths, codes }
    }
}

/// Bits, stored from the highest bit of each byte.
#[derive(Default, Debug)]
pub(super) struct Bits {
    pub(super) bytes: Vec<u8>,
    pub(super) count: usize,
}

impl Bits {
    pub(super) fn push(&mut self, code: &Code, symbol: usize) {
        for bit in (0..code.lengths[symbol]).rev() {
            if self.count.is_multiple_of(8) {
                self.bytes.push(0);
            }
            if code.codes[symbol] >> bit & 1 == 1 {
                let last = self.bytes.len() - 1;
                self.bytes[last] |= 0x80 >> (self.count % 8);
            }
            self.count += 1;
        }
    }
}
