//! Programs in other languages, run where their compilers are, against the interpreter.

use branched_pendulum_codegen::functions::{Argument, Purpose};

use branched_pendulum_codegen::program::{Op, Program};
use branched_pendulum_codegen::{Language, Stages, emit, translate};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::{fixture, scene};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

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
#[derive(Clone)]
struct Call {
    name: String,
    time: Option<f64>,
    inputs: Vec<Vec<f64>>,
    results: Vec<f64>,
}

impl Call {
    /// The time as an argument, if there is one.
    fn time(&self) -> String {
        let time = self.time.map(|time| format!(", {time:?}"));
        time.unwrap_or_default()
    }
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

/// A folder of this process's own.
fn folder() -> PathBuf {
    let own = format!("branched-pendulum-languages-{}", std::process::id());
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
fn prefix(code: &str) -> String {
    let (_, rest) = code.split_once("void ").expect("a function");
    let (name, _) = rest.split_once("_constants(").expect("its name");
    name.to_owned()
}

/// All fixture scenes, each derived once: those that are written out in all languages, those
/// in loops refused but in LaTeX.
#[test]
fn all_scenes_in_all_languages() {
    let scenes = std::fs::read_dir(fixture("scenes")).expect("the folder is there");
    let mut names: Vec<String> = scenes
        .map(|entry| entry.expect("it is read").path())
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    let folder = folder();
    let has_c = has("cc", &["--version"]);
    let mut numpy = Session::new(Language::Numpy);
    let mut julia = Session::new(Language::Julia);
    let mut loops = 0;
    for name in &names {
        let stages = scene(name);
        latex_is_well_formed(name, &stages);
        if stages.scene.in_loops() {
            loops += 1;
            assert_eq!(written(Language::C, &stages), None);
            continue;
        }
        let calls = calls(&stages);
        if has_c {
            c_has_the_bits_of_the_interpreter(name, &stages, &calls, &folder);
        }
        julia_counts_from_one_and_ends_what_it_begins(name, &stages);
        numpy.add(name, &stages, &calls, &folder);
        julia.add(name, &stages, &calls, &folder);
    }
    assert!(loops > 0 && names.len() - loops > 10, "{names:?}");
    if !has_c {
        println!("C not checked: there is no cc");
    }
    match has("python3", &["-c", "import numpy"]) {
        true => numpy.has_the_bits_of_the_interpreter("python3", &folder),
        false => println!("NumPy not checked: python3 has none"),
    }
    match has("julia", &["--version"]) {
        true => julia.has_the_bits_of_the_interpreter("julia", &folder),
        false => println!("Julia not run: there is no julia"),
    }
    std::fs::remove_dir_all(folder).expect("it is ours");
}

fn written(language: Language, stages: &Stages) -> Option<String> {
    translate(language, &stages.scene, &stages.program)
}

fn c_has_the_bits_of_the_interpreter(name: &str, stages: &Stages, calls: &[Call], folder: &Path) {
    let mut code = written(Language::C, stages).expect("no loops");
    let (prefix, count) = (prefix(&code), stages.program.setup.definitions.len());
    // C has no arrays without elements.
    let parameters = list(&[&parameters(stages)[..], &[0.0]].concat());
    let _ = write!(
        code,
        "\n#include <stdio.h>\nint main(void) {{\n    double parameters[] = {{{parameters}}};\n    \
         static double k[{count}], out[100000];\n    {prefix}_constants(parameters, k);\n",
    );
    for call in calls {
        let arrays = call.inputs.iter();
        let arrays: String = arrays
            .map(|array| format!(", (double[]){{{}}}", list(array)))
            .collect();
        let time = call.time();
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
    compare(name, &output(&mut Command::new(&binary)), calls);
}

/// The head of a program of Python. The sines are those of the C library in place of NumPy's
/// own, which differ in the last bit.
const NUMPY: &str = "import math
import numpy
class Plain:
    def __getattr__(self, name):
        return getattr(numpy, name)
Plain.sin = lambda _, x: math.sin(x)
Plain.cos = lambda _, x: math.cos(x)
def show(x):
    for number in numpy.ravel(x):
        print(repr(float(number)))
";

/// The head of a program of Julia.
const JULIA: &str = "show_all(numbers) = foreach(number -> println(repr(number)), numbers)\n";

/// The sines of the C library for a module of Julia, whose own differ in the last bit.
const JULIA_SINES: &str = "const libm = Sys.isapple() ? \"libSystem\" : \"libm.so.6\"
sin(x) = ccall((:sin, libm), Cdouble, (Cdouble,), x)
cos(x) = ccall((:cos, libm), Cdouble, (Cdouble,), x)
";

/// One program that calls the functions of all scenes, in a language that is not compiled
/// before; in NumPy with many states at once too.
struct Session {
    language: Language,
    program: String,
    calls: Vec<Call>,
}

impl Session {
    fn new(language: Language) -> Self {
        let head = if language == Language::Julia {
            JULIA
        } else {
            NUMPY
        };
        Self {
            language,
            program: head.to_owned(),
            calls: Vec::new(),
        }
    }

    fn add(&mut self, name: &str, stages: &Stages, calls: &[Call], folder: &Path) {
        let code = written(self.language, stages).expect("no loops");
        let parameters = list(&parameters(stages));
        let scene = &stages.scene.name;
        let (file, code) = match self.language {
            Language::Julia => {
                let opening = format!("module {scene}\n");
                let with_sines = code.replacen(&opening, &(opening.clone() + JULIA_SINES), 1);
                let _ = writeln!(
                    self.program,
                    "include(\"scene_{name}.jl\")\nk = {scene}.constants(Float64[{parameters}])"
                );
                (format!("scene_{name}.jl"), with_sines)
            }
            _ => {
                let _ = writeln!(
                    self.program,
                    "import scene_{name} as scene\nreal = scene.np\nscene.np = Plain()\n\
                     k = scene.constants([{parameters}])"
                );
                (format!("scene_{name}.py"), code)
            }
        };
        std::fs::write(folder.join(file), code).expect("it can be written");
        let (module, show, open) = match self.language {
            Language::Julia => (scene.as_str(), "show_all", "Float64["),
            _ => ("scene", "show", "["),
        };
        for call in calls {
            let arrays = call.inputs.iter();
            let arrays: String = arrays
                .map(|array| format!(", {open}{}]", list(array)))
                .collect();
            let (time, function) = (call.time(), &call.name);
            let _ = writeln!(self.program, "{show}({module}.{function}(k{time}{arrays}))");
        }
        self.calls.extend_from_slice(calls);
        if self.language == Language::Numpy {
            self.program.push_str(
                "scene.np = real\nn = scene.accelerations.__code__.co_argcount\n\
                 if n == 3:\n    states = numpy.full((100, 1000), 0.3)\n    \
                 assert scene.accelerations(k, states, states).shape[-1:] == (1000,)\n",
            );
        }
    }

    fn has_the_bits_of_the_interpreter(&self, program: &str, folder: &Path) {
        let file = folder.join(format!("main_{program}"));
        std::fs::write(&file, &self.program).expect("it can be written");
        compare(
            program,
            &output(Command::new(program).arg(file)),
            &self.calls,
        );
    }
}

/// Julia counts from one, and ends its functions. `tests/languages/run.sh` parses it.
fn julia_counts_from_one_and_ends_what_it_begins(name: &str, stages: &Stages) {
    let code = written(Language::Julia, stages).expect("no loops");
    assert!(!code.contains("[0]"), "{name}");
    let begun = code
        .lines()
        .filter(|line| line.starts_with("function "))
        .count();
    let ended = code.lines().filter(|line| *line == "end").count();
    assert_eq!(begun, ended, "{name}");
}

/// Braces, groups and environments are closed; no sign is what LaTeX takes for something else.
fn latex_is_well_formed(name: &str, stages: &Stages) {
    let Stages {
        description,
        scene,
        mechanics,
        program,
        ..
    } = stages;
    let document = emit::latex_document(&description.item, scene, mechanics, program);
    let of_one_link = document.contains("\\subsection*{equations of one link}");
    assert_eq!(of_one_link, scene.in_loops(), "{name}");
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
