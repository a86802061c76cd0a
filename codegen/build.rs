//! Computes a hash of the compiler's source, so that expansions stored by another version of the
//! compiler are ignored.

use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    let mut files = Vec::new();
    collect(Path::new("src"), &mut files)?;
    // The versions of the compiler's dependencies, including Symbolica. A package without a
    // workspace has no file above.
    files.push("Cargo.toml".into());
    files.extend(Some(PathBuf::from("../Cargo.toml")).filter(|path| path.is_file()));
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in &files {
        println!("cargo::rerun-if-changed={}", file.display());
        file.hash(&mut hasher);
        fs::read(file)?.hash(&mut hasher);
    }
    // A new file changes its folder.
    println!("cargo::rerun-if-changed=src");
    let state = hasher.finish();
    println!("cargo::rustc-env=BRANCHED_PENDULUM_COMPILER={state:016x}");
    Ok(())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        match path.is_dir() {
            true => collect(&path, files)?,
            false => files.push(path),
        }
    }
    Ok(())
}
