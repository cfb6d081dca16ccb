//! The frequencies of sequences of phones, from a dictionary.

use std::collections::HashMap;

/// The percentage of words before a pause.
const PAUSES: f64 = 15.0;

/// Returns the negative logarithm of the probability of each pair of `phones`, in sixteenths. The last phone is
/// silence. Each word of the dictionary counts once, and may follow any word.
pub(super) fn costs(phones: &[&str], dictionary: &str) -> Vec<u8> {
    let numbers: HashMap<&str, usize> = phones.iter().enumerate().map(|(number, &phone)| (phone, number)).collect();
    let (count, silence) = (phones.len(), phones.len() - 1);
    let mut within = vec![1.0; count * count];
    let mut starts = vec![0.0; count];
    let mut ends = vec![0.0; count];
    let mut words = 0.0;
    for line in dictionary.lines() {
        let word: Vec<usize> = line.split_whitespace().skip(1).filter_map(|name| numbers.get(name).copied()).collect();
        for pair in word.windows(2) {
            within[pair[0] * count + pair[1]] += 1.0;
        }
        if let (Some(&first), Some(&last)) = (word.first(), word.last()) {
            starts[first] += 1.0;
            ends[last] += 1.0;
            words += 1.0;
        }
    }
    let mut costs = Vec::with_capacity(count * count);
    for phone in 0..count {
        let row: Vec<f64> = (0..count)
            .map(|next| match (phone == silence, next == silence) {
                (true, true) => 1.0,
                (true, false) => starts[next] + 1.0,
                (false, true) => 1.0 + ends[phone] * PAUSES / 100.0,
                (false, false) => {
                    within[phone * count + next] + ends[phone] * (1.0 - PAUSES / 100.0) * starts[next] / words
                }
            })
            .collect();
        let sum: f64 = row.iter().sum();
        let cost = |times: &f64| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
            let cost = ((sum / times).ln() * 16.0).round().clamp(0.0, 255.0) as u8;
            cost
        };
        costs.extend(row.iter().map(cost));
    }
    costs
}
