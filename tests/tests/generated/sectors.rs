//! The emitted list of sectors is the one that emitted functions mean.

use branched_pendulum::analysis::{Modes, SectorModes};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::scenes::nested::Nested;

type Model = Nested<f64>;

#[test]
fn sectors_of_a_binary_tree() {
    let sizes: Vec<(&str, usize)> = Model::SECTORS
        .iter()
        .map(|sector| (sector.name(), sector.coordinates().len()))
        .collect();
    let expected = [
        ("in_phase", 3),
        ("limb_d", 2),
        ("twig_1_d", 1),
        ("twig_2_d", 1),
    ];
    assert_eq!(sizes, expected);
}

/// Mean or difference by weights, and by `to_symmetric`.
#[test]
fn weights_are_those_of_the_symmetric_coordinates() {
    let model = Model::new();
    let mut random = Random::new(1);
    let theta: [f64; 7] = random.array(-3.0, 3.0);
    let symmetric = model.to_symmetric(&theta);
    let names = <Model as branched_pendulum::SymmetricPendulum<f64>>::COORDINATE_NAMES;
    let mut seen = 0;
    for coordinate in Model::SECTORS
        .iter()
        .flat_map(|sector| sector.coordinates())
    {
        let index = names.iter().position(|name| *name == coordinate.name());
        let value = symmetric[index.expect("a coordinate of that name")];
        let name = coordinate.name();
        assert!((coordinate.of(&theta) - value).abs() < 1e-15, "{name}");
        seen += 1;
    }
    assert_eq!(seen, 7);
}

#[test]
fn blocks_have_the_modes_of_the_tree() {
    let model = Model::new();
    let hanging = [0.0; 7];
    let mass = model.mass_matrix(&hanging);
    let stiffness = model.stiffness_matrix(&hanging);
    let by_sector = SectorModes::new(Model::SECTORS, &mass, &stiffness).expect("hangs stably");
    let whole = Modes::new(&mass, &stiffness).expect("hangs stably");
    assert!(by_sector.mass_off_block < 1e-15 && by_sector.stiffness_off_block < 1e-15);
    for (block, whole) in by_sector.frequencies_hz().iter().zip(&whole.frequencies_hz) {
        assert!((block / whole - 1.0).abs() < 1e-13, "{block} for {whole}");
    }
    // Exchanged with their limbs, the pairs of twigs have one frequency.
    let [_, _, left, right] = by_sector.blocks.as_slice() else {
        panic!("{} blocks", by_sector.blocks.len());
    };
    let (left, right) = (left.modes.frequencies_hz[0], right.modes.frequencies_hz[0]);
    assert!((left / right - 1.0).abs() < 1e-14);
    // A twig on a pivot at rest: f = √(3 g / 2 l) / 2π.
    let twig = (1.5 * 9.80665_f64 / 0.15).sqrt() / std::f64::consts::TAU;
    assert!((left / twig - 1.0).abs() < 1e-14, "{left} for {twig}");

    // With one limb in line with the trunk and the other across, the sectors are
    // coupled, which is reported.
    let apart = [0.5, 0.5, 0.5, 0.5, -1.0, -1.0, -1.0];
    let mass = model.mass_matrix(&apart);
    let coupled = SectorModes::new(Model::SECTORS, &mass, &stiffness).expect("regular");
    assert!(coupled.mass_off_block > 1e-2);
}
