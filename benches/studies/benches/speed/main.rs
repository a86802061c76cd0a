//! `cargo bench`: quick measurement of the speed after a change, in a few seconds.
//!
//! `cargo bench -- NAME…` runs the named benchmarks instead, and `cargo bench -- --list` lists
//! them. The program `evaluation-speed` measures single evaluations in detail, and
//! `work-precision` the time to a given error.

mod ensembles;
mod gradients;
mod lineages;
mod normal_forms;
mod quick;
mod readers;
mod reductions;
mod scales;
mod transverse;

/// Name of a benchmark, its question, and the function that measures and prints.
type Benchmark = (&'static str, &'static str, fn());

macro_rules! benchmarks {
    ($($name:ident: $question:literal,)*) => {
        const BENCHMARKS: &[Benchmark] = &[$((stringify!($name), $question, $name::run)),*];
    };
}

benchmarks! {
    quick: "evaluations and motions of the paper's pendulum and of rods",
    ensembles: "trajectories one by one and in lanes",
    readers: "accelerations through closures and through slices",
    scales: "energy budgets by scale",
    gradients: "derivatives in reverse mode",
    reductions: "smaller models of the same motion",
    normal_forms: "normal forms and their predictions",
    lineages: "one link of a lineage and of a full tree",
    transverse: "growth of differences between copies of a lineage, not their speed",
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // Cargo adds `--bench`.
    let named: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let named = named.into_iter().filter(|name| *name != "--bench");
    let mut named: Vec<&str> = named.collect();
    if named.contains(&"--list") {
        for (name, question, _) in BENCHMARKS {
            println!("{name:14}{question}");
        }
        return;
    }
    if named.is_empty() {
        named.push("quick");
    }
    for name in named {
        match BENCHMARKS.iter().find(|(known, ..)| *known == name) {
            Some((_, question, run)) => {
                println!("{name}: {question}\n");
                run();
                println!();
            }
            None => {
                eprintln!("there is no benchmark `{name}`; help: `--list` lists them");
                std::process::exit(2);
            }
        }
    }
}
