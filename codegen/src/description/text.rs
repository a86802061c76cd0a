//! Prints a description in the notation of the attribute, one link per line.

use std::fmt::{self, Display, Formatter};

use super::{
    CratePath, Description, Expression, ExpressionKind, LockedClause, Node, ObservableClause,
    Property, Reductions, Request, RequestForm, Value,
};

impl Display for Description {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "description of {}", self.item.ident)?;
        if let Some(path) = &self.crate_path {
            writeln!(f, "crate = {path}")?;
        }
        if let Some(gravity) = &self.gravity {
            writeln!(f, "{gravity}")?;
        }
        for (name, value) in self.solve.iter().chain(&self.code) {
            writeln!(f, "{name} = {value}")?;
        }
        if let Some(parameters) = &self.parameters {
            write!(f, "parameters(")?;
            separated(&parameters.names, f)?;
            writeln!(f, ")")?;
        }
        if let Some(drive) = &self.drive {
            write!(f, "{}(", drive.name)?;
            separated(&drive.parts, f)?;
            writeln!(f, ")")?;
        }
        for root in &self.roots {
            node(root, 0, f)?;
        }
        let Reductions { in_phase, locked } = &self.reductions;
        if !in_phase.is_empty() {
            let nodes: Vec<String> = in_phase.iter().map(ToString::to_string).collect();
            writeln!(f, "in_phase({})", nodes.join(", "))?;
        }
        for LockedClause { link, angle } in locked {
            writeln!(f, "locked({link}, {angle})")?;
        }
        for clause in &self.prescribed {
            let links: Vec<String> = clause.links.iter().map(ToString::to_string).collect();
            writeln!(f, "prescribed({})", links.join(", "))?;
        }
        for clause in &self.spring_dampers {
            let links: Vec<String> = clause.links.iter().map(ToString::to_string).collect();
            write!(f, "{}({}", clause.name, links.join(", "))?;
            for property in &clause.properties {
                write!(f, ", {property}")?;
            }
            writeln!(f, ")")?;
        }
        if !self.requests.is_empty() {
            write!(f, "emit(")?;
            separated(&self.requests, f)?;
            writeln!(f, ")")?;
        }
        if !self.observables.is_empty() {
            write!(f, "observe(")?;
            separated(&self.observables, f)?;
            writeln!(f, ")")?;
        }
        Ok(())
    }
}

/// Writes a link and, indented below it, its children.
fn node(node: &Node, depth: usize, f: &mut Formatter<'_>) -> fmt::Result {
    write!(f, "{:indent$}{}", "", node.name, indent = 4 * depth)?;
    if let Some(shape) = &node.shape {
        write!(f, ": {shape}")?;
    }
    write!(f, "(")?;
    separated(&node.properties, f)?;
    write!(f, ")")?;
    if let Some(copies) = node.copies {
        write!(f, " * {}", copies.count)?;
    }
    writeln!(f)?;
    for child in &node.children {
        self::node(child, depth + 1, f)?;
    }
    Ok(())
}

/// Writes members separated by commas.
fn separated<T: Display>(members: &[T], f: &mut Formatter<'_>) -> fmt::Result {
    for (i, member) in members.iter().enumerate() {
        let comma = if i > 0 { ", " } else { "" };
        write!(f, "{comma}{member}")?;
    }
    Ok(())
}

impl Display for CratePath {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let start = if self.global { "::" } else { "" };
        write!(f, "{start}{}", self.segments.join("::"))
    }
}

impl Display for Property {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.within {
            Some(law) => write!(f, "{law}({} = {})", self.name, self.value),
            None => write!(f, "{} = {}", self.name, self.value),
        }
    }
}

impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Single(value) => write!(f, "{value}"),
            Self::Pair(along, lateral) => write!(f, "({along}, {lateral})"),
            Self::Each { values, .. } => {
                write!(f, "each(")?;
                separated(values, f)?;
                write!(f, ")")
            }
        }
    }
}

impl Display for ObservableClause {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.name, self.value)
    }
}

impl Display for Request {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        if let Some(forms) = &self.forms {
            write!(f, "(")?;
            separated(forms, f)?;
            write!(f, ")")?;
        }
        Ok(())
    }
}

impl Display for RequestForm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        if let Some(value) = self.value {
            write!(f, " = {}", value.count)?;
        }
        if let Some(members) = &self.members {
            write!(f, "(")?;
            separated(members, f)?;
            write!(f, ")")?;
        }
        Ok(())
    }
}

impl Display for Expression {
    /// Writes every operator except the outermost in parentheses, so that the text shows how the
    /// tokens were parsed.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ExpressionKind::Number(value) => write!(f, "{value}"),
            ExpressionKind::Name(name) => write!(f, "{name}"),
            ExpressionKind::Sum(members) => joined(members, " + ", f),
            ExpressionKind::Product { factors, divisors } => {
                joined(factors, " * ", f)?;
                for divisor in divisors {
                    write!(f, " / ")?;
                    operand(divisor, f)?;
                }
                Ok(())
            }
            ExpressionKind::Power(base, exponent) => {
                operand(base, f)?;
                write!(f, "^{exponent}")
            }
            ExpressionKind::Negative(value) => {
                write!(f, "-")?;
                operand(value, f)
            }
            ExpressionKind::Call { function, argument } => write!(f, "{function}({argument})"),
        }
    }
}

/// Writes operands separated by an operator.
fn joined(operands: &[Expression], operator: &str, f: &mut Formatter<'_>) -> fmt::Result {
    for (i, value) in operands.iter().enumerate() {
        if i > 0 {
            f.write_str(operator)?;
        }
        operand(value, f)?;
    }
    Ok(())
}

/// Writes an operand, in parentheses unless it is a number, a name or a function.
fn operand(value: &Expression, f: &mut Formatter<'_>) -> fmt::Result {
    match value.kind {
        ExpressionKind::Number(_) | ExpressionKind::Name(_) | ExpressionKind::Call { .. } => {
            write!(f, "{value}")
        }
        _ => write!(f, "({value})"),
    }
}
