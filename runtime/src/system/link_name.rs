//! Names of links that are too many for a list.

use core::fmt;

/// The name of a link: as in a list of names, or that of its generation with the
/// numbers of the copies that it is and hangs in, as in `tree_3_1_2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinkName<'a> {
    pub(crate) stem: &'a str,
    /// Copies of each generation below the root under one link.
    pub(crate) copies: &'static [usize],
    /// Index in its generation.
    pub(crate) index: usize,
}

impl<'a> LinkName<'a> {
    /// A name from a list.
    #[must_use]
    pub const fn listed(name: &'a str) -> Self {
        Self {
            stem: name,
            copies: &[],
            index: 0,
        }
    }

    /// Returns the name at an index of a list, if there is one.
    #[must_use]
    pub fn in_list(names: &[&'a str], index: usize) -> Option<Self> {
        names.get(index).map(|name| Self::listed(name))
    }
}

impl fmt::Display for LinkName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.stem)?;
        let mut rest = self.index;
        for &copies in self.copies {
            if copies > 1 {
                write!(f, "_{}", rest % copies + 1)?;
            }
            rest /= copies.max(1);
        }
        Ok(())
    }
}
