//! Records in which nothing, or not all, can be found.

use branched_pendulum::prelude::*;
use branched_pendulum_measure::identification::{
    AngleRecord, Family, FamilyOf, Identification, IdentificationError, SearchFailure, Standing,
    Unfound,
};

use super::chain::{Chain, GRAVITY, LAWS, REAL, Rubbing, Uniform, all_unknown, simulated};

fn unfound(error: IdentificationError) -> Unfound {
    match error {
        IdentificationError::NotFound(unfound) => *unfound,
        error => panic!("{error}"),
    }
}

/// A record that is held for so many samples before another one begins.
fn held(record: &AngleRecord, samples: usize, noise: f64) -> AngleRecord {
    let interval = record.times()[1];
    let count = samples + record.times().len();
    let times: Vec<f64> = (0..count).map(|index| index as f64 * interval).collect();
    let mut random = Uniform(12345);
    let all = AngleRecord::new(&times);
    ["upper", "lower"].iter().fold(all, |all, name| {
        let angles = record.angles(name).unwrap();
        let rest = (0..samples).map(|_| Some(angles[0]? + noise * random.normal()));
        let angles: Vec<Option<f64>> = rest.chain(angles.iter().copied()).collect();
        all.with_link(name, &angles, 1e-3)
    })
}

#[test]
fn a_release_is_found_where_there_is_one() {
    for (start, noise) in [([0.8, -0.5], 1e-3), ([-1.2, 0.1], 3e-3), ([2.0, 2.0], 0.0)] {
        let free = simulated(start, 3.0, 100.0, noise, 4);
        assert_eq!(free.release(), None, "{start:?}");
        // Nor one of a motion under way.
        assert_eq!(free.between(1.0, 3.0).release(), None, "{start:?}");
        for samples in [30, 100, 200] {
            let release = held(&free, samples, noise).release().unwrap();
            let late = release - samples as f64 / 100.0;
            assert!((-0.005..0.12).contains(&late), "{start:?} {samples} {late}");
        }
    }
    let rest = AngleRecord::new(&[0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
    assert_eq!(
        rest.with_link("upper", &[Some(0.2); 8], 1e-3).release(),
        None
    );
}

#[test]
fn a_record_that_begins_held_names_its_release() {
    let record = held(&simulated([0.8, -0.5], 3.0, 100.0, 1e-3, 4), 200, 1e-3);
    let task = all_unknown(FamilyOf::<Chain>::new(), |value| 1.2 * value);
    let unfound = unfound(task.fit(&record).unwrap_err());
    let release = unfound.release.unwrap();
    assert!((1.99..2.1).contains(&release), "{release}");
    assert!(unfound.to_string().contains("held until"), "{unfound}");
    let fit = task.fit(&record.between(release, 9.0)).unwrap();
    let joint = fit.determined("joint_1").unwrap();
    let off = (joint.value - 0.172719204).abs() / joint.by_blocks.unwrap();
    assert!(off < 4.0, "{joint:?}");
}

#[test]
fn a_tree_that_is_another_one_is_a_failure() {
    for factor in [0.5, 1.5, 3.0] {
        let record = simulated([0.8, -0.5], 4.0, 50.0, 1e-3, 7);
        let task = Identification::new(FamilyOf::<Chain>::new()).known("gravity", GRAVITY);
        let task = REAL.iter().fold(task, |task, &(name, value)| match name {
            "viscous_1" | "viscous_2" => task.unknown(name, value),
            "com_1" | "com_2" => task.known(name, factor * value),
            _ => task.known(name, value),
        });
        let unfound = unfound(task.fit(&record).unwrap_err());
        assert!(
            matches!(
                unfound.failure,
                SearchFailure::Astray | SearchFailure::Lost { .. }
            ),
            "{unfound}"
        );
        let own = unfound.best.estimates.iter();
        assert!(own.clone().count() > 0);
        own.for_each(|own| assert_eq!((own.naive, own.by_blocks), (None, None)));
    }
}

/// Two seconds of a chain with these values in place of the usual ones, and no laws else.
fn rubbing(start: [f64; 2], others: &[(&str, f64)], noise: f64, seed: u64) -> AngleRecord {
    let value = |name: &String| {
        let mut all = others.iter().chain(&REAL);
        let own = all.find(|(own, _)| own == name).map(|(_, value)| *value);
        own.unwrap_or(if name == "gravity" { GRAVITY } else { 0.0 })
    };
    let values: Vec<f64> = Rubbing.parameters().iter().map(value).collect();
    let times: Vec<f64> = (0..=200)
        .map(|picture| f64::from(picture) / 100.0)
        .collect();
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let start = State::at_rest(0.0, &start);
    let equations = Rubbing.equations(&values);
    let motion = method.sample_to_vec(&equations, &start, &times).unwrap();
    let mut random = Uniform(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let links = ["upper", "lower"].iter().enumerate();
    links.fold(AngleRecord::new(&times), |all, (link, name)| {
        let angle = |state: &State<f64>| Some(state.values[link] + noise * random.normal());
        all.with_link(name, &motion.iter().map(angle).collect::<Vec<_>>(), 1e-3)
    })
}

/// Parameters from 30 % off, and viscous friction alone.
fn viscous(random: &mut Uniform) -> Identification<Rubbing> {
    let task = all_unknown(Rubbing, |value| value * (1.0 + 0.3 * random.next()));
    let task = LAWS.iter().fold(task, |task, law| task.known(law, 0.0));
    task.with_offsets()
}

#[test]
fn friction_stays_above_its_bound() {
    // Joints that drive, as those seem to do that have another law.
    let cases: [&[(&str, f64)]; 4] = [
        &[("viscous_2", -1e-4)],
        &[("viscous_1", -2e-4), ("viscous_2", 1e-4)],
        &[("viscous_1", -1e-3), ("viscous_2", -1e-3)],
        &[("viscous_2", 1e-4)],
    ];
    for (number, others) in cases.into_iter().enumerate() {
        let record = rubbing([0.8, -0.5], others, 1e-3, number as u64 + 1);
        let task = viscous(&mut Uniform(5));
        let free = task.fit(&record).unwrap();
        let task = task.at_least("viscous_1", 0.0).at_least("viscous_2", 0.0);
        let (fit, stands) = match task.fit(&record) {
            Ok(fit) => (fit, true),
            Err(error) => (unfound(error).best, false),
        };
        for name in ["viscous_1", "viscous_2"] {
            let own = fit.estimates.iter().find(|own| own.name == name).unwrap();
            let drives = others
                .iter()
                .any(|(own, value)| *own == name && *value < 0.0);
            let is_below = free.value(name).unwrap() < 0.0;
            assert_eq!(is_below, drives, "{:?}", free.estimates);
            // The other one may have to make up for it.
            assert!(!drives || own.value == 0.0, "{own:?}");
            assert!(own.value >= 0.0, "{own:?}");
            assert_eq!(
                own.value == 0.0,
                own.standing == Standing::AtBound,
                "{own:?}"
            );
        }
        // A search that is refused may have left an inertia behind that nothing has.
        let impossible = fit.impossible.as_ref();
        assert!(
            impossible.is_none_or(|own| !stands && !own.what.contains("friction")),
            "{impossible:?} {:?}",
            fit.estimates
        );
        assert!(
            fit.rms() >= 0.999 * free.rms(),
            "{} {}",
            fit.rms(),
            free.rms()
        );
        assert!(stands || fit.rms() > 1.5e-3, "{}", fit.rms());
    }
    let record = simulated([0.8, -0.5], 3.0, 50.0, 1e-3, 1);
    let below = all_unknown(FamilyOf::<Chain>::new(), |value| value).at_least("viscous_1", 1.0);
    let text = below.fit(&record).unwrap_err().to_string();
    assert!(
        text.starts_with("start of `viscous_1`, which is at least 1, is 0.000"),
        "{text}"
    );
}

#[test]
fn two_seconds_are_found_from_every_start() {
    // More friction than the law of the fit has: beyond the horizontal, a turn, and calmer.
    let laws = LAWS.into_iter().zip([2e-3, 5e-4, 1e-4, 1e-4]);
    let laws: Vec<(&str, f64)> = laws.collect();
    for (number, start) in [[1.9, 2.4], [-2.2, -1.0], [1.4, -0.9]]
        .into_iter()
        .enumerate()
    {
        let record = rubbing(start, &laws, 4e-4, number as u64 + 1);
        let mut random = Uniform(99 + number as u64);
        let rms = |_| viscous(&mut random).fit(&record).unwrap().rms();
        let all: Vec<f64> = (0..6).map(rms).collect();
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(
            all.iter().all(|rms| *rms < 1.02 * least),
            "{start:?} {all:?}"
        );
    }
}
