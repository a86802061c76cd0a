//! The machine code of the paper's accelerations, disassembled: one division,
//! no check of bounds, and no calls but for sines and cosines; and, for one
//! state, for batches and for trajectories in lanes, written out and in loops, in fused
//! instructions.

use branched_pendulum::Pendulum;
use branched_pendulum::batch::Batch;
use branched_pendulum::prelude::*;
use branched_pendulum_tests::promised;
use branched_pendulum_tests::scenes::driven_loops::{DrivenLoops, DrivenLoopsParameters};
use branched_pendulum_tests::scenes::paper::Paper;
use std::collections::BTreeMap;
use std::hint::black_box;
use std::process::Command;

/// A tree of any shape in loops, with children at two places of a link.
#[branched_pendulum(
    gravity = 9.80665,
    code = loops,
    trunk: rod(mass = 0.12, length = 0.3) [
        hook: rod(mass = 0.12, length = 0.3, at = 0.1),
        arm: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
    ],
)]
struct Bush;

#[inline(never)]
fn paper_kernel(model: &Paper, theta: &[f64; 3], omega: &[f64; 3]) -> [f64; 3] {
    model.accelerations(theta, omega)
}

/// Lines of machine code by the symbol of the function.
type Functions = BTreeMap<String, Vec<String>>;

/// The functions of this program; none where this machine cannot show them.
fn disassembled() -> Option<Functions> {
    if !cfg!(all(target_arch = "x86_64", target_os = "linux")) {
        return None;
    }
    let program = std::env::current_exe().ok()?;
    let output = Command::new("objdump")
        .args(["--disassemble", "--no-show-raw-insn"])
        .arg(program)
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let mut functions = Functions::new();
    let mut symbol = String::new();
    for line in text.lines() {
        if let Some(start) = line.strip_suffix(">:") {
            symbol = start.rsplit('<').next().unwrap_or(start).to_owned();
        } else if !line.trim().is_empty() {
            functions
                .entry(symbol.clone())
                .or_default()
                .push(line.to_owned());
        }
    }
    Some(functions)
}

fn assert_straight_arithmetic(functions: &Functions) {
    let found = functions
        .iter()
        .find(|(name, _)| name.contains("paper_kernel"));
    let (_, lines) = found.expect("the function is there");
    let all =
        |name: &str| -> Vec<&String> { lines.iter().filter(|line| line.contains(name)).collect() };
    assert!(lines.len() > 50, "the function is there: {lines:?}");
    assert_eq!(all("div").len(), 1, "{:?}", all("div"));
    // Sines and cosines: the question which instructions the machine has, and
    // one function for each answer. A check of bounds would call once more.
    assert!(all("call").len() <= 4, "{:?}", all("call"));
}

/// One state, a batch and trajectories in lanes.
fn runs_in_kernels<P: Pendulum<f64> + Sync>(model: &P) {
    let links = model.links();
    let columns = black_box(vec![vec![0.1; 20]; links]);
    let mut alpha = vec![vec![0.0; 20]; links];
    let done = Batch::new(model).accelerations(0.0, &columns, &columns, &mut alpha);
    assert!(done.is_ok() && alpha[0][19] < 0.0);
    let mut one = vec![0.0; links];
    model.accelerations_into(0.0, &vec![0.1; links], &vec![0.1; links], &mut one);
    assert!(one[0] < 0.0);
    let method = Dop853::new(Options::with_tolerance(1e-6));
    let starts = vec![State::at_rest(0.0, &vec![0.1; links]); 9];
    let ends = Ensemble::new().integrate_in_lanes(&method, &AbsoluteAngles(model), &starts, 0.01);
    assert!(ends.iter().all(|end| end.is_ok()));
}

/// No vector instruction is left as a function of its own, which would cost as
/// much as ten of them: everything between the choice of the instructions and
/// the arithmetic is inlined.
fn assert_inlined(functions: &Functions) {
    for set in ["avx2", "avx512"] {
        let kernels = functions
            .iter()
            .filter(|(name, _)| name.contains("dispatch") && name.contains(set))
            .filter(|(_, lines)| lines.iter().any(|line| line.contains("vfmadd")));
        let mut count = 0;
        for (name, lines) in kernels {
            count += 1;
            let calls: Vec<&String> = lines.iter().filter(|line| line.contains("call")).collect();
            let wrong = |line: &&&String| line.contains("core_arch") || line.contains("panic");
            assert_eq!(calls.iter().filter(wrong).count(), 0, "{name}: {calls:?}");
        }
        assert!(count > 0, "{set}");
    }
}

/// One test: objdump takes many seconds for a program of this size.
#[test]
fn the_kernel_is_straight_and_kernels_are_inlined() {
    let state = black_box([0.1, 0.2, 0.3]);
    assert!(paper_kernel(&Paper::new(), &state, &state)[0] < 0.0);
    runs_in_kernels(&Paper::new());
    runs_in_kernels(&Bush::new());
    let parameters = DrivenLoopsParameters {
        push: -0.1,
        pace: 3.0,
    };
    runs_in_kernels(&DrivenLoops::new(parameters).expect("they are within their bounds"));
    match disassembled() {
        Some(functions) => {
            assert_straight_arithmetic(&functions);
            assert_inlined(&functions);
        }
        // An error where CI promises that it can.
        None => promised::or_skip("objdump for this machine's code"),
    }
}
