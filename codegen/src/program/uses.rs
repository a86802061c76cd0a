//! What uses a value, and which entry points need it.

use super::{Program, Purpose, ValueId};

/// Uses of the values of a program.
pub(super) struct Uses {
    users: Vec<Vec<ValueId>>,
    /// Entry points that need a value, one bit each.
    entries: Vec<Vec<u64>>,
    /// Entry points that return it.
    returns: Vec<Vec<u64>>,
    purposes: Vec<Purpose>,
}

impl Uses {
    /// Of entry points as many as E and values as many as N: O(E N / 64) words, and as
    /// much time as their outputs take to prune to.
    pub(super) fn new(program: &Program) -> Self {
        let words = program.entries.len().div_ceil(64);
        let length = program.definitions.len();
        let mut uses = Self {
            users: vec![Vec::new(); length],
            entries: vec![vec![0; words]; length],
            returns: vec![vec![0; words]; length],
            purposes: program.entries.iter().map(|entry| entry.purpose).collect(),
        };
        for (number, entry) in program.entries.iter().enumerate() {
            let bit = 1 << (number % 64);
            for id in program.needed(&entry.outputs) {
                uses.entries[id.0 as usize][number / 64] |= bit;
            }
            for id in &entry.outputs {
                uses.returns[id.0 as usize][number / 64] |= bit;
            }
        }
        for (definition, index) in program.definitions.iter().zip(0..) {
            let user = ValueId(index);
            if !uses.is_dead(user) {
                for operand in definition.op.operands() {
                    uses.users[operand.0 as usize].push(user);
                }
            }
        }
        uses
    }

    /// Whether no entry point needs the value.
    pub(super) fn is_dead(&self, id: ValueId) -> bool {
        self.entries[id.0 as usize].iter().all(|&word| word == 0)
    }

    /// The values that are formed of it.
    pub(super) fn of(&self, id: ValueId) -> &[ValueId] {
        &self.users[id.0 as usize]
    }

    /// Whether no entry point that needs `user` needs `id` for anything else.
    pub(super) fn alone(&self, id: ValueId, user: ValueId) -> bool {
        let needed = &self.entries[user.0 as usize];
        let apart = |other: &[u64]| needed.iter().zip(other).all(|(a, b)| a & b == 0);
        let mut times = 0;
        for other in self.of(id) {
            if *other == user {
                times += 1;
            } else if !apart(&self.entries[other.0 as usize]) {
                return false;
            }
        }
        times == 1 && apart(&self.returns[id.0 as usize])
    }

    /// Whether an entry point of such a purpose needs the value.
    pub(super) fn serves(&self, id: ValueId, purpose: impl Fn(Purpose) -> bool) -> bool {
        let entries = &self.entries[id.0 as usize];
        let mut purposes = self.purposes.iter().enumerate();
        purposes.any(|(number, &found)| {
            entries[number / 64] >> (number % 64) & 1 == 1 && purpose(found)
        })
    }
}
