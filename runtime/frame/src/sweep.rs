//! Sweeps: many independent computations, distributed among processes. `--shard i/n` computes every
//! n-th of them, `--merge n` combines the parts.
//!
//! The processes are started by other means: a shell, Slurm, HyperQueue or Dask. Each shard writes
//! its results and a `run.json` into a separate folder; existing results are not computed again.
//! `sweep.json` in the common folder describes the sweep.

use std::fs;
use std::io;
use std::path::Path;
use std::str::FromStr;

use clap::Args;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::files::{create, locked};
use super::input::Input;
use super::job::Job;
use super::owned::{self, part_name};
use super::sealed::{SealError, open, seal};
use super::sweep_error::SweepError;
use crate::failure::Failure;

/// Name of the manifest.
const MANIFEST: &str = "sweep.json";

/// Name of the file with the results of a shard.
const PART: &str = "results.bin";

/// Command-line options that select which part of a run is computed.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sharding {
    /// computes one shard only: every N-th of the starts, from number I on (from 0), into a
    /// separate folder; finished results there are not computed again
    #[arg(long, value_name = "I/N", verbatim_doc_comment)]
    pub shard: Option<Shard>,
    /// computes nothing, but combines the results of N shards
    #[arg(long, value_name = "N", conflicts_with = "shard", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub merge: Option<u32>,
}

/// One of several shards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Index of the shard, from 0.
    pub index: u32,
    /// Number of all.
    pub count: u32,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = |(index, count): (&str, &str)| {
            let (index, count) = (index.parse().ok()?, count.parse().ok()?);
            (index < count && count <= 100_000).then_some(Self { index, count })
        };
        text.split_once('/')
            .and_then(parse)
            .ok_or_else(|| "must be I/N, 0 ≤ I < N ≤ 100000".to_owned())
    }
}

impl Shard {
    /// Name of its folder.
    pub fn folder(self) -> String {
        format!("shard-{}-of-{}", self.index, self.count)
    }

    /// Returns the indices of those of `items` items that the shard computes.
    pub fn items(self, items: usize) -> Vec<usize> {
        (self.index as usize..items)
            .step_by(self.count as usize)
            .collect()
    }
}

/// Results of a shard.
#[derive(Debug, Serialize, Deserialize)]
struct ShardResults<R> {
    shard: Shard,
    results: Vec<(usize, R)>,
}

/// Computes or collects the results of all items, in order; `work` computes a list of items. For
/// one shard, the results are written to its folder and `None` is returned. For `--merge`, the
/// results of all shards are read. Otherwise, all items are computed.
///
/// # Errors
/// [`Failure`].
pub fn results<R: Serialize + DeserializeOwned>(
    job: &Job,
    sharding: Sharding,
    items: usize,
    work: impl FnOnce(&[usize]) -> Result<Vec<R>, Failure>,
) -> Result<Option<Vec<R>>, Failure> {
    match (sharding.shard, sharding.merge, job.folder()) {
        (Some(shard), _, Some(folder)) => {
            if let Some(sweep) = folder.parent() {
                agree(job, sweep, folder, shard.count, items)?;
            }
            if read::<R>(job, folder)?.is_some() {
                job.print(&format!("{} is there\n", folder.display()))?;
                return Ok(None);
            }
            let own = shard.items(items);
            let results = own.iter().copied().zip(work(&own)?).collect();
            let part = seal(&job.identity(), &ShardResults { shard, results });
            let part = part.map_err(|source| Failure::Sealed {
                path: folder.join(PART),
                source,
            })?;
            job.write(PART, &part)?;
            Ok(None)
        }
        (_, Some(count), Some(folder)) => {
            agree(job, folder, folder, count, items)?;
            merge(job, folder, count, items).map(Some)
        }
        _ => work(&(0..items).collect::<Vec<_>>()).map(Some),
    }
}

/// Writes the manifest into the folder of a sweep, or checks the existing one. It is written in
/// `own` first, the folder that this process has locked.
fn agree(job: &Job, sweep: &Path, own: &Path, shards: u32, items: usize) -> Result<(), Failure> {
    let run = job.identity();
    let manifest = json!({
        "program": run.program,
        "version": run.version,
        "arguments": run.arguments,
        "inputs": serde_json::to_value(&run.inputs).unwrap_or_default(),
        "shards": shards,
        "items": items,
    });
    let expected = format!("{manifest:#}\n");
    let path = sweep.join(MANIFEST);
    let part = own.join(part_name(MANIFEST, &locked(&job.ledger).stamp));
    // Of shards that begin together one writes it, and the others find it.
    match create(&path, expected.as_bytes(), part) {
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
        made => return made.map_err(|source| Failure::File { path, source }),
    }
    let found = owned::read(&path, &|_| Ok(true));
    let found = found.map_err(|source| Failure::Unread { path, source })?;
    match found == expected.as_bytes() {
        true => Ok(()),
        false => Err(differs(&String::from_utf8_lossy(&found), &manifest).into()),
    }
}

/// Returns the error that states how the existing manifest differs from the manifest of this sweep.
fn differs(found: &str, manifest: &Value) -> SweepError {
    let expected = format!("{manifest:#}\n");
    let without_inputs = |manifest: &Value| {
        let mut manifest = manifest.clone();
        if let Some(manifest) = manifest.as_object_mut() {
            manifest.remove("inputs");
        }
        manifest
    };
    let inputs = |manifest: &Value| -> Vec<Input> {
        serde_json::from_value(manifest["inputs"].clone()).unwrap_or_default()
    };
    let read: Value = serde_json::from_str(found).unwrap_or_default();
    let difference = Input::first_difference(&inputs(&read), &inputs(manifest));
    match difference {
        Some(difference) if without_inputs(&read) == without_inputs(manifest) => {
            SweepError::Input(difference)
        }
        _ => SweepError::Manifest {
            found: found.to_owned(),
            expected,
        },
    }
}

/// Reads the results in the folder of a shard; `None` if there are none.
fn read<R: DeserializeOwned>(job: &Job, folder: &Path) -> Result<Option<ShardResults<R>>, Failure> {
    let path = folder.join(PART);
    let bytes = match owned::read(&path, &|_| Ok(true)) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(Failure::Unread { path, source }),
    };
    let part: Result<ShardResults<R>, SealError> = open(&job.identity(), &bytes);
    part.map(Some)
        .map_err(|source| Failure::Sealed { path, source })
}

/// Combines the results of all shards, after checking that each exists exactly once.
fn merge<R: DeserializeOwned>(
    job: &Job,
    folder: &Path,
    count: u32,
    items: usize,
) -> Result<Vec<R>, Failure> {
    let unread = |source| Failure::Unread {
        path: folder.to_path_buf(),
        source,
    };
    for entry in fs::read_dir(folder).map_err(unread)? {
        let name = entry.map_err(unread)?.file_name();
        let name = name.to_string_lossy().into_owned();
        let own = format!("-of-{count}");
        if name.starts_with("shard-") && !name.ends_with(&own) {
            return Err(SweepError::Foreign {
                folder: name,
                count,
            }
            .into());
        }
    }
    let mut results: Vec<Option<R>> = (0..items).map(|_| None).collect();
    let mut missing = Vec::new();
    for index in 0..count {
        let shard = Shard { index, count };
        let Some(part) = read::<R>(job, &folder.join(shard.folder()))? else {
            missing.push(index);
            continue;
        };
        let found: Vec<usize> = part.results.iter().map(|(item, _)| *item).collect();
        if part.shard != shard || found != shard.items(items) {
            let folder = shard.folder();
            return Err(SweepError::Items { folder }.into());
        }
        for (item, result) in part.results {
            if let Some(place) = results.get_mut(item) {
                *place = Some(result);
            }
        }
    }
    let results: Option<Vec<R>> = results.into_iter().collect();
    match results {
        Some(results) if missing.is_empty() => Ok(results),
        _ => Err(SweepError::Gaps { missing, count }.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Shard, Sharding, SweepError, results};
    use crate::Job;
    use crate::failure::Failure;
    use std::fs;
    use std::path::Path;

    fn square(items: &[usize]) -> Result<Vec<f64>, Failure> {
        Ok(items.iter().map(|&item| (item as f64).powi(2)).collect())
    }

    fn shard(folder: &Path, index: u32, count: u32, items: usize) -> Result<(), Failure> {
        let shard = Shard { index, count };
        let job = Job::quiet(&folder.join(shard.folder()))?;
        let sharding = Sharding {
            shard: Some(shard),
            merge: None,
        };
        assert!(results(&job, sharding, items, square)?.is_none());
        Ok(())
    }

    fn merge(folder: &Path, count: u32, items: usize) -> Result<Vec<f64>, Failure> {
        let job = Job::quiet(folder)?;
        let sharding = Sharding {
            shard: None,
            merge: Some(count),
        };
        let merged = results(&job, sharding, items, |_| -> Result<Vec<f64>, Failure> {
            panic!("nothing is computed")
        })?;
        Ok(merged.unwrap())
    }

    #[test]
    fn shards_are_read_as_they_are_written() {
        let last = Shard {
            index: 63,
            count: 64,
        };
        assert_eq!("63/64".parse(), Ok(last));
        assert_eq!(last.items(130), [63, 127]);
        for text in ["64/64", "1", "-1/3", "a/b", "1/0", "1/2/3", "1/100001"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn gaps_and_strangers_are_refused() {
        let folder = std::env::temp_dir().join(format!("sweep-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        for index in [0, 2] {
            shard(&folder, index, 3, 11).unwrap();
        }
        let Failure::Sweep(gaps) = merge(&folder, 3, 11).unwrap_err() else {
            panic!("no gap was seen");
        };
        assert_eq!(
            gaps,
            SweepError::Gaps {
                missing: vec![1],
                count: 3
            }
        );
        // Another sweep, and another number of shards, in the same folder.
        for other in [shard(&folder, 1, 3, 12), shard(&folder, 1, 4, 11)] {
            assert!(matches!(
                other,
                Err(Failure::Sweep(SweepError::Manifest { .. }))
            ));
        }
        fs::remove_dir_all(folder.join("shard-1-of-3")).unwrap();
        assert!(matches!(
            merge(&folder, 3, 11),
            Err(Failure::Sweep(SweepError::Foreign { .. }))
        ));
        fs::remove_dir_all(folder.join("shard-1-of-4")).unwrap();
        shard(&folder, 1, 3, 11).unwrap();
        assert_eq!(
            merge(&folder, 3, 11).unwrap(),
            square(&(0..11).collect::<Vec<_>>()).unwrap()
        );
        // A part in the place of another: its items would be there twice.
        let part = |index: u32| folder.join(format!("shard-{index}-of-3/results.bin"));
        fs::copy(part(0), part(1)).unwrap();
        assert!(matches!(
            merge(&folder, 3, 11),
            Err(Failure::Sweep(SweepError::Items { .. }))
        ));
        fs::write(part(1), "torn").unwrap();
        assert!(matches!(merge(&folder, 3, 11), Err(Failure::Sealed { .. })));
        fs::remove_dir_all(&folder).unwrap();
    }
}
