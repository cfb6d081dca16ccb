//! Variants of texts in all formats: each is exported where its language needs it, and comes back to its place.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_texts::{
    ClipTexts, Collect, Division, Exchange, Format, Merge, ReadOptions, Shape, State, TextRecord, Translation, Work,
    WriteOptions, read, texts_of, write,
};

const CLIP: &str = r#"{
  "visemes": "MA|EO",
  "text_en-us": "Look!|{n} guards and a king.",
  "text_en-us-x-one": "|One guard and a king.",
  "text_en-us-x-fem": "|{n} guards and a queen.",
  "text_pl-pl": "Patrz!|{n} strażników i król.",
  "text_pl-pl-x-few": "Patrz!|{n} strażnicy i król.",
  "text_ja-jp": "見て！|衛兵{n}人と王。"
}
"#;

fn exchange(locales: &[&str]) -> Exchange {
    let clip = lipz_file::parse(CLIP.as_bytes()).document.unwrap();
    let collect = Collect::new("en-us", locales.iter().copied());
    let text = collect.unit("act1/guards", &clip, &mut Vec::new()).unwrap();
    let mut units = collect.variants(&text, &clip);
    units.insert(0, text);
    Exchange {
        source_locale: "en-us".into(),
        locales: locales.iter().map(|locale| (*locale).to_owned()).collect(),
        units,
    }
}

/// Returns the exchange after the work of translators: every text that a locale needs is `locale variant segment`.
fn translated(locales: &[&str]) -> Exchange {
    let mut exchange = exchange(locales);
    for unit in &mut exchange.units {
        let variant = unit.variant.clone().unwrap_or_default();
        for (locale, translation) in exchange.locales.iter().zip(&mut unit.translations) {
            let Translation { texts, is_unneeded, state, .. } = translation;
            *state = State::Translated;
            for (number, (text, segment)) in texts.iter_mut().zip(&unit.segments).enumerate() {
                if !*is_unneeded && !segment.source.is_empty() {
                    *text = format!("{locale} {variant} {number} {{n}}");
                }
            }
        }
    }
    exchange
}

/// Returns the texts of the clip after the import of these files.
fn imported(format: Format, files: &[Vec<u8>]) -> ClipTexts {
    let mut clip = CLIP.to_owned();
    for bytes in files {
        let incoming = read(format, bytes, &ReadOptions::new("en-us"));
        assert!(incoming.diagnostics.is_empty(), "{format:?} {:?}\n{}", incoming.diagnostics, incoming.text);
        let mut entries = incoming.entries;
        // The marks are those of the translated texts here.
        entries.iter_mut().for_each(|entry| entry.mark = None);
        let document = lipz_file::parse(clip.as_bytes()).document.unwrap();
        let merged = Merge::new("en-us").merge(&clip, &document, &entries.iter().collect::<Vec<_>>());
        let errors: Vec<_> = merged.found.iter().filter(|(_, diagnostic)| diagnostic.is_error()).collect();
        assert!(errors.is_empty(), "{format:?} {errors:?}\n{}", String::from_utf8_lossy(bytes));
        clip = merged.text.unwrap_or(clip);
    }
    texts_of(&lipz_file::parse(clip.as_bytes()).document.unwrap(), None)
}

#[test]
fn translated_variants_come_back_in_every_format() {
    let locales = ["ja-jp", "pl-pl"];
    let mut expected = texts_of(&lipz_file::parse(CLIP.as_bytes()).document.unwrap(), None);
    for (tag, first, second) in [
        ("ja-jp", "ja-jp  0 {n}", "ja-jp  1 {n}"),
        ("ja-jp-x-fem", "", "ja-jp fem 1 {n}"),
        ("pl-pl", "pl-pl  0 {n}", "pl-pl  1 {n}"),
        ("pl-pl-x-one", "", "pl-pl one 1 {n}"),
        // The export lacks its first segment, which does not vary in the source.
        ("pl-pl-x-few", "Patrz!", "pl-pl few 1 {n}"),
        ("pl-pl-x-fem", "", "pl-pl fem 1 {n}"),
    ] {
        expected.insert(tag.into(), vec![first.into(), second.into()]);
    }
    for division in [Division::Clip, Division::Segment] {
        let options = WriteOptions::new().division(division);
        let formats = Format::ALL.iter().map(|format| (*format, options.clone()));
        let shapes = Shape::ALL.into_iter().map(|shape| (Format::Csv, options.clone().shape(shape)));
        for (format, options) in formats.chain(shapes) {
            let written = write(format, &translated(&locales), &options);
            let files: Vec<Vec<u8>> = written.files.into_iter().map(|file| file.bytes).collect();
            assert_eq!(imported(format, &files), expected, "{format:?} {options:?}");
        }
    }
}

/// The marks of an unchanged file are those of the texts.
#[test]
fn an_unchanged_file_changes_nothing() {
    let document = lipz_file::parse(CLIP.as_bytes()).document.unwrap();
    let shapes = Shape::ALL.into_iter().map(|shape| (Format::Csv, WriteOptions::new().shape(shape)));
    for (format, options) in Format::ALL.iter().map(|format| (*format, WriteOptions::new())).chain(shapes) {
        for file in write(format, &exchange(&["ja-jp", "pl-pl"]), &options).files {
            let entries = read(format, &file.bytes, &ReadOptions::new("en-us")).entries;
            let marked = entries.iter().filter(|entry| entry.mark.is_some()).count();
            assert_eq!(marked, entries.len(), "{format:?} {options:?}");
            let merged = Merge::new("en-us").merge(CLIP, &document, &entries.iter().collect::<Vec<_>>());
            assert_eq!((merged.text, merged.found), (None, Vec::new()), "{format:?} {options:?}");
        }
    }
}

#[test]
fn a_file_has_the_variants_of_its_language() {
    let po = |locale: &str| {
        let written = write(Format::Po, &exchange(&[locale]), &WriteOptions::new());
        String::from_utf8(written.files[0].bytes.clone()).unwrap()
    };
    let polish = po("pl-pl");
    assert!(polish.contains("Plural-Forms: nplurals=3; plural=(n==1 ? 0 : n%10>=2"), "{polish}");
    assert!(
        polish.contains("msgid \"Look! | One guard and a king.\"\nmsgid_plural \"Look! | {n} guards and a king.\"")
    );
    assert!(polish.contains("msgstr[0] \"\"\nmsgstr[1] \"Patrz! | {n} strażnicy i król.\"\nmsgstr[2] \"Patrz! |"));
    assert!(polish.contains("msgctxt \"act1/guards|x-fem\"\nmsgid \" | {n} guards and a queen.\"\nmsgstr \"\""));
    let japanese = po("ja-jp");
    assert!(japanese.contains("nplurals=1; plural=0;") && japanese.contains("msgstr[0] \"見て！"), "{japanese}");
    assert!(!japanese.contains("msgstr[1]"));
    let template = po("");
    assert!(template.contains("nplurals=INTEGER") && template.contains("msgstr[1] \"\""), "{template}");
    assert_eq!(template.matches("msgctxt").count(), 2);
}

#[test]
fn plural_forms_of_other_tools_are_understood() {
    // Four forms, in which the last is for fractions.
    let po = "msgid \"\"\nmsgstr \"Language: pl\\nPlural-Forms: nplurals=4; plural=(n==1 ? 0 : (n%10>=2 && n%10<=4) && \
        (n%100<12 || n%100>14) ? 1 : n!=1 ? 2 : 3);\\n\"\n\nmsgctxt \"act1/guards|2\"\nmsgid \"One guard and a king.\"\n\
        msgid_plural \"{n} guards and a king.\"\nmsgstr[0] \"a\"\nmsgstr[1] \"b {n}\"\nmsgstr[2] \"c {n}\"\nmsgstr[3] \"d {n}\"\n";
    let options = ReadOptions::new("en-us").known(["pl-pl"]);
    let incoming = read(Format::Po, po.as_bytes(), &options);
    let read_texts: Vec<_> =
        incoming.entries.iter().map(|entry| (&*entry.locale, entry.segment, entry.text.text.as_str())).collect();
    let expected = [("pl-pl-x-one", Some(2), "a"), ("pl-pl-x-few", Some(2), "b {n}"), ("pl-pl", Some(2), "c {n}")];
    assert_eq!(read_texts, expected);
    let messages: Vec<_> = incoming.diagnostics.iter().map(|diagnostic| diagnostic.message.as_str()).collect();
    assert_eq!(messages, ["form 3 has no plural category of its own in pl-pl, and is not imported"]);
    // Without a header, the forms are those of the language.
    let without = po.replace("Plural-Forms", "X-Forms").replace("msgstr[3] \"d {n}\"\n", "");
    let read_without = read(Format::Po, without.as_bytes(), &options);
    assert!(
        read_without.entries.iter().map(|entry| &entry.locale).eq(incoming.entries.iter().map(|entry| &entry.locale))
    );
    let unreadable = po.replace("msgstr[2]", "msgstr[z]");
    let unreadable = read(Format::Po, unreadable.as_bytes(), &options).diagnostics;
    assert_eq!(unreadable[0].message, "the number of the plural form cannot be read");
    let menu = "msgid \"\"\nmsgstr \"Language: pl\\n\"\n\nmsgid \"a\"\nmsgid_plural \"b\"\nmsgstr[0] \"c\"\n\n\
        msgctxt \"x\"\nmsgid \"y\"\nmsgstr \"z\"\n";
    let menu = read(Format::Po, menu.as_bytes(), &options);
    assert_eq!((menu.entries.len(), menu.diagnostics.len()), (1, 1), "{:?}", menu.diagnostics);
}

#[test]
fn work_counts_the_variants_that_a_language_needs() {
    let texts = texts_of(&lipz_file::parse(CLIP.as_bytes()).document.unwrap(), None);
    let mut work = Work::new("en-us", ["ja-jp", "pl-pl"]);
    work.add("guards", "guards.lipz", &texts, Some(&TextRecord::default()));
    let open = |at: usize| work.locales[at].open.iter().map(|open| open.key.as_str()).collect::<Vec<_>>();
    assert_eq!(open(0), ["guards|x-fem"]);
    assert_eq!(open(1), ["guards|x-fem", "guards|x-one"]);
}

const LATVIAN: &str = r#"{ "text_en-us": "{n} left.", "text_en-us-x-one": "One left.", "text_lv-lv": "o {n}", "text_lv-lv-x-zero": "z {n}",
    "text_lv-lv-x-one": "1 {n}" }"#;

/// Returns the texts of a file after the import of a PO file, and the messages.
fn merged(file: &str, po: &str, locale: &str, source_locale: &str) -> (ClipTexts, Vec<String>) {
    let incoming = read(Format::Po, po.as_bytes(), &ReadOptions::new(source_locale).wanted([locale]));
    let document = lipz_file::parse(file.as_bytes()).document.unwrap();
    let merged = Merge::new(source_locale).merge(file, &document, &incoming.entries.iter().collect::<Vec<_>>());
    let found = merged.found.into_iter().map(|(_, found)| found).chain(incoming.diagnostics);
    let file = merged.text.unwrap_or(file.to_owned());
    let texts = texts_of(&lipz_file::parse(file.as_bytes()).document.unwrap(), None);
    (texts, found.map(|found| found.message).collect())
}

fn exported(file: &str, locale: &str, source_locale: &str) -> String {
    let clip = lipz_file::parse(file.as_bytes()).document.unwrap();
    let collect = Collect::new(source_locale, [locale]);
    let text = collect.unit("g", &clip, &mut Vec::new()).unwrap();
    let units = [vec![text.clone()], collect.variants(&text, &clip)].concat();
    let exchange = Exchange { source_locale: source_locale.into(), locales: vec![locale.into()], units };
    String::from_utf8(write(Format::Po, &exchange, &WriteOptions::new()).files[0].bytes.clone()).unwrap()
}

/// The header of gettext has other forms than that of CLDR for Latvian.
#[test]
fn marks_belong_to_categories_in_whatever_order_the_forms_are() {
    let po = exported(LATVIAN, "lv-lv", "en-us");
    assert!(po.contains("#. as exported: zero:") && po.contains("msgstr[0] \"z {n}\"\nmsgstr[1] \"1 {n}\""), "{po}");
    let header = po.lines().find(|line| line.contains("Plural-Forms")).unwrap();
    let gettext = "\"Plural-Forms: nplurals=3; plural=(n%10==1 && n%100!=11 ? 0 : n != 0 ? 1 : 2);\\n\"";
    let forms = [
        "\"z {n}\"\nmsgstr[1] \"1 {n}\"\nmsgstr[2] \"o {n}\"",
        "\"1 {n}!\"\nmsgstr[1] \"o {n}\"\nmsgstr[2] \"z {n}!\"",
    ];
    let po = po.replace(header, gettext).replace(forms[0], forms[1]);
    let (texts, messages) = merged(LATVIAN, &po, "lv-lv", "en-us");
    assert_eq!(messages, [""; 0], "{po}");
    let text = |tag: &str| texts[tag].concat();
    assert_eq!([text("lv-lv-x-zero"), text("lv-lv-x-one"), text("lv-lv")], ["z {n}!", "1 {n}!", "o {n}"]);
}

/// A file from a template has the source texts of two forms only.
#[test]
fn files_from_templates_are_imported() {
    let source = r#"{ "text_pl-pl": "O|{n} wielu", "text_pl-pl-x-one": "|jeden", "text_pl-pl-x-few": "|{n} kilku" }"#;
    let po = "msgid \"\"\nmsgstr \"Plural-Forms: nplurals=3; plural=(n==1 ? 0 : n>=2 && n<=4 ? 1 : 2);\\n\"\n\nmsgctxt \"g\"\n\
        msgid \"O | jeden\"\nmsgid_plural \"O | {n} wielu\"\nmsgstr[0] \"A | jeden\"\nmsgstr[1] \"A | {n} par\"\nmsgstr[2] \"A | {n} mnoho\"\n";
    let (texts, messages) = merged(source, po, "cs-cz", "pl-pl");
    assert_eq!(messages, [""; 0]);
    assert_eq!(
        [&texts["cs-cz"], &texts["cs-cz-x-few"], &texts["cs-cz-x-one"]],
        [&["A", "{n} mnoho"], &["", "{n} par"], &["", "jeden"],]
            .map(|texts| texts.map(str::to_owned).to_vec())
            .each_ref()
    );
}

#[test]
fn a_language_without_plurals_has_translations_with_them() {
    let japanese = r#"{ "text_ja-jp": "a|b {n}", "text_pl-pl": "P|{n} wielu" }"#;
    let po = "msgid \"\"\nmsgstr \"\"\n\nmsgctxt \"g\"\nmsgid \"a | b {n}\"\nmsgid_plural \"a | b {n}\"\n\
        msgstr[0] \"P | jeden {n}\"\nmsgstr[1] \"P | {n} wielu\"\nmsgstr[2] \"P | {n} wielu\"\n";
    let (texts, messages) = merged(japanese, po, "pl-pl", "ja-jp");
    assert_eq!(messages, [""; 0]);
    assert_eq!(texts["pl-pl-x-few"], ["P", "{n} wielu"], "a form that equals the text is one");
}

#[test]
fn what_translators_take_out_of_a_variant_goes() {
    let project = r#"{ "text_en-us": "Look!|{n}.", "text_en-us-x-one": "|One.", "text_pl-pl": "Patrz!|{n}.", "text_pl-pl-x-one": "Patrz ty!|Jeden.",
        "text_pl-pl-x-few": "|{n}" }"#;
    let po = exported(project, "pl-pl", "en-us").replace("Patrz ty!", "Patrz!");
    let (texts, messages) = merged(project, &po, "pl-pl", "en-us");
    assert_eq!((texts["pl-pl-x-one"].as_slice(), messages), (&["".to_owned(), "Jeden.".to_owned()][..], vec![]));
}

#[test]
fn unreadable_forms_are_an_error_with_the_right_ones() {
    let po = exported(LATVIAN, "lv-lv", "en-us");
    let header = po.lines().find(|line| line.contains("Plural-Forms")).unwrap();
    let po = po.replace(header, "\"Plural-Forms: nplurals=INTEGER; plural=EXPRESSION;\\n\"");
    let incoming = read(Format::Po, po.as_bytes(), &ReadOptions::new("en-us").wanted(["lv-lv"]));
    assert!(incoming.entries.is_empty());
    let found = &incoming.diagnostics[0];
    assert_eq!(found.message, "`Plural-Forms` in the header cannot be read");
    assert!(found.help.as_deref().is_some_and(|help| help.contains("nplurals=3; plural=(n%10==0")), "{found:?}");
}
