//! A TrueType font with characters of given widths, and without shapes.

/// The units of the font in one em, and thus in the size of its texts.
pub const UNITS_PER_EM: u16 = 1000;

/// Returns a font with these characters of the Basic Multilingual Plane, each with its width in [`UNITS_PER_EM`]. All
/// others have the width of the first glyph, `.notdef`. The tables are those that the OpenType specification describes:
/// `cmap` (format 4), `head`, `hhea`, `hmtx` and `maxp`.
pub fn font(missing: u16, characters: &[(char, u16)]) -> Vec<u8> {
    let mut characters = characters.to_vec();
    characters.sort_unstable();
    let glyphs = u16::try_from(characters.len() + 1).unwrap();
    let widths = std::iter::once(missing).chain(characters.iter().map(|(_, width)| *width));
    let tables: [(&[u8; 4], Vec<u8>); 5] = [
        (b"cmap", cmap(&characters)),
        (b"head", head()),
        (b"hhea", [words(&[1, 0, 800, 200, 0]), vec![0; 24], words(&[glyphs])].concat()),
        (b"hmtx", widths.flat_map(|width| words(&[width, 0])).collect()),
        (b"maxp", words(&[0, 0x5000, glyphs])),
    ];
    let count = u16::try_from(tables.len()).unwrap();
    let mut file = words(&[1, 0, count, 64, 2, 16]);
    let mut offset = file.len() + 16 * tables.len();
    for (tag, table) in &tables {
        file.extend_from_slice(*tag);
        file.extend([0, offset as u32, table.len() as u32].iter().flat_map(|number| number.to_be_bytes()));
        offset += table.len().next_multiple_of(4);
    }
    for (_, table) in tables {
        file.extend_from_slice(&table);
        file.resize(file.len().next_multiple_of(4), 0);
    }
    file
}

/// Returns big-endian 16-bit numbers.
fn words(numbers: &[u16]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_be_bytes()).collect()
}

/// Returns a table with a segment for each character, and the last segment, which is required.
fn cmap(characters: &[(char, u16)]) -> Vec<u8> {
    let codes: Vec<u16> =
        characters.iter().map(|(character, _)| u16::try_from(u32::from(*character)).unwrap()).collect();
    let segments = u16::try_from(codes.len() + 1).unwrap();
    let deltas = codes.iter().zip(1u16..).map(|(code, glyph)| glyph.wrapping_sub(*code));
    let ends: Vec<u16> = codes.iter().copied().chain([0xFFFF]).collect();
    let deltas: Vec<u16> = deltas.chain([1]).collect();
    let search = [segments * 2, 2, 0, segments * 2 - 2];
    let arrays = [&search[..], &ends, &[0], &ends, &deltas, &vec![0; ends.len()]].concat();
    let length = u16::try_from(6 + 2 * arrays.len()).unwrap();
    words(&[&[0, 1, 3, 1, 0, 12, 4, length, 0], &arrays[..]].concat())
}

fn head() -> Vec<u8> {
    let magic = [0x5F0F, 0x3CF5];
    words(&[&[1, 0, 1, 0, 0, 0], &magic[..], &[0, UNITS_PER_EM], &[0; 8], &[0; 4], &[0, 8, 2, 0, 0]].concat())
}
