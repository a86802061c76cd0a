//! Translation of programs to other languages: one function per entry point and one operation per
//! line, in the order of the program. Results are identical bit for bit if the sines and cosines of
//! both languages are.

mod language;
mod names;

use language::Head;
pub use language::Language;
use names::Names;

use crate::functions::{Argument, Purpose};

use crate::program::{ConstantId, ConstantOp, Entry, Op, Program, Setup, ValueId};
use crate::scene::Scene;

/// Translates a program; returns `None` if the code is loops, which are functions of the runtime.
/// Taylor coefficients are left out, because their recurrences are in the runtime too.
pub fn translate(language: Language, scene: &Scene, program: &Program) -> Option<String> {
    if scene.in_loops() {
        return None;
    }
    let translation = Translation {
        language,
        scene,
        program,
    };
    Some(translation.file())
}

struct Translation<'a> {
    language: Language,
    scene: &'a Scene,
    program: &'a Program,
}

impl Translation<'_> {
    fn file(&self) -> String {
        let language = self.language;
        let mut lines = self.title();
        lines.extend(language.opening(&self.scene.name));
        lines.extend(self.constants());
        let entries = self.program.entries.iter();
        for entry in entries.filter(|entry| entry.purpose != Purpose::TaylorCoefficients) {
            lines.push(String::new());
            lines.extend(self.function(entry));
        }
        lines.extend(language.closing(&self.scene.name));
        lines.push(String::new());
        lines.join("\n")
    }

    /// Returns the comment at the head of the file.
    fn title(&self) -> Vec<String> {
        let Scene {
            name,
            links,
            parameters,
            ..
        } = self.scene;
        let list = |names: Vec<&str>| match names.is_empty() {
            true => "none".to_owned(),
            false => names.join(", "),
        };
        let links = list(links.iter().map(|link| link.name.as_str()).collect());
        let parameters = list(parameters.iter().map(|p| p.name.as_str()).collect());
        let lines = [
            format!("{name}: equations of a pendulum tree. Written by `cargo branched-pendulum`."),
            format!(
                "SI units; angles in rad from the {}.",
                self.scene.vertical()
            ),
            format!("Links: {links}"),
            format!("Parameters: {parameters}"),
        ];
        let lines = lines.iter();
        lines.map(|line| self.language.comment(line)).collect()
    }

    /// Returns the function that computes the model's constants from its parameters.
    fn constants(&self) -> Vec<String> {
        let language = self.language;
        let setup = &self.program.setup;
        let at = |id: ConstantId| language.element("k", id.0 as usize);
        let head = Head {
            name: self.name("constants"),
            arguments: vec!["parameters".to_owned()],
            time: false,
            outputs: "k",
            count: setup.definitions.len(),
        };
        let values = setup.iter().map(|(id, definition)| {
            let value = match (&definition.exact, &definition.op) {
                (Some(exact), _) => language.number(exact.to_f64()),
                (None, ConstantOp::Number(number)) => language.number(number.to_f64()),
                (None, ConstantOp::Parameter(index)) => language.element("parameters", *index),
                (None, ConstantOp::Named(_, a) | ConstantOp::Called(a)) => at(*a),
                (None, ConstantOp::Product(number, powers)) => {
                    self.product(language.number(number.to_f64()), powers)
                }
                (None, ConstantOp::Add(a, b)) => format!("{} + {}", at(*a), at(*b)),
                (None, ConstantOp::Sub(a, b)) => format!("{} - {}", at(*a), at(*b)),
            };
            // A number needs no comment.
            let remark = match definition.op {
                ConstantOp::Number(_) => "",
                _ => &definition.name,
            };
            language.output("k", id.0 as usize, &value, remark)
        });
        language.filled(&head, values.collect())
    }

    /// Returns the product number · a · a · b / (c · d) as code, with factors in the order in which
    /// the interpreter multiplies.
    fn product(&self, number: String, powers: &[(ConstantId, i32)]) -> String {
        let (mut above, mut below) = (vec![number], Vec::new());
        for &(id, power) in powers {
            let side = if power > 0 { &mut above } else { &mut below };
            let factor = self.language.element("k", id.0 as usize);
            side.extend(vec![factor; power.unsigned_abs() as usize]);
        }
        let above = above.join(" * ");
        match below.is_empty() {
            true => above,
            false => format!("{above} / ({})", below.join(" * ")),
        }
    }

    fn name(&self, function: &str) -> String {
        self.language.function_name(&self.scene.name, function)
    }

    fn function(&self, entry: &Entry) -> Vec<String> {
        let (language, program) = (self.language, self.program);
        let mut names = Names::new(entry);
        let mut lines = Vec::new();
        for id in program.needed(&entry.outputs) {
            let definition = program.definition(id);
            let wanted = definition.name.as_ref().or(definition.hint.as_ref());
            let text = match &definition.op {
                Op::Input(Argument::Time, _) => {
                    names.is(id, Argument::Time.name().to_owned());
                    continue;
                }
                Op::Input(argument, index) => {
                    names.is(id, language.element(&names.argument(*argument), *index));
                    continue;
                }
                Op::Number(number) => {
                    names.is(id, language.number(number.to_f64()));
                    continue;
                }
                Op::Constant(constant) => {
                    let name = Setup::get(&program.setup, *constant).name.clone();
                    let name = names.own(id, Some(&name));
                    let value = language.element("k", constant.0 as usize);
                    lines.push(language.assignment(&name, &value));
                    continue;
                }
                op => self.operation(&names, op),
            };
            let name = names.own(id, wanted);
            lines.push(language.assignment(&name, &text));
        }
        let arguments = entry.arguments.iter();
        let arrays = arguments.filter(|argument| **argument != Argument::Time);
        let arrays = arrays.map(|argument| names.argument(*argument));
        let head = Head {
            name: self.name(&entry.name),
            arguments: std::iter::once("k".to_owned()).chain(arrays).collect(),
            time: entry.arguments.contains(&Argument::Time),
            outputs: "out",
            count: entry.outputs.len(),
        };
        let outputs: Vec<String> = entry.outputs.iter().map(|id| names.of(*id)).collect();
        let cost = program.operations(&entry.outputs).to_string();
        language.function(&head, &cost, lines, &outputs)
    }

    fn operation(&self, names: &Names, op: &Op) -> String {
        let of = |id: &ValueId| names.of(*id);
        match op {
            Op::Sin(a) => self.language.call("sin", &of(a)),
            Op::Cos(a) => self.language.call("cos", &of(a)),
            Op::Sqrt(a) => self.language.call("sqrt", &of(a)),
            Op::Neg(a) => format!("-{}", of(a)),
            Op::Add(a, b) => format!("{} + {}", of(a), of(b)),
            Op::Sub(a, b) => format!("{} - {}", of(a), of(b)),
            Op::Mul(a, b) => format!("{} * {}", of(a), of(b)),
            Op::Div(a, b) => format!("{} / {}", of(a), of(b)),
            Op::Input(..) | Op::Constant(_) | Op::Number(_) => unreachable!("these are operands"),
        }
    }
}
