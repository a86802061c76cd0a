//! Blocks of sectors against frequencies known in closed form, and refusals.

use branched_pendulum::analysis::{AtRest, Modes, ModesError, SectorModes, SectorModesError};
use branched_pendulum::sectors::{Sector, SectorCoordinate};

use crate::problems::BranchedDouble;

const MEANS: Sector = Sector::listed(
    "in_phase",
    const {
        &[
            SectorCoordinate::listed("theta_parent", &[(0, 1.0)]),
            SectorCoordinate::listed("theta_m", &[(1, 1.0), (2, 1.0)]),
        ]
    },
);

const DIFFERENCE: Sector = Sector::listed(
    "d",
    const { &[SectorCoordinate::listed("theta_d", &[(1, 1.0), (2, -1.0)])] },
);

#[test]
fn the_paper_s_blocks_and_frequencies() {
    let BranchedDouble { m1, m2, mu, g1, g2 } = BranchedDouble::paper();
    let mass = [[m1, mu, mu], [mu, m2, 0.0], [mu, 0.0, m2]];
    let stiffness = [[g1, 0.0, 0.0], [0.0, g2, 0.0], [0.0, 0.0, g2]];
    let modes = SectorModes::new(&[MEANS, DIFFERENCE], &mass, &stiffness).unwrap();
    let [in_phase, antiphase] = modes.blocks.as_slice() else {
        panic!("{} blocks", modes.blocks.len());
    };
    assert_eq!([&*in_phase.name, &*antiphase.name], ["in_phase", "d"]);
    let off = 2.0_f64.sqrt() * mu;
    for (row, expected) in in_phase.mass.iter().zip([[m1, off], [off, m2]]) {
        for (entry, expected) in row.iter().zip(expected) {
            assert!((entry - expected).abs() < 1e-15 * m1, "{row:?}");
        }
    }
    assert!((antiphase.mass[0][0] - m2).abs() < 1e-15 * m2);
    assert!((antiphase.stiffness[0][0] - g2).abs() < 1e-15 * g2);
    let found = modes.frequencies_hz();
    for (found, expected) in found.iter().zip([0.8731696, 1.2580584, 1.5825567]) {
        assert!((found - expected).abs() <= 0.5e-7, "{found}, {expected}");
    }
    assert_eq!(in_phase.modes.frequencies_hz, [found[0], found[2]]);
    assert!(modes.mass_off_block < 1e-15 && modes.stiffness_off_block < 1e-15);
}

#[test]
fn sectors_of_angles_that_are_no_equilibrium_are_refused() {
    let BranchedDouble { m1, m2, mu, g1, g2 } = BranchedDouble::paper();
    let sectors = [MEANS, DIFFERENCE];
    let mut at = AtRest {
        mass: [[m1, mu, mu], [mu, m2, 0.0], [mu, 0.0, m2]],
        stiffness: [[g1, 0.0, 0.0], [0.0, g2, 0.0], [0.0, 0.0, g2]],
        accelerations: [0.0; 3],
    };
    let exact = SectorModes::new(&sectors, &at.mass, &at.stiffness);
    assert_eq!(at.sector_modes(&sectors), exact);
    for link in 0..3 {
        at.accelerations = [0.0; 3];
        at.accelerations[link] = -0.01;
        let error = at.sector_modes(&sectors).unwrap_err();
        let SectorModesError::Matrices(ModesError::NotAtRest { torques, .. }) = &error else {
            panic!("{error}");
        };
        assert_eq!(torques.as_slice(), at.torques());
    }
}

/// Unequal siblings: the sectors are coupled, which is reported by its size.
#[test]
fn what_couples_the_sectors_is_reported() {
    let mass = [[1.0, 0.0, 0.0], [0.0, 1.2, 0.0], [0.0, 0.0, 0.8]];
    let stiffness = [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let modes = SectorModes::new(&[MEANS, DIFFERENCE], &mass, &stiffness).unwrap();
    // (1.2 - 0.8) / 2 between mean and difference, of 1.
    assert!((modes.mass_off_block - 0.2).abs() < 1e-15);
    assert!(modes.stiffness_off_block < 1e-15);
}

#[test]
fn without_gravity_nothing_oscillates() {
    let mass = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let modes = SectorModes::new(&[MEANS, DIFFERENCE], &mass, &[[0.0; 3]; 3]).unwrap();
    assert_eq!(modes.frequencies_hz(), [0.0; 3]);
    assert_eq!(modes.stiffness_off_block, 0.0);
}

#[test]
fn refusals() {
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let refused = |sectors: &[Sector]| SectorModes::new(sectors, &unit, &unit).unwrap_err();
    assert_eq!(
        refused(&[MEANS]).to_string(),
        "the sectors have 2 coordinates, but the matrices have 3 rows: the numbers must be equal"
    );
    let with = |weights: &[(usize, f64)]| {
        let coordinate = SectorCoordinate::new("theta_d".to_owned(), weights.to_vec());
        Sector::new("d".to_owned(), vec![coordinate])
    };
    assert_eq!(
        refused(&[MEANS, with(&[(3, 1.0)])]).to_string(),
        "coordinate `theta_d` has a weight for link 3, but the matrices have only 3 rows"
    );
    assert_eq!(
        refused(&[MEANS, with(&[])]).to_string(),
        "the weights of `theta_d` are zero or not finite"
    );
    assert_eq!(
        refused(&[MEANS, with(&[(1, 1.0), (2, -0.5)])]).to_string(),
        "the coordinates `theta_m` and `theta_d` are not orthogonal"
    );

    let sectors = [MEANS, DIFFERENCE];
    let unstable = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    let error = SectorModes::new(&sectors, &unit, &unstable).unwrap_err();
    assert!(
        matches!(
            &error,
            SectorModesError::Sector {
                sector,
                source: ModesError::NegativeStiffness { .. }
            } if sector == "in_phase"
        ),
        "{error:?}"
    );
    let smaller = [[1.0, 0.0], [0.0, 1.0]];
    let rows = |matrix: &[&[f64]]| matrix.iter().map(|row| row.to_vec()).collect::<Vec<_>>();
    let (unit, smaller) = (
        rows(&[&unit[0], &unit[1], &unit[2]]),
        rows(&[&smaller[0], &smaller[1]]),
    );
    let error = SectorModes::new(&sectors, &unit, &smaller).unwrap_err();
    let expected = Modes::new(&unit, &smaller).unwrap_err();
    assert_eq!(error, SectorModesError::Matrices(expected));
}

/// Sizes between sectors are parts of the largest entry, whichever unit it is in.
#[test]
fn what_couples_the_sectors_depends_on_no_unit() {
    for [one, other] in [[1.2, 0.8], [1.5, 0.3], [0.9, 0.95]] {
        let expected = |largest: f64| 0.5 * f64::abs(one - other) / largest;
        for unit in [1e-9, 1.0, 1e-3, 4e5] {
            let mass = [
                [unit, 0.0, 0.0],
                [0.0, one * unit, 0.0],
                [0.0, 0.0, other * unit],
            ];
            let stiffness = [[2.0 * unit, 0.0, 0.0], [0.0, unit, 0.0], [0.0, 0.0, unit]];
            let of = |mass, stiffness| SectorModes::new(&[MEANS, DIFFERENCE], mass, stiffness);
            let modes = of(&mass, &stiffness).unwrap();
            // In orthonormal coordinates the entry of the means is the mean of both.
            let largest = f64::max(1.0, 0.5 * (one + other));
            let off = modes.mass_off_block;
            assert!((off - expected(largest)).abs() < 1e-14, "{off} in {unit}");
            assert_eq!(modes.stiffness_off_block, 0.0);
            let modes = of(&stiffness, &mass).unwrap();
            assert!((modes.stiffness_off_block - expected(largest)).abs() < 1e-14);
        }
    }
}
