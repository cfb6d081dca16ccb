//! Every code, once: number, name, default level and what it stands for.

use super::Level;
use std::fmt;

macro_rules! codes {
    ($($variant:ident $number:literal $name:literal $level:ident $summary:literal)+) => {
        /// A rule, by its stable code. Numbers are never given a new meaning.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[non_exhaustive]
        pub enum Code {
            $(#[doc = concat!("`", $number, "` ", $name, ": ", $summary)] $variant,)+
        }

        impl Code {
            /// Every code in the order of the numbers.
            pub const ALL: &'static [Code] = &[$(Code::$variant),+];

            /// The stable number, `LZ0401`.
            pub const fn number(self) -> &'static str {
                match self { $(Code::$variant => $number,)+ }
            }

            /// The name for settings, `foreign-code`.
            pub const fn name(self) -> &'static str {
                match self { $(Code::$variant => $name,)+ }
            }

            /// The level unless a project sets another.
            pub const fn default_level(self) -> Level {
                match self { $(Code::$variant => Level::$level,)+ }
            }

            /// What the rule is about, in one line.
            pub const fn summary(self) -> &'static str {
                match self { $(Code::$variant => $summary,)+ }
            }
        }
    };
}

codes! {
    UnreadableFile "LZ0001" "unreadable-file" Error "a source cannot be read"
    EmptyFile "LZ0002" "empty-file" Error "the file is empty"
    NotUtf8 "LZ0003" "not-utf8" Error "the file is not UTF-8"
    Utf16 "LZ0004" "utf16" Error "the file is UTF-16"
    ByteOrderMark "LZ0005" "byte-order-mark" Warning "the file starts with a byte order mark"
    FileTooLarge "LZ0006" "file-too-large" Error "the file is larger than 256 MiB, the largest that is read"

    JsonSyntax "LZ0101" "json-syntax" Error "the file is not JSON"
    TrailingComma "LZ0102" "trailing-comma" Error "a comma stands after the last element"
    Comment "LZ0103" "comment" Error "JSON has no comments"
    JoinedObjects "LZ0104" "joined-objects" Error "text follows the root object"
    RootNotObject "LZ0105" "root-not-object" Error "the root is not an object"
    ControlCharacter "LZ0106" "control-character" Error "a control character stands in a string as it is"
    BadEscape "LZ0107" "bad-escape" Error "an escape stands for no character"
    UnfinishedFile "LZ0108" "unfinished-file" Error "the file ends too early"

    DuplicateElement "LZ0201" "duplicate-element" Error "an element appears twice"
    WrongType "LZ0202" "wrong-type" Error "an element has another type than its name asks for"
    UnknownElement "LZ0203" "unknown-element" Warning "an element is not one of the format"
    EmptyDocument "LZ0204" "empty-document" Warning "the file has no elements"

    FpsOutOfRange "LZ0301" "fps-out-of-range" Error "fps lies between 1 and 1000"
    FpsInexact "LZ0302" "fps-inexact" Warning "fps has more digits than an exact ratio can hold"
    UnknownVisemeType "LZ0303" "unknown-viseme-type" Error "viseme_type is blair, toonboom or rms"

    ForeignCode "LZ0401" "foreign-code" Error "a viseme code is not one of the viseme type"
    WhiteSpaceInVisemes "LZ0402" "white-space-in-visemes" Warning "white space stands between viseme codes"
    MixedCodes "LZ0403" "mixed-codes" Error "the viseme codes fit no viseme type"

    LocaleSpelling "LZ0501" "locale-spelling" Warning "a text element is not spelled text_ll-cc"
    TextWithoutLocale "LZ0502" "text-without-locale" Error "a text has no locale"
    LocaleShape "LZ0503" "locale-shape" Error "a locale does not have the form ll-cc"
    UnknownLocale "LZ0504" "unknown-locale" Warning "a language or country is not in the ISO lists"
    UnbalancedBrace "LZ0505" "unbalanced-brace" Warning "a brace of meta information has no partner"
    NestedBraces "LZ0506" "nested-braces" Warning "meta information contains braces"
    EmptyDisplayText "LZ0507" "empty-display-text" Warning "nothing of a text is displayed"
    NulInText "LZ0508" "nul-in-text" Warning "a text contains U+0000"
    SameLocaleTwice "LZ0509" "same-locale-twice" Error "two texts are of the same locale"
    TextTooWide "LZ0510" "text-too-wide" Warning "a line of a text is wider than the screen holds"
    TooManyLines "LZ0511" "too-many-lines" Warning "a text has more lines than the screen holds"
    ReadsTooFast "LZ0512" "reads-too-fast" Warning "a text is shown for too short a time to be read"
    LowCoverage "LZ0513" "low-coverage" Error "fewer clips have a text in a locale than the project asks for"

    SegmentCount "LZ0601" "segment-count" Error "elements have different numbers of segments"

    NulInEvents "LZ0701" "nul-in-events" Warning "an event contains U+0000"
    UnknownEmotion "LZ0702" "unknown-emotion" Warning "an emotion is not one of the specification"

    KeyClash "LZ0801" "key-clash" Error "two keys differ only in case or Unicode normalisation"
    DuplicateKey "LZ0802" "duplicate-key" Error "two sources have the same key"
    RefusedKey "LZ0803" "refused-key" Error "a key cannot be a file name everywhere"
    IdCollision "LZ0804" "id-collision" Error "two keys have the same clip id"
    NoSources "LZ0805" "no-sources" Error "no Lipz file was found"

    BankTooLarge "LZ0901" "bank-too-large" Error "the bank does not fit its 32-bit offsets"
    BankRefused "LZ0902" "bank-refused" Error "a file cannot be opened as a bank"
    BankDamaged "LZ0903" "bank-damaged" Error "a bank does not pass verification"
    OutputFailed "LZ0904" "output-failed" Error "an output cannot be written"
    SourceDamaged "LZ0905" "source-damaged" Error "a bank's source section cannot be decoded"
    WouldOverwrite "LZ0906" "would-overwrite" Error "an output file is there already"
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.number())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_ascend_and_names_differ() {
        let numbers: Vec<_> = Code::ALL.iter().map(|code| code.number()).collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
        let mut names: Vec<_> = Code::ALL.iter().map(|code| code.name()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), Code::ALL.len());
    }
}
