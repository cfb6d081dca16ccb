//! A bank that is written from front to end: what clips own goes from them, or from their files, to that of the bank, and there
//! is no bank in memory.

mod pieces;
#[cfg(feature = "shards")]
mod windows;

use super::Layout;
use super::assemble::{Head, Section};
use crate::clip::Clips;
use crate::output::failed;
use crate::parallel;
use crate::pipe::{Pass, pipe};
use lipz_diagnostics::{Code, Report};
use lipz_layout::{CHECKED_FROM, RunningChecksum};
use pieces::Pieces;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use zerocopy::IntoBytes;

/// Bytes that are written at once.
const AT_ONCE: usize = 1 << 16;

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
pub(crate) trait Target: Write + Seek + Send {}

impl<T: Write + Seek + Send> Target for T {}

/// What was written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Streamed {
    pub(crate) length_bytes: usize,
    #[cfg(feature = "cache")]
    pub(crate) checksum: u64,
}

/// Writes the bank of a layout, whose clips are in `batches`, and which gets the checksum of its bytes. Each piece stands where the
/// tables say, or there is none. What takes its time to be written is written on a thread of its own, if there are several.
pub(crate) fn stream(
    layout: &Layout,
    batches: &[Clips],
    out: &mut dyn Target,
    takes_time: bool,
) -> Result<Streamed, Fault> {
    let sections = layout.sections();
    let head = Head::new(&sections, layout.index.seed, layout.records.fingerprint).map_err(Fault::Refused)?;
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
    Ok(Streamed {
        length_bytes: head.end,
        #[cfg(feature = "cache")]
        checksum,
    })
}

/// Makes the bytes of the bank, in their order.
fn make(
    layout: &Layout,
    batches: &[Clips],
    sections: &[Section<'_>],
    head: &Head,
    pass: &mut Pass<'_>,
) -> Result<(), Fault> {
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

/// Bytes that gather until there are enough to be written.
struct Output<'o> {
    pass: &'o mut Pass<'o>,
    waiting: Vec<u8>,
    /// How many are passed on.
    passed: usize,
}

impl Output<'_> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.waiting.extend_from_slice(bytes);
        if self.waiting.len() < AT_ONCE { Ok(()) } else { self.finish() }
    }

    /// Passes on what is there.
    fn finish(&mut self) -> io::Result<()> {
        self.passed += self.waiting.len();
        (self.pass)(&mut self.waiting)
    }

    /// Where what comes next stands in the file.
    fn position(&self) -> usize {
        self.passed + self.waiting.len()
    }
}

fn misplaced() -> Fault {
    Fault::Refused(Report::failure(
        "",
        Code::BankDamaged,
        "the bank that was made is not what its tables say",
        "this is a defect of lipz: please report it with the files that lead to it",
    ))
}
