//! The relief N of a subtree, or of several on one pivot: a symmetric matrix.

use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::pair::Pair;

#[derive(Clone, Copy)]
pub(super) struct Relief {
    pub(super) xx: ValueId,
    pub(super) xy: ValueId,
    pub(super) rest: Rest,
}

/// What is known of N beside xx and xy.
#[derive(Clone, Copy)]
pub(super) enum Rest {
    /// The trace, a constant: a leaf's angle turns N and changes nothing else.
    Trace(ValueId),
    /// The third component.
    Yy(ValueId),
}

impl Relief {
    pub(super) fn zero(builder: &mut Builder) -> Self {
        let zero = builder.integer(0);
        Self {
            xx: zero,
            xy: zero,
            rest: Rest::Trace(zero),
        }
    }

    pub(super) fn has_constant_trace(&self) -> bool {
        matches!(self.rest, Rest::Trace(_))
    }

    pub(super) fn name(&self, builder: &mut Builder, name: &str) {
        builder.name(self.xx, &format!("relief_xx_{name}"));
        builder.name(self.xy, &format!("relief_xy_{name}"));
        if let Rest::Yy(yy) = self.rest {
            builder.name(yy, &format!("relief_yy_{name}"));
        }
    }

    pub(super) fn add(&self, builder: &mut Builder, other: &Self) -> Self {
        let rest = match (self.rest, other.rest) {
            (Rest::Trace(a), Rest::Trace(b)) => Rest::Trace(builder.add(a, b)),
            _ => {
                let (a, b) = (self.yy(builder), other.yy(builder));
                Rest::Yy(builder.add(a, b))
            }
        };
        Self {
            xx: builder.add(self.xx, other.xx),
            xy: builder.add(self.xy, other.xy),
            rest,
        }
    }

    pub(super) fn yy(&self, builder: &mut Builder) -> ValueId {
        match self.rest {
            Rest::Trace(trace) => builder.sub(trace, self.xx),
            Rest::Yy(yy) => yy,
        }
    }

    pub(super) fn trace(&self, builder: &mut Builder) -> ValueId {
        match self.rest {
            Rest::Trace(trace) => trace,
            Rest::Yy(yy) => builder.add(self.xx, yy),
        }
    }

    /// N y.
    pub(super) fn times(&self, builder: &mut Builder, y: Pair) -> Pair {
        let yy = self.yy(builder);
        [
            builder.dot([self.xx, self.xy], y),
            builder.dot([self.xy, yy], y),
        ]
    }

    /// (N − ½ tr N) y.
    pub(super) fn deviator_times(&self, builder: &mut Builder, y: Pair) -> Pair {
        let half = self.half_trace(builder);
        let difference = builder.sub(self.xx, half);
        let turned = [builder.mul(self.xy, y[0]), builder.mul(difference, y[1])];
        [
            builder.dot([difference, self.xy], y),
            builder.sub(turned[0], turned[1]),
        ]
    }

    pub(super) fn half_trace(&self, builder: &mut Builder) -> ValueId {
        let (trace, two) = (self.trace(builder), builder.integer(2));
        builder.div(trace, two)
    }
}
