//! Compares ways to find a clip by its id, and to hash a key to an id. The results explain the choices in the bank
//! format.
#![allow(
    missing_docs,
    clippy::cast_possible_truncation,
    clippy::expect_used,
    reason = "a bench program for 64 bits: criterion's macros, and a stop at the first surprise"
)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use foldhash::fast::FixedState;
use lipz_bank::{Bank, ClipId};
use lipz_benches::{DEFAULT_SEED, Random, clip_key};
use lipz_compiler::{Compiler, Input};
use lipz_layout::{KeyRecord, Tag, U32, bucket_of, slot_of, spread};
use std::hash::{BuildHasher, DefaultHasher, Hasher};
use std::hint::black_box;
use std::time::Duration;
use twox_hash::XxHash3_64;
use zerocopy::FromBytes;

/// The queries per round: enough that at 100,000 clips their data exceeds the processor's caches.
const QUESTIONS: usize = 1 << 17;

/// The result of a look-up: a record of the bank's length, with a number for the clip.
#[derive(Clone, Copy, Default)]
struct Record {
    id: u64,
    /// The rest of the record. It is not read here, but takes up space.
    _rest: u64,
}

impl Record {
    fn new(id: u64) -> Record {
        Record { id, _rest: 0 }
    }
}

/// A way to find a record by its id.
trait Index {
    fn find(&self, id: u64) -> Option<usize>;
}

/// The index of the bank.
struct Perfect<'b> {
    seed: u64,
    pilots: &'b [U32],
    records: &'b [KeyRecord],
}

impl<'b> Perfect<'b> {
    fn new(bank: &Bank<'b>) -> Perfect<'b> {
        let section = |tag: Tag| bank.sections().find(|(found, _)| *found == tag.0).map_or(&[][..], |(_, bytes)| bytes);
        Perfect {
            seed: 0, // 0 unless keys were chosen to collide
            pilots: <[U32]>::ref_from_bytes(section(Tag::PILOTS)).expect("pilots"),
            records: <[KeyRecord]>::ref_from_bytes(section(Tag::KEYS)).expect("key records"),
        }
    }
}

impl Index for Perfect<'_> {
    #[inline]
    fn find(&self, id: u64) -> Option<usize> {
        let spread = spread(id, self.seed);
        let pilot = self.pilots.get(bucket_of(spread, self.pilots.len() as u32) as usize)?;
        let slot = slot_of(spread, pilot.get(), self.records.len() as u32) as usize;
        (self.records.get(slot)?.id.get() == id).then_some(slot)
    }
}

/// Open addressing with linear probing, with the records inside. At most two thirds of the entries are used.
struct OpenAddressing(Vec<Record>);

impl OpenAddressing {
    fn new(ids: &[u64]) -> OpenAddressing {
        let mut places = vec![Record::default(); (ids.len() * 3 / 2).next_power_of_two()];
        let mask = places.len() - 1;
        for &id in ids {
            let mut place = id as usize & mask;
            while places[place].id != 0 {
                place = (place + 1) & mask;
            }
            places[place] = Record::new(id);
        }
        OpenAddressing(places)
    }
}

impl Index for OpenAddressing {
    #[inline]
    fn find(&self, id: u64) -> Option<usize> {
        let mask = self.0.len() - 1;
        let mut place = id as usize & mask;
        loop {
            match self.0[place].id {
                found if found == id => return Some(place),
                0 => return None,
                _ => place = (place + 1) & mask,
            }
        }
    }
}

/// Groups of eight records with one-byte tags, which are compared at once. At most seven eighths are used.
struct Tagged {
    /// The tags of a group; an unused entry has the tag 0.
    tags: Vec<u64>,
    records: Vec<[Record; 8]>,
}

/// A one in each byte.
const ONES: u64 = u64::from_ne_bytes([1; 8]);

impl Tagged {
    fn new(ids: &[u64]) -> Tagged {
        let groups = (ids.len() * 8 / 7 / 8 + 1).next_power_of_two();
        let (mut tags, mut records) = (vec![0_u64; groups], vec![[Record::default(); 8]; groups]);
        for &id in ids {
            let mut group = id as usize & (groups - 1);
            let place = loop {
                match tags[group].to_le_bytes().iter().position(|&tag| tag == 0) {
                    Some(place) => break place,
                    None => group = (group + 1) & (groups - 1),
                }
            };
            tags[group] |= u64::from(Self::tag(id)) << (8 * place);
            records[group][place] = Record::new(id);
        }
        Tagged { tags, records }
    }

    /// Returns the upper bits of the id, and a bit for a used entry.
    fn tag(id: u64) -> u8 {
        (id >> 56) as u8 | 0x80
    }

    /// Returns the upper bit of each byte that is 0, and of some bytes above it, which the comparison of ids rejects.
    fn zeros(bytes: u64) -> u64 {
        bytes.wrapping_sub(ONES) & !bytes & (ONES << 7)
    }
}

impl Index for Tagged {
    #[inline]
    fn find(&self, id: u64) -> Option<usize> {
        let wanted = ONES.wrapping_mul(u64::from(Self::tag(id)));
        let mut group = id as usize & (self.tags.len() - 1);
        loop {
            let tags = self.tags[group];
            let mut equal = Self::zeros(tags ^ wanted);
            while equal != 0 {
                let place = (equal.trailing_zeros() / 8) as usize;
                if self.records[group][place].id == id {
                    return Some(8 * group + place);
                }
                equal &= equal - 1;
            }
            if Self::zeros(tags) != 0 {
                return None;
            }
            group = (group + 1) & (self.tags.len() - 1);
        }
    }
}

/// A binary search in sorted records.
struct Sorted(Vec<Record>);

impl Index for Sorted {
    #[inline]
    fn find(&self, id: u64) -> Option<usize> {
        self.0.binary_search_by(|record| record.id.cmp(&id)).ok()
    }
}

/// A binary search without mispredicted branches: sorted records in the order of a tree's levels (Khuong and Morin,
/// "Array layouts for comparison-based searching", 2017). Record 0 is not used.
struct Eytzinger(Vec<Record>);

impl Eytzinger {
    fn new(sorted: &[Record]) -> Eytzinger {
        fn fill(sorted: &mut impl Iterator<Item = Record>, tree: &mut [Record], node: usize) {
            if node < tree.len() {
                fill(sorted, tree, 2 * node);
                tree[node] = sorted.next().expect("a record for each node");
                fill(sorted, tree, 2 * node + 1);
            }
        }
        let mut tree = vec![Record::default(); sorted.len() + 1];
        fill(&mut sorted.iter().copied(), &mut tree, 1);
        Eytzinger(tree)
    }
}

impl Index for Eytzinger {
    #[inline]
    fn find(&self, id: u64) -> Option<usize> {
        let mut node = 1;
        while let Some(record) = self.0.get(node) {
            node = 2 * node + usize::from(record.id < id);
        }
        // Go back up to the node where the search last went left.
        let found = node >> (node.trailing_ones() + 1);
        (self.0[found].id == id).then_some(found)
    }
}

fn indexes(criterion: &mut Criterion) {
    for count in [1_000, 10_000, 100_000] {
        let inputs: Vec<Input> =
            (0..count).map(|index| Input::from_bytes(clip_key(index), br#"{ "visemes": "A" }"#)).collect();
        let bytes = Compiler::default().compile(&inputs).bank.expect("clips without errors");
        let bank = Bank::open(&bytes).expect("a bank");
        let ids: Vec<u64> = (0..count).map(|index| ClipId::from_key(&clip_key(index)).get()).collect();
        let mut sorted: Vec<Record> = ids.iter().copied().map(Record::new).collect();
        sorted.sort_by_key(|record| record.id);
        let mut random = Random::new(DEFAULT_SEED, 0);
        let mut ask = |first: usize| -> Vec<u64> {
            let id = |index| ClipId::from_key(&clip_key(first + index)).get();
            let ids: Vec<u64> = (0..count).map(id).collect();
            (0..QUESTIONS).map(|_| ids[random.between(0, count - 1)]).collect()
        };
        let questions = [("found", ask(0)), ("missing", ask(count))];
        let group = format!("{count} clips");
        time(criterion, &group, "minimal perfect hash", &Perfect::new(&bank), &questions);
        time(criterion, &group, "open addressing, records inside", &OpenAddressing::new(&ids), &questions);
        time(criterion, &group, "groups of eight tags", &Tagged::new(&ids), &questions);
        time(criterion, &group, "Eytzinger", &Eytzinger::new(&sorted), &questions);
        time(criterion, &group, "binary search", &Sorted(sorted), &questions);
    }
}

/// Looks up existing ids, and the ids of other keys.
fn time(criterion: &mut Criterion, group: &str, name: &str, index: &impl Index, questions: &[(&str, Vec<u64>); 2]) {
    let [(_, found), (_, missing)] = questions;
    let is_there = |id: &u64| index.find(*id).is_some();
    assert!(found.iter().all(is_there) && !missing.iter().any(is_there), "{name}");
    let mut group = criterion.benchmark_group(group);
    group.throughput(Throughput::Elements(QUESTIONS as u64));
    group.sample_size(20).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    for (what, asked) in questions {
        group.bench_function(format!("{name}, {what}"), |bencher| {
            bencher.iter(|| {
                let places = black_box(asked).iter().filter_map(|id| index.find(*id));
                places.fold(0, usize::wrapping_add)
            });
        });
    }
    group.finish();
}

fn hashes(criterion: &mut Criterion) {
    let keys: Vec<String> = (0..10_000).map(clip_key).collect();
    let mut group = criterion.benchmark_group("id of a key");
    group.throughput(Throughput::Elements(keys.len() as u64));
    group.sample_size(20).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    let mut time = |name: &str, hash: fn(&str) -> u64| {
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(&keys).iter().fold(0, |sum: u64, key| sum.wrapping_add(hash(key))));
        });
    };
    time("clip id", |key| ClipId::from_key(key).get());
    time("FNV-1a", |key| {
        key.bytes().fold(0xCBF2_9CE4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3))
    });
    time("SipHash 1-3 (std)", |key| {
        let mut hasher = DefaultHasher::new();
        hasher.write(key.as_bytes());
        hasher.finish()
    });
    time("foldhash", |key| FixedState::default().hash_one(key.as_bytes()));
    time("XXH3", |key| XxHash3_64::oneshot(key.as_bytes()));
    group.finish();
}

criterion_group!(benches, indexes, hashes);
criterion_main!(benches);
