//! Building the clip index: a pilot for each bucket, a slot for each clip.

use lipz_layout::{DIRECT_SLOT, U32, bucket_of, slot_of, spread};

/// The average number of ids per bucket. More of them make the table smaller and the search longer: with 3, the table
/// takes 1.3 bytes per clip and the search a few hundred trials for the last buckets.
const IDS_PER_BUCKET: usize = 3;
/// The most ids in a bucket. With more, a different seed is used.
const MAX_BUCKET: usize = 40;
/// The base of the seeds after the first: an arbitrary number without structure.
const ATTEMPT_SEED: u64 = 0x9FB2_1C65_1E98_DF25;
/// The most pilots to try before a different seed is used.
const MAX_TRIALS: u32 = 1 << 22;

/// The clip index.
pub(super) struct Index {
    /// The initial value of the hash.
    pub(super) seed: u64,
    /// One pilot per bucket.
    pub(super) pilots: Vec<U32>,
    /// The slot of each clip, in the given order of clips.
    pub(super) slots: Vec<u32>,
    /// The slots in their stored form.
    pub(super) slots_le: Vec<U32>,
}

/// Returns the index of `ids`, at most 2³¹ of them, or as an error the smallest duplicate id.
///
/// Seed 0 works for all keys except chosen ones: with it, a bucket of more than [`MAX_BUCKET`] ids, or two ids of a
/// bucket that no pilot separates, are less likely than a memory error. Keys chosen against seed 0 are spread by the
/// next seed, which is independent. Only equal ids fail with every seed. They are searched for only after a seed has
/// failed.
pub(super) fn build(ids: &[u64]) -> Result<Index, u64> {
    let mut attempt = 0;
    loop {
        let seed = if attempt == 0 { 0 } else { spread(attempt, ATTEMPT_SEED) };
        if let Some((pilots, slots)) = try_seed(ids, seed) {
            let slots_le = slots.iter().map(|&slot| slot.into()).collect();
            return Ok(Index { seed, pilots: pilots.into_iter().map(U32::new).collect(), slots, slots_le });
        }
        if attempt == 0 {
            are_distinct(ids)?;
        }
        attempt += 1;
    }
}

/// Checks that all ids are distinct. The error is the smallest duplicate.
fn are_distinct(ids: &[u64]) -> Result<(), u64> {
    let mut sorted = ids.to_vec();
    sorted.sort_unstable();
    sorted.array_windows().find(|[id, next]| id == next).map_or(Ok(()), |[id, _]| Err(*id))
}

fn try_seed(ids: &[u64], seed: u64) -> Option<(Vec<u32>, Vec<u32>)> {
    let bucket_count = ids.len().div_ceil(IDS_PER_BUCKET);
    let (slot_count, buckets_u32) = (u32::try_from(ids.len()).ok()?, u32::try_from(bucket_count).ok()?);
    let buckets = Buckets::new(ids, seed, buckets_u32);
    if (0..bucket_count).any(|bucket| buckets.members(bucket).len() > MAX_BUCKET) {
        return None;
    }
    let mut order: Vec<usize> = (0..bucket_count).collect();
    order.sort_by_key(|&bucket| std::cmp::Reverse(buckets.members(bucket).len()));
    let mut taken = vec![false; ids.len()];
    let mut pilots = vec![0; bucket_count];
    let mut slots = vec![0; ids.len()];
    let mut next_free = 0;
    for bucket in order {
        pilots[bucket] = match buckets.members(bucket) {
            [] => break, // the remaining buckets are empty too
            [(_, clip)] => {
                next_free += taken[next_free..].iter().position(|taken| !taken)?;
                taken[next_free] = true;
                slots[*clip] = u32::try_from(next_free).ok()?;
                slots[*clip] | DIRECT_SLOT
            }
            members => place(members, slot_count, &mut taken, &mut slots)?,
        };
    }
    Some((pilots, slots))
}

/// Clips with their spread ids, grouped by bucket.
struct Buckets {
    members: Vec<(u64, usize)>,
    /// The start of each bucket in `members`, and the end of the last one.
    starts: Vec<usize>,
}

impl Buckets {
    fn new(ids: &[u64], seed: u64, count: u32) -> Buckets {
        let bucket_of = |hash: u64| bucket_of(hash, count) as usize;
        let mut starts = vec![0; count as usize + 1];
        for &id in ids {
            starts[bucket_of(spread(id, seed)) + 1] += 1;
        }
        for bucket in 1..starts.len() {
            starts[bucket] += starts[bucket - 1];
        }
        let mut ends = starts.clone();
        let mut members = vec![(0, 0); ids.len()];
        for (clip, &id) in ids.iter().enumerate() {
            let hash = spread(id, seed);
            let end = &mut ends[bucket_of(hash)];
            members[*end] = (hash, clip);
            *end += 1;
        }
        Buckets { members, starts }
    }

    fn members(&self, bucket: usize) -> &[(u64, usize)] {
        &self.members[self.starts[bucket]..self.starts[bucket + 1]]
    }
}

/// Finds a pilot that maps all `members` to different free slots, and takes those.
fn place(members: &[(u64, usize)], slot_count: u32, taken: &mut [bool], slots: &mut [u32]) -> Option<u32> {
    'pilots: for pilot in 0..MAX_TRIALS {
        for (index, &(hash, clip)) in members.iter().enumerate() {
            let slot = slot_of(hash, pilot, slot_count);
            if taken[slot as usize] {
                for &(_, clip) in &members[..index] {
                    taken[slots[clip] as usize] = false;
                }
                continue 'pilots;
            }
            taken[slot as usize] = true;
            slots[clip] = slot;
        }
        return Some(pilot);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_bank::ClipId;

    #[test]
    fn every_id_has_a_slot_of_its_own() {
        for count in [0_usize, 1, 2, 3, 4, 7, 40, 1000, 50_000] {
            let ids: Vec<u64> = (0..count).map(|n| ClipId::from_key(&format!("act{}/line-{n}", n % 7)).get()).collect();
            let index = build(&ids).ok().unwrap();
            let mut slots = index.slots.clone();
            slots.sort_unstable();
            assert!(slots.iter().enumerate().all(|(at, &slot)| slot as usize == at), "{count}");
            for (id, &slot) in ids.iter().zip(&index.slots) {
                let hash = spread(*id, index.seed);
                let pilot = index.pilots[bucket_of(hash, index.pilots.len() as u32) as usize].get();
                assert_eq!(slot_of(hash, pilot, count as u32), slot);
            }
        }
    }

    /// Returns the id whose spread with seed 0 is `hash`.
    fn unspread(hash: u64) -> u64 {
        (hash ^ (hash >> 32)).wrapping_mul(0xF1DE_83E1_9937_733D)
    }

    #[test]
    fn ids_that_no_pilot_separates_get_another_seed() {
        // Two ids whose spread agrees in all bits that determine bucket and slot.
        let target = 0x1234_5678_9ABC_DEF0_u64;
        let ids = [unspread(target), unspread(target ^ (1 << 32))];
        assert_eq!(spread(ids[0], 0) as u32, spread(ids[1], 0) as u32);
        assert_eq!(build(&ids).map(|index| index.seed), Ok(spread(1, ATTEMPT_SEED)));
    }

    #[test]
    fn ids_chosen_to_fall_into_one_bucket_get_another_seed() {
        let ids: Vec<u64> = (1..=20_000).map(unspread).collect();
        assert!(ids.iter().all(|&id| bucket_of(spread(id, 0), 6667) == 0));
        assert_eq!(build(&ids).map(|index| index.seed), Ok(spread(1, ATTEMPT_SEED)));
    }

    #[test]
    fn equal_ids_are_found() {
        let mut ids: Vec<u64> = (0..1000).map(|number| spread(number, 1)).collect();
        ids.extend([8, 8, 7, 7]);
        assert_eq!(build(&ids).map(|index| index.seed), Err(7));
        assert_eq!(build(&[9; 2 * MAX_BUCKET]).map(|index| index.seed), Err(9), "more than a bucket has");
    }
}
