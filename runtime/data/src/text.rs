//! Decoding of the text of a file.

use std::borrow::Cow;

use super::error::ReadErrorKind;
use super::finding::{Basis, Finding};

/// Decodes bytes as UTF-8, or as Latin-1 if they are not valid UTF-8, which is a finding.
pub(crate) fn decoded(bytes: Vec<u8>) -> Result<(String, Option<Finding>), ReadErrorKind> {
    let what = match bytes.as_slice() {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("UTF-16"),
        [0x89, b'H', b'D', b'F', ..] => Some("HDF5"),
        bytes if bytes.contains(&0) => Some("binary data"),
        _ => None,
    };
    if let Some(what) = what {
        return Err(ReadErrorKind::NotText { what });
    }
    Ok(match String::from_utf8(bytes) {
        Ok(text) => (text, None),
        Err(error) => {
            let text = error.into_bytes().into_iter().map(char::from).collect();
            let finding = Finding::new(Basis::Detected, "characters in Latin-1");
            (text, Some(finding))
        }
    })
}

/// Returns a text with lines that end in `\n`, without a byte order mark. Rejects text that is not
/// a table of numbers, with an error that names its kind.
pub(crate) fn plain(text: &str) -> Result<Cow<'_, str>, ReadErrorKind> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let start = text.trim_start();
    if start.is_empty() {
        return Err(ReadErrorKind::Empty);
    }
    let refused = |what, remedy| Err(ReadErrorKind::NotTable { what, remedy });
    let head: String = start.chars().take(2000).collect();
    if head.starts_with('<') {
        return if head.contains("opensourcephysics") {
            let remedy = "open it in Tracker and export the data of its tracks (File, Export)";
            refused("a project of Tracker", remedy)
        } else if head.to_ascii_lowercase().contains("<html") {
            refused("a page of the web", "save the table itself as text")
        } else {
            refused("XML", "export the table from the program that wrote it")
        };
    }
    if head.starts_with('{') || head.starts_with("[{") || head.starts_with("[[") {
        let remedy = "write a line for each time, with commas between its numbers";
        return refused("JSON", remedy);
    }
    if !text.contains('\r') {
        return Ok(Cow::Borrowed(text));
    }
    Ok(Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")))
}
