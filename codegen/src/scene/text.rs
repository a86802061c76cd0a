//! Prints a scene, one line for each link, orbit (set of equal copies of one link), group and
//! parameter.

use std::fmt::{self, Display, Formatter};

use super::{
    BudgetRequest, DescribedTranslationalSpringDamper, Drive, FrictionContact, FrictionLaw,
    GradientRequest, Group, LawConstant, Layout, LineEnds, Lineage, Link, NodeMotion, Observable,
    Offset, Orbit, Parameter, PassiveTorques, Quantity, Reduction, Requests, Requirement, Scene,
    Sign, TransferRequest, WholeNode, WholeOrder,
};

impl Display for Scene {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            name,
            crate_path,
            gravity,
            links,
            orbits: _,
            groups: _,
            drive,
            parameters,
            requirements,
            requests,
            observables,
            prescribed,
            spring_dampers,
            translational,
            reduction: _,
            lineage: _,
            layout: _,
        } = self;
        writeln!(f, "scene {name}")?;
        writeln!(f, "crate {crate_path}")?;
        writeln!(f, "gravity {} m/s²", gravity.display(parameters))?;
        for Parameter { name, doc, sign } in parameters {
            writeln!(f, "parameter {name}, {sign}: {doc}")?;
        }
        for Requirement {
            what,
            quantity,
            sign,
            magnitudes,
        } in requirements
        {
            let (quantity, range) = (quantity.display(parameters), magnitudes.text);
            writeln!(f, "require {quantity} {sign}, {range}: {what}")?;
        }
        self.write_layout(f)?;
        for link in links {
            self.write_link(link, f)?;
        }
        self.write_orbits(f)?;
        for (name, signal, unit) in drive.iter().flat_map(Drive::parts) {
            writeln!(f, "drive {name} {} {unit}", signal.display(parameters))?;
        }
        for set in prescribed {
            writeln!(f, "prescribed {}", set.members.join(", "))?;
        }
        for spring_damper in spring_dampers {
            writeln!(f, "{}", spring_damper.what)?;
            self.write_passive(&spring_damper.torques, f)?;
        }
        for own in translational {
            self.write_straight(own, f)?;
        }
        writeln!(f, "requests {requests}")?;
        for Observable { name, value } in observables {
            writeln!(f, "observable {name} = {}", value.display(parameters))?;
        }
        Ok(())
    }
}

impl Display for WholeNode {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        if self.copies > 1 {
            let how = if self.in_phase { "in phase" } else { "apart" };
            write!(f, ", {} copies {how}", self.copies)?;
        }
        match &self.motion {
            NodeMotion::Moving { .. } => Ok(()),
            NodeMotion::Locked { angle } => write!(f, ", locked at {angle}"),
        }
    }
}

impl Scene {
    /// Writes which links represent the whole tree, if the scene does not hold all links.
    fn write_layout(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.layout {
            Layout::Unrolled => {}
            Layout::Generations { branching, links } => writeln!(
                f,
                "{links} links in generations, {branching} under each; one of each:"
            )?,
            Layout::Links => writeln!(f, "in a loop over the links")?,
        }
        if let Some(Lineage { generations }) = self.lineage {
            writeln!(f, "one branching open in each of {generations} generations")?;
        }
        if let Some(Reduction {
            order,
            links,
            orbits,
        }) = &self.reduction
        {
            let order = match order {
                WholeOrder::DepthFirst => "depth first",
                WholeOrder::Generations => "by generations",
            };
            writeln!(f, "stands for {links} links, {order}:")?;
            for orbit in orbits {
                writeln!(f, "    {orbit}")?;
            }
        }
        Ok(())
    }

    /// Writes the orbits (equal copies of a node) and the groups of sibling copies.
    fn write_orbits(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for Orbit {
            name,
            node: _,
            depth,
            links,
        } in &self.orbits
        {
            let links = self.names(links.iter().map(|link| link.0));
            writeln!(f, "orbit {name}, depth {depth}: {links}")?;
        }
        for Group {
            name,
            parent,
            copies,
        } in &self.groups
        {
            write!(f, "group {name}")?;
            if let Some(parent) = parent {
                write!(f, " on {}", self.names([parent.0]))?;
            }
            writeln!(f, ": {}", self.names(copies.iter().map(|copy| copy.0)))?;
        }
        Ok(())
    }

    /// Writes a straight spring and damper.
    fn write_straight(
        &self,
        own: &DescribedTranslationalSpringDamper,
        f: &mut Formatter<'_>,
    ) -> fmt::Result {
        let DescribedTranslationalSpringDamper {
            what,
            ends,
            potentials,
            friction,
        } = own;
        let shown = |quantity: &Quantity| quantity.display(&self.parameters).to_string();
        let point = |at: &Offset| format!("({}, {})", shown(&at.along), shown(&at.lateral));
        write!(f, "straight {what}")?;
        match ends {
            LineEnds::Links(_, [first, second]) => {
                write!(f, ", from {} to {} m", point(first), point(second))?;
            }
            LineEnds::Guy(_, at, [x, y]) => {
                write!(
                    f,
                    ", from {} m to ({}, {}) m",
                    point(at),
                    shown(x),
                    shown(y)
                )?;
            }
        }
        let stored = potentials.iter().flat_map(|own| own.quantities());
        for (name, value, unit) in stored.chain([("friction", friction, "N s/m")]) {
            if !value.is_zero() {
                write!(f, ", {name} {} {unit}", shown(value))?;
            }
        }
        writeln!(f)
    }

    /// Writes a link and, indented, its properties.
    fn write_link(&self, link: &Link, f: &mut Formatter<'_>) -> fmt::Result {
        let Link {
            name,
            parent,
            orbit: _,
            mass,
            inertia,
            com,
            pivot,
            end,
            passive,
        } = link;
        let show = |Offset { along, lateral }: &Offset| {
            let along = along.display(&self.parameters);
            format!("({along}, {})", lateral.display(&self.parameters))
        };
        match parent {
            Some(parent) => {
                writeln!(
                    f,
                    "link {name} on {} at {} m",
                    self.names([parent.0]),
                    show(pivot)
                )?;
            }
            None => writeln!(f, "link {name} on the ground")?,
        }
        writeln!(f, "    mass {} kg", mass.display(&self.parameters))?;
        writeln!(f, "    inertia {} kg m²", inertia.display(&self.parameters))?;
        writeln!(f, "    com {} m", show(com))?;
        if self.requests.positions {
            writeln!(f, "    end {} m", show(end))?;
        }
        self.write_passive(passive, f)
    }

    /// Writes, indented, the nonzero passive torques.
    fn write_passive(&self, passive: &PassiveTorques, f: &mut Formatter<'_>) -> fmt::Result {
        let forces = [
            ("friction", &passive.friction, "N m s"),
            ("drag", &passive.drag, "N m s"),
            ("spring", &passive.spring, "N m"),
            ("rest", &passive.rest, "rad"),
        ];
        for (name, force, unit) in forces.into_iter().filter(|(_, force, _)| !force.is_zero()) {
            writeln!(f, "    {name} {} {unit}", force.display(&self.parameters))?;
        }
        for place in FrictionContact::ALL {
            let law = passive.law(place);
            if law.is_none() {
                continue;
            }
            let constants = FrictionLaw::NAMES.into_constants().into_iter();
            let values = law.effective(Quantity::is_zero).into_constants();
            let given = constants.zip(values).filter_map(|(constant, value)| {
                let LawConstant { member, unit, .. } = constant;
                Some(format!(
                    "{member} {} {unit}",
                    value?.display(&self.parameters)
                ))
            });
            let given: Vec<String> = given.collect();
            writeln!(f, "    {} {}", place.property(), given.join(", "))?;
        }
        Ok(())
    }

    /// Returns the names of links, joined.
    fn names(&self, links: impl IntoIterator<Item = usize>) -> String {
        let names: Vec<&str> = links
            .into_iter()
            .map(|link| self.links.get(link).map_or("?", |link| link.name.as_str()))
            .collect();
        names.join(", ")
    }
}

impl Display for Sign {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Any => "any",
            Self::Hanging => "non-negative",
            Self::Standing => "non-positive",
            Self::NonNegative => "non-negative",
            Self::Positive => "positive",
        })
    }
}

impl Display for Requests {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            solve,
            transfer,
            budget,
            small,
            gradient,
            ..
        } = self;
        write!(f, "accelerations")?;
        if let Some(solve) = solve {
            write!(f, " by {}", solve.name())?;
        }
        for (name, _) in self.named() {
            write!(f, ", {name}")?;
        }
        if !small.is_empty() {
            write!(f, ", small in {} sectors", small.len())?;
        }
        if let Some(transfer) = transfer {
            write!(f, ", {transfer}")?;
        }
        if let Some(gradient) = gradient {
            write!(f, ", {gradient}")?;
        }
        match budget {
            Some(budget) => write!(f, ", {budget}"),
            None => Ok(()),
        }
    }
}

impl Display for GradientRequest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            accelerations,
            energies,
            transfer,
            observables,
        } = self;
        let flags = [
            (accelerations, "accelerations"),
            (energies, "energies"),
            (transfer, "transfer"),
        ];
        let named = flags.iter().filter(|(wanted, _)| **wanted);
        let named = named.map(|(_, name)| *name);
        let names: Vec<&str> = named
            .chain(observables.iter().map(String::as_str))
            .collect();
        write!(f, "gradient({})", names.join(", "))
    }
}

impl Display for BudgetRequest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            rest,
            canonical,
            parseval,
            velocity,
            matrix,
            scales,
            amplitude_orders,
            angle_orders,
            small,
        } = self;
        let flags = [
            (rest, "rest"),
            (canonical, "canonical"),
            (parseval, "parseval"),
            (velocity, "velocity"),
            (matrix, "matrix"),
            (scales, "scales"),
        ];
        let named = flags.iter().filter(|(wanted, _)| **wanted);
        let forms: Vec<String> = named
            .map(|(_, name)| (*name).to_owned())
            .chain(orders(angle_orders, amplitude_orders))
            .chain((!small.is_empty()).then(|| format!("small in {} sectors", small.len())))
            .collect();
        write!(f, "budget({})", forms.join(", "))
    }
}

impl Display for TransferRequest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            angle_orders,
            amplitude_orders,
            exact,
        } = self;
        let forms: Vec<String> = orders(angle_orders, amplitude_orders)
            .chain(exact.then(|| "exact".to_owned()))
            .collect();
        write!(f, "transfer({})", forms.join(", "))
    }
}

/// Returns truncated forms in the notation of the attribute.
fn orders(angle: &[u32], amplitude: &[u32]) -> impl Iterator<Item = String> {
    let angles = angle.iter().map(|order| format!("angle = {order}"));
    let amplitudes = amplitude.iter().map(|order| format!("amplitude = {order}"));
    angles.chain(amplitudes)
}
