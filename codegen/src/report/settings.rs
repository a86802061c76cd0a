//! Settings of a description, by name.

use super::nearest::nearest;

/// A member of a description that is not a link.
#[derive(Debug, PartialEq, Eq)]
pub struct SceneSetting {
    /// Name of the setting.
    pub name: &'static str,
    /// Example of its syntax.
    pub example: &'static str,
}

impl SceneSetting {
    const ALL: &[Self] = &[
        Self::new("gravity", "gravity = 9.80665"),
        Self::new("crate", "crate = ::branched_pendulum"),
        Self::new("solve", "solve = recursion"),
        Self::new("code", "code = loops"),
        Self::new("parameters", "parameters(m, l)"),
        Self::new("drive", "drive(torque = 0.1 * cos(2 * t))"),
        Self::new("between", "between(left, right, spring = 0.2)"),
        Self::new("siblings", "siblings(child, spring = 0.2)"),
        Self::new("guy", "guy(mast, at = 0.4, to = (-0.4, 0), spring = 60)"),
        Self::new("emit", "emit(energies)"),
        Self::new("observe", "observe(height = cos(theta_arm))"),
        Self::new("in_phase", "in_phase(child)"),
        Self::new("locked", "locked(arm, 0.3)"),
        Self::new("prescribed", "prescribed(arm)"),
    ];

    const fn new(name: &'static str, example: &'static str) -> Self {
        Self { name, example }
    }

    /// Returns the setting with the given name.
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|setting| setting.name == name)
    }

    /// Returns the setting that a misspelt name probably means. At most one letter in three may
    /// differ, because most names of links are as short as those of settings.
    pub fn nearest(name: &str) -> Option<&'static Self> {
        let names: Vec<&str> = Self::ALL.iter().map(|setting| setting.name).collect();
        let most = name.chars().count() / 3;
        nearest(name, &names)
            .filter(|near| strsim::osa_distance(name, near) <= most)
            .and_then(Self::named)
    }

    /// Returns true if parentheses follow the name, and false if `=` does.
    pub fn in_parentheses(&self) -> bool {
        let behind = self.example.strip_prefix(self.name);
        behind.is_some_and(|behind| behind.starts_with('('))
    }

    /// Returns the punctuation that follows the name, `(` or `=`.
    pub(super) fn mark(&self) -> &'static str {
        match self.in_parentheses() {
            true => "(",
            false => "=",
        }
    }

    /// Lists all settings with their punctuation.
    pub(super) fn listed() -> String {
        let forms = Self::ALL.iter().map(|setting| {
            let name = setting.name;
            match setting.in_parentheses() {
                true => format!("`{name}(...)`"),
                false => format!("`{name} = ...`"),
            }
        });
        forms.collect::<Vec<_>>().join(", ")
    }
}
