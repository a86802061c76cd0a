//! Random observables, twice: as text for a description, and as a tree that is
//! evaluated in plain numbers.

use branched_pendulum_compiler_tests::random::Random;

/// An expression in named symbols.
#[derive(Clone, Debug)]
pub enum Observable {
    /// A decimal, as written and in numbers.
    Number(String, f64),
    /// A symbol of the scene.
    Symbol(String),
    /// A sum.
    Sum(Box<Observable>, Box<Observable>),
    /// A difference.
    Difference(Box<Observable>, Box<Observable>),
    /// A product.
    Product(Box<Observable>, Box<Observable>),
    /// A quotient, its divisor never near zero.
    Quotient(Box<Observable>, Box<Observable>),
    /// A power.
    Power(Box<Observable>, i32),
    /// The opposite.
    Negative(Box<Observable>),
    /// Sine.
    Sin(Box<Observable>),
    /// Cosine.
    Cos(Box<Observable>),
    /// Square root of what is never near zero.
    Sqrt(Box<Observable>),
}

use Observable::{
    Cos, Difference, Negative, Number, Power, Product, Quotient, Sin, Sqrt, Sum, Symbol,
};

impl Observable {
    /// A random expression of at most `depth` operations inside one another.
    pub fn random(random: &mut Random, symbols: &[String], depth: usize) -> Self {
        if depth == 0 || random.below(8) == 0 {
            return match random.below(5) {
                0 => {
                    let text = format!("{:.3}", random.between(0.1, 3.0));
                    let value = text.parse().unwrap_or(1.0);
                    Number(text, value)
                }
                _ => Symbol(symbols[random.below(symbols.len())].clone()),
            };
        }
        let choice = random.below(12);
        if choice == 6 || choice == 7 {
            let argument = Self::argument(random, symbols, depth);
            let function = if choice == 6 { Sin } else { Cos };
            return function(Box::new(argument));
        }
        let mut part = |depth| Box::new(Self::random(random, symbols, depth));
        match choice {
            0 | 1 => Sum(part(depth - 1), part(depth - 1)),
            2 => Difference(part(depth - 1), part(depth - 1)),
            3..=5 => Product(part(depth - 1), part(depth - 1)),
            8 => Negative(part(depth - 1)),
            9 => {
                let base = part(0);
                Power(base, 2 + random.below(2) as i32)
            }
            10 => {
                let above = part(depth - 1);
                Quotient(above, Box::new(away_from_zero(part(0))))
            }
            _ => Sqrt(Box::new(away_from_zero(part(depth - 1)))),
        }
    }

    /// An argument of a sine or cosine: of large products, and of energies,
    /// these would turn too fast for differences in time.
    fn argument(random: &mut Random, symbols: &[String], depth: usize) -> Self {
        let calm = symbols.iter().filter(|name| !name.ends_with("_energy"));
        let calm: Vec<String> = calm.cloned().collect();
        Self::random(random, &calm, 1.min(depth - 1))
    }

    /// The expression in the attribute's notation.
    pub fn text(&self) -> String {
        match self {
            Number(text, _) | Symbol(text) => text.clone(),
            Sum(a, b) => format!("({} + {})", a.text(), b.text()),
            Difference(a, b) => format!("({} - {})", a.text(), b.text()),
            Product(a, b) => format!("{} * {}", a.text(), b.text()),
            Quotient(a, b) => format!("{} / {}", a.text(), b.text()),
            Power(a, exponent) => format!("({})^{exponent}", a.text()),
            Negative(a) => format!("(-{})", a.text()),
            Sin(a) => format!("sin({})", a.text()),
            Cos(a) => format!("cos({})", a.text()),
            Sqrt(a) => format!("sqrt({})", a.text()),
        }
    }

    /// The value, and by how much it changes at worst, to first order, where
    /// every symbol and every operation changes by one part in one: the measure
    /// for rounding errors. `symbol` gives both for a symbol.
    pub fn evaluate(&self, symbol: &impl Fn(&str) -> (f64, f64)) -> (f64, f64) {
        let at = |part: &Self| part.evaluate(symbol);
        match self {
            Number(_, value) => (*value, value.abs()),
            Symbol(name) => symbol(name),
            Sum(a, b) => {
                let ((a, size_a), (b, size_b)) = (at(a), at(b));
                (a + b, size_a + size_b + (a + b).abs())
            }
            Difference(a, b) => {
                let ((a, size_a), (b, size_b)) = (at(a), at(b));
                (a - b, size_a + size_b + (a - b).abs())
            }
            Product(a, b) => {
                let ((a, size_a), (b, size_b)) = (at(a), at(b));
                (a * b, size_a * b.abs() + a.abs() * size_b + (a * b).abs())
            }
            Quotient(a, b) => {
                let ((a, size_a), (b, size_b)) = (at(a), at(b));
                let value = a / b;
                (
                    value,
                    (size_a + value.abs() * size_b) / b.abs() + value.abs(),
                )
            }
            Power(a, exponent) => {
                let (a, size) = at(a);
                let value = a.powi(*exponent);
                let slope = f64::from(*exponent) * a.powi(exponent - 1);
                (value, slope.abs() * size + 3.0 * value.abs())
            }
            Negative(a) => {
                let (value, size) = at(a);
                (-value, size)
            }
            Sin(a) => {
                let (a, size) = at(a);
                (a.sin(), a.cos().abs() * size + a.sin().abs())
            }
            Cos(a) => {
                let (a, size) = at(a);
                (a.cos(), a.sin().abs() * size + a.cos().abs())
            }
            Sqrt(a) => {
                let (a, size) = at(a);
                (a.sqrt(), 0.5 * size / a.sqrt() + a.sqrt())
            }
        }
    }
}

/// 1.5 + sin x or 1 + x².
fn away_from_zero(part: Box<Observable>) -> Observable {
    let number = |text: &str, value| Box::new(Number(text.to_owned(), value));
    match *part {
        Symbol(_) => Sum(number("1", 1.0), Box::new(Power(part, 2))),
        _ => Sum(number("1.5", 1.5), Box::new(Sin(part))),
    }
}
