//! Trees that are shipped with the program.

/// A description that is shipped.
pub struct Shipped {
    /// Name.
    pub name: &'static str,
    /// The description.
    pub text: &'static str,
    /// Default values of the parameters.
    pub values: &'static [(&'static str, f64)],
}

/// All shipped trees, in the order in which they are listed.
pub const SHIPPED: [Shipped; 9] = [
    Shipped {
        name: "paper",
        text: include_str!("../trees/paper.txt"),
        values: &[("friction", 0.0)],
    },
    Shipped {
        name: "apparatus",
        text: include_str!("../trees/apparatus.txt"),
        values: &[
            ("gravity", 9.80665),
            ("mass_1", 0.12880),
            ("com_1", 0.084),
            ("inertia_1", 1.88e-3),
            ("joint_1", 0.27),
            ("viscous_1", 1e-4),
            ("coulomb_1", 0.0),
            ("quadratic_1", 0.0),
            ("mass_2", 0.10531),
            ("com_2", 0.043),
            ("inertia_2", 0.516e-3),
            ("viscous_2", 2e-5),
            ("coulomb_2", 0.0),
            ("quadratic_2", 0.0),
        ],
    },
    Shipped {
        name: "double-pendulum",
        text: include_str!("../trees/double-pendulum.txt"),
        // Those that the authors of its measurements fitted (K. Kaheman et al., arXiv:2205.06231;
        // their repository's `ParameterEstimation/DoublePendulum`), whose friction is viscous.
        values: &[
            ("gravity", 9.80858023),
            ("mass_1", 0.0938439748),
            ("com_1", 0.108565215),
            ("inertia_1", 4.37529430e-4),
            ("joint_1", 0.172719204),
            ("viscous_1", 2.37142783e-4),
            ("coulomb_1", 0.0),
            ("quadratic_1", 0.0),
            ("mass_2", 0.137595970),
            ("com_2", 0.116779018),
            ("inertia_2", 1.26882939e-3),
            ("viscous_2", 1.00000019e-5),
            ("coulomb_2", 0.0),
            ("quadratic_2", 0.0),
        ],
    },
    Shipped {
        name: "chain",
        text: include_str!("../trees/chain.txt"),
        values: &[
            ("upper_length", 0.3),
            ("lower_length", 0.2),
            ("friction", 0.0),
        ],
    },
    Shipped {
        name: "triple",
        text: include_str!("../trees/triple.txt"),
        values: &[("friction", 0.0)],
    },
    Shipped {
        name: "y",
        text: include_str!("../trees/y.txt"),
        values: &[],
    },
    Shipped {
        name: "branch",
        text: include_str!("../trees/branch.txt"),
        values: &[],
    },
    Shipped {
        name: "coupled",
        text: include_str!("../trees/coupled.txt"),
        values: &[("bar_mass", 10.0), ("coupling", 0.01)],
    },
    Shipped {
        name: "cascade",
        text: include_str!("../trees/cascade.txt"),
        values: &[
            ("mass_ratio", 0.5),
            ("length_ratio", 0.7),
            ("friction", 1e-5),
            ("friction_ratio", 1e6),
            ("sibling_friction", 0.0),
            ("gravity", 9.80665),
        ],
    },
];

/// Returns the names of the shipped trees.
pub fn names() -> String {
    let names = SHIPPED.each_ref().map(|shipped| shipped.name);
    names.join(", ")
}
