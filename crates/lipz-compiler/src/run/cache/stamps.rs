//! The cache file: the state of a bank's sources when it was packed.

use crate::files::FileMeta;
use crate::project::Options;
use bincode::config::{Configuration, Fixint, LittleEndian};
use bincode::{Decode, Encode};
use lipz_layout::{FORMAT_MAJOR, FORMAT_MINOR};
use std::sync::OnceLock;
use std::time::SystemTime;
use twox_hash::XxHash3_128;

/// The first bytes of a cache of any version. Files that start differently are never replaced.
pub(super) type Magic = &'static [u8; 16];

/// The magic of a packing cache.
pub(super) const MAGIC: Magic = b"lipz cache file\n";
/// The magic of a checking cache.
pub(super) const CHECK_MAGIC: Magic = b"lipz check cache";

/// Changes with the file format and the meaning of a stamp. It includes the version of the crate, because a different
/// compiler may produce different diagnostics for the same file.
const MAKER: (&str, u16, u16, u32) = (env!("CARGO_PKG_VERSION"), FORMAT_MAJOR, FORMAT_MINOR, 3);

/// The length in bytes of the hash between the magic and the encoded stamps.
const HASH_BYTES: usize = 16;

/// Numbers have a fixed length, because there are many and they are rarely small.
const ENCODING: Configuration<LittleEndian, Fixint> = bincode::config::standard().with_fixed_int_encoding();

/// A 128-bit hash as bytes, because 128-bit integers would be aligned and take more memory.
type Hash = [u8; HASH_BYTES];

/// Returns the hash of `bytes`. Different files have different hashes, except for files constructed to collide.
pub(super) fn hash(bytes: &[u8]) -> Hash {
    XxHash3_128::oneshot(bytes).to_le_bytes()
}

/// The state of a source file without diagnostics when it was packed.
#[derive(Encode, Decode, Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Stamp {
    meta: FileMeta,
    contents: Hash,
    flags: u8,
}

/// The file was old enough when it was examined for the same metadata to prove the same contents.
const SETTLED: u8 = 1;
/// A lint counts the file.
const MARKED: u8 = 2;

impl Stamp {
    /// Creates the stamp of a file with these contents and this metadata from before it was read, in a run that started
    /// at `start`.
    pub(super) fn new(meta: FileMeta, contents: Hash, start: SystemTime) -> Stamp {
        Stamp { meta, contents, flags: if meta.is_settled_at(start) { SETTLED } else { 0 } }
    }

    /// Whether a file with this metadata is certain to be that of the stamp.
    pub(super) fn proves(&self, meta: &FileMeta) -> bool {
        self.flags & SETTLED != 0 && self.meta == *meta
    }

    /// Sets whether a lint counts the file.
    pub(super) fn mark(&mut self, is_marked: bool) {
        self.flags = self.flags & !MARKED | if is_marked { MARKED } else { 0 };
    }

    /// Whether a lint counts the file.
    pub(super) fn is_marked(self) -> bool {
        self.flags & MARKED != 0
    }

    /// Whether the file of the stamp had these contents.
    pub(super) fn has_contents(&self, contents: Hash) -> bool {
        self.contents == contents
    }
}

/// The name of a file in a cache.
#[derive(Encode, Decode, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct CacheFileName(Hash);

impl CacheFileName {
    /// Creates the name of the file at `path`, whose clip has this key, using a buffer.
    pub(super) fn new(path: &[u8], key: &str, buffer: &mut Vec<u8>) -> CacheFileName {
        buffer.clear();
        // No path contains the separator.
        [path, b"\0", key.as_bytes()].into_iter().for_each(|part| buffer.extend_from_slice(part));
        CacheFileName(hash(buffer))
    }
}

/// The stamps of the files of a bank.
#[derive(Encode, Decode, PartialEq, Eq, Debug)]
pub(super) struct Stamps {
    maker: Hash,
    options: Hash,
    /// The checksum of the bank packed from the files.
    pub(super) bank_checksum: u64,
    /// In the order of the inputs.
    files: Vec<(CacheFileName, Stamp)>,
}

impl Stamps {
    /// Creates the stamps of the files of the bank with this checksum. They are sorted by the numbers that come with
    /// them.
    pub(super) fn new(options: &Options, bank_checksum: u64, files: Vec<(u32, CacheFileName, Stamp)>) -> Stamps {
        let files = files.into_iter().map(|(_, name, stamp)| (name, stamp)).collect();
        Stamps { maker: maker(), options: hash_of(options), bank_checksum, files }
    }

    /// Creates the stamps of files that were checked, including by a lint that depends on `beside`. There is no bank.
    pub(super) fn of_check(options: &Options, beside: &[u8], files: Vec<(u32, CacheFileName, Stamp)>) -> Stamps {
        Stamps { options: hash_of_check(options, beside), ..Stamps::new(options, 0, files) }
    }

    /// Decodes the stamps in a cache file; `None` if it is damaged or of a different version.
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

    /// Whether the files were checked with these options and this input of the lint.
    pub(super) fn are_of_check(&self, options: &Options, beside: &[u8]) -> bool {
        self.options == hash_of_check(options, beside)
    }

    /// Encodes the cache file.
    pub(super) fn encode(&self, magic: Magic) -> Option<Vec<u8>> {
        let encoded = bincode::encode_to_vec(self, ENCODING).ok()?;
        Some([magic.as_slice(), &hash(&encoded), &encoded].concat())
    }

    /// Returns a lookup of the stamps by name.
    pub(super) fn lookup(&self) -> Lookup<'_> {
        Lookup::new(&self.files)
    }

    /// Returns the number of stamps.
    pub(super) fn count(&self) -> usize {
        self.files.len()
    }

    /// Returns the names and stamps of files, in the order of the inputs.
    pub(super) fn files(&self) -> &[(CacheFileName, Stamp)] {
        &self.files
    }
}

/// Stamps by name. Files usually come in the order in which the previous run stamped them, except for added ones and
/// those with diagnostics, so that the next stamp is nearly always the right one.
pub(super) struct Lookup<'s> {
    files: &'s [(CacheFileName, Stamp)],
    /// The indexes of the stamps, sorted by name. Computed when a file is out of order.
    by_name: OnceLock<Vec<usize>>,
}

impl<'s> Lookup<'s> {
    /// Creates a lookup of these stamps.
    pub(super) fn new(files: &'s [(CacheFileName, Stamp)]) -> Lookup<'s> {
        Lookup { files, by_name: OnceLock::new() }
    }

    /// Returns the stamp of a file, which is probably the one at `next`. Sets `next` to the one after it.
    pub(super) fn get(&self, name: CacheFileName, next: &mut usize) -> Option<&'s Stamp> {
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

/// Returns a hash of the options, except for the number of threads, which affects no bank.
fn hash_of(options: &Options) -> Hash {
    hash(format!("{:?}", Options { threads: None, ..options.clone() }).as_bytes())
}

/// Returns a hash of the options and of the other input of a lint.
fn hash_of_check(options: &Options, beside: &[u8]) -> Hash {
    hash(&[hash_of(options).as_slice(), beside].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(path: &[u8], key: &str) -> CacheFileName {
        CacheFileName::new(path, key, &mut Vec::new())
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
