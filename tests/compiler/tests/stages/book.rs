//! The book holds every page of `docs/` once, and its links lead somewhere.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use branched_pendulum_compiler_tests::source::fixture;

/// Markdown files below a folder, but the summary itself.
fn pages(folder: &Path) -> BTreeSet<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder exists");
    let paths = entries.map(|entry| entry.expect("it can be read").path());
    paths
        .flat_map(|path| {
            if path.is_dir() {
                pages(&path)
            } else {
                BTreeSet::from([path])
            }
        })
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .filter(|path| path.file_name().is_some_and(|name| name != "SUMMARY.md"))
        .collect()
}

/// Targets of the links of a page, without those to other sites and within the page.
fn links(text: &str) -> Vec<&str> {
    let targets = text
        .split("](")
        .skip(1)
        .filter_map(|rest| Some(rest.split_once(')')?.0));
    targets
        .filter(|target| !target.contains("://") && !target.starts_with('#'))
        .filter_map(|target| target.split('#').next())
        .filter(|target| target.contains('.') && !target.contains(' '))
        .collect()
}

#[test]
fn every_page_stands_in_the_summary_once() {
    let docs = fixture("../../docs");
    let summary = fs::read_to_string(docs.join("SUMMARY.md")).expect("it exists");
    let listed = links(&summary);
    let once: BTreeSet<PathBuf> = listed.iter().map(|target| docs.join(target)).collect();
    assert_eq!(once.len(), listed.len(), "a page is listed twice");
    assert_eq!(once, pages(&docs));
}

#[test]
fn links_lead_to_files() {
    for page in pages(&fixture("../../docs")) {
        let text = fs::read_to_string(&page).expect("it exists");
        let folder = page.parent().expect("it lies in a folder");
        for target in links(&text) {
            assert!(
                folder.join(target).exists(),
                "{} links to {target}, which does not exist",
                page.display()
            );
        }
    }
}
