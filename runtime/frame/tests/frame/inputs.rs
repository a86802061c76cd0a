//! A checkpoint, a shard and a record belong to one content of each file that was read.

use super::temporary;
use branched_pendulum_frame::sweep::{Shard, Sharding, results};
use branched_pendulum_frame::{Checkpoint, Ended, Failure, Input, Job};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use std::fs;
use std::path::Path;

/// Texts of a tree, of parameters and of a table.
fn texts() -> [(&'static str, String); 3] {
    let rows = (0..200).map(|row| format!("{row},{}\n", row * row));
    [
        (
            "tree.txt",
            "gravity = 9.81,\nstem: rod(mass = 0.12, length = 0.3) [\n    \
             arm: rod(mass = 0.1, length = l) * 2\n]\n"
                .to_owned(),
        ),
        ("p.json", "{\n  \"l\": 0.25\n}\n".to_owned()),
        ("film.csv", rows.collect()),
    ]
}

/// Changes one character of a line; returns the text and the number of the line.
fn edited(text: &str, random: &mut SplitMix64) -> (String, usize) {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    loop {
        let line = (random.next_u64() % lines.len() as u64) as usize;
        let own = &mut lines[line];
        let place = (random.next_u64() % (own.len() as u64 + 1)) as usize;
        let digit = char::from(b'0' + (random.next_u64() % 10) as u8);
        let before = own.clone();
        match own.is_char_boundary(place) && place < own.len() {
            true => own.replace_range(place..=place, &digit.to_string()),
            false => own.push(digit),
        }
        if *own != before {
            return (lines.join("\n") + "\n", line + 1);
        }
    }
}

fn job(folder: &Path, texts: &[(&str, String)]) -> Job {
    let job = Job::quiet(folder).unwrap();
    for (name, text) in texts {
        job.input(Input::of_text(name, text)).unwrap();
    }
    job
}

fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}

/// Fifty runs that are killed, of which one file is edited before they go on.
#[test]
fn an_edited_file_stops_a_killed_run_from_going_on() {
    let mut random = SplitMix64::seed_from_u64(48);
    for pair in 0..50 {
        let [folder, killed] =
            ["running", "killed"].map(|name| temporary(&format!("{name}-{pair}")));
        let mut texts = texts();
        let first = job(&folder, &texts);
        Checkpoint::new(&first, 0.0).save(&pair).unwrap();
        // What a kill leaves, while the run holds its folder.
        copy(&folder, &killed);
        drop(first);
        let own = &mut texts[pair % 3];
        let before = own.1.clone();
        let (after, line) = edited(&own.1, &mut random);
        own.1 = after;
        let name = own.0;
        let resumed = job(&killed, &texts);
        let refused = Checkpoint::new(&resumed, 0.0).read::<usize>();
        let Err(Failure::Sealed { source, .. }) = refused else {
            panic!("{refused:?}");
        };
        let reported = source.to_string();
        let expected = format!("`{name}` has changed: line {line} was ");
        assert!(reported.contains(&expected), "{reported}; {expected}");
        drop(resumed);
        texts[pair % 3].1 = before;
        let resumed = job(&killed, &texts);
        let read = Checkpoint::new(&resumed, 0.0).read::<usize>().unwrap();
        assert_eq!(read, Some(pair));
        drop(resumed);
        for folder in [folder, killed] {
            fs::remove_dir_all(folder).unwrap();
        }
    }
}

fn sweep(folder: &Path, shard: Option<u32>, texts: &[(&str, String)]) -> Result<(), Failure> {
    let shard = shard.map(|index| Shard { index, count: 3 });
    let own = shard.map_or(folder.to_path_buf(), |shard| folder.join(shard.folder()));
    let job = job(&own, texts);
    let sharding = Sharding {
        shard,
        merge: shard.is_none().then_some(3),
    };
    let found = results(&job, sharding, 7, |items| Ok(items.to_vec()));
    job.end(&Ended::Finished).unwrap();
    found.map(|_| ())
}

#[test]
fn shards_of_other_input_are_not_put_together() {
    let mut random = SplitMix64::seed_from_u64(7);
    for case in 0..12 {
        let folder = temporary(&format!("sweep-{case}"));
        let before = texts();
        let mut after = texts();
        let own = &mut after[case % 3];
        let (text, line) = edited(&own.1, &mut random);
        own.1 = text;
        let expected = format!("`{}` has changed: line {line} was ", own.0);
        sweep(&folder, Some(0), &before).unwrap();
        for shard in [Some(1), Some(0), None] {
            let Err(Failure::Sweep(error)) = sweep(&folder, shard, &after) else {
                panic!("a shard of other input was taken");
            };
            assert!(error.to_string().contains(&expected), "{error}");
        }
        for shard in [Some(1), Some(2), None] {
            sweep(&folder, shard, &before).unwrap();
        }
        fs::remove_dir_all(folder).unwrap();
    }
}

/// Shards that begin while others are put together keep their files.
#[test]
fn putting_together_takes_nothing_from_shards_that_begin() {
    let texts = texts();
    for case in 0..40 {
        let folder = temporary(&format!("beginning-{case}"));
        std::thread::scope(|scope| {
            for shard in 0..3 {
                let (folder, texts) = (&folder, &texts);
                scope.spawn(move || sweep(folder, Some(shard), texts).unwrap());
            }
            for _ in 0..4 {
                let merged = sweep(&folder, None, &texts);
                assert!(
                    matches!(merged, Err(Failure::Sweep(_)) | Ok(())),
                    "{merged:?}"
                );
            }
        });
        sweep(&folder, None, &texts).unwrap();
        fs::remove_dir_all(folder).unwrap();
    }
}

#[test]
fn a_repeated_run_refuses_other_input() {
    for changed in 0..3 {
        let folder = temporary(&format!("repeated-{changed}"));
        let texts = texts();
        let recorded: Vec<Input> = texts
            .iter()
            .map(|(name, text)| Input::of_text(name, text))
            .collect();
        let job = Job::quiet(&folder).unwrap().with_recorded(recorded);
        for (place, (name, text)) in texts.iter().enumerate() {
            let now = match place == changed {
                true => format!("{text}more\n"),
                false => text.clone(),
            };
            let noted = job.input(Input::of_text(name, &now));
            assert_eq!(noted.is_err(), place == changed);
            if let Err(failure) = noted {
                let reported = failure.to_string();
                let lines = text.lines().count() + 1;
                assert!(
                    reported.contains(&format!("`{name}` has changed: line {lines} ")),
                    "{reported}"
                );
                assert!(reported.contains("help: "), "{reported}");
            }
        }
        drop(job);
        fs::remove_dir_all(folder).unwrap();
    }
}
