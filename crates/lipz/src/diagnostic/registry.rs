//! Every code, once: number, name, default level and what it stands for. Its page is in `pages/`.

use super::Level;
use std::fmt;

macro_rules! codes {
    ($($group:literal $($variant:ident $number:literal $name:literal $level:ident $summary:literal)+)+) => {
        /// A rule, by its stable code. Numbers are never given a new meaning.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[non_exhaustive]
        pub enum Code {
            $($(#[doc = concat!("`", $number, "` ", $name, ": ", $summary)] $variant,)+)+
        }

        impl Code {
            /// Every code in the order of the numbers.
            pub const ALL: &'static [Code] = &[$($(Code::$variant),+),+];

            /// The stable number, `LZ0401`.
            pub const fn number(self) -> &'static str {
                match self { $($(Code::$variant => $number,)+)+ }
            }

            /// The name for settings, `foreign-code`.
            pub const fn name(self) -> &'static str {
                match self { $($(Code::$variant => $name,)+)+ }
            }

            /// The level unless a project sets another.
            pub const fn default_level(self) -> Level {
                match self { $($(Code::$variant => Level::$level,)+)+ }
            }

            /// What the rule is about, in one line.
            pub const fn summary(self) -> &'static str {
                match self { $($(Code::$variant => $summary,)+)+ }
            }

            /// The heading under which lists show the code.
            pub const fn group(self) -> &'static str {
                match self { $($(Code::$variant => $group,)+)+ }
            }

            /// What a writer or localiser should know about the rule, in Markdown: what, why, example
            /// and fix.
            pub const fn page(self) -> &'static str {
                match self { $($(Code::$variant => include_str!(concat!("pages/", $number, ".md")),)+)+ }
            }
        }
    };
}

codes! {
    "Reading files"
    UnreadableFile "LZ0001" "unreadable-file" Error "a source cannot be read"
    EmptyFile "LZ0002" "empty-file" Error "the file is empty"
    NotUtf8 "LZ0003" "not-utf8" Error "the file is not UTF-8"
    Utf16 "LZ0004" "utf16" Error "the file is UTF-16"
    ByteOrderMark "LZ0005" "byte-order-mark" Warning "the file starts with a byte order mark"
    FileTooLarge "LZ0006" "file-too-large" Error "the file is larger than 256 MiB, the largest that is read"

    "JSON"
    JsonSyntax "LZ0101" "json-syntax" Error "the file is not JSON"
    TrailingComma "LZ0102" "trailing-comma" Error "a comma stands after the last element"
    Comment "LZ0103" "comment" Error "JSON has no comments"
    JoinedObjects "LZ0104" "joined-objects" Error "text follows the root object"
    RootNotObject "LZ0105" "root-not-object" Error "the root is not an object"
    ControlCharacter "LZ0106" "control-character" Error "a control character stands in a string as it is"
    BadEscape "LZ0107" "bad-escape" Error "an escape stands for no character"
    UnfinishedFile "LZ0108" "unfinished-file" Error "the file ends too early"

    "Elements"
    DuplicateElement "LZ0201" "duplicate-element" Error "an element appears twice"
    WrongType "LZ0202" "wrong-type" Error "an element has another type than its name asks for"
    UnknownElement "LZ0203" "unknown-element" Warning "an element is not one of the format"
    EmptyDocument "LZ0204" "empty-document" Warning "the file has no elements"

    "Frame rate and viseme type"
    FpsOutOfRange "LZ0301" "fps-out-of-range" Error "fps lies between 1 and 1000"
    FpsInexact "LZ0302" "fps-inexact" Warning "fps has more digits than an exact ratio can hold"
    UnknownVisemeType "LZ0303" "unknown-viseme-type" Error "viseme_type is blair, toonboom or rms"

    "Viseme codes"
    ForeignCode "LZ0401" "foreign-code" Error "a viseme code is not one of the viseme type"
    WhiteSpaceInVisemes "LZ0402" "white-space-in-visemes" Warning "white space stands between viseme codes"
    MixedCodes "LZ0403" "mixed-codes" Error "the viseme codes fit no viseme type"
    ConversionLoss "LZ0404" "conversion-loss" Warning "frames lose their own mouth shape in the new viseme type"
    NotConvertible "LZ0405" "not-convertible" Error "viseme codes cannot be converted to the new viseme type"

    "Locales and texts"
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
    LocaleWithoutTexts "LZ0514" "locale-without-texts" Warning "no clip has a text in a locale that is to be packed"

    "Segments"
    SegmentCount "LZ0601" "segment-count" Error "elements have different numbers of segments"

    "Events"
    NulInEvents "LZ0701" "nul-in-events" Warning "an event contains U+0000"
    UnknownEmotion "LZ0702" "unknown-emotion" Warning "an emotion is neither one of the specification nor registered"
    UnknownCharacter "LZ0703" "unknown-character" Warning "the character of an event is not registered"
    UnknownTarget "LZ0704" "unknown-target" Warning "a character or prop that an event is aimed at is not registered"
    UnknownAction "LZ0705" "unknown-action" Warning "the action of an event is not registered"
    NearEvent "LZ0706" "near-event" Warning "events are nearly Character Event Syntax, and so kept as text"

    "Keys and sources"
    KeyClash "LZ0801" "key-clash" Error "two keys differ only in case or Unicode normalisation"
    DuplicateKey "LZ0802" "duplicate-key" Error "two sources have the same key"
    RefusedKey "LZ0803" "refused-key" Error "a key cannot be a file name everywhere"
    IdCollision "LZ0804" "id-collision" Error "two keys have the same clip id"
    NoSources "LZ0805" "no-sources" Error "no Lipz file was found"

    "Banks and outputs"
    BankTooLarge "LZ0901" "bank-too-large" Error "a bank has no room for the clips, or for a part of one"
    BankRefused "LZ0902" "bank-refused" Error "a file cannot be opened as a bank"
    BankDamaged "LZ0903" "bank-damaged" Error "a bank does not pass verification"
    OutputFailed "LZ0904" "output-failed" Error "an output cannot be written"
    SourceDamaged "LZ0905" "source-damaged" Error "a bank's source section cannot be decoded"
    WouldOverwrite "LZ0906" "would-overwrite" Error "an output file is there already"

    "Settings"
    SettingsSyntax "LZ1001" "settings-syntax" Error "the settings are not TOML"
    UnknownSetting "LZ1002" "unknown-setting" Error "there is no such setting"
    SettingType "LZ1003" "setting-type" Error "a setting has a value of another type"
    SettingValue "LZ1004" "setting-value" Error "a setting has a value that it cannot have"
    UnknownLint "LZ1005" "unknown-lint" Error "there is no such lint"
    FixedLevel "LZ1006" "fixed-level" Error "an error cannot be lowered"
    SettingsUnreadable "LZ1007" "settings-unreadable" Error "a settings file cannot be read"

    "Files of other tools"
    ForeignSyntax "LZ1101" "foreign-syntax" Error "a file of another tool is not in its format"
    ForeignCutOff "LZ1102" "foreign-cut-off" Error "a file of another tool ends too early"
    ForeignValue "LZ1103" "foreign-value" Error "a file of another tool has a value that it cannot have"
    ForeignOddity "LZ1104" "foreign-oddity" Warning "a file of another tool is not quite as the tool writes it"
    UnknownSymbol "LZ1105" "unknown-symbol" Error "a mouth shape of another tool is not in the mapping table"
    TimesBackwards "LZ1106" "times-backwards" Warning "the times of mouth shapes run backwards"
    NoShapes "LZ1107" "no-shapes" Warning "a file of another tool has no mouth shapes"
    ShapesLost "LZ1108" "shapes-lost" Warning "mouth shapes are too short for a frame"
    SegmentGuessed "LZ1109" "segment-guessed" Warning "a segment starts where no pause is"
    TextLeftOut "LZ1110" "text-left-out" Warning "a text is left out because its locale is not known"
    MapRefused "LZ1111" "map-refused" Error "a mapping table cannot be used"
    NotExportable "LZ1112" "not-exportable" Error "a clip cannot be written in the format of another tool"
    ExportLoss "LZ1113" "export-loss" Warning "the format of another tool cannot hold a part of a clip"

    "Ids"
    IdentifierClash "LZ1201" "identifier-clash" Error "two keys have the same identifier in a program"

    "Subtitles"
    SubtitleSyntax "LZ1301" "subtitle-syntax" Error "a subtitle file is not in its format"
    SubtitleTimes "LZ1302" "subtitle-times" Warning "subtitles overlap, or are not in the order of their times"
    SubtitlePlace "LZ1303" "subtitle-place" Warning "a subtitle does not fit the segments of its clip"
    SubtitleText "LZ1304" "subtitle-text" Warning "a subtitle has what a Lipz text cannot hold"
    SubtitleLoss "LZ1305" "subtitle-loss" Warning "a text has no place in subtitles"

    "Babble"
    BabbleDigits "LZ1401" "babble-digits" Error "a loop or power transfer of a babble profile is not digits"
    BabbleRate "LZ1402" "babble-rate" Error "the rate of a babble profile is outside 1 to 1000"
    ViewerSettingsSyntax "LZ1403" "viewer-settings-syntax" Error "viewer settings are not LLSD in XML"
    ViewerSettingType "LZ1404" "viewer-setting-type" Error "a setting of a viewer has a value of another type"
    LipSyncDisabled "LZ1405" "lip-sync-disabled" Warning "lip sync is switched off in the viewer's settings"
    "Fallout"
    LipVersion "LZ1501" "lip-version" Error "a file is not a LIP file of version 2"
    LipCutOff "LZ1502" "lip-cut-off" Error "a LIP file ends before its last marker"
    LipHeader "LZ1503" "lip-header" Warning "a word of a LIP file's header is not what it is in other files"
    LipLengthOrder "LZ1504" "lip-length-order" Warning "the length in a LIP file is little-endian"
    LipLength "LZ1505" "lip-length" Warning "the length in a LIP file is not the position of the last marker"
    LipCounts "LZ1506" "lip-counts" Warning "a LIP file does not have one more marker than phonemes"
    LipName "LZ1507" "lip-name" Warning "a LIP file names another sound than its own"
    LipPhoneme "LZ1508" "lip-phoneme" Warning "a phoneme code of a LIP file stands for no sound"
    LipMarkerType "LZ1509" "lip-marker-type" Warning "a marker of a LIP file has an unknown type"
    LipMarkerOrder "LZ1510" "lip-marker-order" Warning "the markers of a LIP file do not run from 0 forwards"
    LipTrailing "LZ1511" "lip-trailing" Warning "bytes follow the last marker of a LIP file"
    LipTimeBase "LZ1512" "lip-time-base" Warning "a LIP file does not end where its sound does"
    LipExportName "LZ1513" "lip-export-name" Error "a clip cannot be a LIP file by its name"
    MsgSyntax "LZ1521" "msg-syntax" Error "the braces or numbers of a .msg file are wrong"
    MsgEntry "LZ1522" "msg-entry" Warning "the game does not show an entry of a .msg file as it is written"
    FrmRefused "LZ1531" "frm-refused" Error "a file is not a whole FRM file"
    HeadFrames "LZ1532" "head-frames" Error "a head's phoneme file has fewer frames than mouth shapes"
    HeadsList "LZ1533" "heads-list" Error "a line of heads.lst names no head"
    HeadName "LZ1534" "head-name" Warning "an FRM file is not named like a file of a head"
    HeadFiles "LZ1535" "head-files" Warning "the files of a head are not those that heads.lst counts"
}

impl Code {
    /// Whether a project may lower the level of the rule, in `lipz.toml` or on the command line. Every
    /// level may be raised.
    ///
    /// Most errors are fixed: the file or the bank has no meaning then. These say what they do instead:
    /// elements are joined to one segment ([`Code::SegmentCount`]), a text without a locale is kept for
    /// unpacking like an unknown element ([`Code::TextWithoutLocale`]), keys clash on other systems only
    /// ([`Code::KeyClash`]), and an empty folder adds no clips ([`Code::NoSources`]).
    pub const fn can_be_lowered(self) -> bool {
        matches!(self.default_level(), Level::Warning)
            || matches!(self, Code::SegmentCount | Code::TextWithoutLocale | Code::KeyClash | Code::NoSources)
    }

    /// The code with this number or name, whatever the case of the letters.
    ///
    /// ```
    /// use lipz::Code;
    /// assert_eq!(Code::find("lz0401"), Some(Code::ForeignCode));
    /// assert_eq!(Code::find("foreign-code"), Some(Code::ForeignCode));
    /// assert_eq!(Code::find("LZ0400"), None);
    /// ```
    pub fn find(text: &str) -> Option<Code> {
        let is = |known: &str| known.eq_ignore_ascii_case(text);
        Code::ALL.iter().copied().find(|code| is(code.number()) || is(code.name()))
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.number())
    }
}

#[cfg(test)]
#[allow(clippy::panic, reason = "tests")]
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

    #[test]
    fn groups_are_the_hundreds_of_the_numbers() {
        for pair in Code::ALL.windows(2) {
            let [a, b] = pair else { continue };
            let same_hundred = a.number()[..4] == b.number()[..4];
            assert_eq!(a.group() == b.group(), same_hundred, "{a} {} and {b} {}", a.group(), b.group());
        }
    }

    #[test]
    fn pages_have_their_four_parts() {
        for code in Code::ALL {
            let mut rest = code.page();
            assert!(rest.starts_with("**What.** "), "{code}");
            for part in ["**What.** ", "**Why.** ", "**Example.**", "**Fix.** "] {
                let at = rest.find(part).unwrap_or_else(|| panic!("{code}: {part} is missing or out of order"));
                rest = &rest[at..];
            }
        }
    }
}
