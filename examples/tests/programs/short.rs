//! The short programs, run to their ends: what they print is right.

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;

use super::{run, text};

/// Runs a short program and returns what it prints.
fn printed(program: &str) -> String {
    let output = run(program, &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    text(&output.stdout).to_owned()
}

/// The number in front of `unit`, or behind a word where that ends with a space.
fn number(line: &str, before: &str) -> f64 {
    let words: Vec<&str> = line.split_whitespace().collect();
    let place = words.iter().position(|word| *word == before).unwrap();
    words[place - 1].parse().unwrap()
}

/// The number at the end of a line.
fn last(line: &str) -> f64 {
    line.split_whitespace().last().unwrap().parse().unwrap()
}

#[test]
fn first_motion_keeps_the_energy() {
    let text = printed(env!("CARGO_BIN_EXE_first-motion"));
    assert_eq!(text.lines().count(), 12);
    let kept = last(text.lines().last().unwrap());
    assert!(kept > 0.0 && kept < 1e-10, "{text}");
}

#[test]
fn transfer_forms_close_the_budget_or_do_not() {
    let text = printed(env!("CARGO_BIN_EXE_transfer-forms"));
    let excess: Vec<f64> = text
        .lines()
        .skip(1)
        .map(|line| number(line, "of"))
        .collect();
    let [exact, published, second, fourth] = excess[..] else {
        panic!("{text}");
    };
    assert!(exact.abs() < 1e-3, "{text}");
    assert!(published.abs() > 0.1, "{text}");
    assert!(second.abs() < 0.5 && fourth.abs() < second.abs(), "{text}");
}

#[test]
fn own_torque_leans_with_the_wind() {
    let text = printed(env!("CARGO_BIN_EXE_own-torque"));
    let angle = |line: &str| -> f64 {
        let word = line.split_whitespace().last().unwrap();
        word.trim_end_matches('°').parse().unwrap()
    };
    let angles: Vec<f64> = text.lines().map(angle).collect();
    assert_eq!((angles.len(), angles[0]), (11, 0.0));
    assert!(angles[5..].iter().all(|angle| *angle > 1.0), "{text}");
}

#[test]
fn falling_friction_feeds_the_swing_of_froudes_pendulum() {
    let text = printed(env!("CARGO_BIN_EXE_froude"));
    let rows = text.lines().skip(1).map(|line| {
        let words = line.split_whitespace().filter(|word| *word != "%");
        let numbers = words.map(|word| word.parse().unwrap());
        numbers.collect::<Vec<f64>>()
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    let [coulomb, weak, strong] = &rows[..] else {
        panic!("{text}");
    };
    assert!(coulomb[3] < 0.9 * coulomb[1] && coulomb[4] == 0.0, "{text}");
    for row in [weak, strong] {
        assert!(row[3] > 5.0 * coulomb[1] && row[4] > 5.0, "{text}");
    }
}

#[test]
fn events_end_the_run_where_the_rod_turns_over() {
    let text = printed(env!("CARGO_BIN_EXE_events"));
    let times: Vec<f64> = text
        .lines()
        .filter(|line| line.contains(" s  "))
        .map(|line| number(line, "s"))
        .collect();
    assert!(times.is_sorted() && !times.is_empty(), "{text}");
    let end = number(text.lines().last().unwrap(), "s");
    assert!(
        end < 60.0 && (end - times[times.len() - 1]).abs() < 1e-5,
        "{text}"
    );
    assert!(text.contains("it turns over"), "{text}");
}

#[test]
fn many_starts_part_where_the_motion_is_chaotic() {
    let text = printed(env!("CARGO_BIN_EXE_many-starts"));
    let apart = |line: &str| -> f64 {
        let words: Vec<&str> = line.split_whitespace().collect();
        words[words.len() - 4]
            .trim_end_matches('°')
            .parse()
            .unwrap()
    };
    let apart: Vec<f64> = text.lines().map(apart).collect();
    assert_eq!(apart.len(), 8);
    assert!(apart[0] < 2.0 && apart[7] > 20.0, "{text}");
}

#[test]
fn any_time_is_as_accurate_as_a_step() {
    let text = printed(env!("CARGO_BIN_EXE_any-time"));
    assert!(last(text.lines().next().unwrap()) < 1e-8, "{text}");
    assert!(text.lines().last().unwrap().contains("10.1"), "{text}");
}

#[test]
fn modes_have_the_frequencies_of_the_paper() {
    let text = printed(env!("CARGO_BIN_EXE_modes"));
    let frequencies: Vec<&str> = text.lines().map(|line| &line[..9]).collect();
    assert_eq!(frequencies, ["0.8731696", "1.2580584", "1.5825567"]);
}

#[test]
fn taylor_series_keep_the_energy_better_the_finer_they_are() {
    let text = printed(env!("CARGO_BIN_EXE_taylor"));
    let kept: Vec<f64> = text.lines().map(last).collect();
    assert_eq!(kept.len(), 3);
    assert!(
        kept[0] > kept[1] && kept[1] < 1e-9 && kept[2] < 1e-11,
        "{text}"
    );
}

#[test]
fn scales_have_all_the_energy() {
    let text = printed(env!("CARGO_BIN_EXE_scales"));
    let shares: Vec<f64> = text.lines().skip(1).map(last).collect();
    assert_eq!(shares.len(), 11);
    assert!(
        shares.iter().all(|share| (share - 1.0).abs() < 1e-11),
        "{text}"
    );
}

#[test]
fn more_friction_leaves_less_energy() {
    let text = printed(env!("CARGO_BIN_EXE_swept-parameter"));
    let left: Vec<f64> = text.lines().map(|line| number(line, "%")).collect();
    assert_eq!((left.len(), left[0]), (5, 100.0));
    assert!(left.windows(2).all(|pair| pair[0] > pair[1]), "{text}");
}

#[test]
fn branches_damp_the_trunk_best_at_twice_its_frequency() {
    let text = printed(env!("CARGO_BIN_EXE_damping-by-branching"));
    let rows = text.lines().skip(3).map(|line| {
        let words = line.split_whitespace().filter(|word| *word != "%");
        words
            .map(|word| word.parse().unwrap())
            .collect::<Vec<f64>>()
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    assert_eq!(rows.len(), 5, "{text}");
    for row in &rows {
        // By small motions nothing is lost: the part that is grows with the amplitude.
        assert!(
            row[3..].is_sorted_by(|less, more| 1.5 * less < *more || *more > 40.0),
            "{text}"
        );
        assert!(row[2] > 1.5 && row[3] < 6.0, "{text}");
    }
    let best = rows.iter().max_by(|a, b| a[3].total_cmp(&b[3])).unwrap();
    assert!((best[2] - 2.0).abs() < 0.1 && best[6] > 50.0, "{text}");
}

#[test]
fn guys_hold_the_mast_and_keep_the_energy() {
    let text = printed(env!("CARGO_BIN_EXE_guys-and-magnets"));
    let rows: Vec<&str> = text.lines().filter(|line| line.contains(" s: ")).collect();
    let (held, free) = rows.split_at(rows.len() / 2);
    let mast = |line: &str| -> f64 {
        let mut words = line.split_whitespace();
        words.nth(2).unwrap().parse().unwrap()
    };
    assert_eq!((held.len(), free.len()), (11, 11), "{text}");
    assert!(held.iter().all(|line| mast(line).abs() < 10.0), "{text}");
    assert!(mast(free[10]).abs() > 90.0, "{text}");
    for rows in [held, free] {
        assert!(
            rows.iter()
                .all(|line| (last(line) - last(rows[0])).abs() < 1e-6),
            "{text}"
        );
    }
}

/// E(10 s) by the friction's power along another method's motion of the same rod.
#[test]
fn a_committed_expansion_is_the_scene() {
    let text = printed(env!("CARGO_BIN_EXE_committed"));
    let left = number(&text, "%");
    let (inertia, moment) = (4e-3 + 0.2 * 0.25 * 0.25, 9.80665 * 0.2 * 0.25);
    let rod = OdeFn::new(2, |_: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = -(moment * y[0].sin() + 1e-4 * y[1]) / inertia;
    });
    let energy = |y: &[f64]| 0.5 * inertia * y[1] * y[1] + moment * (1.0 - y[0].cos());
    let start = State::at_rest(0.0, &[1.0]);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let end = method.run(&rod, &start, 10.0).unwrap();
    let expected = 100.0 * energy(&end.state.values) / energy(&start.values);
    assert!((left - expected).abs() < 1e-4, "{text} {expected}");
}
