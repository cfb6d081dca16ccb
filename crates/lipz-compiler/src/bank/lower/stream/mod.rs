//! Writing a bank from front to end: the data of clips is copied from them or from their files to the file of the bank,
//! without a bank in memory.

mod pieces;
#[cfg(feature = "shards")]
mod windows;

use super::Layout;
use super::assemble::{FileHead, Section};
use crate::clip::Clips;
use crate::files::output::failed;
use crate::util::parallel;
use crate::util::pipe::{Pass, pipe};
use lipz_diagnostics::{Code, Report};
use lipz_layout::{CHECKED_FROM, RunningChecksum};
use pieces::Pieces;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use zerocopy::IntoBytes;

/// The number of bytes per write.
const AT_ONCE: usize = 1 << 16;

/// The reason why a bank could not be written.
pub(crate) enum WriteFault {
    /// The system cannot write it.
    Output(io::Error),
    /// The bank would be wrong.
    Refused(Report),
}

impl From<io::Error> for WriteFault {
    fn from(error: io::Error) -> WriteFault {
        WriteFault::Output(error)
    }
}

impl WriteFault {
    /// Returns the report about the bank at `path`.
    pub(crate) fn into_report(self, path: &Path) -> Report {
        match self {
            WriteFault::Output(error) => failed(path, &error),
            WriteFault::Refused(report) => report,
        }
    }
}

/// The destination of a bank.
pub(crate) trait BankSink: Write + Seek + Send {}

impl<T: Write + Seek + Send> BankSink for T {}

/// The result of writing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StreamedBank {
    pub(crate) length_bytes: usize,
    #[cfg(feature = "cache")]
    pub(crate) checksum: u64,
}

/// Writes the bank of a layout, with its checksum. Its clips are in `batches`. Each piece is at the position in the
/// tables, or writing fails. If there are several threads, one of them performs the slow writes.
pub(crate) fn stream(
    layout: &Layout,
    batches: &[Clips],
    out: &mut dyn BankSink,
    takes_time: bool,
) -> Result<StreamedBank, WriteFault> {
    let sections = layout.sections();
    let head = FileHead::new(&sections, layout.index.seed, layout.records.fingerprint).map_err(WriteFault::Refused)?;
    let (mut checksum, mut written) = (RunningChecksum::default(), 0);
    let make = |pass: &mut Pass<'_>| make(layout, batches, &sections, &head, pass);
    let write = |piece: &[u8]| {
        let unchecked = CHECKED_FROM.saturating_sub(written).min(piece.len());
        checksum.add(&piece[unchecked..]);
        written += piece.len();
        Ok(out.write_all(piece)?)
    };
    pipe(takes_time && parallel::thread_count() > 1, make, write)?;
    let checksum = checksum.finish();
    let mut header = head.header;
    header.checksum = checksum.into();
    out.seek(SeekFrom::Start(0))?;
    out.write_all(header.as_bytes())?;
    out.flush()?;
    Ok(StreamedBank {
        length_bytes: head.end,
        #[cfg(feature = "cache")]
        checksum,
    })
}

/// Produces the bytes of the bank in order.
fn make(
    layout: &Layout,
    batches: &[Clips],
    sections: &[Section<'_>],
    head: &FileHead,
    pass: &mut Pass<'_>,
) -> Result<(), WriteFault> {
    let mut output = Output { pass, waiting: Vec::with_capacity(2 * AT_ONCE), passed: 0 };
    output.put(head.header.as_bytes())?;
    output.put(head.directory.as_bytes())?;
    let mut pieces = Pieces::new(layout, batches);
    for (section, entry) in std::iter::zip(sections, &head.directory) {
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
    Ok(output.finish()?)
}

/// A buffer that collects bytes for writing.
struct Output<'o> {
    pass: &'o mut Pass<'o>,
    waiting: Vec<u8>,
    /// The number of bytes passed on.
    passed: usize,
}

impl Output<'_> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.waiting.extend_from_slice(bytes);
        if self.waiting.len() < AT_ONCE { Ok(()) } else { self.finish() }
    }

    /// Passes on the remaining bytes.
    fn finish(&mut self) -> io::Result<()> {
        self.passed += self.waiting.len();
        (self.pass)(&mut self.waiting)
    }

    /// Returns the offset of the next byte in the file.
    fn position(&self) -> usize {
        self.passed + self.waiting.len()
    }
}

fn misplaced() -> WriteFault {
    WriteFault::Refused(Report::failure(
        "",
        Code::BankDamaged,
        "the new bank does not match its tables",
        "report this bug of lipz together with the files that cause it",
    ))
}
