//! SQLite: tables, keys, prepared statements.

use crate::Failure;
use crate::corpus::{Corpus, frame_at};
use crate::rival::{File, Reader, Rival};
use rusqlite::{Connection, OpenFlags, OptionalExtension, params};
use std::path::Path;

/// A database with a row per clip and a row per text.
pub(crate) struct Sqlite;

const SCHEMA: &str = "
    CREATE TABLE locale (id INTEGER PRIMARY KEY, tag TEXT NOT NULL UNIQUE);
    CREATE TABLE clip (id INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, fps INTEGER NOT NULL,
        viseme_type INTEGER NOT NULL, visemes BLOB NOT NULL);
    CREATE TABLE segment (clip INTEGER, start INTEGER, number INTEGER, event TEXT,
        PRIMARY KEY (clip, start)) WITHOUT ROWID;
    CREATE TABLE text (clip INTEGER, locale INTEGER, segment INTEGER, text TEXT NOT NULL,
        PRIMARY KEY (clip, locale, segment)) WITHOUT ROWID;";

const FIND: &str = "SELECT id FROM clip WHERE key = ?";
const FRAME: &str = "SELECT fps, visemes FROM clip WHERE id = ?";
const TEXT: &str = "SELECT text FROM text WHERE clip = ?1 AND locale = ?2 AND segment =
    (SELECT number FROM segment WHERE clip = ?1 AND start <= ?3 ORDER BY start DESC LIMIT 1)";

const EVENT: &str = "SELECT IFNULL(event, '') FROM segment WHERE clip = ?1 AND start <= ?2 ORDER BY start DESC LIMIT 1";

impl Rival for Sqlite {
    const NAME: &'static str = "SQLite 3";
    type Reader = Connection;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let mut database = Connection::open(path)?;
        database.execute_batch(SCHEMA)?;
        let writing = database.transaction()?;
        for (id, tag) in corpus.bank.locales.iter().enumerate() {
            writing.execute("INSERT INTO locale VALUES (?, ?)", params![id as i64, tag])?;
        }
        for (id, clip) in corpus.bank.clips.iter().enumerate() {
            let id = id as i64;
            writing.prepare_cached("INSERT INTO clip VALUES (?, ?, ?, ?, ?)")?.execute(params![
                id,
                clip.key,
                clip.fps,
                clip.viseme_type,
                clip.visemes.as_bytes()
            ])?;
            for (segment, &start) in clip.starts.iter().enumerate() {
                let mut insert = writing.prepare_cached("INSERT INTO segment VALUES (?, ?, ?, ?)")?;
                insert.execute(params![id, start, segment as i64, clip.events.get(segment)])?;
                for (locale, texts) in clip.texts.iter().enumerate() {
                    let mut insert = writing.prepare_cached("INSERT INTO text VALUES (?, ?, ?, ?)")?;
                    insert.execute(params![id, locale as i64, segment as i64, texts[segment]])?;
                }
            }
        }
        Ok(writing.commit()?)
    }

    fn open(file: &'static File) -> Result<Connection, Failure> {
        let database = Connection::open_with_flags(&file.path, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
        // One transaction for all queries, because otherwise each of them locks the file.
        database.execute_batch("PRAGMA mmap_size = 1000000000; BEGIN")?;
        // The first statement reads the schema, which opening alone does not.
        drop(database.prepare_cached(FRAME)?);
        Ok(database)
    }

    /// SQLite counts its own allocations.
    fn foreign_heap_bytes() -> usize {
        // SAFETY: the function has no conditions.
        usize::try_from(unsafe { rusqlite::ffi::sqlite3_memory_used() }).unwrap_or_default()
    }

    fn open_validated(file: &'static File) -> Result<Connection, Failure> {
        let database = Self::open(file)?;
        let answer: String = database.query_row("PRAGMA integrity_check", [], |row| row.get(0))?;
        if answer == "ok" { Ok(database) } else { Err(answer.into()) }
    }
}

/// Statements are prepared once, on first use. A clip is its row, because SQLite has no cheaper handle.
impl Reader for Connection {
    type Clip<'r> = u32;
    type Locale<'r> = u32;

    fn locale(&self, tag: &str) -> Option<u32> {
        self.query_row("SELECT id FROM locale WHERE tag = ?", [tag], |row| row.get(0)).optional().ok()?
    }

    fn find(&self, key: &str) -> Option<u32> {
        self.prepare_cached(FIND).ok()?.query_row([key], |row| row.get(0)).optional().ok()?
    }

    fn clip(&self, number: u32) -> Option<u32> {
        Some(number)
    }

    fn viseme(&self, clip: u32, time_us: u32) -> u8 {
        let code = self.prepare_cached(FRAME).and_then(|mut statement| {
            statement.query_row([clip], |row| {
                let frame = frame_at(row.get(0)?, time_us);
                Ok(row.get_ref(1)?.as_blob()?.get(frame).copied())
            })
        });
        code.ok().flatten().unwrap_or(b'-')
    }

    fn text<T>(&self, clip: u32, locale: u32, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let frame = frame_of(self, clip, time_us)?;
        let mut statement = self.prepare_cached(TEXT).ok()?;
        statement.query_row(params![clip, locale, frame], |row| Ok(then(row.get_ref(0)?.as_str()?))).ok()
    }

    fn event<T>(&self, clip: u32, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let frame = frame_of(self, clip, time_us)?;
        let mut statement = self.prepare_cached(EVENT).ok()?;
        statement.query_row(params![clip, frame], |row| Ok(then(row.get_ref(0)?.as_str()?))).ok()
    }
}

/// Returns the frame at a time, if it is in the clip.
fn frame_of(database: &Connection, clip: u32, time_us: u32) -> Option<i64> {
    let frame = |row: &rusqlite::Row<'_>| {
        let frame = frame_at(row.get(0)?, time_us);
        Ok((frame < row.get_ref(1)?.as_blob()?.len()).then_some(frame as i64))
    };
    database.prepare_cached(FRAME).ok()?.query_row([clip], frame).ok()?
}
