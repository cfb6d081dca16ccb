//! Tests with small crates, whose imports are known.

use super::modules::Sources;
use super::table::Floor;
use super::{examine, table};

const FLOOR: Floor = Floor { name: "small", wings: &["low", "high"] };

/// Returns the sources of a crate with these files.
fn sources(files: &[(&str, &str)]) -> Sources {
    let read = |name: &str| files.iter().find(|(file, _)| *file == name).map(|(_, text)| (*text).to_owned());
    Sources::from_files(&read).unwrap()
}

/// Returns the reported lines for a crate with these files and `lib.rs`.
fn refused(files: &[(&str, &str)]) -> Vec<String> {
    examine(&sources(&[&[("lib.rs", "mod high; mod low;")], files].concat()), &FLOOR).refused
}

#[test]
fn the_workspace_has_the_order_of_its_design() {
    let (numbers, refused) = super::check().unwrap();
    assert_eq!(refused, Vec::<String>::new());
    assert_eq!(numbers.len(), table::FLOORS.len());
}

#[test]
fn the_map_has_every_file_with_its_line() {
    let map = super::map().unwrap();
    assert!(map.contains("lipz-compiler: Compiler of lipz dialogue banks."), "{map}");
    let line = "\n    discover.rs: Finding the Lipz files in the sources that a user names.\n";
    assert!(map.contains(line), "{map}");
    for line in map.lines() {
        assert!(line.split_once(": ").is_some_and(|(_, about)| !about.is_empty()), "no comment: {line}");
    }
}

#[test]
fn imports_run_down() {
    assert_eq!(refused(&[("low.rs", "pub struct A;"), ("high.rs", "use crate::low::A;")]), Vec::<String>::new());
    let line = "low.rs imports high.rs: the wing `low` is below `high`";
    let high = ("high.rs", "pub struct A; pub mod inner { pub fn f() {} }");
    for low in [
        "use crate::high::A;",
        "use crate::{high::{A as B}};",
        "use super::high::A;",
        "fn f() -> crate::high::A { todo!() }",
        "fn f() { assert!(crate::high::inner::f() == 1); }",
        "use crate::high; fn f() { high::inner::f() }",
        "#[serde(with = \"crate::high\")] struct C;",
        "struct C { #[serde(with = \"crate::high::inner\")] c: u8 }",
        "struct C { #[cfg_attr(feature = \"json\", serde(with = \"super::high::inner\"))] c: u8 }",
        "use crate::high::*;",
        "pub(crate) use crate::high::A; fn f(_: A) {}",
        "#[cfg(any(feature = \"shards\", test))] use crate::high::A;",
        "mod inside { use super::super::high::A; }",
    ] {
        assert_eq!(refused(&[("low.rs", low), high]), [line], "{low}");
    }
}

#[test]
fn tests_comments_and_texts_import_what_they_like() {
    for low in [
        "#[cfg(test)] mod tests { use crate::high::A; }",
        "#[cfg(test)] use crate::high::A;",
        "#[test] fn t() { crate::high::f() }",
        "#[cfg(all(test, unix))] use crate::high::A;",
        "//! [`A`](crate::high::A)\n/// crate::high::A\nfn f() {}",
        "const TEXT: &str = \"see crate::high::A there\";",
    ] {
        assert_eq!(refused(&[("low.rs", low), ("high.rs", "")]), Vec::<String>::new(), "{low}");
    }
}

#[test]
fn nothing_comes_through_lib() {
    let lib = ("lib.rs", "mod high; mod low; pub use low::A;");
    let found = examine(&sources(&[lib, ("low.rs", "pub struct A;"), ("high.rs", "use crate::A;")]), &FLOOR);
    assert_eq!(found.refused, ["high.rs imports `crate::A` through lib.rs: import it from its wing"]);
}

#[test]
fn an_import_through_an_export_leads_to_the_definition() {
    // `low` imports from `high` an item that `high` re-exports from `low`, so no import is against the order.
    let files = [
        ("lib.rs", "mod high; mod low;"),
        ("low/mod.rs", "mod a; mod b; pub use a::A;"),
        ("low/a.rs", "pub struct A;"),
        ("low/b.rs", "use crate::high::A;"),
        ("high.rs", "pub use crate::low::A;"),
    ];
    let found = examine(&sources(&files), &FLOOR);
    assert_eq!(found.refused, Vec::<String>::new());
    // The export itself is an import of `high`, and the one of `low/mod.rs` is not, because `a` is its own.
    assert_eq!((found.between_wings, found.largest_circle), (1, 1));
}

#[test]
fn wings_are_those_of_the_table() {
    let lib = ("lib.rs", "mod low; mod other;");
    let found = examine(&sources(&[lib, ("low.rs", ""), ("other.rs", "")]), &FLOOR);
    assert_eq!(
        found.refused,
        ["`other` is not a wing: list it in xtask/src/edges/wings/table.rs", "the wing `high` is missing"]
    );
}

#[test]
fn circles_are_small() {
    let circle = |count: usize| {
        let modules: String = (0..count).map(|number| format!("mod f{number};")).collect();
        let mut files =
            vec![("lib.rs".to_owned(), "mod high; mod low;".to_owned()), ("high.rs".to_owned(), String::new())];
        files.push(("low/mod.rs".to_owned(), modules));
        files.extend((0..count).map(|number| {
            (format!("low/f{number}.rs"), format!("use super::f{}::f; pub fn f() {{}}", (number + 1) % count))
        }));
        let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        let found = examine(&sources(&files), &FLOOR);
        (found.largest_circle, found.refused)
    };
    assert_eq!(circle(3), (3, Vec::new()));
    assert_eq!(
        circle(4),
        (4, vec!["4 files import each other, but 3 may: low/f0.rs, low/f1.rs, low/f2.rs, low/f3.rs".to_owned()])
    );
}
