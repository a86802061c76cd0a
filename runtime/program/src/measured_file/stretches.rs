//! Parts of a record between gaps that are too long to integrate the motion across them.

use std::ops::Range;
use std::path::Path;

use branched_pendulum_data::{Basis, Finding, Recording, Timing};

use crate::Failure;

/// Smallest number of rows with angles of all links in a part between long gaps.
const FEWEST: usize = 16;

/// Removes parts that long gaps separate from the rest and that are too short for a motion.
pub(crate) fn leave_fragments_out(recording: &mut Recording) {
    let stretches = Timing::stretches(&recording.times);
    if stretches.len() < 2 {
        return;
    }
    let is_whole = |row: &usize| {
        let mut links = recording.links.iter();
        links.all(|link| link.angle(*row).is_some())
    };
    let is_long = |rows: &Range<usize>| rows.clone().filter(is_whole).count() >= FEWEST;
    let (long, short): (Vec<_>, Vec<_>) = stretches.into_iter().partition(is_long);
    let mut reported = Vec::new();
    if long.len() > 1 {
        reported.push(Finding {
            basis: Basis::Detected,
            text: format!(
                "{} stretches between long gaps ({}): each is a motion by itself; --from and --to \
                 take one of them",
                long.len(),
                named(recording, &long)
            ),
        });
    }
    if !long.is_empty() && !short.is_empty() {
        let rows: usize = short.iter().map(Range::len).sum();
        reported.push(Finding {
            basis: Basis::Doubtful,
            text: format!(
                "rows that long gaps separate from the rest are left out, {rows} of them ({})",
                named(recording, &short)
            ),
        });
        keep(recording, &long);
    }
    recording.findings.extend(reported);
    recording
        .findings
        .sort_by_key(|finding| finding.basis != Basis::Doubtful);
}

/// Keeps, of the parts between long gaps, the one with the most rows.
pub(crate) fn keep_longest(recording: &mut Recording) {
    let stretches = Timing::stretches(&recording.times);
    let longest = stretches.iter().max_by_key(|rows| rows.len()).cloned();
    let Some(longest) = longest.filter(|_| stretches.len() > 1) else {
        return;
    };
    let others: Vec<Range<usize>> = stretches
        .into_iter()
        .filter(|own| *own != longest)
        .collect();
    let text = format!(
        "of several stretches between long gaps the longest is taken ({}); --from and --to take \
         another ({})",
        named(recording, std::slice::from_ref(&longest)),
        named(recording, &others)
    );
    let basis = Basis::Assumed;
    recording.findings.push(Finding { basis, text });
    keep(recording, &[longest]);
}

/// Returns the first and last times of the given parts, for messages.
fn named(recording: &Recording, all: &[Range<usize>]) -> String {
    const NAMED: usize = 4;
    let each = all.iter().map(|rows| {
        let [from, to] = [recording.times[rows.start], recording.times[rows.end - 1]];
        format!("{from} s to {to} s")
    });
    let more = all.len().saturating_sub(NAMED);
    let more = (more > 0).then(|| format!("{more} more"));
    each.take(NAMED).chain(more).collect::<Vec<_>>().join(", ")
}

/// Keeps some stretches of rows.
fn keep(recording: &mut Recording, stretches: &[Range<usize>]) {
    let is_kept = |row: usize| stretches.iter().any(|rows| rows.contains(&row));
    let kept: Vec<bool> = (0..recording.times.len()).map(is_kept).collect();
    retain(&mut recording.times, &kept);
    for link in &mut recording.links {
        retain(&mut link.samples, &kept);
    }
}

fn retain<T>(all: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    all.retain(|_| kept.next() == Some(&true));
}

/// Approximate number of bytes that smoothing needs per angle.
const BYTES: usize = 1500;

/// Checks that the smoothed motion of a record fits into memory.
///
/// # Errors
/// [`Failure::Lacking`] with the number of rows.
pub(crate) fn check_memory(path: &Path, recording: &Recording) -> Result<(), Failure> {
    let rows = recording.times.len();
    let needed = rows
        .saturating_mul(recording.links.len())
        .saturating_mul(BYTES);
    let mut memory: Vec<u8> = Vec::new();
    memory.try_reserve_exact(needed).map_err(|_| Failure::Lacking {
        what: format!(
            "{}: the motion of {rows} rows needs some {:.1} GB, more memory than there is: take a \
             part of it by --from and --to, or write fewer rows",
            path.display(),
            needed as f64 / 1e9
        ),
    })
}
