//! Random descriptions by the grammar of the attribute. Most are right; some
//! have odd values, names, sizes or requests, as users and machines write them.

mod clauses;

use super::words::{LINKS, ODD_NAMES, ODD_NUMBERS, PARAMETERS, SHAPES, STRUCTS};
use branched_pendulum_compiler_tests::random::Random;

/// Writes one description after the other.
pub(crate) struct Grammar<'a> {
    random: &'a mut Random,
    /// One in so many choices is odd; none if 0.
    odd: usize,
    /// Links of the present tree.
    links: Vec<String>,
    /// Copies of the present link.
    copies: usize,
}

/// A description: attribute and item.
pub(crate) fn description(random: &mut Random) -> (String, String) {
    let odd = *random.pick(&[0, 0, 0, 60, 25, 8]);
    let links = Vec::new();
    let mut grammar = Grammar {
        random,
        odd,
        links,
        copies: 1,
    };
    let attribute = grammar.attribute();
    (attribute, grammar.item())
}

impl Grammar<'_> {
    /// Returns true if the next choice is odd.
    fn is_odd(&mut self) -> bool {
        self.odd > 0 && self.one_in(self.odd)
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.random.below(count) == 0
    }

    fn pick(&mut self, choices: &[&str]) -> String {
        (*self.random.pick(choices)).to_owned()
    }

    fn item(&mut self) -> String {
        let name = match self.is_odd() {
            true => self.pick(STRUCTS),
            false => "Pendulum".to_owned(),
        };
        let before = self.pick(&[
            "",
            "pub ",
            "pub(crate) ",
            "#[derive(Debug)] pub ",
            "/// Text.\n",
        ]);
        let after = match self.is_odd() {
            true => self.pick(&[" {}", "();", "<T>;", " { a: f64 }", "", "(u8);"]),
            false => ";".to_owned(),
        };
        format!("{before}struct {name}{after}")
    }

    fn attribute(&mut self) -> String {
        let mut entries = Vec::new();
        if self.one_in(20) {
            let path = self.pick(&[
                "::bp",
                "crate",
                "::r#type",
                "super::a::b",
                "self",
                "::a::r#fn",
            ]);
            entries.push(format!("crate = {path}"));
        }
        if !self.is_odd() {
            let gravity = self.value();
            entries.push(format!("gravity = {gravity}"));
        }
        for (name, values) in [
            ("solve", ["factorization", "recursion", "lu"]),
            ("code", ["loops", "unrolled", "fast"]),
        ] {
            if self.one_in(10) {
                let known = if self.is_odd() { 3 } else { 2 };
                let value = values[self.random.below(known)];
                entries.push(format!("{name} = {value}"));
            }
        }
        if self.one_in(20) {
            entries.push(format!("parameters({})", PARAMETERS.join(", ")));
        }
        let budget = *self.random.pick(&[1, 2, 3, 4, 5, 7]);
        entries.push(self.tree(budget));
        if self.is_odd() {
            entries.push(self.tree(1));
        }
        if self.one_in(4) {
            entries.push(self.drive());
        }
        if self.one_in(2) {
            entries.push(self.emit());
        }
        if self.one_in(12) {
            entries.push(self.in_phase());
        }
        if self.one_in(25) {
            entries.push(self.locked());
        }
        if self.one_in(6) {
            entries.push(self.spring_damper());
        }
        if self.one_in(4) {
            entries.push(self.observe());
        }
        if self.is_odd() {
            let other = self.random.below(entries.len());
            entries.swap(0, other);
        }
        if self.is_odd() {
            let other = self.random.below(entries.len());
            entries.push(entries[other].clone());
        }
        let comma = if self.one_in(2) { "," } else { "" };
        format!("{}{comma}", entries.join(", "))
    }

    /// A link of at most so many below each other and beside each other, copies
    /// aside.
    fn tree(&mut self, budget: usize) -> String {
        let name = match self.is_odd() {
            true => self.pick(ODD_NAMES),
            false => LINKS[self.links.len() % LINKS.len()].to_owned(),
        };
        self.links.push(name.clone());
        if self.one_in(8) {
            return self.rule(&name);
        }
        let copies = match self.links.len() > 1 && self.one_in(3) {
            true if self.is_odd() => {
                self.pick(&["0", "1", "7", "40", "4097", "99999999999", "m", "-1", "2.0"])
            }
            true => self.pick(&["2", "2", "3"]),
            false => String::new(),
        };
        self.copies = copies.parse().unwrap_or(1);
        let (shape, needed) = *self.random.pick(SHAPES);
        let mut properties: Vec<String> = Vec::new();
        for property in needed {
            if !self.is_odd() {
                properties.push(self.property(property));
            }
        }
        for property in ["friction", "drag", "spring"] {
            if self.one_in(8) {
                properties.push(self.property(property));
                if property == "spring" && (self.is_odd() || self.one_in(2)) {
                    properties.push(self.property("rest"));
                }
            }
        }
        if self.links.len() > 1 && self.one_in(5) {
            properties.push(self.property("at"));
        }
        if self.is_odd() {
            let other = self.pick(&["com", "joint", "inertia", "mass", "stiffness", "at"]);
            properties.push(self.property(&other));
        }
        let mut children = Vec::new();
        let mut left = budget.saturating_sub(1);
        while left > 0 {
            let part = 1 + self.random.below(left);
            children.push(self.tree(part));
            left -= part;
        }
        let mut link = match shape {
            "" => name,
            shape => format!("{name}: {shape}"),
        };
        link.push_str(&format!("({})", properties.join(", ")));
        if !children.is_empty() {
            link.push_str(&format!(" [{}]", children.join(", ")));
        }
        if !copies.is_empty() {
            link.push_str(&format!(" * {copies}"));
        }
        link
    }

    /// A rule for generations.
    fn rule(&mut self, name: &str) -> String {
        self.copies = 1;
        let (shape, needed) = self.random.pick(&SHAPES[..7]);
        let (shape, needed) = (shape.to_owned(), needed.to_owned());
        let mut properties: Vec<String> = needed.iter().map(|p| self.property(p)).collect();
        let (count, branching) = match self.is_odd() {
            true => (
                self.pick(&[
                    "0",
                    "30",
                    "45",
                    "64",
                    "65",
                    "100",
                    "1000",
                    "4096",
                    "5000",
                    "9999999999",
                ]),
                self.pick(&["0", "1", "1", "2", "3", "10", "4294967296", "m"]),
            ),
            false => (
                self.pick(&["1", "2", "3", "4"]),
                self.pick(&["1", "2", "2", "3"]),
            ),
        };
        properties.push(format!(
            "shape = {shape}, count = {count}, branching = {branching}"
        ));
        const RATIOS: [&str; 6] = [
            "mass_ratio",
            "length_ratio",
            "friction",
            "spring",
            "spring_ratio",
            "inertia_ratio",
        ];
        for ratio in RATIOS {
            if self.one_in(4) {
                properties.push(self.property(ratio));
            }
        }
        if self.one_in(8) {
            let code = self.pick(&["code = loops", "code = unrolled"]);
            properties.push(code);
        }
        format!("{name}: generations({})", properties.join(", "))
    }

    fn property(&mut self, name: &str) -> String {
        let copies = match self.is_odd() {
            true => self.random.below(4),
            false => self.copies,
        };
        if copies != 1 && copies < 10 && self.one_in(5) {
            let values: Vec<String> = (0..copies).map(|_| self.point(name)).collect();
            return format!("{name} = each({})", values.join(", "));
        }
        let value = self.point(name);
        match name {
            "friction" | "drag" => law(name, &value, self.links.len()),
            _ => format!("{name} = {value}"),
        }
    }

    /// The value of one copy, for points also a pair.
    fn point(&mut self, name: &str) -> String {
        if ["com", "joint", "at"].contains(&name) && self.one_in(4) {
            let (along, lateral) = (self.value(), self.value());
            return format!("({along}, {lateral})");
        }
        self.value()
    }

    /// The value of a property.
    fn value(&mut self) -> String {
        if self.is_odd() {
            return match self.random.below(3) {
                0 => self.pick(ODD_NAMES),
                1 => self.expression(5, &[]),
                _ => self.pick(ODD_NUMBERS),
            };
        }
        match self.random.below(8) {
            0 | 1 => self.pick(PARAMETERS),
            2 => self.expression(2, &[]),
            _ => self.pick(&["1", "0.27", "0.084", "1.88e-3", "2.5", "0.1", "9.80665"]),
        }
    }

    /// An expression of parameters, numbers and `symbols`, which have functions.
    fn expression(&mut self, depth: usize, symbols: &[String]) -> String {
        if depth == 0 || self.one_in(4) {
            if self.is_odd() {
                let odd = if self.one_in(2) {
                    ODD_NAMES
                } else {
                    ODD_NUMBERS
                };
                return self.pick(odd);
            }
            return match self.random.below(3) {
                0 => self.pick(&["1", "2", "0.5", "3.7", "1e-3"]),
                1 if symbols.is_empty() || self.one_in(3) => self.pick(PARAMETERS),
                _ if symbols.is_empty() => self.pick(&["4", "0.25"]),
                _ => self.random.pick(symbols).clone(),
            };
        }
        let part = |grammar: &mut Self| grammar.expression(depth - 1, symbols);
        // Properties are mostly positive.
        let signs = !symbols.is_empty() || self.is_odd();
        match self.random.below(9) {
            2 if !signs => part(self),
            8 if !signs => format!("({})", part(self)),
            0 | 1 => format!("{} + {}", part(self), part(self)),
            2 => format!("({} - {})", part(self), part(self)),
            3 | 4 => format!("{} * {}", part(self), part(self)),
            5 => format!("({}) / ({})", part(self), part(self)),
            6 => {
                let powers = match self.is_odd() {
                    true => [
                        "8",
                        "-8",
                        "9",
                        "400",
                        "0",
                        "-1",
                        "2147483647",
                        "(-2147483648)",
                    ],
                    false => ["2", "2", "3", "-1", "4", "2", "3", "2"],
                };
                format!("({})^{}", part(self), self.pick(&powers))
            }
            7 if !symbols.is_empty() || self.is_odd() => {
                let function = match self.is_odd() {
                    true => self.pick(&["tan", "exp", "sqrt", "sin", "abs"]),
                    false => self.pick(&["sin", "cos"]),
                };
                format!("{function}({})", part(self))
            }
            _ => format!("-({})", part(self)),
        }
    }
}

/// Friction with this coefficient by one law or several, told by what is drawn already:
/// another draw would make other descriptions of all that follow.
fn law(name: &str, value: &str, links: usize) -> String {
    match (name, (value.len() + links) % 6) {
        (_, 0) => format!("{name}(viscous = {value}, quadratic = {value})"),
        (_, 1) => format!("{name}(quadratic = {value}, width = 0.1)"),
        ("friction", 2) => {
            format!("friction(coulomb = {value}, static = 2, stribeck = {value}, width = w)")
        }
        ("friction", 3) => format!("friction(coulomb = 1, quadratic = {value}, viscous = 2,)"),
        _ => format!("{name} = {value}"),
    }
}
