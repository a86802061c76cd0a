//! Formulas of the normal form of degree 4, against the run-time normal form of the same model.

use std::f64::consts::TAU;

use branched_pendulum::analysis::normal_form::{
    Agreement, MotionSubspace, NormalForm, NormalFormOptions,
};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Polynomial;
use branched_pendulum::system::{Energy, Model};
use branched_pendulum_tests::scenes::blades::Blades;

/// Three copies with springs.
#[branched_pendulum(
    gravity = 9.81,
    trunk(mass = trunk_mass, com = 0.1, inertia = 3e-3, joint = 0.25, spring = 0.1) [
        twig(mass = twig_mass, com = 0.05, inertia = 4e-4, spring = 0.02, friction = 1e-5) * 3
    ],
    emit(energies, normal_form),
)]
struct Crown;

/// The paper's apparatus with everything as a parameter.
#[branched_pendulum(
    parameters(g, parent_mass, parent_com, parent_inertia, joint, child_mass, child_com, child_inertia),
    gravity = g,
    parent(mass = parent_mass, com = parent_com, inertia = parent_inertia, joint = joint) [
        child(mass = child_mass, com = child_com, inertia = child_inertia) * 2
    ],
    emit(normal_form),
)]
struct Apparatus;

/// Without copies there are frequencies only.
#[branched_pendulum(
    gravity = 9.81,
    arm: rod(mass = 2, length = 0.5) [ hand: rod(mass = 0.5, length = 0.4) ],
    emit(energies, normal_form),
)]
struct Double;

#[branched_pendulum(gravity = 9.81, rod: rod(mass = 2, length = 0.5), emit(normal_form))]
struct Rod;

fn close(one: f64, other: f64, tolerance: f64) {
    assert!((one / other - 1.0).abs() < tolerance, "{one} {other}");
}

/// The run-time normal form of degree 4, with no refusals.
fn at_run_time<M>(model: &M, subspace: &MotionSubspace, bound: f64) -> NormalForm
where
    M: Pendulum<f64> + Model<f64>,
    M::Of<Polynomial>: Energy<Polynomial>,
{
    let options = NormalFormOptions {
        degree: 4,
        bound,
        agreement: Agreement { frequency: 10.0 },
        ..NormalFormOptions::default()
    };
    NormalForm::new(model, &vec![0.0; model.links()], subspace, options).expect("a stable tree")
}

fn copies(count: usize) -> MotionSubspace {
    let parents: Vec<Option<usize>> = (0..=count).map(|link| (link > 0).then_some(0)).collect();
    let links: Vec<usize> = (1..=count).collect();
    let copies = Copies::of_links(&parents, &[&links]).expect("leaves of one link");
    MotionSubspace::of_copies(count + 1, &copies, &copies)
}

/// Compares everything with the run-time normal form, from releases of links `0` and all others.
/// Returns the number of releases from which the difference grows.
macro_rules! agree {
    ($model:expr, $links:literal, $form:expr, $releases:expr) => {{
        let (model, form) = ($model, $form);
        let linear = form.linear_frequencies_hz();
        let at_rest = model.normal_form_frequencies(&[0.0; 2]);
        assert_eq!(at_rest.len(), linear.len());
        for (own, linear) in at_rest.iter().zip(&linear) {
            close(own / TAU, *linear, 1e-12);
        }
        let mut growing = 0;
        for [first, second] in $releases {
            let mut theta = [second; $links];
            theta[0] = first;
            let theta = theta.map(f64::to_radians);
            let momenta = [0.0; $links];
            let actions = form.actions(&theta, &momenta);
            // Degree 2 of the transform is the degree before.
            for (own, known) in model.normal_form_actions(&theta).iter().zip(&actions) {
                close(*own, known.before, 1e-11);
            }
            let actions = [0, 1].map(|mode| actions[mode].value);
            let frequencies = model.normal_form_frequencies(&actions);
            let known = form.frequencies_hz(&actions);
            for (own, known) in frequencies.iter().zip(&known) {
                close(own / TAU, known.value, 1e-11);
            }
            let prediction = form.predict(&theta, &momenta).expect("no refusals");
            growing += usize::from(compare_growth(model, &frequencies, &actions, &prediction));
        }
        growing
    }};
}

/// Functions of models with copies.
trait Growing {
    fn coupling(&self, actions: &[f64; 2]) -> f64;
    fn rate_squared(&self, actions: &[f64; 2]) -> f64;
}

macro_rules! growing {
    ($model:ident) => {
        impl Growing for $model {
            fn coupling(&self, actions: &[f64; 2]) -> f64 {
                self.normal_form_coupling(actions)
            }

            fn rate_squared(&self, actions: &[f64; 2]) -> f64 {
                self.normal_form_growth_rate_squared(actions)
            }
        }
    };
}

growing!(Blades);
growing!(Crown);

/// Margin and growth rate determine |κ| and |δ| if the difference grows.
fn compare_growth(
    model: &impl Growing,
    frequencies: &[f64],
    actions: &[f64; 2],
    prediction: &branched_pendulum::analysis::normal_form::Prediction,
) -> bool {
    let coupling = model.coupling(actions).abs();
    let detuning = frequencies[2] - 0.5 * (frequencies[0] + frequencies[1]);
    let rate_squared = model.rate_squared(actions);
    close(rate_squared, coupling.powi(2) - detuning.powi(2), 1e-9);
    let margin = prediction.margin.expect("a kept resonance").value;
    close(coupling - detuning.abs(), margin, 1e-9);
    let resonance = prediction.resonance.as_ref().map(ToString::to_string);
    let rate = prediction.growth_rate.value;
    if rate > 0.0 {
        close(rate_squared.sqrt(), rate, 1e-9);
    }
    assert_eq!(rate > 0.0, rate_squared > 0.0, "{resonance:?}");
    rate > 0.0
}

const RELEASES: [[f64; 2]; 8] = [
    [15.0, 56.0],
    [20.0, 1.0],
    [25.0, 9.5],
    [-10.0, -48.0],
    [5.0, 30.0],
    [12.0, -20.0],
    [19.5, 0.0],
    [30.0, 19.0],
];

#[test]
fn of_two_copies() {
    let model = &Blades::new();
    let growing = agree!(model, 3, at_run_time(model, &copies(2), 0.15), RELEASES);
    assert!(growing >= 3, "{growing}");
}

#[test]
fn of_three_copies_with_springs() {
    let parameters = CrownParameters {
        trunk_mass: 0.4,
        twig_mass: 0.04,
    };
    let model = &Crown::new(parameters).expect("possible parameters");
    let growing = agree!(model, 4, at_run_time(model, &copies(3), 0.15), RELEASES);
    assert!(growing >= 3, "{growing}");
}

#[test]
fn of_a_chain() {
    let model = Double::new();
    let form = at_run_time(&model, &MotionSubspace::whole(2), 0.0);
    for [first, second] in RELEASES {
        let theta = [first, second].map(f64::to_radians);
        let actions = form.actions(&theta, &[0.0; 2]);
        for (own, known) in model.normal_form_actions(&theta).iter().zip(&actions) {
            close(*own, known.before, 1e-11);
        }
        let actions = [0, 1].map(|mode| actions[mode].value);
        let known = form.frequencies_hz(&actions);
        let own = model.normal_form_frequencies(&actions);
        for (own, known) in own.iter().zip(&known) {
            close(own / TAU, known.value, 1e-11);
        }
    }
}

/// The frequency of one rod is ω (1 − θ²/16 + 11 θ⁴/3072 − …) at the amplitude θ.
#[test]
fn of_one_rod() {
    let model = Rod::new();
    let [linear] = model.normal_form_frequencies(&[0.0]);
    close(linear, (1.5 * 9.81 / 0.5_f64).sqrt(), 1e-15);
    for theta in [0.01, 0.1, 0.2_f64] {
        let [own] = model.normal_form_frequencies(&model.normal_form_actions(&[theta]));
        close((1.0 - own / linear) / theta.powi(2), 1.0 / 16.0, 1e-9);
    }
}

/// Under a heavy parent each child is a separate pendulum, with H = Ω I − I²/(16 M). Two of them
/// in phase share their action, and a difference exchanges it with them.
#[test]
fn of_children_of_a_heavy_parent() {
    let parameters = CrownParameters {
        trunk_mass: 1e12,
        twig_mass: 0.08,
    };
    let model = Crown::new(parameters).expect("possible parameters");
    let inertia = 4e-4 + 0.08 * 0.05_f64.powi(2);
    let own = ((0.08 * 9.81 * 0.05 + 0.02) / inertia).sqrt();
    let [_, fast, difference] = model.normal_form_frequencies(&[0.0; 2]);
    close(fast, own, 1e-6);
    close(difference, own, 1e-12);
    // The spring does not shift frequencies.
    let gravity = 0.08 * 9.81 * 0.05;
    let of_one = -gravity / (8.0 * (inertia * own).powi(2));
    let action = 1e-3;
    let shifted = model.normal_form_frequencies(&[0.0, action]);
    close((shifted[1] - fast) / action, of_one / 3.0, 1e-5);
    close((shifted[2] - difference) / action, 2.0 * of_one / 3.0, 1e-5);
}

/// The thresholds are where the growth rate vanishes, and between them the difference grows.
#[test]
fn thresholds_bound_the_growth() {
    let model = Blades::new();
    for [first, second] in [[1.0, 0.0], [1.0, 0.7], [1.0, 4.0]] {
        let theta = [first, second, second].map(f64::to_radians);
        let squares = model.normal_form_thresholds(&theta);
        let rate_squared = |square: f64| {
            let theta = theta.map(|angle| angle * square.sqrt());
            model.normal_form_growth_rate_squared(&model.normal_form_actions(&theta))
        };
        let [least, most] = match squares[0] < squares[1] {
            true => squares,
            false => [squares[1], squares[0]],
        };
        assert!(least > 0.0, "{squares:?}");
        assert!(rate_squared(0.5 * (least + most)) > 0.0);
        for edge in [least, most] {
            let inside = rate_squared(0.5 * (least + most));
            assert!(rate_squared(edge).abs() < 1e-9 * inside, "{squares:?}");
        }
        for outside in [0.9 * least, 1.1 * most] {
            assert!(rate_squared(outside) < 0.0, "{squares:?}");
        }
    }
}

/// The critical angle with vertical children depends on ratios of masses and of lengths only.
/// `--nocapture` prints by how many per cent it changes per one per cent of each parameter.
#[test]
fn critical_angle_depends_on_ratios() {
    let paper = [
        9.80665, 0.1288, 0.084, 1.88e-3, 0.27, 0.10531, 0.043, 0.516e-3,
    ];
    let critical = |[
        g,
        parent_mass,
        parent_com,
        parent_inertia,
        joint,
        child_mass,
        child_com,
        child_inertia,
    ]: [f64; 8]| {
        let parameters = ApparatusParameters {
            g,
            parent_mass,
            parent_com,
            parent_inertia,
            joint,
            child_mass,
            child_com,
            child_inertia,
        };
        let model = Apparatus::new(parameters).expect("possible parameters");
        let mut squares = model.normal_form_thresholds(&[1.0, 0.0, 0.0]);
        squares.sort_by(f64::total_cmp);
        squares.map(f64::sqrt)
    };
    // Percent per percent, with each parameter raised to a power of the factor.
    let sensitivity = |powers: [i32; 8]| {
        let step = 1e-5_f64;
        let scaled = |factor: f64| {
            let both = |k: usize| paper[k] * factor.powi(powers[k]);
            critical(std::array::from_fn(both))[0].ln()
        };
        (scaled(step.exp()) - scaled((-step).exp())) / (2.0 * step)
    };
    let [lower, upper] = critical(paper).map(f64::to_degrees);
    println!("thresholds {lower:.2}° and {upper:.2}°");
    let grows = |hundredths: &i32| {
        let parent = (0.01 * f64::from(*hundredths)).to_radians();
        let model = Blades::new();
        let actions = model.normal_form_actions(&[parent, 0.0, 0.0]);
        model.normal_form_growth_rate_squared(&actions) > 0.02_f64.powi(2)
    };
    let grown: Vec<i32> = (1000..3000).filter(grows).collect();
    println!(
        "0.02 1/s: {:?} to {:?} hundredths of a degree",
        grown.first(),
        grown.last()
    );
    let names = [
        "parent mass",
        "parent com",
        "parent inertia",
        "joint",
        "child mass",
        "child com",
        "child inertia",
    ];
    let single = |place: usize| sensitivity(std::array::from_fn(|k| i32::from(k == place)));
    for (place, name) in names.iter().enumerate() {
        println!("{name}: {:+.2}", single(place + 1));
    }
    assert!(single(5).abs() > 0.1);
    let of_gravity = single(0);
    let of_masses = sensitivity([0, 1, 0, 1, 0, 1, 0, 1]);
    let of_lengths = sensitivity([0, 0, 1, 2, 1, 0, 1, 2]);
    for none in [of_gravity, of_masses, of_lengths] {
        assert!(none.abs() < 1e-8, "{none:e}");
    }
}
