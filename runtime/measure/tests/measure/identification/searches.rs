//! Searches from 30 % off over records of any length and motion: what is found is right, or is
//! refused.

use branched_pendulum_measure::identification::{
    AngleRecord, FamilyOf, Fit, Identification, IdentificationError, SearchFailure, Standing,
    Unfound,
};

use super::chain::{Chain, Uniform, all_unknown, five_unknown, simulated, truth};

/// A record and a start of a search.
struct Trial {
    record: AngleRecord,
    task: Identification<FamilyOf<Chain>>,
    words: String,
}

/// Records of 2 to `longest` s from any release, every second one without a parameter known.
fn trial(number: u64, longest: f64, rate: f64) -> Trial {
    let mut random = Uniform((number + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mut uniform = || random.next();
    (0..4).for_each(|_| _ = uniform());
    let span = 2.0 * (longest / 2.0).powf(0.5 * (1.0 + uniform()));
    let start = [2.5 * uniform(), 2.5 * uniform()];
    let off = |value: f64| value * (1.0 + 0.3 * uniform());
    let task = match number % 2 {
        0 => five_unknown(off),
        _ => all_unknown(FamilyOf::new(), off),
    };
    Trial {
        record: simulated(start, span, rate, 1e-3, number + 1),
        task: task.with_offsets(),
        words: format!(
            "{number:>2} {span:>5.1} s from {:>5.2} {:>5.2}",
            start[0], start[1]
        ),
    }
}

/// The largest error, in deviations, of what a fit says is determined.
fn worst(fit: &Fit) -> f64 {
    let own = fit.estimates.iter().chain(&fit.ratios);
    let own = own.filter(|estimate| estimate.standing == Standing::Determined);
    let errors = own.map(|own| (own.value - truth(&own.name)).abs() / own.deviation().unwrap());
    errors.fold(0.0, f64::max)
}

fn unfound(error: IdentificationError) -> Unfound {
    match error {
        IdentificationError::NotFound(unfound) => *unfound,
        error => panic!("{error}"),
    }
}

/// Fits all, prints a line for each and returns how many one motion was found for, how many
/// segments, and how many nothing.
fn searched(numbers: impl Iterator<Item = u64>, longest: f64, rate: f64) -> [usize; 3] {
    let mut counts = [0; 3];
    for number in numbers {
        let Trial {
            record,
            task,
            words,
        } = trial(number, longest, rate);
        let (fit, kind) = match task.fit(&record).map_err(unfound) {
            Ok(fit) => (Ok(fit), 0),
            Err(unfound) if matches!(unfound.failure, SearchFailure::Lost { .. }) => {
                (task.fit_in_segments(&record).map_err(self::unfound), 1)
            }
            Err(unfound) => (Err(unfound), 2),
        };
        match &fit {
            Ok(fit) => {
                let last = fit.stages.last().unwrap();
                println!(
                    "{words}: segments of {} s, {}, {} stages, worst {:.2}",
                    last.length,
                    fit.convergence,
                    fit.stages.len(),
                    worst(fit)
                );
                assert!(worst(fit) < 4.0, "{words} {:#?}", fit.estimates);
                counts[kind] += 1;
            }
            Err(unfound) => {
                println!("{words}: {unfound}");
                let own = unfound.best.estimates.iter().chain(&unfound.best.ratios);
                assert!(own.clone().all(|own| own.naive.or(own.by_blocks).is_none()));
                counts[2] += 1;
            }
        }
    }
    counts
}

#[test]
fn what_is_found_is_right_or_is_refused() {
    let [motions, segments, none] = searched(0..12, 10.0, 50.0);
    assert!(none == 0 && segments <= 2, "{motions} {segments} {none}");
}

/// Some minutes: `cargo test --release -p branched-pendulum-measure --test measure -- --ignored --nocapture forty`.
#[test]
#[ignore = "some minutes"]
fn what_is_found_of_forty_records_is_right_or_is_refused() {
    let [motions, segments, none] = searched(0..40, 60.0, 100.0);
    println!("one motion {motions}, segments {segments}, nothing {none}");
    assert!(none <= 1, "{motions} {segments} {none}");
}
