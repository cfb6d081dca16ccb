//! `lipz texts`: texts of clips to translators and back.

mod deliver;
mod export;
mod import;
mod incoming;

pub(super) use export::{locales_of, source_locale};

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::{Args, Subcommand, ValueEnum};
use lipz_texts::{Division, Progress, Shape};

/// Write the texts of clips for translators, and read their translations: PO (gettext), XLIFF, CSV, XLSX, JSON.
///
/// Each clip is an entry, with what helps to translate it: who speaks, when, for how long, with which events.
/// docs/guides/localisation.md shows the way there and back.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz texts export po voices --locale de-de -o de-de.po
  lipz texts export po voices --locale de-de --state missing,stale -o to-do.po
  lipz texts export xliff voices --locale de-de -o de-de.xlf
  lipz texts export xlsx voices --locale de-de --locale fr-fr -o texts.xlsx
  lipz texts import de-de.po -o voices
  lipz texts import texts.xlsx -o voices --locale fr-fr --check
  msgmerge old.po texts.pot | lipz texts import - --text-format po --locale de-de")]
pub(crate) struct Texts {
    #[command(subcommand)]
    direction: Direction,
}

#[derive(Subcommand, Debug)]
enum Direction {
    Export(Box<export::Export>),
    Import(Box<import::Import>),
}

/// A format for translators, for the command line.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum Format {
    /// gettext, for Poedit, Weblate and others: a file for each locale
    Po,
    /// A gettext template: the same without translations, for tools that make a PO file of it for each locale
    Pot,
    /// XLIFF 2.1: a unit for each clip with its segments, placeholders and states; a file for each locale
    Xliff,
    /// XLIFF 1.2, for tools that know no other
    #[value(name = "xliff-1.2")]
    Xliff12,
    /// A table, for spreadsheets and engines: a column for each locale
    Csv,
    /// A spreadsheet: the same columns
    Xlsx,
    /// All that is known, for programs
    Json,
}

impl From<Format> for lipz_texts::Format {
    fn from(format: Format) -> lipz_texts::Format {
        match format {
            Format::Po | Format::Pot => lipz_texts::Format::Po,
            Format::Xliff => lipz_texts::Format::Xliff,
            Format::Xliff12 => lipz_texts::Format::Xliff12,
            Format::Csv => lipz_texts::Format::Csv,
            Format::Xlsx => lipz_texts::Format::Xlsx,
            Format::Json => lipz_texts::Format::Json,
        }
    }
}

impl Format {
    /// The extension of its files.
    fn extension(self) -> &'static str {
        match self {
            Format::Pot => "pot",
            format => lipz_texts::Format::from(format).extension(),
        }
    }
}

/// How far a translation is, for the command line.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum StateName {
    /// A segment has no text
    Missing,
    /// It is older than its source
    Stale,
    /// It is translated
    Translated,
    /// Somebody else has read it
    Reviewed,
    /// It is done
    Final,
}

impl From<StateName> for Progress {
    fn from(name: StateName) -> Progress {
        match name {
            StateName::Missing => Progress::Missing,
            StateName::Stale => Progress::Stale,
            StateName::Translated => Progress::Translated,
            StateName::Reviewed => Progress::Reviewed,
            StateName::Final => Progress::Final,
        }
    }
}

/// What an entry is about.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum By {
    /// A clip, with `|` between its segments
    Clip,
    /// A segment: there is no `|` to be lost
    Segment,
}

impl From<By> for Division {
    fn from(by: By) -> Division {
        match by {
            By::Clip => Division::Clip,
            By::Segment => Division::Segment,
        }
    }
}

/// The columns of a CSV.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum Columns {
    /// key, speaker, time, …, en-us, de-de: Google Sheets, Excel, LibreOffice
    Sheet,
    /// Key, Shared Comments, en-US(en-US): string tables of Unity
    Unity,
    /// keys, en_US, de_DE: translations of Godot
    Godot,
    /// Key, SourceString, de-DE, Comment: string tables of Unreal
    Unreal,
    /// language, id, text, file, node, lineNumber, lock, comment: Yarn Spinner, a file for each locale
    Yarn,
}

impl From<Columns> for Shape {
    fn from(columns: Columns) -> Shape {
        match columns {
            Columns::Sheet => Shape::Sheet,
            Columns::Unity => Shape::Unity,
            Columns::Godot => Shape::Godot,
            Columns::Unreal => Shape::Unreal,
            Columns::Yarn => Shape::Yarn,
        }
    }
}

impl Run for Texts {
    fn prints_result(&self) -> bool {
        match &self.direction {
            Direction::Export(export) => export.is_printed(),
            Direction::Import(_) => false,
        }
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        match &self.direction {
            Direction::Export(export) => export::run(export, reporter),
            Direction::Import(import) => import::run(import, reporter),
        }
    }
}
