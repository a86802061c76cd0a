//! Record of a run, written next to its results when it ends.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use super::files::{CHECKPOINT, Ledger, replace};
use super::input::{INPUTS, Input};
use super::lock::FolderLock;
use super::owned;
use super::sealed;
use crate::failure::Failure;

/// Name of the record of a run.
pub const RECORD: &str = "run.json";

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Everything is there.
    Finished,
    /// Interrupted by Ctrl-C, or by the system's request to terminate.
    Interrupted,
    /// Failed, with the error message.
    Failed(String),
}

/// Record of a run, stored next to its results: the program, its arguments, the files that it read,
/// how it ended, and the files that it wrote. `--repeat` uses the arguments and checks the files
/// that were read.
#[derive(Debug)]
pub(super) struct Record {
    pub(super) program: String,
    pub(super) folder: Option<PathBuf>,
    /// True if the run created the folder.
    pub(super) made: bool,
    /// Lock that keeps other runs from writing into the folder until the record is written.
    pub(super) lock: Option<FolderLock>,
    pub(super) arguments: Map<String, Value>,
    pub(super) inputs: Vec<Input>,
    pub(super) report: Map<String, Value>,
    pub(super) closed: bool,
}

impl Record {
    /// Removes incomplete files, and writes the record next to the complete ones. If there are
    /// none, removes the folder if the run created it and it is empty. Returns a sentence about the
    /// files that remain; `None` for a run without a folder. Closing a record again has no effect.
    ///
    /// No file can be started or placed meanwhile, because the caller holds the ledger.
    pub(super) fn close(
        &mut self,
        ended: &Ended,
        ledger: &mut Ledger,
    ) -> Result<Option<String>, Failure> {
        for part in ledger.parts.drain(..) {
            owned::remove_created(&part);
        }
        let Some(folder) = self.folder.clone() else {
            return Ok(None);
        };
        let mut files = ledger.files.clone();
        files.retain(|file| file != RECORD);
        let goes_on = owned::is_own(&folder.join(CHECKPOINT), &owned::has_header(sealed::MARK));
        if files.is_empty() && !goes_on {
            self.lock = None;
            if self.made {
                owned::remove_empty_folder(&folder);
            }
            return Ok(Some("no file was finished".to_owned()));
        }
        let shown = folder.display();
        let left = match files.len() {
            _ if goes_on => format!("the same command goes on from the checkpoint in {shown}"),
            1 => format!("1 file is in {shown}"),
            count => format!("{count} files are in {shown}"),
        };
        if std::mem::replace(&mut self.closed, true) {
            return Ok(Some(left));
        }
        let written = self.write(ended, &files, &folder, ledger);
        if written.is_err() {
            // No results without a record of how they were computed.
            ledger.remove_files(&folder);
        }
        self.lock = None;
        if written.is_err() && self.made {
            owned::remove_empty_folder(&folder);
        }
        written.map_err(|source| Failure::File {
            path: folder.join(RECORD),
            source,
        })?;
        ledger.files.push(RECORD.to_owned());
        Ok(Some(left))
    }

    /// Writes the record; on a full disk it uses the bytes that the lock file has reserved.
    fn write(
        &self,
        ended: &Ended,
        files: &[String],
        folder: &Path,
        ledger: &Ledger,
    ) -> io::Result<()> {
        let ended = match ended {
            Ended::Finished => "finished".to_owned(),
            Ended::Interrupted => "interrupted".to_owned(),
            Ended::Failed(message) => format!("failed: {message}"),
        };
        let record = json!({
            "program": self.program,
            "version": env!("CARGO_PKG_VERSION"),
            "system": format!("{} {}", std::env::consts::ARCH, std::env::consts::OS),
            "arguments": self.arguments,
            INPUTS: serde_json::to_value(&self.inputs).map_err(io::Error::other)?,
            "report": self.report,
            "ended": ended,
            "files": files,
            DIGESTS: ledger.digests(folder),
        });
        let text = format!("{record:#}\n");
        let write = || {
            let path = folder.join(RECORD);
            replace(&path, text.as_bytes(), &ledger.stamp, &is_record)
        };
        write().or_else(|_| {
            if let Some(lock) = &self.lock {
                lock.shrink();
            }
            write()
        })
    }
}

/// Key in a record of the SHA-256 digests of all files in the folder that programs of this project
/// have written.
const DIGESTS: &str = "sha256";

/// Reads a record; returns `None` if the file is not a record of this project.
fn record_in(file: &mut File) -> io::Result<Option<Map<String, Value>>> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    let value = serde_json::from_slice(&bytes).unwrap_or_default();
    let Value::Object(record) = value else {
        return Ok(None);
    };
    let has = |entry: &str| record.contains_key(entry);
    let is_record = ["program", "version", "arguments", "ended", "files"]
        .into_iter()
        .all(has);
    Ok(is_record.then_some(record))
}

/// Returns true if the file is the record of a run.
fn is_record(file: &mut File) -> io::Result<bool> {
    Ok(record_in(file)?.is_some())
}

/// Returns the digests of files that earlier runs have left in a folder, according to the record there.
///
/// # Errors
/// An error if the file with the record's name is not a record of this project.
pub(super) fn earlier(folder: &Path) -> io::Result<BTreeMap<String, String>> {
    let path = folder.join(RECORD);
    owned::may_install(&path, &is_record)?;
    let record = match owned::open(&path, false) {
        Ok(mut file) => record_in(&mut file)?.unwrap_or_default(),
        Err(_) => Map::new(),
    };
    if let Some(digests) = record.get(DIGESTS).and_then(Value::as_object) {
        let digest =
            |(name, digest): (&String, &Value)| Some((name.clone(), digest.as_str()?.to_owned()));
        return Ok(digests.iter().filter_map(digest).collect());
    }
    // Records of older versions name the files alone.
    let files = record.get("files").and_then(Value::as_array);
    let names = files.into_iter().flatten().filter_map(Value::as_str);
    let digest = |name: &str| {
        let mut file = owned::open(&folder.join(name), false).ok()?;
        Some((name.to_owned(), owned::digest(&mut file).ok()?))
    };
    Ok(names.filter_map(digest).collect())
}

#[cfg(test)]
mod tests {
    use super::{Ended, RECORD};
    use crate::files::locked;
    use crate::owned::part_name;
    use crate::{Failure, Job};
    use std::fs;

    /// Checks that neither results nor the lock remain if the record cannot be written, as on a
    /// full disk.
    #[test]
    fn no_results_stay_without_a_record() {
        let folder = std::env::temp_dir().join(format!("no-record-{}", std::process::id()));
        for ended in [
            Ended::Finished,
            Ended::Interrupted,
            Ended::Failed(String::new()),
        ] {
            for is_new in [true, false] {
                let _ = fs::remove_dir_all(&folder);
                if !is_new {
                    fs::create_dir_all(&folder).unwrap();
                    fs::write(folder.join("notes.txt"), "").unwrap();
                }
                let job = Job::quiet(&folder).unwrap();
                job.write("a.csv", b"1\n").unwrap();
                job.write("a.svg", b"<svg/>\n").unwrap();
                let part = folder.join(part_name(RECORD, &locked(&job.ledger).stamp));
                fs::create_dir(&part).unwrap();
                let failure = job.end(&ended).unwrap_err();
                assert!(matches!(&failure, Failure::File { path, .. } if path.ends_with(RECORD)));
                fs::remove_dir(&part).unwrap();
                let left = fs::read_dir(&folder).unwrap();
                let names: Vec<_> = left.map(|entry| entry.unwrap().file_name()).collect();
                assert_eq!(names.len(), usize::from(!is_new), "{names:?}");
                // The job is still there, and the folder is free.
                drop(Job::quiet(&folder).unwrap());
            }
        }
        fs::remove_dir_all(&folder).unwrap();
    }
}
