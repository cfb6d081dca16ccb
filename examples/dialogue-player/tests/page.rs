//! The program on docs/guides/build-scripts.md, compared with the example that cargo compiles.

#[test]
fn the_page_shows_the_example() {
    let page = include_str!("../../../docs/guides/build-scripts.md");
    let (_, program) = include_str!("../examples/smallest.rs").split_once("\n\n").unwrap_or_default();
    let shown = format!("```rust,ignore\n{program}```");
    assert!(!program.is_empty() && page.contains(&shown), "copy the example to the page");
}
