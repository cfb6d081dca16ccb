//! flatbuffers: tables with offsets. The code that its compiler would generate is written by hand here.

use crate::Failure;
use crate::corpus::{Corpus, frame_at};
use crate::rival::{File, Reader, Rival};
use flatbuffers::{
    FlatBufferBuilder, Follow, ForwardsUOffset, InvalidFlatbuffer, Table, VOffsetT, Vector, Verifiable, Verifier,
    WIPOffset,
};
use std::path::Path;

/// A table of clips, ordered by key.
pub(crate) struct Flatbuffers;

/// Returns the offset of field number `index` in a table's list of fields.
const fn field(index: VOffsetT) -> VOffsetT {
    4 + 2 * index
}

type Strings<'f> = Vector<'f, ForwardsUOffset<&'f str>>;

/// Defines a table type, with the check of its fields.
macro_rules! table {
    ($name:ident { $($getter:ident: $type:ty = $field:literal),* $(,)? }) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $name<'f>(Table<'f>);

        impl<'f> Follow<'f> for $name<'f> {
            type Inner = $name<'f>;

            unsafe fn follow(bytes: &'f [u8], place: usize) -> Self::Inner {
                // SAFETY: guaranteed by the caller.
                $name(unsafe { Table::new(bytes, place) })
            }
        }

        impl<'f> Verifiable for $name<'f> {
            fn run_verifier(verifier: &mut Verifier<'_, '_>, place: usize) -> Result<(), InvalidFlatbuffer> {
                let table = verifier.visit_table(place)?;
                $(let table = table.visit_field::<$type>(stringify!($getter), field($field), false)?;)*
                table.finish();
                Ok(())
            }
        }

        impl<'f> $name<'f> {
            $(
                #[inline]
                #[allow(dead_code, reason = "fields that nothing asks for are in the file, too")]
                fn $getter(self) -> Option<<$type as Follow<'f>>::Inner> {
                    // SAFETY: `build` writes the field with this type.
                    unsafe { self.0.get::<$type>(field($field), None) }
                }
            )*
        }
    };
}

table!(Bank {
    locales: ForwardsUOffset<Strings<'f>> = 0,
    clips: ForwardsUOffset<Vector<'f, ForwardsUOffset<Clip<'f>>>> = 1,
});

table!(Clip {
    key: ForwardsUOffset<&'f str> = 0,
    fps: u16 = 1,
    visemes: ForwardsUOffset<&'f str> = 2,
    starts: ForwardsUOffset<Vector<'f, u16>> = 3,
    texts: ForwardsUOffset<Vector<'f, ForwardsUOffset<Texts<'f>>>> = 4,
    events: ForwardsUOffset<Strings<'f>> = 5,
    viseme_type: u8 = 6,
});

table!(Texts { segments: ForwardsUOffset<Strings<'f>> = 0 });

impl Rival for Flatbuffers {
    const NAME: &'static str = "flatbuffers 25";
    type Reader = Bank<'static>;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let mut builder = FlatBufferBuilder::new();
        let clips: Vec<_> = corpus.bank.clips.iter().map(|clip| add_clip(&mut builder, clip)).collect();
        let clips = builder.create_vector(&clips);
        let locales = add_strings(&mut builder, &corpus.bank.locales);
        let table = builder.start_table();
        builder.push_slot_always(field(0), locales);
        builder.push_slot_always(field(1), clips);
        let bank = builder.end_table(table);
        builder.finish_minimal(bank);
        Ok(std::fs::write(path, builder.finished_data())?)
    }

    fn open(file: &'static File) -> Result<Bank<'static>, Failure> {
        // SAFETY: `build` wrote the file.
        Ok(unsafe { flatbuffers::root_unchecked::<Bank<'static>>(&file.map) })
    }

    fn open_validated(file: &'static File) -> Result<Bank<'static>, Failure> {
        // The verifier has limits against forged files, but these files are large.
        let options = flatbuffers::VerifierOptions {
            max_tables: usize::MAX,
            max_apparent_size: usize::MAX,
            ..flatbuffers::VerifierOptions::default()
        };
        Ok(flatbuffers::root_with_opts::<Bank<'static>>(&options, &file.map)?)
    }
}

type Offset<'b, T> = WIPOffset<Vector<'b, ForwardsUOffset<T>>>;

fn add_strings<'b>(builder: &mut FlatBufferBuilder<'b>, strings: &[String]) -> Offset<'b, &'b str> {
    let strings: Vec<_> = strings.iter().map(|string| builder.create_string(string)).collect();
    builder.create_vector(&strings)
}

fn add_clip<'b>(builder: &mut FlatBufferBuilder<'b>, clip: &crate::corpus::Clip) -> WIPOffset<Clip<'b>> {
    let key = builder.create_string(&clip.key);
    let visemes = builder.create_string(&clip.visemes);
    let starts: Vec<u16> = clip.starts.iter().map(|&start| start as u16).collect();
    let starts = builder.create_vector(&starts);
    let add_texts = |builder: &mut FlatBufferBuilder<'b>, texts: &[String]| {
        let segments = add_strings(builder, texts);
        let table = builder.start_table();
        builder.push_slot_always(field(0), segments);
        WIPOffset::<Texts<'b>>::new(builder.end_table(table).value())
    };
    let texts: Vec<_> = clip.texts.iter().map(|texts| add_texts(builder, texts)).collect();
    let texts = builder.create_vector(&texts);
    let events = add_strings(builder, &clip.events);
    let table = builder.start_table();
    builder.push_slot_always(field(0), key);
    builder.push_slot_always(field(1), clip.fps as u16);
    builder.push_slot_always(field(2), visemes);
    builder.push_slot_always(field(3), starts);
    builder.push_slot_always(field(4), texts);
    builder.push_slot_always(field(5), events);
    builder.push_slot_always(field(6), clip.viseme_type);
    WIPOffset::new(builder.end_table(table).value())
}

impl Reader for Bank<'static> {
    type Clip<'r> = Clip<'static>;
    type Locale<'r> = usize;

    fn locale(&self, tag: &str) -> Option<usize> {
        self.locales()?.iter().position(|locale| locale == tag)
    }

    /// Binary search, as in the code that flatbuffers' compiler generates for sorted tables.
    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        let clips = self.clips()?;
        let (mut start, mut end) = (0, clips.len());
        while start < end {
            let middle = (start + end) / 2;
            match clips.get(middle).key()?.cmp(key) {
                std::cmp::Ordering::Less => start = middle + 1,
                std::cmp::Ordering::Equal => return Some(middle as u32),
                std::cmp::Ordering::Greater => end = middle,
            }
        }
        None
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<Clip<'static>> {
        Some(self.clips()?.get(number as usize))
    }

    #[inline]
    fn viseme(&self, clip: Clip<'static>, time_us: u32) -> u8 {
        let code = || clip.visemes()?.as_bytes().get(frame_at(clip.fps()?.into(), time_us)).copied();
        code().unwrap_or(b'-')
    }

    #[inline(always)]
    fn text<T>(&self, clip: Clip<'static>, locale: usize, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let segment = segment(clip, time_us)?;
        let segments = clip.texts()?.get(locale).segments()?;
        Some(then(segments.get(segment)))
    }

    #[inline(always)]
    fn event<T>(&self, clip: Clip<'static>, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let segment = segment(clip, time_us)?;
        let events = clip.events()?;
        Some(then(if segment < events.len() { events.get(segment) } else { "" }))
    }
}

#[inline]
fn segment(clip: Clip<'_>, time_us: u32) -> Option<usize> {
    let frame = frame_at(clip.fps()?.into(), time_us);
    if frame >= clip.visemes()?.len() {
        return None;
    }
    let starts = clip.starts()?;
    (0..starts.len()).rev().find(|&segment| usize::from(starts.get(segment)) <= frame)
}
