//! Progress of a long run, kept in its folder: the same command goes on from there.

use std::fs;
use std::io;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::files::{CHECKPOINT, locked, replace};
use super::job::Job;
use super::sealed::{open, seal};
use crate::failure::Failure;

/// The checkpoint of a run, at most one, replaced as a whole.
///
/// Where the run may be interrupted does not depend on the clock: a program goes on from
/// any of its checkpoints with the bits that it would have had.
#[derive(Debug)]
pub struct Checkpoint<'j> {
    job: &'j Job,
    path: Option<PathBuf>,
    interval: Duration,
    saved: Instant,
}

impl<'j> Checkpoint<'j> {
    /// The checkpoint in the folder of `job`, if it has one, that is replaced no sooner
    /// than after so many seconds.
    pub fn new(job: &'j Job, seconds: f64) -> Self {
        Self {
            job,
            path: job.folder().map(|folder| folder.join(CHECKPOINT)),
            interval: Duration::from_secs_f64(seconds.clamp(0.0, 1e6)),
            saved: Instant::now(),
        }
    }

    /// Progress of the run, if it was interrupted.
    ///
    /// # Errors
    /// [`Failure::Sealed`] of a checkpoint that is damaged, or of another run;
    /// [`Failure::File`].
    pub fn read<C: DeserializeOwned>(&self) -> Result<Option<C>, Failure> {
        let Some(path) = &self.path else {
            return Ok(None);
        };
        let bytes = match fs::read(path) {
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

    /// Saves what the run has reached, if it is time to.
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
        replace(path, &bytes).map_err(|source| Failure::File {
            path: path.clone(),
            source,
        })?;
        drop(ledger);
        self.saved = Instant::now();
        Ok(())
    }

    /// Takes the checkpoint away: its run has ended, and its results are there.
    pub fn discard(self) {
        if let Some(path) = self.path {
            let _ = fs::remove_file(path);
        }
    }
}
