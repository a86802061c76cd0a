//! The template is what the front page shows.

#[test]
fn the_front_page_shows_the_template() {
    let page = include_str!("../../README.md");
    let program = include_str!("../template/src/main.rs");
    assert!(page.contains(&format!("```rust,ignore\n{program}```\n")));
    let manifest = include_str!("../template/Cargo.toml");
    assert!(manifest.contains("[profile.dev]\nopt-level = 1\n"));
    assert!(page.contains("[profile.dev]\nopt-level = 1 "));
}
