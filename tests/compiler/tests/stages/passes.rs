//! Programs with and without each pass say the same.

use branched_pendulum_codegen::functions::{Argument, Purpose};

use branched_pendulum_codegen::program::{Pass, Program};
use branched_pendulum_codegen::stages_without;
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::{attributed_struct, fixture};

const SCENES: [&str; 9] = [
    "chain",
    "driven",
    "driven_series",
    "nested",
    "observed",
    "offset",
    "paper",
    "triplet",
    "unequal",
];

fn program(name: &str, off: Option<Pass>) -> Program {
    let source = std::fs::read_to_string(fixture(&format!("scenes/{name}.rs")));
    let (attribute, item) = attributed_struct(&source.expect("the fixture exists"));
    match stages_without(off, attribute, item) {
        Ok(stages) => stages.program,
        Err((report, _)) => panic!("{name}: {report:?}"),
    }
}

/// Outputs of all entry points at some states.
fn values(program: &Program) -> Vec<(String, Vec<f64>)> {
    let mut random = Random::new(29);
    let parameters: Vec<f64> = (0..20).map(|_| random.between(0.3, 0.9)).collect();
    let mut values = Vec::new();
    for _ in 0..5 {
        let numbers: [[f64; 16]; 2] = [random.array(-1.0, 1.0), random.array(-3.0, 3.0)];
        let time = random.between(-5.0, 5.0);
        let input = |argument: Argument, index: usize| match argument {
            Argument::Time => time,
            Argument::Theta | Argument::Coordinates | Argument::Absolute => numbers[0][index],
            _ => numbers[1][index],
        };
        for entry in &program.entries {
            // Lists the partners of its sines too, which differ where their angles do.
            if entry.purpose == Purpose::TaylorCoefficients {
                continue;
            }
            let outputs = program.evaluate(f64::sin_cos, &entry.name, &parameters, input);
            values.push((entry.name.clone(), outputs.expect("the entry is there")));
        }
    }
    values
}

/// Values of well-conditioned states differ by roundings.
#[test]
fn passes_keep_the_values() {
    for name in SCENES {
        let with = values(&program(name, None));
        for pass in Pass::ALL {
            let program = program(name, Some(pass));
            assert_eq!(program.verify(), Ok(()), "{name} without {}", pass.name());
            for ((entry, with), (_, without)) in with.iter().zip(values(&program)) {
                let size = with
                    .iter()
                    .fold(0.0, |size: f64, value| size.max(value.abs()));
                for (with, without) in with.iter().zip(without) {
                    let error = (with - without).abs();
                    assert!(
                        error <= 1e-11 * size,
                        "{name}::{entry} without {}: {with} and {without}",
                        pass.name()
                    );
                }
            }
        }
    }
}
