//! Unsupported audio formats, detected by their first bytes for a helpful error message.

/// The number of bytes that [`name`] examines.
pub(super) const LOOKED_AT: usize = 64;

/// The first bytes of formats: their offset, their value, and a description.
const STARTS: [(usize, &[u8], &str); 10] = [
    (4, b"ftyp", "an MPEG-4 file (M4A, AAC)"),
    (0, b"caff", "a Core Audio file (CAF)"),
    (0, b"\x1a\x45\xdf\xa3", "a Matroska or WebM file"),
    (0, b"\x30\x26\xb2\x75\x8e\x66\xcf\x11", "a Windows Media file (WMA)"),
    (0, b"#!AMR", "an AMR file"),
    (0, b"wvpk", "a WavPack file"),
    (0, b"MAC ", "a Monkey's Audio file (APE)"),
    (0, b".snd", "an AU file"),
    (0, b"MThd", "a MIDI file"),
    (0, b"riff\x2e\x91\xcf\x11", "a Sony Wave64 file (W64)"),
];
/// The first bytes of the first packet of an Ogg file.
const IN_OGG: [(&[u8], &str); 2] = [(b"OpusHead", "an Ogg file with Opus"), (b"Speex   ", "an Ogg file with Speex")];
/// The offset of that packet: after the header of a page with one packet.
const OGG_PACKET: usize = 28;

/// Returns a description of the file that starts with these bytes, if its format is certainly unsupported.
pub(super) fn name(start: &[u8]) -> Option<&'static str> {
    let has = |at: usize, bytes: &[u8]| start.get(at..).is_some_and(|rest| rest.starts_with(bytes));
    if has(0, b"OggS") {
        return IN_OGG.iter().find(|(bytes, _)| has(OGG_PACKET, bytes)).map(|(_, name)| *name);
    }
    if has(0, b"RIFF") && !has(8, b"WAVE") && start.len() >= 12 {
        return Some("a RIFF file without audio");
    }
    STARTS.iter().find(|(at, bytes, _)| has(*at, bytes)).map(|(.., name)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_known_by_their_first_bytes() {
        assert_eq!(name(b"\0\0\0\x20ftypM4A \0"), Some("an MPEG-4 file (M4A, AAC)"));
        let page = [b"OggS".as_slice(), &[0; 22], &[1, 19], b"OpusHead\x01"].concat();
        assert_eq!(name(&page), Some("an Ogg file with Opus"));
        assert_eq!(name(b"RIFF\x10\0\0\0AVI LIST"), Some("a RIFF file without audio"));
        assert_eq!(name(b"riff\x2e\x91\xcf\x11\xa5\xd6"), Some("a Sony Wave64 file (W64)"));
        for read in
            [b"RIFF\x10\0\0\0WAVEfmt ".as_slice(), b"OggS", b"fLaC", b"ID3\x04", b"FORM\0\0\0\0AIFF", b"RIFF", b""]
        {
            assert_eq!(name(read), None);
        }
    }
}
