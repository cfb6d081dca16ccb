//! A bank that is written from front to end, so that what clips own goes from their files to its own in small pieces.

use super::Layout;
use super::assemble::Head;
use crate::clip::{Clip, Clips, Part, Window};
use crate::output::failed;
use crate::running_checksum::RunningChecksum;
use lipz_diagnostics::{Code, Report};
use lipz_layout::{CHECKED_FROM, TEXT_HAS_LENGTH, TEXT_OFFSET, Tag, U32, text_count};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use zerocopy::IntoBytes;

/// Bytes that are written at once.
const AT_ONCE: usize = 1 << 18;

/// Bytes of the windows of all files together, and of each at least.
const WINDOWS_BYTES: usize = 1 << 22;
const SMALLEST_WINDOW_BYTES: usize = 1 << 12;

/// Why a bank could not be written.
pub(crate) enum Fault {
    /// The system cannot write it.
    Output(io::Error),
    /// It would not be what it should be.
    Refused(Report),
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Fault {
        Fault::Output(error)
    }
}

impl Fault {
    /// The report about the bank at `path`.
    pub(crate) fn into_report(self, path: &Path) -> Report {
        match self {
            Fault::Output(error) => failed(path, &error),
            Fault::Refused(report) => report,
        }
    }
}

/// Where a bank is written.
pub(crate) trait Target: Write + Seek {}

impl<T: Write + Seek> Target for T {}

/// The file of a bank, of which everything is written once, in its order.
struct Output<'o> {
    out: &'o mut dyn Target,
    /// What is not yet written, and how many bytes are.
    waiting: Vec<u8>,
    written: usize,
    checksum: RunningChecksum,
}

impl Output<'_> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.waiting.extend_from_slice(bytes);
        if self.waiting.len() < AT_ONCE { Ok(()) } else { self.write() }
    }

    fn write(&mut self) -> io::Result<()> {
        let unchecked = CHECKED_FROM.saturating_sub(self.written).min(self.waiting.len());
        self.checksum.add(&self.waiting[unchecked..]);
        self.out.write_all(&self.waiting)?;
        self.written += self.waiting.len();
        self.waiting.clear();
        Ok(())
    }

    /// Where what comes next stands in the file.
    fn position(&self) -> usize {
        self.written + self.waiting.len()
    }
}

/// Writes the bank of a layout, whose clips are in `batches`, and which gets the checksum of its bytes. Each piece stands where the
/// tables say, or there is none.
pub(crate) fn stream(layout: &Layout, batches: &[Clips], out: &mut dyn Target) -> Result<usize, Fault> {
    let sections = layout.sections();
    let head = Head::new(&sections, layout.index.seed, layout.records.fingerprint).map_err(Fault::Refused)?;
    let checksum = RunningChecksum::new();
    let mut output = Output { out, waiting: Vec::with_capacity(2 * AT_ONCE), written: 0, checksum };
    output.put(head.header.as_bytes())?;
    output.put(head.directory.as_bytes())?;
    let mut pieces = Pieces::new(layout, batches);
    for (section, entry) in std::iter::zip(&sections, &head.directory) {
        let start = entry.offset_bytes.get() as usize;
        let gap = start.checked_sub(output.position()).ok_or_else(misplaced)?;
        output.put(&vec![0; gap])?;
        match section.table {
            Some(table) => table.chunks(AT_ONCE).try_for_each(|piece| output.put(piece))?,
            None => pieces.copy(section.tag, start, &mut output)?,
        }
        if output.position() != start + entry.length_bytes.get() as usize {
            return Err(misplaced());
        }
    }
    output.write()?;
    let mut header = head.header;
    header.checksum = output.checksum.finish().into();
    output.out.seek(SeekFrom::Start(0))?;
    output.out.write_all(header.as_bytes())?;
    output.out.flush()?;
    Ok(head.end)
}

/// What is copied from the clips.
struct Pieces<'l> {
    layout: &'l Layout,
    batches: &'l [Clips],
    /// Batch and index of the clip in each slot.
    by_slot: Vec<(u32, u32)>,
    /// Slots in the order of the segments' numbers.
    order: Vec<u32>,
    /// For each batch, where its file was read last.
    windows: Vec<Window>,
    window_bytes: usize,
}

impl<'l> Pieces<'l> {
    fn new(layout: &'l Layout, batches: &'l [Clips]) -> Pieces<'l> {
        let mut by_slot = vec![(0, 0); layout.records.clips.len()];
        for (batch, slots) in (0..).zip(&layout.batch_slots) {
            (0..).zip(slots).for_each(|(index, &slot)| by_slot[slot as usize] = (batch, index));
        }
        let mut order: Vec<u32> = layout.batch_slots.iter().flatten().copied().collect();
        // Each batch is in this order.
        order.sort_by_key(|&slot| layout.records.clips[slot as usize].segments_first.get());
        Pieces {
            layout,
            batches,
            by_slot,
            order,
            windows: batches.iter().map(|_| Window::default()).collect(),
            window_bytes: (WINDOWS_BYTES / batches.len().max(1)).max(SMALLEST_WINDOW_BYTES),
        }
    }

    /// Writes a section that starts at this offset in the file.
    fn copy(&mut self, tag: Tag, start: usize, output: &mut Output<'_>) -> Result<(), Fault> {
        match tag {
            Tag::FRAMES => self.frames(start, output),
            Tag::TEXTS => self.texts(start, output),
            _ => self.sources(start, output),
        }
    }

    fn frames(&mut self, start: usize, output: &mut Output<'_>) -> Result<(), Fault> {
        for place in 0..self.order.len() {
            let slot = self.order[place];
            let record = &self.layout.records.clips[slot as usize];
            if start + record.frames_offset_bytes.get() as usize != output.position() {
                return Err(misplaced());
            }
            let part = self.clip(slot).frames();
            let (bytes, _) = self.pieces(slot, part, usize::MAX);
            output.put(bytes)?;
        }
        Ok(())
    }

    /// The texts, locale by locale. Equal ones have one place, and stand there when the first of them has been written.
    fn texts(&mut self, start: usize, output: &mut Output<'_>) -> Result<(), Fault> {
        let layout = self.layout;
        for (locale, table) in layout.texts.starts.chunks(layout.segment_count.max(1)).enumerate() {
            for place in 0..self.order.len() {
                let slot = self.order[place];
                let clip = self.clip(slot);
                let Some(index) = clip.text_in(locale as u32) else { continue };
                let first = layout.records.clips[slot as usize].segments_first.get() as usize;
                let entries = &table[first..first + clip.starts().len()];
                self.text(slot, clip.displays(index), start, entries, output)?;
            }
        }
        Ok(())
    }

    /// Writes the texts of a clip at their entries, unless they stand there.
    fn text(
        &mut self,
        slot: u32,
        texts: Part<'l>,
        section_start: usize,
        entries: &[U32],
        output: &mut Output<'_>,
    ) -> Result<(), Fault> {
        let offset = |entry: &U32| (entry.get() & TEXT_OFFSET) as usize;
        let (Some(first), Some(last)) = (entries.first(), entries.last()) else { return Ok(()) };
        if section_start + offset(first) < output.position() {
            return Ok(());
        }
        let inner = offset(last).checked_sub(offset(first)).ok_or_else(misplaced)?;
        let (before, last_text) = self.pieces(slot, texts, inner);
        let starts = entries.iter().map(|entry| offset(entry).checked_sub(offset(first)));
        let are_starts = starts.clone().all(|start| start.is_some_and(|start| is_start(before, start)));
        if section_start + offset(first) != output.position() || !are_starts || !is_start(last_text, 0) {
            return Err(misplaced());
        }
        output.put(before)?;
        if last.get() & TEXT_HAS_LENGTH != 0 {
            output.put(&text_count(last_text.len()))?;
        }
        output.put(last_text)?;
        Ok(())
    }

    /// The source records, in the order of the keys of the first clips that have them.
    fn sources(&mut self, start: usize, output: &mut Output<'_>) -> Result<(), Fault> {
        let layout = self.layout;
        for slot in layout.index.slots.iter().copied() {
            let offset = start + layout.sources.index[slot as usize].get() as usize;
            let part = self.clip(slot).source();
            if offset > output.position() {
                return Err(misplaced());
            }
            if offset == output.position() {
                let (bytes, _) = self.pieces(slot, part, usize::MAX);
                output.put(bytes)?;
            }
        }
        Ok(())
    }

    fn clip(&self, slot: u32) -> Clip<'l> {
        let (batch, index) = self.by_slot[slot as usize];
        self.batches[batch as usize].clip(index)
    }

    /// The part of the clip in a slot in two pieces: so many bytes, and the rest.
    fn pieces(&mut self, slot: u32, part: Part<'l>, before: usize) -> (&[u8], &[u8]) {
        match part {
            Part::Here(bytes) => bytes.split_at(before.min(bytes.len())),
            Part::Stays(part) => {
                let (batch, _) = self.by_slot[slot as usize];
                match self.windows[batch as usize].pieces(&part, self.window_bytes) {
                    (bytes, []) => bytes.split_at(before.min(bytes.len())),
                    pieces => pieces,
                }
            }
        }
    }
}

/// Whether a character of a UTF-8 string starts there, or the string ends.
fn is_start(text: &[u8], at: usize) -> bool {
    text.get(at).map_or(at == text.len(), |byte| byte & 0xC0 != 0x80)
}

fn misplaced() -> Fault {
    Fault::Refused(Report::failure(
        "",
        Code::BankDamaged,
        "the bank that was made is not what its tables say",
        "this is a defect of lipz: please report it with the files that lead to it",
    ))
}
