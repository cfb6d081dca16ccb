//! The sizes of a linked program's sections.

use object::{Object, ObjectSection, SectionKind};

/// Bytes of a program.
pub(super) struct Sizes {
    /// Machine code.
    pub(super) code_bytes: u64,
    /// Constants outside of the code.
    pub(super) constant_bytes: u64,
    /// Static memory: data and bss.
    pub(super) memory_bytes: u64,
}

/// Tables for unwinding, which firmware that does not unwind drops.
const UNWINDING: &str = ".ARM.ex";

/// Counts the sections of an ELF file.
pub(super) fn sizes(elf: &[u8]) -> object::Result<Sizes> {
    let file = object::File::parse(elf)?;
    let mut sizes = Sizes { code_bytes: 0, constant_bytes: 0, memory_bytes: 0 };
    for section in file.sections() {
        if section.name()?.starts_with(UNWINDING) {
            continue;
        }
        match section.kind() {
            SectionKind::Text => sizes.code_bytes += section.size(),
            SectionKind::ReadOnlyData | SectionKind::ReadOnlyString => sizes.constant_bytes += section.size(),
            SectionKind::Data | SectionKind::UninitializedData => sizes.memory_bytes += section.size(),
            _ => {}
        }
    }
    Ok(sizes)
}
