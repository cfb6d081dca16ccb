//! The declaration of records: each is a struct that is read in place, and a description of its fields, which tests
//! compare with `docs/reference/bank-format.md`.

use crate::{header, optional, required, set};

/// A record: its name and its fields, without gaps, in their order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct RecordLayout {
    /// The name of the struct.
    pub name: &'static str,
    /// The length of the record in bytes.
    pub length_bytes: usize,
    /// Name and length in bytes of each field.
    pub fields: &'static [(&'static str, usize)],
}

/// All records of format 1, by file of this crate.
pub const RECORDS: [&[RecordLayout]; 4] = [header::RECORDS, required::RECORDS, optional::RECORDS, set::RECORDS];

/// Declares the records of a file: documentation, name and length in bytes of each, and its fields.
macro_rules! records {
    ($($(#[$doc:meta])* $name:ident: $length:literal {
        $($(#[$field_doc:meta])* $field:ident: $kind:ty,)+
    })+) => {
        $(
            $(#[$doc])*
            #[derive(
                zerocopy::FromBytes,
                zerocopy::IntoBytes,
                zerocopy::Immutable,
                zerocopy::KnownLayout,
                zerocopy::Unaligned,
                Clone,
                Copy,
                Debug,
            )]
            #[repr(C)]
            pub struct $name {
                $($(#[$field_doc])* pub $field: $kind,)+
            }

            const _: () = assert!(core::mem::size_of::<$name>() == $length);
        )+

        /// The records of this file.
        pub(crate) const RECORDS: &[crate::RecordLayout] = &[$(crate::RecordLayout {
            name: stringify!($name),
            length_bytes: $length,
            fields: &[$((stringify!($field), core::mem::size_of::<$kind>())),+],
        }),+];
    };
}

pub(crate) use records;
