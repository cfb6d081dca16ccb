//! The content hashes in docs/reference/bank-format.md, which were computed with xxHash's own library.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_sync::content_hash;

#[test]
fn the_content_hash_is_that_of_the_page() {
    let page = include_str!("../../../docs/reference/bank-format.md");
    let (_, table) = page.split_once("| bytes | content hash |\n|---|---|\n").unwrap();
    let rows: Vec<&str> = table.lines().take_while(|line| line.starts_with('|')).collect();
    let bytes = |cell: &str| match cell {
        "(none)" => Vec::new(),
        "00 01 02 ... FF" => (0..=255).collect(),
        quoted => quoted.trim_matches('`').as_bytes().to_vec(),
    };
    for row in &rows {
        let mut cells = row.trim_matches('|').split('|').map(str::trim);
        let (cell, hash) = (cells.next().unwrap(), cells.next().unwrap());
        let found = content_hash(bytes(cell).as_slice()).unwrap();
        assert_eq!(format!("`{found:016x}`"), hash, "{cell}");
    }
    assert_eq!(rows.len(), 3);
}
