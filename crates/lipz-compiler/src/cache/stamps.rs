//! The file of a cache: what the sources of a bank looked like when it was packed.

use super::file_meta::FileMeta;
use crate::Options;
use bincode::config::{Configuration, Fixint, LittleEndian};
use bincode::{Decode, Encode};
use lipz_layout::{FORMAT_MAJOR, FORMAT_MINOR};
use std::sync::OnceLock;
use std::time::SystemTime;
use twox_hash::XxHash3_128;

/// What a cache starts with, of any version: files that start with something else are never replaced.
pub(super) type Magic = &'static [u8; 16];

/// The magic of a cache of packing.
pub(super) const MAGIC: Magic = b"lipz cache file\n";
/// The magic of a cache of checking.
pub(super) const CHECK_MAGIC: Magic = b"lipz check cache";

/// Changes whenever the file or the meaning of a stamp does. The version of the crate counts, too:
/// another compiler may find other things in the same file.
const MAKER: (&str, u16, u16, u32) = (env!("CARGO_PKG_VERSION"), FORMAT_MAJOR, FORMAT_MINOR, 3);

/// Bytes of the hash between the magic and the encoded stamps.
const HASH_BYTES: usize = 16;

/// Numbers of fixed length: there are many, and they have no small values.
const ENCODING: Configuration<LittleEndian, Fixint> = bincode::config::standard().with_fixed_int_encoding();

/// A 128-bit hash, as bytes: there are many, and numbers of that length would stand further apart.
type Hash = [u8; HASH_BYTES];

/// The hash of `bytes`. Files that differ have different ones, unless somebody makes them for that.
pub(super) fn hash(bytes: &[u8]) -> Hash {
    XxHash3_128::oneshot(bytes).to_le_bytes()
}

/// What a source file without diagnostics was when it was packed.
#[derive(Encode, Decode, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Stamp {
    meta: FileMeta,
    contents: Hash,
    flags: u8,
}

/// The file was old enough when it was looked at for the same meta to prove the same contents.
const SETTLED: u8 = 1;
/// A lint counts the file.
const MARKED: u8 = 2;

impl Stamp {
    /// The stamp of a file with these contents that looked like this before it was read, in a run that
    /// started at `start`.
    pub(super) fn new(meta: FileMeta, contents: Hash, start: SystemTime) -> Stamp {
        Stamp { meta, contents, flags: if meta.is_settled_at(start) { SETTLED } else { 0 } }
    }

    /// Whether a file that looks like this is certainly the one of the stamp.
    pub(super) fn proves(&self, meta: &FileMeta) -> bool {
        self.flags & SETTLED != 0 && self.meta == *meta
    }

    /// Notes whether a lint counts the file.
    pub(crate) fn mark(&mut self, is_marked: bool) {
        self.flags = self.flags & !MARKED | if is_marked { MARKED } else { 0 };
    }

    /// Whether a lint counts the file.
    pub(crate) fn is_marked(self) -> bool {
        self.flags & MARKED != 0
    }

    /// Whether the file of the stamp had these contents.
    pub(super) fn has_contents(&self, contents: Hash) -> bool {
        self.contents == contents
    }
}

/// The name of a file in a cache.
#[derive(Encode, Decode, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Name(Hash);

impl Name {
    /// The name of the file at `path`, whose clip has this key, made in a buffer.
    pub(super) fn new(path: &[u8], key: &str, buffer: &mut Vec<u8>) -> Name {
        buffer.clear();
        // No path contains the separator.
        [path, b"\0", key.as_bytes()].into_iter().for_each(|part| buffer.extend_from_slice(part));
        Name(hash(buffer))
    }
}

/// The stamps of the files of a bank.
#[derive(Encode, Decode, PartialEq, Eq, Debug)]
pub(super) struct Stamps {
    maker: Hash,
    options: Hash,
    /// Checksum of the bank that was packed from the files.
    pub(super) bank_checksum: u64,
    /// In the order of the inputs.
    files: Vec<(Name, Stamp)>,
}

impl Stamps {
    /// Stamps of the files of the bank with this checksum; they come with numbers, in whose order they are.
    pub(super) fn new(options: &Options, bank_checksum: u64, files: Vec<(u32, Name, Stamp)>) -> Stamps {
        let files = files.into_iter().map(|(_, name, stamp)| (name, stamp)).collect();
        Stamps { maker: maker(), options: hash_of(options), bank_checksum, files }
    }

    /// Stamps of files that were checked, and by a lint that depends on what is `beside` the files. There is no bank.
    pub(super) fn of_check(options: &Options, beside: &[u8], files: Vec<(u32, Name, Stamp)>) -> Stamps {
        Stamps { options: hash_of_check(options, beside), ..Stamps::new(options, 0, files) }
    }

    /// The stamps in the file of a cache; `None` if it was made by another version, or is damaged.
    pub(super) fn decode(magic: Magic, file: &[u8]) -> Option<Stamps> {
        let (sum, encoded) = file.strip_prefix(magic)?.split_first_chunk::<HASH_BYTES>()?;
        if *sum != hash(encoded) {
            return None;
        }
        let (stamps, length): (Stamps, usize) = bincode::decode_from_slice(encoded, ENCODING).ok()?;
        (length == encoded.len() && stamps.maker == maker()).then_some(stamps)
    }

    /// Whether the files were checked with these options.
    pub(super) fn are_of(&self, options: &Options) -> bool {
        self.options == hash_of(options)
    }

    /// Whether they were checked so.
    pub(super) fn are_of_check(&self, options: &Options, beside: &[u8]) -> bool {
        self.options == hash_of_check(options, beside)
    }

    /// The file of a cache.
    pub(super) fn encode(&self, magic: Magic) -> Option<Vec<u8>> {
        let encoded = bincode::encode_to_vec(self, ENCODING).ok()?;
        Some([magic.as_slice(), &hash(&encoded), &encoded].concat())
    }

    /// For looking the stamps up by name.
    pub(super) fn lookup(&self) -> Lookup<'_> {
        Lookup::new(&self.files)
    }

    /// Number of stamps.
    pub(super) fn count(&self) -> usize {
        self.files.len()
    }

    /// The names and stamps of files, in the order of the inputs.
    pub(super) fn files(&self) -> &[(Name, Stamp)] {
        &self.files
    }
}

/// Stamps by name. Files come in the order in which the run before this one stamped them, but for those
/// that were added or had diagnostics: nearly always the next stamp is the one that is looked for.
pub(super) struct Lookup<'s> {
    files: &'s [(Name, Stamp)],
    /// The places of the stamps in the order of their names; made when a file is out of order.
    by_name: OnceLock<Vec<usize>>,
}

impl<'s> Lookup<'s> {
    /// For looking these up.
    pub(super) fn new(files: &'s [(Name, Stamp)]) -> Lookup<'s> {
        Lookup { files, by_name: OnceLock::new() }
    }

    /// The stamp of a file, probably the one at `next`, which is then moved behind it.
    pub(super) fn get(&self, name: Name, next: &mut usize) -> Option<&'s Stamp> {
        let at = |at: &usize| self.files.get(*at).filter(|(found, _)| *found == name);
        if at(next).is_none() {
            let by_name = self.by_name.get_or_init(|| {
                let mut places: Vec<usize> = (0..self.files.len()).collect();
                places.sort_unstable_by_key(|&at| self.files[at].0);
                places
            });
            *next = *by_name.get(by_name.partition_point(|&at| self.files[at].0 < name))?;
        }
        let (_, stamp) = at(next)?;
        *next += 1;
        Some(stamp)
    }
}

fn maker() -> Hash {
    hash(format!("{MAKER:?}").as_bytes())
}

/// The options as a number: all but the number of threads, which changes no bank.
fn hash_of(options: &Options) -> Hash {
    hash(format!("{:?}", Options { threads: None, ..options.clone() }).as_bytes())
}

/// The options and what else a lint depends on.
fn hash_of_check(options: &Options, beside: &[u8]) -> Hash {
    hash(&[hash_of(options).as_slice(), beside].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(path: &[u8], key: &str) -> Name {
        Name::new(path, key, &mut Vec::new())
    }

    fn stamps(options: &Options) -> Stamps {
        let meta = FileMeta::new(&std::fs::metadata(env!("CARGO_MANIFEST_DIR")).unwrap()).unwrap();
        let file = |path: &[u8]| (0, name(path, "a"), Stamp::new(meta, hash(path), SystemTime::now()));
        Stamps::new(options, 7, vec![file(b"x"), file(b"y"), file(b"z")])
    }

    #[test]
    fn a_file_gives_its_stamps_back_and_damaged_none() {
        let stamps = stamps(&Options::default());
        let file = stamps.encode(MAGIC).unwrap();
        assert_eq!(Stamps::decode(MAGIC, &file).as_ref(), Some(&stamps));
        for at in 0..file.len() {
            assert_eq!(Stamps::decode(MAGIC, &file[..at]), None);
            for bit in 0..8 {
                let mut damaged = file.clone();
                damaged[at] ^= 1 << bit;
                assert_eq!(Stamps::decode(MAGIC, &damaged), None, "bit {bit} of byte {at}");
            }
        }
        assert_eq!(Stamps::decode(MAGIC, &[&file[..], b"\0"].concat()), None);
    }

    #[test]
    fn stamps_are_found_in_and_out_of_order() {
        let stamps = stamps(&Options::default());
        let lookup = stamps.lookup();
        let mut next = 0;
        let mut has = |path: &[u8]| {
            let name = name(path, "a");
            lookup.get(name, &mut next).is_some_and(|stamp| stamp.has_contents(hash(path)))
        };
        assert!([b"x", b"y", b"z"].into_iter().all(|path| has(path)), "in order");
        assert!(lookup.by_name.get().is_none(), "nothing had to be searched");
        assert!(!has(b"w"), "not known");
        assert!([b"z", b"x", b"y", b"y"].into_iter().all(|path| has(path)), "out of order");
        assert_eq!(lookup.get(name(b"y", "b"), &mut 1), None, "the path with another key");
    }

    #[test]
    fn other_options_and_versions_are_not_meant() {
        let stamps = stamps(&Options::default());
        assert!(stamps.are_of(&Options::new().threads(3)));
        assert!(!stamps.are_of(&Options::new().strip(true)));
        assert_eq!(Stamps::decode(CHECK_MAGIC, &stamps.encode(MAGIC).unwrap()), None);
        let of_another = Stamps { maker: hash(b"another"), ..stamps };
        assert_eq!(Stamps::decode(MAGIC, &of_another.encode(MAGIC).unwrap()), None);
    }
}
