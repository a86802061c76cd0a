//! The deficit N of the articulated inertia of a subtree, or of several subtrees on one pivot: a
//! symmetric matrix. With the mass S of the subtree, S 1 − N is its articulated inertia; N is the
//! reduction caused by free joints.

use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::pair::Pair;

#[derive(Clone, Copy)]
pub(super) struct Deficit {
    pub(super) xx: ValueId,
    pub(super) xy: ValueId,
    pub(super) rest: Rest,
}

/// The third number that determines N, in addition to xx and xy.
#[derive(Clone, Copy)]
pub(super) enum Rest {
    /// The trace, if it is constant: for a leaf, whose angle only rotates N.
    Trace(ValueId),
    /// The component yy.
    Yy(ValueId),
}

impl Deficit {
    pub(super) fn zero(builder: &mut Builder) -> Self {
        let zero = builder.integer(0);
        Self {
            xx: zero,
            xy: zero,
            rest: Rest::Trace(zero),
        }
    }

    /// Computes b gᵀ for two parallel vectors.
    pub(super) fn product(builder: &mut Builder, b: Pair, g: Pair) -> Self {
        Self {
            xx: builder.mul(b[0], g[0]),
            xy: builder.mul(b[0], g[1]),
            rest: Rest::Yy(builder.mul(b[1], g[1])),
        }
    }

    pub(super) fn has_constant_trace(&self) -> bool {
        matches!(self.rest, Rest::Trace(_))
    }

    pub(super) fn name(&self, builder: &mut Builder, suffix: &str) {
        builder.name(self.xx, &format!("deficit_xx{suffix}"));
        builder.name(self.xy, &format!("deficit_xy{suffix}"));
        if let Rest::Yy(yy) = self.rest {
            builder.name(yy, &format!("deficit_yy{suffix}"));
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

    /// Computes N − m 1.
    pub(super) fn less_mass(&self, builder: &mut Builder, mass: ValueId) -> Self {
        if builder.is(mass, 0) {
            return *self;
        }
        let yy = self.yy(builder);
        Self {
            xx: builder.sub(self.xx, mass),
            xy: self.xy,
            rest: Rest::Yy(builder.sub(yy, mass)),
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

    /// Computes N y.
    pub(super) fn times(&self, builder: &mut Builder, y: Pair) -> Pair {
        let yy = self.yy(builder);
        [
            builder.dot([self.xx, self.xy], y),
            builder.dot([self.xy, yy], y),
        ]
    }

    /// Computes (N − ½ tr N) y.
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
