//! Fused arithmetic: what `accelerations_into` computes where the machine has it
//! is the program with fused products, bit for bit, and keeps what unfused
//! arithmetic keeps.

use branched_pendulum::scalar::InstructionSet;
use branched_pendulum::system::LinkName;
use branched_pendulum::{Model, Pendulum, Scalar};
use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::scene;
use branched_pendulum_tests::scenes::{
    chain::Chain, driven::Driven, driven::DrivenParameters, generations::Generations,
    nested::Nested, offset::Offset, paper::Paper, triplet::Triplet,
};

/// Hands out the sine and cosine that the machine computes with.
struct Sines;

impl<T: Scalar> Model<T> for Sines {
    type Of<S: Scalar> = Sines;
    const KNOWN_LINKS: Option<usize> = Some(2);

    fn links(&self) -> usize {
        2
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        LinkName::in_list(&["sine", "cosine"], index)
    }

    fn cast<S: Scalar>(&self, _convert: impl Fn(T) -> S) -> Sines {
        Sines
    }
}

impl<T: Scalar> Pendulum<T> for Sines {
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        _omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        let (sine, cosine) = theta(0).sin_cos();
        alpha(0, sine);
        alpha(1, cosine);
    }
}

fn sin_cos(angle: f64) -> (f64, f64) {
    let mut both = [0.0; 2];
    Pendulum::<f64>::accelerations_into(&Sines, 0.0, &[angle, 0.0], &[0.0; 2], &mut both);
    (both[0], both[1])
}

fn mul_add(x: f64, y: f64, z: f64) -> f64 {
    if InstructionSet::widest() > InstructionSet::Build {
        x.mul_add(y, z)
    } else {
        x * y + z
    }
}

/// The compiled accelerations against the program's, both fused.
fn agrees<P: Pendulum<f64>>(name: &str, model: &P, parameters: &[f64]) {
    let program = scene(name).program;
    let mut random = Random::new(13);
    let mut different = 0;
    let entry = "accelerations";
    let interpreter = program.interpreter(entry, parameters);
    let interpreter = interpreter.expect("every scene has accelerations");
    for _ in 0..100 {
        let mut numbers = |size: f64| -> Vec<f64> {
            (0..model.links())
                .map(|_| random.array::<1>(-size, size)[0])
                .collect()
        };
        let (theta, omega) = (numbers(4.0), numbers(9.0));
        let time = random.between(-5.0, 50.0);
        let input = |argument: Argument, index: usize| match argument {
            Argument::Omega => omega[index],
            Argument::Time => time,
            _ => theta[index],
        };
        let mut compiled = vec![0.0; model.links()];
        model.accelerations_into(time, &theta, &omega, &mut compiled);
        let fused = interpreter.evaluate_fused(sin_cos, mul_add, input);
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&compiled), bits(&fused), "{name}");
        let plain = interpreter.evaluate(Scalar::sin_cos, input);
        different += usize::from(bits(&plain) != bits(&compiled));
    }
    // Else the comparison would say nothing about fusing.
    let fuses = InstructionSet::widest() > InstructionSet::Build;
    assert_eq!(different > 0, fuses, "{name}");
}

#[test]
fn compiled_code_fuses_what_the_program_fuses() {
    agrees("paper", &Paper::new(), &[]);
    agrees("chain", &Chain::new(), &[]);
    agrees("triplet", &Triplet::new(), &[]);
    agrees("offset", &Offset::new(), &[]);
    agrees("nested", &Nested::new(), &[]);
    agrees("generations", &Generations::new(), &[]);
    let driven = DrivenParameters {
        push: 0.3,
        pace: 7.1,
        phase: -0.4,
        sway: 0.05,
    };
    let model = Driven::new(driven).expect("possible parameters");
    agrees("driven", &model, &[0.3, 7.1, -0.4, 0.05]);
}

/// Subtrees that are equal and move equally are accelerated equally, to the bit:
/// the two halves of a binary tree, the quarters within them.
#[test]
fn equal_subtrees_stay_equal() {
    let model = Generations::new();
    let mut random = Random::new(17);
    for _ in 0..500 {
        let mut columns = [3.0, 9.0].map(|size| {
            let root: [f64; 1] = random.array(-size, size);
            let top: [f64; 1] = random.array(-size, size);
            let quarter: [f64; 3] = random.array(-size, size);
            let half = [&top[..], &quarter, &quarter].concat();
            [&root[..], &half, &half].concat()
        });
        let [theta, omega] = &mut columns;
        let mut alpha = [0.0; 15];
        model.accelerations_into(0.0, theta, omega, &mut alpha);
        let bits = alpha.map(f64::to_bits);
        assert_eq!(bits[1..8], bits[8..15]);
        assert_eq!(bits[2..5], bits[5..8]);
    }
}

/// Hanging straight down, in phase or not, at rest: nothing moves.
#[test]
fn rest_is_rest() {
    let model = Generations::new();
    let mut alpha = [1.0; 15];
    model.accelerations_into(0.0, &[0.0; 15], &[0.0; 15], &mut alpha);
    assert_eq!(alpha, [0.0; 15]);
}
