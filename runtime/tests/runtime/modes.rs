//! Linear modes against frequencies known in closed form, and refusals.

use branched_pendulum::analysis::{AtRest, Modes, ModesError};

use crate::problems::BranchedDouble;

#[test]
fn the_paper_s_frequencies_to_seven_digits() {
    let BranchedDouble { m1, m2, mu, g1, g2 } = BranchedDouble::paper();
    let modes = Modes::new(
        &[[m1, mu, mu], [mu, m2, 0.0], [mu, 0.0, m2]],
        &[[g1, 0.0, 0.0], [0.0, g2, 0.0], [0.0, 0.0, g2]],
    )
    .unwrap();
    for (found, expected) in modes
        .frequencies_hz
        .iter()
        .zip([0.8731696, 1.2580584, 1.5825567])
    {
        assert!(
            (found - expected).abs() <= 0.5e-7,
            "{found} is not {expected}"
        );
    }
    // The second is the antiphase mode: the parent rests.
    let antiphase = &modes.shapes[1];
    assert!(antiphase[0].abs() < 1e-12 * antiphase[1].abs().max(antiphase[2].abs()));
    assert!((antiphase[1] + antiphase[2]).abs() < 1e-12 * antiphase[1].abs());
}

#[test]
fn shapes_are_orthonormal_by_mass_and_diagonalise_the_stiffness() {
    let mass = [[3.0, 0.5, 0.2], [0.5, 2.0, -0.1], [0.2, -0.1, 1.0]];
    let stiffness = [[9.0, -2.0, 0.0], [-2.0, 5.0, 1.0], [0.0, 1.0, 40.0]];
    let modes = Modes::new(&mass, &stiffness).unwrap();
    let form = |matrix: &[[f64; 3]; 3], a: &[f64], b: &[f64]| -> f64 {
        (0..3)
            .flat_map(|i| (0..3).map(move |j| (i, j)))
            .map(|(i, j)| a[i] * matrix[i][j] * b[j])
            .sum()
    };
    for (i, a) in modes.shapes.iter().enumerate() {
        for (j, b) in modes.shapes.iter().enumerate() {
            let unit = if i == j { 1.0 } else { 0.0 };
            let eigenvalue = (core::f64::consts::TAU * modes.frequencies_hz[i]).powi(2);
            assert!((form(&mass, a, b) - unit).abs() < 1e-13);
            assert!((form(&stiffness, a, b) - unit * eigenvalue).abs() < 1e-12);
        }
        let largest = a.iter().copied().max_by(|x, y| x.abs().total_cmp(&y.abs()));
        assert!(largest > Some(0.0));
    }
    assert!(modes.frequencies_hz.is_sorted());
}

#[test]
fn a_free_coordinate_gives_a_mode_of_zero_frequency() {
    let modes = Modes::new(&[[2.0, 0.0], [0.0, 1.0]], &[[3.0, -3.0], [-3.0, 3.0]]).unwrap();
    assert_eq!(modes.frequencies_hz[0], 0.0);
    let expected = (3.0_f64 * 1.5).sqrt() / core::f64::consts::TAU;
    assert!((modes.frequencies_hz[1] - expected).abs() < 1e-14);
}

/// Torques that a millionth of a radian makes up for are rest, all others are none.
#[test]
fn modes_are_about_rest() {
    let (mass, stiffness) = ([[2.0, 0.3], [0.3, 1.0]], [[5.0, -1.0], [-1.0, 3.0]]);
    let exact = Modes::new(&mass, &stiffness).unwrap();
    for torques in [[0.0, 0.0], [4e-6, -2e-6], [0.0, 1e-12]] {
        assert_eq!(
            Modes::at_rest(&mass, &stiffness, &torques).as_ref(),
            Ok(&exact)
        );
    }
    for (torques, place) in [([6e-6, 0.0], 0), ([1.0, -2.0], 1), ([0.5, f64::NAN], 1)] {
        let error = Modes::at_rest(&mass, &stiffness, &torques).unwrap_err();
        let ModesError::NotAtRest { coordinate, .. } = error else {
            panic!("{error}");
        };
        assert_eq!(coordinate, place);
    }
    // Without stiffness only no torque at all is rest.
    let free = |torque: f64| Modes::at_rest(&[[1.0]], &[[0.0]], &[torque]);
    assert!(free(0.0).is_ok() && free(1e-12).is_err());
    let (torques, rows) = (1, 2);
    assert_eq!(
        Modes::at_rest(&mass, &stiffness, &[0.0]),
        Err(ModesError::Torques { torques, rows })
    );
    // An unstable place that is no equilibrium is told as the latter.
    let error = Modes::at_rest(&[[1.0]], &[[-1.0]], &[0.1]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the angles are not an equilibrium: at rest, a torque of 0.1 N m acts on coordinate 0. \
         Use the angles that `equilibrium` finds near them"
    );
    let moving = AtRest {
        mass,
        stiffness,
        accelerations: [0.1, -0.2],
    };
    let [one, other] = moving.torques();
    assert!((one - 0.14).abs() < 1e-15 && (other + 0.17).abs() < 1e-15);
    assert!(matches!(
        moving.modes(),
        Err(ModesError::NotAtRest { coordinate: 1, .. })
    ));
    let still = AtRest {
        accelerations: [0.0; 2],
        ..moving
    };
    assert_eq!(still.modes(), Ok(exact));
}

#[test]
fn refusals() {
    let unit = [[1.0, 0.0], [0.0, 1.0]];
    let message = |mass: &[Vec<f64>], stiffness: &[Vec<f64>]| {
        Modes::new(mass, stiffness).unwrap_err().to_string()
    };
    let rows = |matrix: &[[f64; 2]; 2]| matrix.map(|row| row.to_vec()).to_vec();
    assert_eq!(message(&[], &[]), "the mass matrix has no rows");
    assert_eq!(
        message(&rows(&unit), &[vec![1.0, 0.0], vec![0.0]]),
        "the stiffness matrix is not square: 2 rows, but 1 entries in row 1"
    );
    assert_eq!(
        message(&rows(&unit), &[vec![1.0]]),
        "the mass matrix has 2 rows and the stiffness matrix 1"
    );
    assert_eq!(
        message(&rows(&[[1.0, f64::NAN], [0.0, 1.0]]), &rows(&unit)),
        "entry (0, 1) of the mass matrix is NaN"
    );
    assert_eq!(
        message(&rows(&[[1.0, 0.5], [0.4, 1.0]]), &rows(&unit)),
        "the mass matrix is not symmetric at (0, 1)"
    );
    assert_eq!(
        Modes::new(&[[1.0, 2.0], [2.0, 1.0]], &unit),
        Err(ModesError::MassNotPositiveDefinite)
    );
    assert_eq!(
        message(&rows(&unit), &rows(&[[4.0, 0.0], [0.0, -9.0]])),
        "the equilibrium is unstable: a squared angular frequency is -9 1/s^2"
    );
    assert_eq!(
        ModesError::MassNotPositiveDefinite.to_string(),
        "the mass matrix is not positive definite: some motion has no inertia"
    );
}
