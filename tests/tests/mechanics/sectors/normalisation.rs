//! Plain and orthonormal coordinates of the same state.

use branched_pendulum::sectors::Normalisation::{self, Orthonormal, Plain};
use branched_pendulum::sectors::{Sector, SectorCoordinate};
use branched_pendulum::{Sectors, SymmetricPendulum, branched_pendulum};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::nested::Nested;

/// Three arms with two hands each, and a tail.
#[branched_pendulum(
    gravity = 9.80665,
    body: rod(mass = 0.4, length = 0.3) [
        arm: rod(mass = 0.2, length = 0.2) [hand: rod(mass = 0.1, length = 0.1) * 2] * 3,
        tail: rod(mass = 0.1, length = 0.2)
    ],
    emit(energies, momenta, symmetric, budget(parseval)),
)]
struct Creature;

const BOTH: [Normalisation; 2] = [Plain, Orthonormal];

fn close(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 4e-15)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn sectors_list_the_coordinates_in_their_order() {
    fn listed<M: Sectors + SymmetricPendulum<f64>>(model: &M) {
        let listed = model.sectors().iter().flat_map(Sector::coordinates);
        let names: Vec<&str> = listed.map(SectorCoordinate::name).collect();
        assert_eq!(names, M::COORDINATE_NAMES);
    }
    listed(&Creature::new());
    listed(&Nested::<f64>::new());
}

#[test]
fn plain_coordinates_and_momenta_are_the_emitted_ones() {
    let model = Creature::new();
    let mut random = Random::new(3);
    for _ in 0..20 {
        let (theta, omega): ([f64; 11], [f64; 11]) =
            (random.array(-3.0, 3.0), random.array(-3.0, 3.0));
        let (mut q, mut rates, mut p) = ([0.0; 11], [0.0; 11], [0.0; 11]);
        model.symmetric_from_absolute(Plain, &theta, &mut q);
        model.symmetric_from_absolute(Plain, &omega, &mut rates);
        assert!(close(&q, &model.to_symmetric(&theta)));
        let momenta = model.momenta(&theta, &omega);
        model.symmetric_momenta_from_absolute(Plain, &momenta, &mut p);
        assert!(close(&p, &model.symmetric_momenta(&q, &rates)));
        let mut absolute = [0.0; 11];
        model.absolute_from_symmetric(Plain, &q, &mut absolute);
        assert!(close(&absolute, &model.from_symmetric(&q)));
    }
}

/// Back where one came from, for both kinds and normalisations; p · q' does not
/// depend on the coordinates.
#[test]
fn round_trips_and_invariance() {
    let model = Creature::new();
    let mut random = Random::new(4);
    for normalisation in BOTH {
        let (omega, momenta): ([f64; 11], [f64; 11]) =
            (random.array(-3.0, 3.0), random.array(-3.0, 3.0));
        let (mut rates, mut p, mut back) = ([0.0; 11], [0.0; 11], [0.0; 11]);
        model.symmetric_from_absolute(normalisation, &omega, &mut rates);
        model.symmetric_momenta_from_absolute(normalisation, &momenta, &mut p);
        assert!((dot(&p, &rates) - dot(&momenta, &omega)).abs() < 1e-13);
        model.absolute_from_symmetric(normalisation, &rates, &mut back);
        assert!(close(&back, &omega));
        model.absolute_momenta_from_symmetric(normalisation, &p, &mut back);
        assert!(close(&back, &momenta));
        for other in BOTH {
            let (mut values, mut expected) = (rates, [0.0; 11]);
            model.renormalise(normalisation, other, &mut values);
            model.symmetric_from_absolute(other, &omega, &mut expected);
            assert!(close(&values, &expected));
            let (mut values, mut expected) = (p, [0.0; 11]);
            model.renormalise_momenta(normalisation, other, &mut values);
            model.symmetric_momenta_from_absolute(other, &momenta, &mut expected);
            assert!(close(&values, &expected));
        }
    }
}

/// The matrix of the orthonormal transform is orthogonal, and is its own
/// contragredient.
#[test]
fn the_orthonormal_transform_is_a_rotation() {
    let model = Creature::new();
    let column = |link: usize| {
        let (mut unit, mut x, mut p) = ([0.0; 11], [0.0; 11], [0.0; 11]);
        unit[link] = 1.0;
        model.symmetric_from_absolute(Orthonormal, &unit, &mut x);
        model.symmetric_momenta_from_absolute(Orthonormal, &unit, &mut p);
        assert_eq!(x, p);
        x
    };
    for a in 0..11 {
        for b in 0..11 {
            let expected = if a == b { 1.0 } else { 0.0 };
            assert!((dot(&column(a), &column(b)) - expected).abs() < 1e-15);
        }
    }
}

#[test]
fn equal_copies_have_no_differences() {
    let model = Creature::new();
    let (arm, hand) = (0.1, -0.7);
    let theta = [0.3, arm, hand, hand, arm, hand, hand, arm, hand, hand, 0.2];
    for normalisation in BOTH {
        let mut x = [0.0; 11];
        model.symmetric_from_absolute(normalisation, &theta, &mut x);
        let means = Creature::<f64>::SECTORS[0].coordinates().len();
        assert!(
            x[means..].iter().all(|&difference| difference == 0.0),
            "{x:?}"
        );
    }
    let mut short = [0.0_f64; 10];
    model.symmetric_from_absolute(Plain, &theta, &mut short);
    assert!(short.iter().all(|value| value.is_nan()));
    model.renormalise(Plain, Orthonormal, &mut short[..3]);
}
