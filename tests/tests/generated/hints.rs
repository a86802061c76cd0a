//! Messages of the compiler where a model is used for something that its description
//! does not ask for, or without coordinates: what to write.

use super::toolchain::{runtime, rustc};

/// A model without requests, and the beginning of every mistake.
const HEAD: &str = r#"
use branched_pendulum::analysis::variational::{ByTangents, flow_jacobian};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Dual;


#[branched_pendulum(gravity = 9.8, rod: rod(mass = 1, length = 1))]
struct Model;

fn mistake(model: &Model, start: &State<f64>, method: &Dop853<f64>) {
"#;

/// A mistake, and a part of what is said of it.
const MISTAKES: [(&str, &str); 9] = [
    (
        "let _ = method.run(model, start, 1.0);",
        "choose the coordinates of a model: `AbsoluteAngles(&model)`",
    ),
    (
        "let method = Taylor::new(Options::with_tolerance(1e-9)); \
         let _ = method.run(&AbsoluteAngles(model), start, 1.0);",
        "with `emit(taylor)` in its attribute",
    ),
    (
        "let _ = method.run(&CanonicalVariables(model), start, 1.0);",
        "canonical variables by `emit(momenta)`",
    ),
    (
        "fn energy<P: Energy<f64>>(_: P) {} energy(model);",
        "a model knows them with `emit(energies)` in its attribute",
    ),
    (
        "fn symmetric<P: SymmetricPendulum<f64>>(_: P) {} symmetric(model);",
        "with `emit(symmetric)` in its attribute",
    ),
    (
        "fn positions<P: Positions<f64>>(_: P) {} positions(model);",
        "a model knows it with `emit(positions)` in its attribute",
    ),
    (
        "model.accelerations_under_into(0.0, &[0.1], &[0.0], &[0.0], &mut [0.0]);",
        "torques from outside are requested by `emit(forces)`",
    ),
    (
        "let _ = flow_jacobian(method, &AbsoluteAngles(model), start, 1.0);",
        "for a model: `linearised(AbsoluteAngles(&model))`",
    ),
    (
        "let angles = AbsoluteAngles(model); \
         let system = ByTangents::<_, Dual<f64, 1>>::new(&angles); \
         let _ = flow_jacobian(method, &system, start, 1.0);",
        "`linearised(AbsoluteAngles(&model))` to those of variational equations",
    ),
];

#[test]
fn mistakes_in_calls_say_what_to_write() {
    let folder = std::env::temp_dir().join(format!("branched-pendulum-h{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder is writable");
    let external = format!("branched_pendulum={}", runtime(&folder).display());
    for (mistake, hint) in MISTAKES {
        let source = format!("#![allow(unused)]{HEAD}{mistake}\n}}");
        let output = rustc(&folder, "mistake", &source, &external, "metadata").output();
        let output = output.expect("the compiler runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "{mistake}");
        assert!(errors.contains(hint), "{mistake}\n{errors}");
    }
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}
