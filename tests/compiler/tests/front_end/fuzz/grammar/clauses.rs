//! Clauses beside the tree: drive, reductions, outputs and observables.

use super::super::words::ODD_NAMES;
use super::Grammar;

impl Grammar<'_> {
    pub(super) fn drive(&mut self) -> String {
        let symbols = ["t".to_owned(), "t".to_owned()];
        let parts = ["torque", "x", "y"].map(|name| {
            let depth = 1 + self.random.below(4);
            let value = self.expression(depth, &symbols);
            format!("{name} = {value}")
        });
        let mut parts = parts.to_vec();
        while parts.len() > 1 && self.one_in(2) {
            let one = self.random.below(parts.len());
            drop(parts.remove(one));
        }
        format!("drive({})", parts.join(", "))
    }

    /// Copies in phase, and sometimes the equations beside them.
    pub(super) fn in_phase(&mut self) -> String {
        let mut nodes = vec!["all".to_owned()];
        if self.one_in(3) {
            nodes = vec![self.link()];
        }
        while self.one_in(8) {
            nodes.push(self.link());
        }
        let transverse = self.pick(&["", ", emit(transverse)", ", emit(small)"]);
        format!("in_phase({}){transverse}", nodes.join(", "))
    }

    pub(super) fn locked(&mut self) -> String {
        let (link, angle) = (self.link(), self.value());
        format!("locked({link}, {angle})")
    }

    /// Springs and friction between two links, between the copies of one, or to a place: on their
    /// angles, or straight ones between points, which may repel each other.
    pub(super) fn spring_damper(&mut self) -> String {
        let word = self.pick(&["siblings", "between", "guy"]);
        let count = if word == "between" { 2 } else { 1 };
        let mut parts: Vec<String> = (0..count).map(|_| self.link()).collect();
        if count == 2 {
            for link in &mut parts {
                let copy = self.pick(&["", "", "_1", "_2", "_1_2"]);
                link.push_str(&copy);
            }
        }
        let is_straight = (word == "guy" || self.one_in(2)) != self.is_odd();
        if is_straight {
            self.copies = count;
            parts.push(self.property("at"));
        }
        self.copies = 1;
        if (word == "guy") != self.is_odd() {
            let (x, y) = (self.value(), self.value());
            parts.push(format!("to = ({x}, {y})"));
        }
        for property in ["spring", "friction"] {
            if self.one_in(2) || self.is_odd() {
                parts.push(self.property(property));
            }
        }
        if self.one_in(if is_straight { 2 } else { 6 }) {
            parts.push(self.property("rest"));
        }
        if (is_straight && self.one_in(2)) != self.is_odd() {
            parts.push(self.property("repulsion"));
            let exponents: &[&str] = match self.is_odd() {
                true => &["0", "-1", "2.5", "13", "m", "2 + 1"],
                false => &["1", "2", "3", "6", "12"],
            };
            parts.push(format!("exponent = {}", self.pick(exponents)));
        }
        format!("{word}({})", parts.join(", "))
    }

    /// The name of a link, or of none.
    fn link(&mut self) -> String {
        if self.links.is_empty() || self.is_odd() {
            return self.pick(ODD_NAMES);
        }
        self.links[self.random.below(self.links.len())].clone()
    }

    pub(super) fn emit(&mut self) -> String {
        let mut requests = Vec::new();
        for request in [
            "energies",
            "momenta",
            "modes",
            "symmetric",
            "taylor",
            "positions",
            "forces",
        ] {
            if self.one_in(4) {
                requests.push(request.to_owned());
            }
        }
        if self.one_in(5) {
            let forms = [
                "",
                "(exact)",
                "(angle = 1)",
                "(angle = 3, amplitude = 4)",
                "(amplitude = 2)",
            ];
            let odd = [
                "()",
                "(angle = 8, amplitude = 8)",
                "(angle = 0)",
                "(rest)",
                "(exact = 1)",
            ];
            let forms = if self.is_odd() { odd } else { forms };
            requests.push(format!("transfer{}", self.pick(&forms)));
        }
        if self.one_in(5) {
            let forms = [
                "",
                "(canonical)",
                "(parseval, matrix)",
                "(rest, velocity)",
                "(amplitude = 2)",
            ];
            let odd = [
                "()",
                "(angle = 6, amplitude = 8)",
                "(amplitude = 2, small(hand_d))",
                "(amplitude = 4, small(hand))",
                "(angle = 99)",
            ];
            let forms = if self.is_odd() { odd } else { forms };
            requests.push(format!("budget{}", self.pick(&forms)));
        }
        if self.is_odd() {
            requests.push(self.pick(ODD_NAMES));
        }
        format!("emit({})", requests.join(", "))
    }

    pub(super) fn observe(&mut self) -> String {
        let mut symbols = vec!["kinetic_energy".to_owned(), "gravity".to_owned()];
        for link in &self.links {
            for symbol in ["theta", "omega", "p", "inertia", "gravity"] {
                symbols.push(format!("{symbol}_{link}"));
                if self.odd > 0 {
                    symbols.push(format!("{symbol}_{link}_1"));
                }
            }
        }
        let count = 1 + self.random.below(3);
        let observables: Vec<String> = (0..count)
            .map(|index| {
                let name = match self.is_odd() {
                    true => self.pick(&[
                        "accelerations",
                        "sin",
                        "new",
                        "friction_power",
                        "cast",
                        "self",
                        "z",
                        "budget_rest",
                    ]),
                    false => ["first", "second", "third"][index].to_owned(),
                };
                let depth = 1 + self.random.below(4);
                let value = self.expression(depth, &symbols);
                format!("{name} = {value}")
            })
            .collect();
        format!("observe({})", observables.join(", "))
    }
}
