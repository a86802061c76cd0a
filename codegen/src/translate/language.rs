//! Syntax of the other languages.

/// A language to which programs can be translated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C99, in `double`.
    C,
    /// Python with NumPy; elements of array arguments may themselves be arrays, one element per
    /// state.
    Numpy,
    /// Julia.
    Julia,
}

/// Name, arguments and results of a translated function.
pub(super) struct Head {
    pub(super) name: String,
    /// Names of the array arguments, in order.
    pub(super) arguments: Vec<String>,
    /// True if the time is an argument, which then follows the constants.
    pub(super) time: bool,
    /// Name of the array of results.
    pub(super) outputs: &'static str,
    /// Number of results of the function.
    pub(super) count: usize,
}

impl Language {
    pub(super) fn comment(self, text: &str) -> String {
        match self {
            Self::C => format!("/* {text} */"),
            Self::Numpy | Self::Julia => format!("# {text}"),
        }
    }

    pub(super) fn opening(self, scene: &str) -> Vec<String> {
        let lines: &[&str] = match self {
            Self::C => &["", "#include <math.h>", ""],
            Self::Numpy => &["", "import numpy as np", "", ""],
            Self::Julia => return vec![String::new(), format!("module {scene}"), String::new()],
        };
        lines.iter().map(|line| (*line).to_owned()).collect()
    }

    pub(super) fn closing(self, scene: &str) -> Vec<String> {
        match self {
            Self::C | Self::Numpy => Vec::new(),
            Self::Julia => vec![String::new(), format!("end # module {scene}")],
        }
    }

    /// Returns the name of a function. In C it contains the scene's name, because C has no
    /// namespaces.
    pub(super) fn function_name(self, scene: &str, function: &str) -> String {
        match self {
            Self::C => format!("{}_{function}", snake(scene)),
            Self::Numpy | Self::Julia => function.to_owned(),
        }
    }

    pub(super) fn element(self, array: &str, index: usize) -> String {
        match self {
            Self::C | Self::Numpy => format!("{array}[{index}]"),
            Self::Julia => format!("{array}[{}]", index + 1),
        }
    }

    /// Returns the shortest decimal number that is read back as the same bits.
    pub(super) fn number(self, value: f64) -> String {
        match value < 0.0 {
            true => format!("({value:?})"),
            false => format!("{value:?}"),
        }
    }

    pub(super) fn call(self, function: &str, argument: &str) -> String {
        match self {
            Self::C | Self::Julia => format!("{function}({argument})"),
            Self::Numpy => format!("np.{function}({argument})"),
        }
    }

    pub(super) fn assignment(self, name: &str, value: &str) -> String {
        match self {
            Self::C => format!("    const double {name} = {value};"),
            Self::Numpy | Self::Julia => format!("    {name} = {value}"),
        }
    }

    /// Returns the line that stores a result at its index, with a comment.
    pub(super) fn output(self, array: &str, index: usize, value: &str, remark: &str) -> String {
        let place = self.element(array, index);
        let end = if self == Self::C { ";" } else { "" };
        let line = format!("    {place} = {value}{end}");
        match remark.is_empty() {
            true => line,
            false => format!("{line} {}", self.comment(remark)),
        }
    }

    /// Returns the first lines of a function.
    fn begin(self, head: &Head) -> String {
        let Head {
            name,
            arguments,
            time,
            outputs,
            count: _,
        } = head;
        let mut all: Vec<String> = arguments
            .iter()
            .map(|array| match self {
                Self::C => format!("const double *{array}"),
                Self::Numpy | Self::Julia => array.clone(),
            })
            .collect();
        if *time {
            let time = if self == Self::C {
                "double time"
            } else {
                "time"
            };
            all.insert(1, time.to_owned());
        }
        match self {
            Self::C => {
                all.push(format!("double *{outputs}"));
                format!("void {name}({})\n{{", all.join(", "))
            }
            Self::Numpy => format!("def {name}({}):", all.join(", ")),
            Self::Julia => format!("function {name}({})", all.join(", ")),
        }
    }

    fn end(self) -> &'static str {
        match self {
            Self::C => "}",
            Self::Numpy => "",
            Self::Julia => "end",
        }
    }

    /// Returns a function that fills an array, with one line of [`output`](Self::output) for each
    /// value.
    pub(super) fn filled(self, head: &Head, values: Vec<String>) -> Vec<String> {
        let (array, count) = (head.outputs, head.count);
        let mut lines = vec![self.comment(&format!(
            "The {count} constants of the model, of its parameters in their order."
        ))];
        lines.push(self.begin(head));
        lines.extend(match self {
            Self::C => Some("    (void)parameters;".to_owned()),
            Self::Numpy => Some(format!("    {array} = np.zeros({count})")),
            Self::Julia => Some(format!("    {array} = zeros({count})")),
        });
        lines.extend(values);
        lines.extend(match self {
            Self::C => None,
            Self::Numpy | Self::Julia => Some(format!("    return {array}")),
        });
        lines.push(self.end().to_owned());
        lines
    }

    /// Returns the function for an entry point.
    pub(super) fn function(
        self,
        head: &Head,
        cost: &str,
        body: Vec<String>,
        outputs: &[String],
    ) -> Vec<String> {
        let count = head.count;
        let mut lines = vec![
            self.comment(&format!("Results: {count}. Cost: {cost}.")),
            self.begin(head),
        ];
        if self == Self::C {
            let all = head.arguments.iter().map(|name| format!("(void){name};"));
            let time = head.time.then(|| "(void)time;".to_owned());
            let all: Vec<String> = all.chain(time).collect();
            lines.push(format!("    {}", all.join(" ")));
        }
        lines.extend(body);
        match (self, outputs) {
            (Self::C, _) => {
                let outputs = outputs.iter().enumerate();
                lines.extend(outputs.map(|(index, value)| format!("    out[{index}] = {value};")));
            }
            (_, [value]) => lines.push(format!("    return {value}")),
            (Self::Numpy, _) => lines.push(format!(
                "    return np.stack(np.broadcast_arrays({}))",
                outputs.join(", ")
            )),
            (Self::Julia, _) => lines.push(format!("    return [{}]", outputs.join(", "))),
        }
        lines.push(self.end().to_owned());
        lines
    }
}

/// Converts `BranchedDouble` to `branched_double`.
fn snake(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}
