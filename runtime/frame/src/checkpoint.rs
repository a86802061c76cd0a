//! Checkpoints: the progress of a long run, stored in its folder, from which the same command
//! continues.

use std::io;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::files::{CHECKPOINT, locked, replace};
use super::job::Job;
use super::owned;
use super::sealed::{MARK, open, seal};
use crate::failure::Failure;

/// The checkpoint file of a run; there is at most one, which is replaced as a whole.
///
/// Results do not depend on the time of the interruption: a run that continues from a checkpoint
/// has the same bits as an uninterrupted one.
#[derive(Debug)]
pub struct Checkpoint<'j> {
    job: &'j Job,
    path: Option<PathBuf>,
    interval: Duration,
    saved: Instant,
}

impl<'j> Checkpoint<'j> {
    /// Creates the access to the checkpoint in the folder of `job`, if there is a folder. The
    /// checkpoint is replaced at most every `seconds` seconds.
    pub fn new(job: &'j Job, seconds: f64) -> Self {
        Self {
            job,
            path: job.folder().map(|folder| folder.join(CHECKPOINT)),
            interval: Duration::from_secs_f64(seconds.clamp(0.0, 1e6)),
            saved: Instant::now(),
        }
    }

    /// Reads the progress of the run, if it was interrupted before.
    ///
    /// # Errors
    /// [`Failure::Sealed`] if the checkpoint is damaged or belongs to another run;
    /// [`Failure::File`].
    pub fn read<C: DeserializeOwned>(&self) -> Result<Option<C>, Failure> {
        let Some(path) = &self.path else {
            return Ok(None);
        };
        let bytes = match owned::read(path, &|_| Ok(true)) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(source) => {
                return Err(Failure::Unread {
                    path: path.clone(),
                    source,
                });
            }
        };
        let content = open(&self.job.identity(), &bytes);
        content.map(Some).map_err(|source| Failure::Sealed {
            path: path.clone(),
            source,
        })
    }

    /// Saves the progress of the run, if enough time has passed since the last checkpoint.
    ///
    /// # Errors
    /// [`Failure::File`].
    pub fn save<C: Serialize>(&mut self, content: &C) -> Result<(), Failure> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        if self.saved.elapsed() < self.interval {
            return Ok(());
        }
        let bytes = seal(&self.job.identity(), content);
        let bytes = bytes.map_err(|source| Failure::Sealed {
            path: path.clone(),
            source,
        })?;
        // Ctrl-C waits for the file to be whole.
        let ledger = locked(&self.job.ledger);
        replace(path, &bytes, &ledger.stamp, &owned::has_header(MARK)).map_err(|source| {
            Failure::File {
                path: path.clone(),
                source,
            }
        })?;
        drop(ledger);
        self.saved = Instant::now();
        Ok(())
    }

    /// Removes the checkpoint after its run has ended and its results have been written.
    pub fn discard(self) {
        if let Some(path) = self.path {
            owned::remove(&path, &owned::has_header(MARK));
        }
    }
}
