//! The visually distinct groups of phones.

use crate::Phone;
use Phone::*;

/// The phones of speech and silence, grouped by their look: at rest, with closed lips, with the lip under the teeth,
/// round, open, and narrow (the shapes of the chart in `shapes.rs`, with hardly distinguishable ones joined).
pub(crate) const LOOKS: [&[Phone]; 6] = [
    &[Sil],
    &[B, M, P],
    &[F, V],
    &[Ao, Ow, Oy, Uh, Uw, W],
    &[Aa, Ae, Ah, Aw, Ay, Eh, Er, Ey, Ih, Iy],
    &[Ch, D, Dh, G, Hh, Jh, K, L, N, Ng, R, S, Sh, T, Th, Y, Z, Zh],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_phone_of_speech_has_one_look() {
        let mut all = LOOKS.concat();
        all.sort_by_key(|phone| phone.index());
        assert!(all.into_iter().eq(Phone::ALL.into_iter().filter(|phone| phone.is_speech() || *phone == Sil)));
    }
}
