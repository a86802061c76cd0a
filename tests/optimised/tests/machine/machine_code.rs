//! The machine code of the paper's accelerations, disassembled: one division,
//! no check of bounds, and no calls but for sines and cosines; and, for one
//! state and for batches, in fused instructions.

use branched_pendulum::Pendulum;
use branched_pendulum::batch::Batch;
use branched_pendulum_tests::promised;
use branched_pendulum_tests::scenes::paper::Paper;
use std::collections::BTreeMap;
use std::hint::black_box;
use std::process::Command;
use std::sync::LazyLock;

#[inline(never)]
fn paper_kernel(model: &Paper, theta: &[f64; 3], omega: &[f64; 3]) -> [f64; 3] {
    model.accelerations(theta, omega)
}

/// The functions of this program, by their symbols; none where this machine
/// cannot show them, which is an error where CI promises that it can.
fn disassembled() -> Option<&'static BTreeMap<String, Vec<String>>> {
    // A program of this size takes objdump many seconds.
    static FUNCTIONS: LazyLock<Option<BTreeMap<String, Vec<String>>>> = LazyLock::new(disassemble);
    if FUNCTIONS.is_none() {
        promised::or_skip("objdump for this machine's code");
    }
    FUNCTIONS.as_ref()
}

fn disassemble() -> Option<BTreeMap<String, Vec<String>>> {
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
    let mut functions: BTreeMap<String, Vec<String>> = BTreeMap::new();
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

#[test]
fn the_kernel_is_straight_arithmetic() {
    let state = black_box([0.1, 0.2, 0.3]);
    assert!(paper_kernel(&Paper::new(), &state, &state)[0] < 0.0);
    let Some(functions) = disassembled() else {
        return;
    };
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

/// No vector instruction is left as a function of its own, which would cost as
/// much as ten of them: everything between the choice of the instructions and
/// the arithmetic is inlined.
#[test]
fn kernels_are_compiled_for_their_instructions() {
    let model = Paper::new();
    let columns = black_box(vec![vec![0.1; 20]; 3]);
    let mut alpha = vec![vec![0.0; 20]; 3];
    let done = Batch::new(&model).accelerations(0.0, &columns, &columns, &mut alpha);
    assert!(done.is_ok() && alpha[0][19] < 0.0);
    let mut one = [0.0; 3];
    model.accelerations_into(0.0, &[0.1; 3], &[0.1; 3], &mut one);
    let Some(functions) = disassembled() else {
        return;
    };
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
