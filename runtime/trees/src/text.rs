//! The text of an attribute, read and checked.

use std::thread;

use branched_pendulum_codegen::description;
use branched_pendulum_codegen::report::Faults;
use branched_pendulum_codegen::scene::{self, Scene};

use crate::error::DescriptionError;

/// Longest text, in bytes.
const LONGEST: usize = 1 << 20;

/// Stack of the thread that reads: parsing recurses as deep as brackets nest, 64 levels.
const STACK: usize = 8 << 20;

/// Reads and checks a description.
///
/// The places of tokens are kept by thread, for as long as it lives: a thread of its own
/// gives their memory back.
pub(crate) fn scene(text: &str) -> Result<Scene, DescriptionError> {
    if text.len() > LONGEST {
        return Err(DescriptionError::too_long(LONGEST));
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

fn read(text: &str) -> Result<Scene, DescriptionError> {
    let mut report = Faults::new();
    let scene = description::parse_text(text, &mut report)
        .and_then(|description| scene::resolve_at_run_time(&description, &mut report));
    scene.ok_or_else(|| DescriptionError::of(&report, text))
}
