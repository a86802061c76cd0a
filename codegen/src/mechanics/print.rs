//! Prints expressions as text and as LaTeX, for docs and for `cargo branched-pendulum stage`.

use super::expression::{Expr, Symbols};
use crate::exact::Rational;

/// Spellings of the parts of an expression in one notation.
struct Notation {
    latex: bool,
    /// True if terminating decimals are printed as decimals, as in descriptions, instead of as
    /// fractions.
    decimals: bool,
}

/// Returns the expression in plain text: `μ cos(θ_2 − θ_1) ω_1² / (2 M)`.
pub fn text(expr: &Expr, symbols: &Symbols) -> String {
    if let Expr::Number(number) = expr {
        return number.to_string();
    }
    let notation = Notation {
        latex: false,
        decimals: false,
    };
    notation.sum(expr, symbols)
}

/// Returns the expression in LaTeX.
pub fn latex(expr: &Expr, symbols: &Symbols) -> String {
    let notation = Notation {
        latex: true,
        decimals: false,
    };
    notation.sum(expr, symbols)
}

/// Returns the value of a constant in plain text: `1 / 30 + 0.25 m`. Its numbers are printed as
/// [`Rational`] prints them: terminating decimals as decimals, others as fractions. In formulas of
/// motion ½ stays a fraction.
pub fn constant_text(value: &Expr, symbols: &Symbols) -> String {
    if let Expr::Number(number) = value {
        return number.to_string();
    }
    let notation = Notation {
        latex: false,
        decimals: true,
    };
    notation.sum(value, symbols)
}

/// Returns the value of a constant in LaTeX, with numbers as in [`constant_text`].
pub fn constant_latex(value: &Expr, symbols: &Symbols) -> String {
    let notation = Notation {
        latex: true,
        decimals: true,
    };
    notation.sum(value, symbols)
}

impl Notation {
    fn sum(&self, expr: &Expr, symbols: &Symbols) -> String {
        let mut out = String::new();
        for (index, term) in expr.terms().iter().enumerate() {
            let (negative, body) = self.term(term, symbols);
            let minus = if self.latex { "-" } else { "−" };
            match (index, negative) {
                (0, false) => {}
                (0, true) => out.push_str(minus),
                (_, false) => out.push_str(" + "),
                (_, true) => {
                    out.push(' ');
                    out.push_str(minus);
                    out.push(' ');
                }
            }
            out.push_str(&body);
        }
        out
    }

    /// Returns true if a term is negative, and the term without its sign.
    fn term(&self, term: &Expr, symbols: &Symbols) -> (bool, String) {
        let mut negative = false;
        let mut above = Vec::new();
        let mut below = Vec::new();
        for factor in term.factors() {
            match factor {
                Expr::Number(number) => {
                    negative = number.is_negative();
                    let size = if negative { -number } else { number.clone() };
                    let (numerator, denominator) = self.number(&size);
                    if numerator != "1" {
                        above.push(numerator);
                    }
                    if denominator != "1" {
                        below.push(denominator);
                    }
                }
                Expr::Power(base, exponent) if *exponent < 0 => {
                    below.push(self.power(base, -exponent, symbols));
                }
                Expr::Power(base, exponent) => above.push(self.power(base, *exponent, symbols)),
                other => above.push(self.power(other, 1, symbols)),
            }
        }
        let product = |factors: &[String]| match factors {
            [] => "1".to_owned(),
            _ if self.latex => factors.join("\\,"),
            _ => factors.join(" "),
        };
        let body = match (below.len(), self.latex) {
            (0, _) => product(&above),
            (_, true) => format!("\\frac{{{}}}{{{}}}", product(&above), product(&below)),
            (1, false) => format!("{} / {}", product(&above), below[0]),
            (_, false) => format!("{} / ({})", product(&above), product(&below)),
        };
        (negative, body)
    }

    /// Returns numerator and denominator of a number; the denominator of a decimal is 1.
    fn number(&self, size: &Rational) -> (String, String) {
        match size.terminating_decimal() {
            Some(decimal) if self.decimals => (decimal, "1".to_owned()),
            _ => (size.numerator_text(), size.denominator_text()),
        }
    }

    fn power(&self, base: &Expr, exponent: i32, symbols: &Symbols) -> String {
        let atom = match base {
            Expr::Number(number) => number.to_string(),
            Expr::Symbol(id) => {
                let symbol = symbols.get(*id);
                let spelled = if self.latex {
                    &symbol.latex
                } else {
                    &symbol.text
                };
                let function = spelled.trim_start_matches('\\');
                let is_function = function.starts_with("cos") || function.starts_with("sin");
                if exponent != 1 && is_function {
                    return self.function_power(spelled, exponent);
                }
                spelled.clone()
            }
            other if self.latex => format!("\\left({}\\right)", self.sum(other, symbols)),
            other => format!("({})", self.sum(other, symbols)),
        };
        match exponent {
            1 => atom,
            _ => format!("{atom}{}", self.exponent(exponent)),
        }
    }

    /// Writes a power of a function as cos² x instead of (cos x)².
    fn function_power(&self, spelled: &str, exponent: i32) -> String {
        let name_length = if self.latex { 4 } else { 3 };
        let (name, argument) = spelled.split_at(name_length);
        format!("{name}{}{argument}", self.exponent(exponent))
    }

    fn exponent(&self, exponent: i32) -> String {
        match self.latex {
            true => format!("^{{{exponent}}}"),
            false => superscript(exponent),
        }
    }
}

/// Returns a number in superscript: `²`, `⁻¹`.
pub(crate) fn superscript(number: impl Into<i64>) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |digit: char| match digit.to_digit(10) {
        Some(digit) => DIGITS[digit as usize],
        None => '⁻',
    };
    number.into().to_string().chars().map(raised).collect()
}

/// Returns a snake-case name inside `\mathrm{}`.
pub(super) fn latex_name(name: &str) -> String {
    name.replace('_', "\\_")
}

/// Names as the index of a letter, spelled in code, in text and in LaTeX.
pub(super) struct Index {
    pub(super) code: String,
    pub(super) text: String,
    pub(super) latex: String,
}

impl Index {
    pub(super) fn of(names: &[impl AsRef<str>]) -> Self {
        let plain: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
        let latex: Vec<String> = plain.iter().map(|name| latex_name(name)).collect();
        Self {
            code: plain.join("_"),
            text: plain.join(","),
            latex: latex.join(","),
        }
    }
}
