//! Programs in other languages, run where their compilers are, against the interpreter.

use branched_pendulum_codegen::program::{Argument, Op, Program, Purpose};
use branched_pendulum_codegen::{Language, Stages, emit, translate};
use branched_pendulum_tests::random::Random;
use branched_pendulum_tests::source::{scene, stages_of};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;

/// Fixture scenes whose code is no loop.
const SCENES: [&str; 14] = [
    "branch",
    "chain",
    "damped_series",
    "driven",
    "driven_series",
    "free_series",
    "generations",
    "nested",
    "observed",
    "offset",
    "paper",
    "series",
    "simple",
    "unequal",
];

const STATES: usize = 3;

/// Numbers of elements of all arguments of a program.
fn lengths(program: &Program) -> BTreeMap<Argument, usize> {
    let mut lengths = BTreeMap::new();
    for definition in &program.definitions {
        if let Op::Input(argument, index) = definition.op {
            let length = lengths.entry(argument).or_insert(0);
            *length = (index + 1).max(*length);
        }
    }
    lengths
}

/// A call of a function: its name, its inputs, and what the interpreter gives.
struct Call {
    name: String,
    time: Option<f64>,
    inputs: Vec<Vec<f64>>,
    results: Vec<f64>,
}

fn parameters(stages: &Stages) -> Vec<f64> {
    let count = stages.scene.parameters.len();
    (0..count).map(|i| 0.3 + 0.07 * i as f64).collect()
}

/// Calls of all functions, with the sines of the C library.
fn calls(stages: &Stages) -> Vec<Call> {
    let (program, parameters) = (&stages.program, parameters(stages));
    let lengths = lengths(program);
    let mut random = Random::new(11);
    let mut calls = Vec::new();
    let entries = program.entries.iter();
    for entry in entries.filter(|entry| entry.purpose != Purpose::TaylorCoefficients) {
        for _ in 0..STATES {
            let inputs = entry.arguments.iter().map(|argument| {
                let length = lengths.get(argument).copied().unwrap_or(1);
                random.around_zero(length, 2.0)
            });
            let inputs: Vec<Vec<f64>> = inputs.collect();
            let input = |wanted: Argument, index: usize| {
                let place = entry.arguments.iter().position(|own| *own == wanted);
                inputs[place.expect("its own")][index]
            };
            let sines = |angle: f64| (angle.sin(), angle.cos());
            let results = program.evaluate(sines, &entry.name, &parameters, input);
            let time = entry.arguments.iter().position(|a| *a == Argument::Time);
            let mut inputs = inputs.clone();
            calls.push(Call {
                name: entry.name.clone(),
                time: time.map(|place| inputs.remove(place)[0]),
                inputs,
                results: results.expect("it is there"),
            });
        }
    }
    calls
}

fn list(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
    numbers.join(", ")
}

/// A folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let own = format!("branched-pendulum-{name}-{}", std::process::id());
    let folder = std::env::temp_dir().join(own);
    std::fs::create_dir_all(&folder).expect("the temporary folder is writable");
    folder
}

fn output(command: &mut Command) -> String {
    let output = command.output().expect("it starts");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{error}");
    String::from_utf8(output.stdout).expect("it is text")
}

/// Compares printed numbers with those of the interpreter, bit for bit.
fn compare(what: &str, printed: &str, calls: &[Call]) {
    let mut printed = printed.split_whitespace();
    for call in calls {
        for (index, right) in call.results.iter().enumerate() {
            let own: f64 = printed.next().expect("a number").parse().expect("a number");
            let same = own.to_bits() == right.to_bits() || (own.is_nan() && right.is_nan());
            assert!(
                same,
                "{what}: {}[{index}] is {own:e}, not {right:e}",
                call.name
            );
        }
    }
    assert_eq!(printed.next(), None, "{what}");
}

fn has(program: &str, arguments: &[&str]) -> bool {
    let status = Command::new(program).args(arguments).output();
    status.is_ok_and(|output| output.status.success())
}

/// `PaperDouble` as `paper_double`, as functions of C are called.
fn prefix(stages: &Stages) -> String {
    let code = translate(Language::C, &stages.scene, &stages.program).expect("no loops");
    let (_, rest) = code.split_once("void ").expect("a function");
    let (name, _) = rest.split_once("_constants(").expect("its name");
    name.to_owned()
}

#[test]
fn c_has_the_bits_of_the_interpreter() {
    if !has("cc", &["--version"]) {
        println!("not checked: there is no cc");
        return;
    }
    let folder = folder("c");
    for name in SCENES {
        let stages = scene(name);
        let calls = calls(&stages);
        let mut code = translate(Language::C, &stages.scene, &stages.program).expect("no loops");
        let (prefix, count) = (prefix(&stages), stages.program.setup.definitions.len());
        let parameters = list(&parameters(&stages));
        let _ = write!(
            code,
            "\n#include <stdio.h>\nint main(void) {{\n    double parameters[] = {{{parameters} 0.0}};\n    \
             static double k[{count}], out[100000];\n    {prefix}_constants(parameters, k);\n",
            parameters = if parameters.is_empty() {
                parameters
            } else {
                parameters + ","
            },
        );
        for call in &calls {
            let arrays = call.inputs.iter();
            let arrays: String = arrays
                .map(|array| format!(", (double[]){{{}}}", list(array)))
                .collect();
            let time = call
                .time
                .map_or(String::new(), |time| format!(", {time:?}"));
            let _ = writeln!(
                code,
                "    {prefix}_{}(k{time}{arrays}, out);\n    \
                 for (int i = 0; i < {}; i++) printf(\"%.17g\\n\", out[i]);",
                call.name,
                call.results.len(),
            );
        }
        code.push_str("    return 0;\n}\n");
        let (source, binary) = (folder.join(format!("{name}.c")), folder.join(name));
        std::fs::write(&source, code).expect("it can be written");
        // Neither fused nor folded: the compiler has sines of its own.
        let flags = [
            "-std=c99",
            "-O1",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-ffp-contract=off",
        ];
        let mut compiler = Command::new("cc");
        compiler.args(flags).arg("-fno-builtin").arg(&source);
        output(compiler.arg("-o").arg(&binary).arg("-lm"));
        compare(name, &output(&mut Command::new(&binary)), &calls);
    }
    std::fs::remove_dir_all(folder).expect("it is ours");
}

/// With sines of the C library in place of NumPy's own, which differ in the last bit; and with
/// many states at once.
#[test]
fn numpy_has_the_bits_of_the_interpreter() {
    if !has("python3", &["-c", "import numpy"]) {
        println!("not checked: there is no numpy");
        return;
    }
    let folder = folder("numpy");
    let mut main = String::from(
        "import math, sys\nsys.path.insert(0, sys.argv[1])\nimport numpy\n\
         class Plain:\n    def __getattr__(self, name):\n        return getattr(numpy, name)\n\
         Plain.sin = lambda _, x: math.sin(x)\nPlain.cos = lambda _, x: math.cos(x)\n\
         def show(x):\n    for number in numpy.ravel(x):\n        print(repr(float(number)))\n",
    );
    let mut all = Vec::new();
    for name in SCENES {
        let stages = scene(name);
        let code = translate(Language::Numpy, &stages.scene, &stages.program).expect("no loops");
        let file = folder.join(format!("scene_{name}.py"));
        std::fs::write(file, code).expect("it can be written");
        let parameters = list(&parameters(&stages));
        let _ = writeln!(
            main,
            "import scene_{name} as scene\nreal = scene.np\nscene.np = Plain()\nk = scene.constants([{parameters}])"
        );
        let calls = calls(&stages);
        for call in &calls {
            let arrays = call.inputs.iter();
            let arrays: String = arrays.map(|array| format!(", [{}]", list(array))).collect();
            let time = call
                .time
                .map_or(String::new(), |time| format!(", {time:?}"));
            let _ = writeln!(main, "show(scene.{}(k{time}{arrays}))", call.name);
        }
        all.extend(calls);
        main.push_str(
            "scene.np = real\nn = scene.accelerations.__code__.co_argcount\n\
             if n == 3:\n    states = numpy.full((100, 1000), 0.3)\n    \
             assert scene.accelerations(k, states, states).shape[-1:] == (1000,)\n",
        );
    }
    let file = folder.join("main.py");
    std::fs::write(&file, main).expect("it can be written");
    let printed = output(Command::new("python3").arg(&file).arg(&folder));
    compare("numpy", &printed, &all);
    std::fs::remove_dir_all(folder).expect("it is ours");
}

/// Julia counts from one; where it is installed it has to read the file.
#[test]
fn julia_counts_from_one_and_ends_what_it_begins() {
    for name in SCENES {
        let stages = scene(name);
        let code = translate(Language::Julia, &stages.scene, &stages.program).expect("no loops");
        assert!(!code.contains("[0]"), "{name}");
        let begun = code
            .lines()
            .filter(|line| line.starts_with("function "))
            .count();
        let ended = code.lines().filter(|line| *line == "end").count();
        assert_eq!(begun, ended, "{name}");
        if has("julia", &["--version"]) {
            let parse = "Meta.parseall(read(stdin, String)).args[end]";
            let file = folder("julia").join("scene.jl");
            std::fs::write(&file, code).expect("it can be written");
            let parse = parse.replace("read(stdin, String)", &format!("read({file:?}, String)"));
            output(Command::new("julia").arg("-e").arg(parse));
        }
    }
}

/// Braces, groups and environments are closed; no sign is what LaTeX takes for something else.
#[test]
fn latex_is_well_formed() {
    for name in SCENES {
        let Stages {
            description,
            scene,
            mechanics,
            program,
            ..
        } = scene(name);
        let document = emit::latex_document(&description.item, &scene, &mechanics, &program);
        let mut depth = 0;
        for (place, letter) in document.char_indices() {
            let plain = !document[..place].ends_with('\\');
            depth += match letter {
                '{' if plain => 1,
                '}' if plain => -1,
                _ => 0,
            };
            assert!(depth >= 0, "{name}: {}", &document[..place]);
            assert!(letter.is_ascii(), "{name}: {letter}");
        }
        assert_eq!(depth, 0, "{name}");
        for (open, close) in [("\\begin{", "\\end{"), ("\\left", "\\right")] {
            let [open, close] = [open, close].map(|word| document.matches(word).count());
            assert_eq!(open, close, "{name}");
        }
        let equations = document.split("\\begin{align*}\n").skip(1);
        for equation in equations {
            let (lines, _) = equation.split_once("\n\\end{align*}").expect("it ends");
            assert!(
                lines
                    .split("\\\\\n")
                    .all(|line| line.matches('&').count() == 1),
                "{lines}"
            );
        }
    }
}

#[test]
fn loops_are_refused() {
    let stages = stages_of(
        "#[branched_pendulum(gravity = 9.81, code = loops, a: rod(mass = 1, length = 1) [
             b: rod(mass = 1, length = 1) ])] struct Loops;",
    );
    assert_eq!(translate(Language::C, &stages.scene, &stages.program), None);
}
