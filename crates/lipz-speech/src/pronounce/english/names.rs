//! The English names of letters.

use crate::Phone::{self, *};

/// The names of `a` to `z`.
const NAMES: [&[Phone]; 26] = [
    &[Ey],
    &[B, Iy],
    &[S, Iy],
    &[D, Iy],
    &[Iy],
    &[Eh, F],
    &[Jh, Iy],
    &[Ey, Ch],
    &[Ay],
    &[Jh, Ey],
    &[K, Ey],
    &[Eh, L],
    &[Eh, M],
    &[Eh, N],
    &[Ow],
    &[P, Iy],
    &[K, Y, Uw],
    &[Aa, R],
    &[Eh, S],
    &[T, Iy],
    &[Y, Uw],
    &[V, Iy],
    &[D, Ah, B, Ah, L, Y, Uw],
    &[Eh, K, S],
    &[W, Ay],
    &[Z, Iy],
];

/// Returns the names of all letters of a word in lower case.
pub(super) fn spelled(word: &str) -> Vec<Phone> {
    let names = word.bytes().filter(u8::is_ascii_lowercase).map(|letter| NAMES[usize::from(letter - b'a')]);
    names.flatten().copied().collect()
}
