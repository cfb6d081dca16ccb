//! Banks built field by field, which are larger or less usual than those of the fixtures.

use lipz_bank::{ClipId, VisemeType};
use lipz_layout::*;
use zerocopy::IntoBytes;

/// A clip to be forged, without frame rate and events.
#[derive(Clone)]
pub struct ForgedClip {
    pub key: &'static str,
    pub frames: Vec<u8>,
    /// Starts of segments 1 and up.
    pub starts: Vec<u32>,
}

/// Returns the bank of `clips`, which must be ordered by key. `locale_count` locales share the pool of texts and the
/// same text starts, `text_starts`.
pub fn bank(clips: &[ForgedClip], locale_count: usize, text_starts: &[u32], pool: &[u8]) -> Vec<u8> {
    let (mut records, mut keys, mut names, mut frames) = (Vec::new(), Vec::new(), String::new(), Vec::new());
    let mut starts: Vec<U32> = Vec::new();
    for clip in clips {
        let start = frames.len() as u32;
        records.push(ClipRecord {
            frames_offset_bytes: start.into(),
            frame_count: (clip.frames.len() as u32).into(),
            segments_first: (starts.len() as u32).into(),
            rate: NO_RATE.into(),
            viseme_type: VisemeType::Blair as u8,
            flags: FLAG_VISEMES,
        });
        keys.push(KeyRecord {
            id: ClipId::from_key(clip.key).get().into(),
            key_offset_bytes: (names.len() as u32).into(),
            key_length_bytes: (clip.key.len() as u16).into(),
            segment_count: (clip.starts.len() as u16 + 1).into(),
        });
        starts.extend(std::iter::once(&0).chain(&clip.starts).map(|&behind| U32::new(start + behind)));
        names.push_str(clip.key);
        frames.extend_from_slice(&clip.frames);
    }
    starts.push((frames.len() as u32).into());
    let mut locales = Vec::new();
    for number in 0..locale_count {
        let offset = names.len() as u32;
        locales.push(LocaleRecord { tag_offset_bytes: offset.into(), tag_length_bytes: 8.into(), flags: 0.into() });
        names.push_str(&format!("{number:08}"));
    }
    let order: Vec<U32> = (0..clips.len() as u32).map(U32::new).collect();
    let all_locales = text_starts.repeat(locale_count);
    let text_starts: Vec<U32> = all_locales.into_iter().chain([pool.len() as u32]).map(U32::new).collect();
    let (pilots, none) = (pilots(&keys), [].as_slice());
    let contents: [&[u8]; 16] = [
        records.as_bytes(),
        keys.as_bytes(),
        none,
        pilots.as_bytes(),
        order.as_bytes(),
        names.as_bytes(),
        &frames,
        starts.as_bytes(),
        locales.as_bytes(),
        text_starts.as_bytes(),
        pool,
        none,
        none,
        none,
        none,
        none,
    ];
    let sections = Tag::REQUIRED.iter().zip(contents).map(|(&(tag, entry), contents)| (tag, entry as u16, contents));
    file(&sections.collect::<Vec<_>>(), fingerprint(&keys, &records), 0)
}

/// Returns pilots that lead every id directly to its slot: with so many buckets that each has at most one id.
fn pilots(records: &[KeyRecord]) -> Vec<U32> {
    let buckets = |count: u32| records.iter().map(move |record| bucket_of(spread(record.id.get(), 0), count) as usize);
    let count = (1..10_000).find(|&count| {
        let mut taken = vec![false; count as usize];
        buckets(count).all(|bucket| !std::mem::replace(&mut taken[bucket], true))
    });
    let mut pilots = vec![U32::new(DIRECT_SLOT); count.expect("few clips") as usize];
    for (slot, bucket) in buckets(pilots.len() as u32).enumerate() {
        pilots[bucket] = (DIRECT_SLOT | slot as u32).into();
    }
    pilots
}

/// Returns the file of these sections: tag, length of an entry, contents. They follow each other as `verify` requires.
pub fn file(sections: &[(Tag, u16, &[u8])], fingerprint: u64, index_seed: u64) -> Vec<u8> {
    let mut bytes = vec![0; 64 + 16 * sections.len()];
    for (index, &(tag, entry_bytes, contents)) in sections.iter().enumerate() {
        bytes.resize(bytes.len().next_multiple_of(64), 0);
        let is_optional = Tag::OPTIONAL.iter().any(|optional| optional.tag == tag);
        let entry = DirectoryEntry {
            tag: tag.0,
            offset_bytes: (bytes.len() as u32).into(),
            length_bytes: (contents.len() as u32).into(),
            entry_bytes: entry_bytes.into(),
            flags: if is_optional { 0 } else { SECTION_REQUIRED }.into(),
        };
        bytes[64 + 16 * index..][..16].copy_from_slice(entry.as_bytes());
        bytes.extend_from_slice(contents);
    }
    let mut header = Header {
        magic: MAGIC,
        checksum: 0.into(),
        file_length_bytes: (bytes.len() as u32).into(),
        format_major: FORMAT_MAJOR.into(),
        format_minor: FORMAT_MINOR.into(),
        fingerprint: fingerprint.into(),
        index_seed: index_seed.into(),
        section_count: (sections.len() as u32).into(),
        reserved: [0; 20],
    };
    bytes[..64].copy_from_slice(header.as_bytes());
    header.checksum = checksum(&bytes[CHECKED_FROM..]).into();
    bytes[..64].copy_from_slice(header.as_bytes());
    bytes
}
