//! Files of others stay as they are, under every name that a run uses.

use super::temporary;
use branched_pendulum_frame::sweep::{Shard, Sharding, results};
use branched_pendulum_frame::{Checkpoint, Ended, Failure, Job};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use std::fs::{self, File};
use std::os::unix::fs::{FileTypeExt, MetadataExt, symlink};
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, SystemTime};

/// Names that runs use in a folder, and names that look like them.
const NAMES: [&str; 16] = [
    ".running",
    ".running.0123456789abcdef.part",
    "checkpoint",
    ".checkpoint.0123456789abcdef.part",
    ".checkpoint.12.part",
    "run.json",
    ".run.json.0123456789abcdef.part",
    "sweep.json",
    ".sweep.json.77.part",
    "motion.csv",
    ".motion.csv.12.part",
    "motion.svg",
    "shard-0-of-2",
    "shard-1-of-2",
    ".film.mp4.12.part",
    ".download.2026.part",
];

/// Kinds of things that [`place`] puts in a folder.
const KINDS: u64 = 12;

/// Puts a thing of a kind in a folder, under a name.
fn install(path: &Path, outside: &Path, kind: u64) {
    let thesis = outside.join("thesis.tex");
    match kind {
        0 => fs::write(path, "\\documentclass{book}\n").unwrap(),
        1 => fs::write(path, "").unwrap(),
        2 => fs::write(path, "branched-pendulum run 2\nstamp 0\nholder\n").unwrap(),
        3 => fs::write(path, "branched-pendulum dat").unwrap(),
        4 => fs::write(
            path,
            "{\"program\": \"other\", \"files\": [\"motion.csv\"]}",
        )
        .unwrap(),
        5 => {
            fs::create_dir(path).unwrap();
            fs::write(path.join("motion.csv"), "notes\n").unwrap();
        }
        6 => symlink(&thesis, path).unwrap(),
        7 => fs::hard_link(&thesis, path).unwrap(),
        8 => symlink(outside.join("missing"), path).unwrap(),
        9 => symlink("/dev/zero", path).unwrap(),
        10 => assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
        _ => drop(UnixListener::bind(path).unwrap()),
    }
    if kind < 5 {
        let old = SystemTime::now() - Duration::from_secs(100_000_000);
        let file = File::options().append(true).open(path).unwrap();
        file.set_modified(old).unwrap();
    }
}

/// Describes a file or a folder, with its content.
fn seen(path: &Path) -> String {
    let data = fs::symlink_metadata(path).unwrap();
    let content = match data.file_type() {
        kind if kind.is_dir() => {
            let mut inside: Vec<String> = fs::read_dir(path)
                .unwrap()
                .map(|entry| seen(&entry.unwrap().path()))
                .collect();
            inside.sort();
            inside.insert(0, String::new());
            inside.join(", ")
        }
        kind if kind.is_symlink() => format!("{:?}", fs::read_link(path).unwrap()),
        kind if kind.is_fifo() || kind.is_socket() => String::new(),
        _ => fs::read_to_string(path).unwrap(),
    };
    let [mode, time, inode] = [u64::from(data.mode()), data.mtime() as u64, data.ino()];
    // Entries change the time of a folder.
    let time = if data.is_dir() { 0 } else { time };
    format!("{path:?} {mode:o} {time} {inode} {content}")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.collect()
}

/// Runs a program in a folder as programs do: from its checkpoint, with files of results.
fn run(folder: &Path) -> Result<(), Failure> {
    let job = Job::quiet(folder)?;
    let work = || {
        let mut checkpoint = Checkpoint::new(&job, 0.0);
        let reached = checkpoint.read::<u32>()?.unwrap_or(0);
        checkpoint.save(&(reached + 1))?;
        job.write("motion.csv", b"1,2\n")?;
        job.write("motion.svg", b"<svg/>\n")?;
        checkpoint.discard();
        Ok(())
    };
    let worked = work();
    let ended = match &worked {
        Ok(()) => Ended::Finished,
        Err(_) => Ended::Failed("in the way".to_owned()),
    };
    job.end(&ended)?;
    worked
}

/// Runs a shard of a sweep, or puts the shards together.
fn sweep(folder: &Path, shard: Option<u32>) -> Result<(), Failure> {
    let shard = shard.map(|index| Shard { index, count: 2 });
    let own = shard.map_or(folder.to_path_buf(), |shard| folder.join(shard.folder()));
    let job = Job::quiet(&own)?;
    let sharding = Sharding {
        shard,
        merge: shard.is_none().then_some(2),
    };
    let found = results(&job, sharding, 4, |items| Ok(items.to_vec()));
    let merged = found.and_then(|found| match found {
        Some(all) => job.write("motion.csv", format!("{all:?}\n").as_bytes()),
        None => Ok(()),
    });
    job.end(&Ended::Finished)?;
    merged
}

#[test]
fn foreign_files_stay_in_a_hundred_folders() {
    let outside = temporary("outside");
    fs::write(outside.join("thesis.tex"), "\\chapter{One}\n").unwrap();
    let mut refused = 0;
    for seed in 0..100 {
        let folder = temporary(&format!("foreign-{seed}"));
        let mut random = SplitMix64::seed_from_u64(seed);
        let mut below = |most: u64| random.next_u64() % most;
        for _ in 0..1 + below(5) {
            let path = folder.join(NAMES[below(NAMES.len() as u64) as usize]);
            if fs::symlink_metadata(&path).is_err() {
                install(&path, &outside, below(KINDS));
            }
        }
        let foreign = names(&folder);
        let all_seen = |folder: &Path| {
            let own = foreign.iter().map(|name| seen(&folder.join(name)));
            own.collect::<Vec<_>>()
        };
        let before = (all_seen(&folder), seen(&outside));
        // Twice: the second run replaces the files of the first one.
        let runs = [run(&folder), run(&folder)];
        for shard in [Some(0), Some(1), None] {
            refused += u32::from(sweep(&folder, shard).is_err());
        }
        // A shard may put its results next to foreign files in its folder.
        let after = all_seen(&folder).join(", ");
        let is_kept = |file: &str| after.contains(file);
        let mut foreign_files = before.0.iter().flat_map(|listed| listed.split(", "));
        assert!(foreign_files.all(is_kept), "{seed}: {before:?} {after}");
        assert_eq!(seen(&outside), before.1, "{seed}");
        assert_eq!(runs[0].is_ok(), runs[1].is_ok(), "{seed}: {runs:?}");
        refused += u32::from(runs[0].is_err());
        let is_taken = |name: &str| foreign.iter().any(|own| own == name);
        for name in names(&folder).iter().filter(|name| !is_taken(name)) {
            let expected = ["run.json", "motion.csv", "motion.svg", "sweep.json"];
            let is_shard = name.starts_with("shard-");
            // The run goes on from there when the way is free.
            let is_checkpoint = name == "checkpoint" && runs[0].is_err();
            assert!(
                is_shard || is_checkpoint || expected.contains(&name.as_str()),
                "{seed}: {name}"
            );
        }
        if runs[0].is_ok() {
            assert_eq!(fs::read(folder.join("motion.svg")).unwrap(), b"<svg/>\n");
        } else {
            let own = [
                ".running",
                "run.json",
                "checkpoint",
                "motion.csv",
                "motion.svg",
            ];
            assert!(own.into_iter().any(is_taken), "{seed}: {runs:?}");
        }
        fs::remove_dir_all(folder).unwrap();
    }
    fs::remove_dir_all(outside).unwrap();
    assert!((50..450).contains(&refused), "{refused}");
}

/// The thesis is a target of links of both kinds, under the name of the lock.
#[test]
fn a_lock_that_is_a_link_is_refused() {
    let folder = temporary("thesis");
    let thesis = folder.join("thesis.tex");
    for kind in [6, 7, 10, 0, 1] {
        fs::write(&thesis, "\\chapter{One}\n").unwrap();
        let results = folder.join("results");
        fs::create_dir(&results).unwrap();
        install(&results.join(".running"), &folder, kind);
        let refused = run(&results).unwrap_err();
        let Failure::File { path, source } = &refused else {
            panic!("{refused:?}");
        };
        assert!(path.ends_with(".running") && source.to_string().contains("help: move it away"));
        assert_eq!(fs::read_to_string(&thesis).unwrap(), "\\chapter{One}\n");
        assert_eq!(names(&results), [".running"]);
        fs::remove_dir_all(&results).unwrap();
    }
    fs::remove_dir_all(folder).unwrap();
}

/// A result that the user has changed is the user's.
#[test]
fn results_that_were_edited_are_not_replaced() {
    let folder = temporary("edited");
    for name in ["motion.csv", "motion.svg"] {
        run(&folder).unwrap();
        run(&folder).unwrap();
        fs::write(folder.join(name), "edited\n").unwrap();
        assert!(matches!(run(&folder), Err(Failure::File { path, .. }) if path.ends_with(name)));
        assert_eq!(fs::read_to_string(folder.join(name)).unwrap(), "edited\n");
        fs::remove_file(folder.join(name)).unwrap();
    }
    // Files of a folder whose record names no digests, as those of earlier versions.
    run(&folder).unwrap();
    let record = folder.join("run.json");
    let text = fs::read_to_string(&record).unwrap();
    let mut old: serde_json::Value = serde_json::from_str(&text).unwrap();
    old.as_object_mut().unwrap().remove("sha256").unwrap();
    fs::write(&record, old.to_string()).unwrap();
    run(&folder).unwrap();
    fs::remove_dir_all(folder).unwrap();
}
