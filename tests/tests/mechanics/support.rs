//! Runs the pipeline on text and evaluates programs.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use branched_pendulum::Scalar;
use branched_pendulum_codegen::Stages;
use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::mechanics::{EnergyParts, Frame, Mechanics};
use branched_pendulum_codegen::program::{Interpreter, Program};
use branched_pendulum_codegen::scene::Scene;
use branched_pendulum_compiler_tests::source;

/// The stages of a description that can be shared between threads.
pub(crate) struct Compiled {
    pub(crate) scene: Scene,
    pub(crate) mechanics: Mechanics,
    pub(crate) program: Program,
    /// Entry points that were evaluated without parameters.
    ready: Mutex<BTreeMap<String, Arc<Interpreter>>>,
}

impl From<Stages> for Compiled {
    fn from(stages: Stages) -> Self {
        Self {
            scene: stages.scene,
            mechanics: stages.mechanics,
            program: stages.program,
            ready: Mutex::default(),
        }
    }
}

/// Runs the pipeline on the arguments of an attribute.
pub(crate) fn compile(arguments: &str) -> Compiled {
    compile_item(&format!("#[branched_pendulum({arguments})] struct Sample;"))
}

/// Runs the pipeline on an item with its attribute.
pub(crate) fn compile_item(source: &str) -> Compiled {
    source::stages_of(source).into()
}

/// The library's fixture of the paper's apparatus.
pub(crate) fn compile_paper() -> Compiled {
    source::scene("paper").into()
}

impl Compiled {
    /// The outputs of an entry point of a scene without parameters; `inputs`
    /// are its arguments in their order.
    pub(crate) fn evaluate(&self, entry: &str, inputs: &[&[f64]]) -> Vec<f64> {
        let mut ready = self.ready.lock().expect("no test panics in here");
        let interpreter = ready.entry(entry.to_owned());
        let interpreter = interpreter.or_insert_with(|| Arc::new(self.interpreter(entry, &[])));
        let interpreter = Arc::clone(interpreter);
        drop(ready);
        self.run(&interpreter, entry, inputs)
    }

    /// The outputs of an entry point for the given parameters, with the sine and
    /// cosine that emitted code uses.
    pub(crate) fn evaluate_with(
        &self,
        parameters: &[f64],
        entry: &str,
        inputs: &[&[f64]],
    ) -> Vec<f64> {
        self.run(&self.interpreter(entry, parameters), entry, inputs)
    }

    fn interpreter(&self, entry: &str, parameters: &[f64]) -> Interpreter {
        match self.program.interpreter(entry, parameters) {
            Some(interpreter) => interpreter,
            None => panic!("the program has no entry point `{entry}`"),
        }
    }

    fn run(&self, interpreter: &Interpreter, entry: &str, inputs: &[&[f64]]) -> Vec<f64> {
        let entry = self.program.entry(entry).expect("it was found");
        let arguments = &entry.arguments;
        assert_eq!(
            arguments.len(),
            inputs.len(),
            "arguments of `{}`",
            entry.name
        );
        let input = |argument: Argument, index: usize| {
            let position = arguments.iter().position(|a| *a == argument);
            inputs[position.expect("an entry point uses its own arguments")][index]
        };
        interpreter.evaluate(Scalar::sin_cos, input)
    }
}

/// The largest figure seen and where.
#[derive(Debug, Default)]
pub(crate) struct Worst {
    figure: f64,
    place: String,
}

impl Worst {
    /// Notes `error` in units of `scale`; both must be finite.
    pub(crate) fn note(&mut self, error: f64, scale: f64, place: impl FnOnce() -> String) {
        let figure = if error == 0.0 {
            0.0
        } else {
            error.abs() / scale
        };
        assert!(figure.is_finite(), "{error} of {scale} at {}", place());
        if figure > self.figure {
            self.figure = figure;
            self.place = place();
        }
    }

    /// Fails if the largest figure is above `tolerance`.
    pub(crate) fn assert_below(&self, tolerance: f64, what: &str) {
        println!("{what}: worst {:.2e} at {}", self.figure, self.place);
        assert!(
            self.figure <= tolerance,
            "{what}: {:.2e} at {}",
            self.figure,
            self.place
        );
    }
}

/// The energies of a frame whose scene asks for them.
pub(crate) fn energies(frame: &Frame) -> &EnergyParts {
    frame
        .energies
        .as_ref()
        .expect("the scene asks for energies")
}
