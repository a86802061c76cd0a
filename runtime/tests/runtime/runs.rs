//! Springs in runs of the same constants are the same springs one by one.

use branched_pendulum::spring_dampers::{SpringDamper, SpringDampers};
use branched_pendulum::translational::{
    LineArm, LinePotential, TranslationalSpringDamper, TranslationalSpringDampers,
};

const LINKS: usize = 9;

fn line(links: &[usize], rest: Option<f64>) -> TranslationalSpringDamper<f64> {
    let arm = |(place, &link): (usize, &usize)| LineArm {
        link,
        along: 0.3 + 0.1 * place as f64,
        lateral: -0.05 * place as f64,
    };
    TranslationalSpringDamper {
        arms: links.iter().enumerate().map(arm).collect(),
        offset: [0.7, 0.1],
        potentials: vec![LinePotential::Spring {
            stiffness: 2.0,
            rest,
        }],
        friction: Some(0.3),
    }
}

#[test]
fn runs_of_lines_are_the_lines_one_by_one() {
    for (links, count) in [(vec![2], 4), (vec![0, 3], 6), (vec![4, 1, 2], 5)] {
        let first = line(&links, Some(0.2));
        let others = (0..count).map(|place| {
            let links: Vec<usize> = links.iter().map(|link| link + place).collect();
            line(&links, Some(0.2))
        });
        let others: Vec<_> = std::iter::once(line(&[1], None)).chain(others).collect();
        let runs = [(line(&[1], None), 1), (first, count)];
        let runs = TranslationalSpringDampers::of_runs(LINKS, runs).unwrap();
        assert_eq!(runs.iter().collect::<Vec<_>>(), others);
        let one_by_one = TranslationalSpringDampers::new(LINKS, others).unwrap();
        let theta: Vec<f64> = (0..LINKS).map(|link| (link as f64).sin()).collect();
        let omega: Vec<f64> = (0..LINKS).map(|link| (3.0 * link as f64).cos()).collect();
        let torques = |all: &TranslationalSpringDampers<f64>| {
            let mut torques = vec![0.0; LINKS];
            all.add_torques([&theta, &omega], &mut torques);
            torques
        };
        assert_eq!(torques(&runs), torques(&one_by_one));
        assert_eq!(runs.energy(&theta), one_by_one.energy(&theta));
    }
}

#[test]
fn runs_of_torsion_springs_are_the_springs_one_by_one() {
    for (links, count) in [([0, 4], 4), ([5, 2], 3), ([3, 0], 3)] {
        let spring = |links: [usize; 2]| SpringDamper {
            links,
            spring: 2.0,
            rest: 0.1,
            friction: 0.3,
            law: None,
        };
        let others: Vec<_> = (0..count)
            .map(|place| spring(links.map(|own| own + place)))
            .collect();
        let runs = SpringDampers::of_runs(LINKS, [(spring(links), count)]).unwrap();
        assert_eq!(runs.iter().collect::<Vec<_>>(), others);
    }
}
