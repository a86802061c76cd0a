//! Names of links, also in trees that are too large for a list of names.

use core::fmt;

/// The name of a link, either from a list of names, or composed of the name of its generation and
/// the indices of the copies on its path from the root, such as `tree_3_1_2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinkName<'a> {
    pub(crate) stem: &'a str,
    /// For each generation below the root, the number of copies under each link.
    pub(crate) copies: &'static [usize],
    /// Index of the link in its generation.
    pub(crate) index: usize,
}

impl<'a> LinkName<'a> {
    /// Creates a name from one in a list.
    #[must_use]
    pub const fn listed(name: &'a str) -> Self {
        Self {
            stem: name,
            copies: &[],
            index: 0,
        }
    }

    /// Returns the name at an index of a list of names; `None` beyond the end of the list.
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
