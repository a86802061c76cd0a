//! Reading and checking the text of an attribute.

use std::thread;

use branched_pendulum_codegen::description;
use branched_pendulum_codegen::report::{Faults, NameRule};
use branched_pendulum_codegen::scene::{self, Scene};

use crate::error::DescriptionError;

/// Longest text, in bytes.
const LONGEST: usize = 1 << 20;

/// Stack size of the thread that parses: the recursion is as deep as brackets are nested, at most
/// 64 levels.
const STACK: usize = 8 << 20;

/// Reads and checks a description.
///
/// A thread stores the positions of tokens until it ends; parsing in a separate thread frees their
/// memory.
pub(crate) fn scene(text: &str) -> Result<Scene, DescriptionError> {
    if text.len() > LONGEST {
        return Err(DescriptionError::too_long(LONGEST));
    }
    if is_file_name(text) {
        return Err(DescriptionError::file_name(text.trim()));
    }
    let reader = thread::Builder::new()
        .name("description".to_owned())
        .stack_size(STACK);
    thread::scope(|scope| match reader.spawn_scoped(scope, || read(text)) {
        Ok(reader) => match reader.join() {
            Ok(read) => read,
            Err(panic) => std::panic::resume_unwind(panic),
        },
        // Where there are no threads.
        Err(_) => read(text),
    })
}

/// Returns true if a text looks like the name of a file: one line without the punctuation of a
/// description, and with folders or an extension.
fn is_file_name(text: &str) -> bool {
    let text = text.trim();
    let has_marks = text.contains(['(', ')', '[', ']', '=', '\n', ',', '"']);
    let extension = text.rsplit_once('.').map_or("", |(_, extension)| extension);
    let is_extension = (1..=5).contains(&extension.len())
        && extension.starts_with(|c: char| c.is_ascii_alphabetic())
        && extension.chars().all(|c| c.is_ascii_alphanumeric());
    !has_marks && (is_extension || text.contains(['/', '\\']))
}

fn read(text: &str) -> Result<Scene, DescriptionError> {
    let mut report = Faults::with_names(NameRule::Free);
    let scene = description::parse_text(text, &mut report)
        .and_then(|description| scene::resolve_at_run_time(&description, &mut report));
    scene.ok_or_else(|| DescriptionError::of(&report, text))
}
