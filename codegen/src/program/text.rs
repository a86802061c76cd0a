//! Prints a program, for `cargo branched-pendulum stage program` and for snapshots.

use crate::functions::Argument;

use super::{
    ConstantId, ConstantOp, ConstantSlope, LinePotentialConstants, LoopTree, Op, Program, ValueId,
};
use crate::scene::PairRun;
use std::fmt::{self, Write};

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_constants(f)?;
        if let Some(strips) = &self.strips {
            write_tables(f, strips)?;
            write_spring_dampers(f, strips)?;
            write_power(f, strips)?;
        }
        self.write_entries(f)
    }
}

fn value(id: ValueId) -> String {
    format!("v{}", id.0)
}

/// Writes the constants of the links, table by table.
fn write_tables(f: &mut fmt::Formatter<'_>, strips: &LoopTree) -> fmt::Result {
    let tables = [
        ("strips", &strips.columns),
        ("bodies", &strips.body_columns),
    ];
    for (number, (table, columns)) in tables.into_iter().enumerate() {
        if number > 0 && columns.is_empty() {
            continue;
        }
        writeln!(f, "{table}")?;
        for strip in &strips.strips {
            let constants = [&strip.constants, &strip.body][number];
            let columns = columns.iter().zip(constants);
            let columns: Vec<String> = columns
                .map(|(column, id)| format!("{} k{}", column.name(), id.0))
                .collect();
            writeln!(f, "  {}: {}", strip.name, columns.join(", "))?;
        }
    }
    Ok(())
}

/// Writes the constants of spring-dampers between links, with their pairs of links.
fn write_spring_dampers(f: &mut fmt::Formatter<'_>, strips: &LoopTree) -> fmt::Result {
    for own in &strips.spring_dampers {
        let constants = own.named().map(|(name, id)| format!("{name} k{}", id.0));
        let constants: Vec<String> = constants.collect();
        writeln!(f, "{}: {}", own.what, constants.join(", "))?;
        for PairRun { first, count } in &own.pairs {
            let [a, b] = first;
            writeln!(f, "  {count} from {a}, {b}")?;
        }
    }
    for own in &strips.lines {
        let constants = own.named().map(|(name, id)| format!("{name} k{}", id.0));
        let potentials = own.potentials.iter();
        let exponents = potentials.filter_map(|potential| match potential {
            LinePotentialConstants::Spring { .. } => None,
            LinePotentialConstants::InversePower { exponent, .. } => {
                Some(format!("exponent {exponent}"))
            }
        });
        let constants: Vec<String> = constants.chain(exponents).collect();
        writeln!(f, "line of {}: {}", own.what, constants.join(", "))?;
        for (links, count) in &own.runs {
            let links: Vec<String> = links.iter().map(ToString::to_string).collect();
            writeln!(f, "  {count} from {}", links.join(", "))?;
        }
    }
    Ok(())
}

/// Writes the constants of the virtual power, strip by strip, and their derivatives by parameters.
fn write_power(f: &mut fmt::Formatter<'_>, strips: &LoopTree) -> fmt::Result {
    let Some(power) = &strips.power else {
        return Ok(());
    };
    let list = |constants: &[ConstantId]| {
        let constants: Vec<String> = constants.iter().map(|id| format!("k{}", id.0)).collect();
        constants.join(" ")
    };
    writeln!(f, "virtual power: gravity k{}", power.gravity.0)?;
    for (strip, row) in strips.strips.iter().zip(&power.rows) {
        writeln!(f, "  {}: {}", strip.name, list(row))?;
    }
    for ConstantSlope { place, slope } in &power.slopes {
        let [group, constant, parameter] = place;
        writeln!(
            f,
            "  derivative of constant {constant} in group {group} by parameter {parameter}: k{}",
            slope.0
        )?;
    }
    Ok(())
}

impl Program {
    fn write_constants(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "constants")?;
        for (index, definition) in self.setup.definitions.iter().enumerate() {
            let at = |id: ConstantId| format!("k{}", id.0);
            write!(f, "  k{index} = ")?;
            match &definition.op {
                ConstantOp::Number(number) => write!(f, "{number}")?,
                ConstantOp::Parameter(parameter) => write!(f, "parameter {parameter}")?,
                ConstantOp::Named(_, a) | ConstantOp::Called(a) => write!(f, "{}", at(*a))?,
                ConstantOp::Product(number, powers) => {
                    write!(f, "{number}")?;
                    for (id, power) in powers {
                        write!(f, " * {}^{power}", at(*id))?;
                    }
                }
                ConstantOp::Add(a, b) => write!(f, "{} + {}", at(*a), at(*b))?,
                ConstantOp::Sub(a, b) => write!(f, "{} - {}", at(*a), at(*b))?,
            }
            match &definition.exact {
                Some(_) if matches!(definition.op, ConstantOp::Number(_)) => writeln!(f)?,
                Some(exact) => writeln!(f, "    # {} = {exact}", definition.name)?,
                None => writeln!(f, "    # {}", definition.name)?,
            }
        }
        Ok(())
    }

    fn write_entries(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for entry in &self.entries {
            let arguments: Vec<&str> = entry.arguments.iter().map(|a| a.name()).collect();
            let operations = self.operations(&entry.outputs);
            writeln!(
                f,
                "{}({})    # {operations}",
                entry.name,
                arguments.join(", ")
            )?;
            for id in self.needed(&entry.outputs) {
                writeln!(f, "  {}", self.line(id))?;
            }
            let outputs: Vec<String> = entry.outputs.iter().map(|id| value(*id)).collect();
            writeln!(f, "  -> {}", outputs.join(" "))?;
        }
        Ok(())
    }

    fn line(&self, id: ValueId) -> String {
        let definition = self.definition(id);
        let mut line = format!("{} = ", value(id));
        // Writing to a string cannot fail.
        let _ = match &definition.op {
            Op::Input(Argument::Time, _) => write!(line, "{}", Argument::Time.name()),
            Op::Input(argument, index) => write!(line, "{}[{index}]", argument.name()),
            Op::Constant(constant) => {
                write!(line, "k{} ({})", constant.0, self.setup.get(*constant).name)
            }
            Op::Number(number) => write!(line, "{number}"),
            Op::Sin(a) => write!(line, "sin {}", value(*a)),
            Op::Cos(a) => write!(line, "cos {}", value(*a)),
            Op::Sqrt(a) => write!(line, "sqrt {}", value(*a)),
            Op::Neg(a) => write!(line, "-{}", value(*a)),
            Op::Add(a, b) => write!(line, "{} + {}", value(*a), value(*b)),
            Op::Sub(a, b) => write!(line, "{} - {}", value(*a), value(*b)),
            Op::Mul(a, b) => write!(line, "{} * {}", value(*a), value(*b)),
            Op::Div(a, b) => write!(line, "{} / {}", value(*a), value(*b)),
        };
        if let Some(name) = &definition.name {
            line.push_str("    # ");
            line.push_str(name);
        }
        line
    }
}
