//! What the compiler makes of the paper's accelerations, disassembled: one
//! division, no check of bounds, and no calls but for sines and cosines.

use branched_pendulum_tests::scenes::paper::Paper;
use std::hint::black_box;
use std::process::Command;

#[inline(never)]
fn paper_kernel(model: &Paper, theta: &[f64; 3], omega: &[f64; 3]) -> [f64; 3] {
    model.accelerations(theta, omega)
}

/// The instructions of the function above, if this machine can show them.
fn disassembled() -> Option<Vec<String>> {
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
    let lines = text
        .lines()
        .skip_while(|line| !(line.contains("paper_kernel") && line.ends_with(">:")))
        .skip(1)
        .take_while(|line| !line.trim().is_empty());
    Some(lines.map(str::to_owned).collect())
}

#[test]
fn the_kernel_is_straight_arithmetic() {
    let state = black_box([0.1, 0.2, 0.3]);
    assert!(paper_kernel(&Paper::new(), &state, &state)[0] < 0.0);
    let Some(lines) = disassembled() else {
        println!("skipped: no objdump for this machine's code");
        return;
    };
    let all =
        |name: &str| -> Vec<&String> { lines.iter().filter(|line| line.contains(name)).collect() };
    assert!(lines.len() > 50, "the function is there: {lines:?}");
    assert_eq!(all("div").len(), 1, "{:?}", all("div"));
    // Sines and cosines: the question which instructions the machine has, and
    // one function for each answer. A check of bounds would call once more.
    assert!(all("call").len() <= 4, "{:?}", all("call"));
}
