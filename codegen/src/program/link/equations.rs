//! The equations of one link, physics (10.4) to (10.8).
//!
//! All values are what the caller says: constants of the model and sines of a named link
//! where a tree is written out, elements of arguments where the link stands in a loop.

use super::deficit::Deficit;
use crate::program::builder::Builder;
use crate::program::pair::Pair;
use crate::program::{Op, ValueId};

/// A link: its constants in reduced units (`reduced_units`), and its motion.
#[derive(Clone)]
pub(super) struct ReducedLink {
    /// The first moment ĥ = h + i e about the pivot.
    pub(super) moment: Pair,
    /// The moment of inertia M about the pivot.
    pub(super) inertia: ValueId,
    /// The part of the mass that no parent has in its constants.
    pub(super) mass: ValueId,
    /// The link's own unit of length.
    pub(super) length: ValueId,
    /// One over it.
    pub(super) inverse_length: ValueId,
    /// v: cosine and sine.
    pub(super) direction: Pair,
    pub(super) omega: ValueId,
    /// The torque Q of joints, drag and drive.
    pub(super) torque: ValueId,
    /// Suffix of the names of the link's values.
    pub(super) suffix: String,
}

/// Response of subtrees on one pivot to its acceleration a: the force γ − N a, beside
/// that of their mass.
#[derive(Clone, Copy)]
pub(super) struct Response {
    pub(super) deficit: Deficit,
    /// γ.
    pub(super) bias_force: Pair,
}

impl Response {
    pub(super) fn add(&self, builder: &mut Builder, other: &Self) -> Self {
        Self {
            deficit: self.deficit.add(builder, &other.deficit),
            bias_force: builder.add_pairs(self.bias_force, other.bias_force),
        }
    }

    pub(super) fn name(&self, builder: &mut Builder, suffix: &str) {
        self.deficit.name(builder, suffix);
        builder.name_pair(self.bias_force, &format!("bias_force@{suffix}"));
    }
}

/// The subtrees on a link, about the link's pivot, while its joint is held.
#[derive(Clone, Copy)]
pub(super) struct Attached {
    /// Σ N.
    pub(super) deficit: Deficit,
    /// The share of b.
    pub(super) first_moment: Pair,
    /// The share of J.
    pub(super) inertia: ValueId,
    /// The share of γ'.
    pub(super) force: Pair,
    /// Σ y·γ'.
    pub(super) torque: ValueId,
}

impl Attached {
    pub(super) fn add(&self, builder: &mut Builder, other: &Self) -> Self {
        Self {
            deficit: self.deficit.add(builder, &other.deficit),
            first_moment: builder.add_pairs(self.first_moment, other.first_moment),
            inertia: builder.add(self.inertia, other.inertia),
            force: builder.add_pairs(self.force, other.force),
            torque: builder.add(self.torque, other.torque),
        }
    }
}

/// Factors of a link for the way down: ω̇ = −(b·a + κ)/J, or what follows in its place
/// where ω̇ is given.
#[derive(Clone, Copy)]
pub(super) struct Elimination {
    /// b/J.
    pub(super) gain: Pair,
    /// κ/J.
    pub(super) offset: ValueId,
}

impl ReducedLink {
    /// ω² in units of length.
    pub(super) fn centripetal(&self, builder: &mut Builder) -> ValueId {
        let squared = builder.mul(self.omega, self.omega);
        if self.suffix.is_empty() {
            // One value in functions of links of several lengths.
            builder.name(squared, "omega_squared");
        }
        let centripetal = builder.mul(self.length, squared);
        builder.name(centripetal, &format!("centripetal{}", self.suffix))
    }

    /// The link by itself, without what hangs from it.
    pub(super) fn alone(&self, builder: &mut Builder) -> Attached {
        let first_moment = builder.turn(self.moment, self.direction);
        let centripetal = self.centripetal(builder);
        Attached {
            deficit: Deficit::zero(builder),
            first_moment,
            inertia: self.inertia,
            force: inwards(builder, centripetal, first_moment),
            torque: builder.integer(0),
        }
    }

    /// Subtrees that hang at λ, with ĥ and M of the link where its `body` counts here.
    /// `passed_on` says whether γ' is needed by itself.
    ///
    /// (10.4), (10.5): y = λ v, b = ĥ v − N y, J = M − y·N y;
    /// (10.6): γ' = γ + i ω² ((ĥ − tr N λ) v + N y), Σ y·γ' = y·γ' + ω² λ × ĥ
    /// = y·γ − ω² y × N y.
    pub(super) fn attach(
        &self,
        builder: &mut Builder,
        place: Pair,
        response: &Response,
        body: Option<(Pair, ValueId)>,
        passed_on: bool,
    ) -> Attached {
        let v = self.direction;
        let (moment, mut inertia) =
            body.unwrap_or_else(|| (builder.zero_pair(), builder.integer(0)));
        let centripetal = self.centripetal(builder);
        let Response {
            deficit,
            bias_force,
        } = response;
        let y = self.attachment(builder, place);
        // Where the trace is a constant so is the lever, and N enters without it.
        let (part, first_moment, thrown) = if deficit.has_constant_trace() {
            let half = deficit.half_trace(builder);
            let lever = builder.scale_pair(half, place);
            let lever = builder.sub_pairs(moment, lever);
            let square = builder.dot(place, place);
            let isotropic = builder.mul(half, square);
            inertia = builder.sub(inertia, isotropic);
            let part = deficit.deviator_times(builder, y);
            let moment = builder.turn(lever, v);
            builder.name_pair(moment, &format!("moment@{}", self.suffix));
            let first_moment = builder.sub_pairs(moment, part);
            (part, first_moment, builder.add_pairs(moment, part))
        } else {
            let trace = deficit.trace(builder);
            let lever = builder.scale_pair(trace, place);
            let lever = builder.sub_pairs(moment, lever);
            let part = deficit.times(builder, y);
            let whole = builder.turn(moment, v);
            let first_moment = builder.sub_pairs(whole, part);
            builder.hint(trace, &format!("deficit_trace{}", self.suffix));
            builder.hint(lever[0], &format!("centrifugal_moment{}", self.suffix));
            builder.hint(
                lever[1],
                &format!("lateral_centrifugal_moment{}", self.suffix),
            );
            let moment = builder.turn(lever, v);
            (part, first_moment, builder.add_pairs(moment, part))
        };
        builder.name_pair(part, &format!("deficit_moment@{}", self.suffix));
        // One product after the other: each is fused with its difference.
        for (component, part) in y.into_iter().zip(part) {
            let along = builder.mul(component, part);
            inertia = builder.sub(inertia, along);
        }
        let thrown = inwards(builder, centripetal, thrown);
        let force = builder.add_pairs(*bias_force, thrown);
        let torque = if passed_on {
            let torque = builder.dot(y, force);
            let lateral = builder.cross(place, moment);
            let lateral = builder.mul(lateral, centripetal);
            builder.add(torque, lateral)
        } else {
            let torque = builder.dot(y, *bias_force);
            let across = builder.cross(y, part);
            let across = builder.mul(centripetal, across);
            builder.sub(torque, across)
        };
        Attached {
            deficit: *deficit,
            first_moment,
            inertia,
            force,
            torque,
        }
    }

    /// y = λ v.
    fn attachment(&self, builder: &mut Builder, place: Pair) -> Pair {
        let y = builder.turn(place, self.direction);
        for (component, axis) in y.into_iter().zip(["x", "y"]) {
            builder.hint(component, &format!("attachment_{axis}{}", self.suffix));
        }
        y
    }

    /// ĥ and M.
    pub(super) fn body(&self) -> (Pair, ValueId) {
        (self.moment, self.inertia)
    }

    /// Eliminates the link's angular acceleration, (10.7); `whole` is the link with
    /// what hangs from it.
    pub(super) fn eliminate(
        &self,
        builder: &mut Builder,
        whole: &Attached,
    ) -> (Response, Elimination) {
        let suffix = &self.suffix;
        let first_moment = builder.name_pair(whole.first_moment, &format!("first_moment@{suffix}"));
        builder.name(whole.inertia, &format!("joint_inertia{suffix}"));
        builder.name_pair(whole.force, &format!("held_force@{suffix}"));
        let torque = self.net_torque(builder, whole);
        let one = builder.integer(1);
        let inverse = builder.div(one, whole.inertia);
        builder.name(inverse, &format!("inverse_joint_inertia{suffix}"));
        let gain = builder.scale_pair(inverse, first_moment);
        builder.name_pair(gain, &format!("gain@{suffix}"));
        let reduced = builder.mul(torque, inverse);
        let offset = builder.neg(reduced);
        builder.name(offset, &format!("offset{suffix}"));
        let elimination = Elimination { gain, offset };
        let deficit = whole.deficit.less_mass(builder, self.mass);
        let own = Deficit::product(builder, first_moment, gain);
        let response = Response {
            deficit: deficit.add(builder, &own),
            bias_force: passed_on(builder, whole.force, torque, gain),
        };
        response.name(builder, suffix);
        (response, elimination)
    }

    /// Response of a leaf, whose J is a constant: `gain` is ĥ/M, `inverse` 1/M.
    pub(super) fn leaf(
        &self,
        builder: &mut Builder,
        gain: Pair,
        inverse: ValueId,
    ) -> (Response, Elimination) {
        let suffix = &self.suffix;
        let gain = builder.turn(gain, self.direction);
        builder.name_pair(gain, &format!("gain@{suffix}"));
        let first_moment = builder.scale_pair(self.inertia, gain);
        builder.name_pair(first_moment, &format!("first_moment@{suffix}"));
        let centripetal = self.centripetal(builder);
        let force = inwards(builder, centripetal, first_moment);
        let reduced = builder.mul(self.torque, inverse);
        let offset = builder.neg(reduced);
        builder.name(offset, &format!("offset{suffix}"));
        let response = Response {
            deficit: Deficit::product(builder, first_moment, gain),
            bias_force: passed_on(builder, force, self.torque, gain),
        };
        response.name(builder, suffix);
        (response, Elimination { gain, offset })
    }

    /// −κ = Q − Σ y·γ'. Of the two the one that no sign stands before has a name.
    pub(super) fn net_torque(&self, builder: &mut Builder, whole: &Attached) -> ValueId {
        let torque = builder.sub(self.torque, whole.torque);
        match *builder.op(torque) {
            Op::Neg(bias) => builder.name(bias, &format!("bias_torque{}", self.suffix)),
            _ => builder.name(torque, &format!("minus_bias_torque{}", self.suffix)),
        };
        torque
    }

    /// ω̇ in units of length and in rad/s², (10.8), where `gravity` is that which the
    /// pivot's acceleration makes apparent, −a.
    pub(super) fn accelerate(
        &self,
        builder: &mut Builder,
        elimination: &Elimination,
        gravity: Pair,
    ) -> [ValueId; 2] {
        // The offset first: what it is formed of need not be kept for this.
        let mut tangential = builder.neg(elimination.offset);
        for (gain, component) in elimination.gain.into_iter().zip(gravity) {
            let part = builder.mul(gain, component);
            tangential = builder.add(tangential, part);
        }
        if !builder.is(self.inverse_length, 1) {
            builder.name(tangential, &format!("tangential{}", self.suffix));
        }
        builder.hint(tangential, &format!("tangential{}", self.suffix));
        let alpha = builder.mul(self.inverse_length, tangential);
        if !self.suffix.is_empty() {
            builder.name(alpha, &format!("alpha{}", self.suffix));
        }
        [tangential, alpha]
    }

    /// v (ω̇ + i ω²): the acceleration against the pivot's at λ = 1.
    pub(super) fn end_acceleration(&self, builder: &mut Builder, tangential: ValueId) -> Pair {
        let centripetal = self.centripetal(builder);
        builder.turn([tangential, centripetal], self.direction)
    }

    /// The apparent gravity at λ: −a − λ v (ω̇ + i ω²).
    pub(super) fn gravity_at(
        &self,
        builder: &mut Builder,
        place: Pair,
        gravity: Pair,
        tangential: ValueId,
    ) -> Pair {
        let centripetal = self.centripetal(builder);
        let y = self.attachment(builder, place);
        let inwards = inwards(builder, centripetal, y);
        let forwards = builder.scale_pair(tangential, y);
        let steady = builder.sub_pairs(gravity, inwards);
        builder.sub_pairs(steady, forwards)
    }
}

/// i ω² r.
fn inwards(builder: &mut Builder, centripetal: ValueId, r: Pair) -> Pair {
    let [x, y] = builder.scale_pair(centripetal, r);
    [builder.neg(y), x]
}

/// γ = γ' − b κ/J, and γ' + b ω̇ where ω̇ is given.
pub(super) fn passed_on(builder: &mut Builder, force: Pair, torque: ValueId, gain: Pair) -> Pair {
    let part = builder.scale_pair(torque, gain);
    builder.add_pairs(force, part)
}
