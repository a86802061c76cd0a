//! Runs in folders that hold other files, and runs whose input has changed.

#[cfg(unix)]
mod foreign;
mod inputs;

use std::path::PathBuf;

/// Returns an empty folder for one test.
fn temporary(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("frame-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}
