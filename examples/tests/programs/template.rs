//! The template is what the first page of the book shows.

#[test]
fn the_first_page_shows_the_template() {
    let page = include_str!("../../../docs/tutorials/first-crate.md");
    assert!(
        page.contains("```rust,ignore\n{{#include ../../examples/template/src/main.rs}}\n```\n")
    );
    let manifest = include_str!("../../template/Cargo.toml");
    assert!(manifest.contains("[profile.dev]\nopt-level = 1\n"));
    for page in [page, include_str!("../../../README.md")] {
        assert!(page.contains("[profile.dev]\nopt-level = 1 "));
    }
}
