//! The forms of W by number are the emitted functions, and are there only where
//! there is something to compare.

use branched_pendulum::prelude::*;
use branched_pendulum::{TransferForm, TransferForms};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::stages_of;
use branched_pendulum_tests::scenes::paper::Paper;
use branched_pendulum_tests::scenes::triplet::Triplet;

/// Orders out of their order, of one sector of three.
#[branched_pendulum(
    gravity = 9.80665,
    trunk: rod(mass = 0.12, length = 0.3) [
        limb: rod(mass = 0.06, length = 0.2) [twig: rod(mass = 0.03, length = 0.15) * 2] * 2
    ],
    emit(budget(amplitude = 3, canonical, angle = 2, amplitude = 2, small(limb_d))),
)]
struct Chosen;

fn forms<M: TransferForms<f64>>(_: &M) -> (Vec<TransferForm>, Vec<&'static str>, Vec<Vec<usize>>) {
    let small = M::SMALL_SECTORS.iter();
    (
        M::TRANSFER_FORMS.to_vec(),
        M::RECEIVERS.to_vec(),
        small.map(|sector| sector.coordinates.to_vec()).collect(),
    )
}

#[test]
fn forms_receivers_and_small_sectors_are_listed() {
    use TransferForm::{Amplitude, Angle, Exact};
    let expected = (
        vec![Angle(1), Amplitude(2), Exact],
        vec!["d"],
        vec![vec![2]],
    );
    assert_eq!(forms(&Paper::new()), expected);
    let small = vec![vec![2], vec![3]];
    let expected = (vec![Amplitude(2), Exact], vec!["d1", "d2"], small);
    assert_eq!(forms(&Triplet::new()), expected);
    let receivers = vec!["in_phase", "limb_d", "twig_1_d", "twig_2_d"];
    let orders = vec![Angle(2), Amplitude(2), Amplitude(3), Exact];
    assert_eq!(forms(&Chosen::new()), (orders, receivers, vec![vec![3, 4]]));
}

#[test]
fn each_number_is_its_function() {
    let mut random = Random::new(5);
    let (q, p) = (random.array(-1.0, 1.0), random.array(-0.01, 0.01));
    let model = Triplet::new();
    let mut found = [Transfer::default(); 2];
    model.transfers_into(0, &q, &p, &mut found);
    let (first, second) = (
        model.transfer_amplitude_2_d1(&q, &p),
        model.transfer_amplitude_2_d2(&q, &p),
    );
    assert_eq!(found, [first, second]);
    model.transfers_into(1, &q, &p, &mut found);
    let exact = [
        model.transfer_exact_d1(&q, &p),
        model.transfer_exact_d2(&q, &p),
    ];
    assert_eq!(found, exact);

    let (q, p) = (random.array(-1.0, 1.0), random.array(-0.01, 0.01));
    let model = Chosen::new();
    let functions = [
        model.sector_transfers_angle_2(&q, &p),
        model.sector_transfers_amplitude_2(&q, &p),
        model.sector_transfers_amplitude_3(&q, &p),
        model.symmetric_sector_transfers(&q, &model.symmetric_velocities(&q, &p)),
    ];
    for (form, expected) in functions.iter().enumerate() {
        let mut found = [Transfer::default(); 4];
        model.transfers_into(form, &q, &p, &mut found);
        assert_eq!(&found, expected, "form {form}");
    }
    let mut momenta = [0.0; 7];
    model.symmetric_momenta_into(&q, &p, &mut momenta);
    assert_eq!(momenta, model.symmetric_momenta(&q, &p));
}

#[test]
fn what_there_is_not_is_nan() {
    let model = Paper::new();
    let (q, p) = ([0.1, 0.2, 0.3], [0.01; 3]);
    let answers = |form: usize, q: &[f64], length: usize| {
        let mut found = vec![Transfer::default(); length];
        model.transfers_into(form, q, &p, &mut found);
        found.iter().all(|transfer| transfer.total().is_nan())
    };
    assert!(answers(3, &q, 1));
    assert!(answers(0, &q[..2], 1));
    assert!(answers(0, &q, 2));
    assert!(!answers(2, &q, 1));
    for (rates, length) in [(&[1.0; 3][..], 2), (&[1.0; 2], 3)] {
        let mut momenta = vec![0.0; length];
        model.symmetric_momenta_into(&q, rates, &mut momenta);
        assert!(momenta.iter().all(|momentum| momentum.is_nan()));
    }
}

/// One form alone, or truncated ones without the exact one, are not compared.
#[test]
fn scenes_with_one_form_have_none_of_it() {
    for (request, compared) in [
        ("", false),
        ("transfer(exact)", false),
        ("transfer(amplitude = 2)", false),
        ("transfer(amplitude = 2, amplitude = 4)", false),
        ("transfer(amplitude = 2, exact)", true),
        ("symmetric, momenta, budget(canonical, parseval)", false),
        ("budget(amplitude = 2)", false),
        ("budget(canonical, amplitude = 2)", true),
        ("transfer(exact), budget(canonical, amplitude = 2)", true),
    ] {
        let source = format!(
            "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) \
             [b: rod(mass = 1, length = 1) * 2], emit({request}))] struct Model;"
        );
        let code = stages_of(&source).tokens().to_string();
        assert_eq!(code.contains("TransferForms"), compared, "{request}");
    }
}
