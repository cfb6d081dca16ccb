//! A pipe for bytes that one thread produces and another consumes, piece by piece.

use std::io;
use std::sync::mpsc::{channel, sync_channel};
use std::thread;

/// The most pieces that wait.
const MOST_WAITING: usize = 2;

/// Takes a piece, and leaves an empty buffer for the next one.
pub(crate) type Pass<'p> = dyn FnMut(&mut Vec<u8>) -> io::Result<()> + 'p;

/// Makes `make` pass pieces to `take` in order; on a separate thread if it `may_share` the work and the system provides
/// one.
pub(crate) fn pipe<E: From<io::Error> + Send>(
    may_share: bool,
    make: impl Fn(&mut Pass<'_>) -> Result<(), E>,
    mut take: impl FnMut(&[u8]) -> Result<(), E> + Send,
) -> Result<(), E> {
    if may_share && let Some(done) = on_two_threads(&make, &mut take) {
        return done;
    }
    let mut fault = None;
    let made = make(&mut |piece| {
        let taken = take(piece);
        piece.clear();
        taken.map_err(|error| {
            fault = Some(error);
            stopped()
        })
    });
    fault.map_or(made, Err)
}

/// Does the same on two threads. Returns `None` without doing anything if the system does not provide a second thread.
fn on_two_threads<E: From<io::Error> + Send>(
    make: &impl Fn(&mut Pass<'_>) -> Result<(), E>,
    take: &mut (impl FnMut(&[u8]) -> Result<(), E> + Send),
) -> Option<Result<(), E>> {
    let (full, to_take) = sync_channel::<Vec<u8>>(MOST_WAITING);
    let (empty, to_fill) = channel();
    thread::scope(|scope| {
        let taking = thread::Builder::new().spawn_scoped(scope, move || {
            for mut piece in to_take {
                take(&piece)?;
                piece.clear();
                // The producer may have ended.
                let _ = empty.send(piece);
            }
            Ok(())
        });
        let taking = taking.ok()?;
        let made = make(&mut |piece| {
            full.send(std::mem::replace(piece, to_fill.try_recv().unwrap_or_default())).map_err(|_| stopped())
        });
        drop(full);
        match taking.join() {
            Ok(taken) => Some(taken.and(made)),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Returns the error that nothing more is taken. The consumer reports the actual reason.
fn stopped() -> io::Error {
    io::ErrorKind::BrokenPipe.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the bytes taken from this number of pieces, optionally with an error at one of them.
    fn taken(may_share: bool, pieces: u8, fails_at: Option<u8>) -> Result<Vec<u8>, String> {
        struct Fault(String);
        impl From<io::Error> for Fault {
            fn from(error: io::Error) -> Fault {
                Fault(error.to_string())
            }
        }
        let mut taken = Vec::new();
        let make = |pass: &mut Pass<'_>| {
            let mut piece = Vec::new();
            for number in 0..pieces {
                assert!(piece.is_empty());
                piece.extend_from_slice(&[number; 3]);
                pass(&mut piece)?;
            }
            Ok(())
        };
        let take = |piece: &[u8]| {
            if piece.first().copied() == fails_at && fails_at.is_some() {
                return Err(Fault("the disk is full".to_owned()));
            }
            taken.extend_from_slice(piece);
            Ok(())
        };
        pipe(may_share, make, take).map_err(|fault| fault.0)?;
        Ok(taken)
    }

    #[test]
    fn pieces_come_in_their_order() {
        for may_share in [false, true] {
            let all: Vec<u8> = (0..200).flat_map(|number| [number; 3]).collect();
            assert_eq!(taken(may_share, 200, None), Ok(all));
            assert_eq!(taken(may_share, 0, None), Ok(Vec::new()));
        }
    }

    #[test]
    fn a_fault_of_who_takes_is_the_one_that_is_told() {
        for may_share in [false, true] {
            for at in [0, 1, 150, 199] {
                assert_eq!(taken(may_share, 200, Some(at)), Err("the disk is full".to_owned()), "{at}");
            }
        }
    }

    #[test]
    fn panics_of_either_side_end_both() {
        for (may_share, of_taker) in [(false, false), (false, true), (true, false), (true, true)] {
            let make = |pass: &mut Pass<'_>| {
                (0..100).try_for_each(|number| {
                    assert!(of_taker || number < 50, "made up");
                    pass(&mut vec![number])
                })
            };
            let take = |piece: &[u8]| {
                assert!(!of_taker || piece[0] < 50, "made up");
                Ok(())
            };
            let ended = std::panic::catch_unwind(move || pipe::<io::Error>(may_share, make, take));
            assert!(ended.is_err(), "{may_share} {of_taker}");
        }
    }
}
