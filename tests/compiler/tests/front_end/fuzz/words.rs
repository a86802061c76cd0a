//! Words of random descriptions.

/// Shapes with the properties that they need.
pub(super) const SHAPES: &[(&str, &[&str])] = &[
    ("point", &["mass", "length"]),
    ("rod", &["mass", "length"]),
    ("rod_with_bob", &["mass", "length", "bob_mass"]),
    ("cylinder", &["mass", "length", "radius"]),
    ("disc", &["mass", "radius", "length"]),
    ("ball", &["mass", "radius", "length"]),
    ("plate", &["mass", "length", "width"]),
    ("", &["mass", "com", "inertia", "joint"]),
];

/// Names of links.
#[rustfmt::skip]
pub(super) const LINKS: &[&str] = &[
    "arm", "hand", "finger", "tip", "bob", "twig", "leaf", "stem",
];

/// Names of parameters, some of which look like something else.
#[rustfmt::skip]
pub(super) const PARAMETERS: &[&str] = &[
    "m", "l", "g", "k", "a", "b", "w", "p", "q", "n", "x", "scale",
];

/// Names that are reserved, taken, or no names.
#[rustfmt::skip]
pub(super) const ODD_NAMES: &[&str] = &[
    "sin", "cos", "sqrt", "t", "T", "S", "pi", "PI", "tau", "inf", "nan", "self", "Self",
    "crate", "super", "async", "gen", "type", "r#type", "r#fn", "_", "__", "_a", "a_", "A",
    "mL", "é", "Ω", "true", "time", "out", "new", "momenta", "theta_arm", "omega", "theta",
    "gravity", "inertia_arm", "coupling_hand_arm", "kinetic_energy", "parameters",
    "generations", "links", "scaled", "shared", "convert", "f64", "prismatic", "ball", "alpha",
    "turns", "number", "constant_0", "d", "m_1",
];

/// Numbers at the edges of what is exact, representable or a number.
#[rustfmt::skip]
pub(super) const ODD_NUMBERS: &[&str] = &[
    "0", "0.0", "1", "-1", "1e308", "1.7976931348623157e308", "1e300", "1e200", "1e155",
    "1e100", "1e-100", "1e-155", "1e-200", "1e-300", "5e-324", "2e-324", "1e400", "1e-400",
    "1e401", "1e99999999999", "4294967296", "340282366920938463463374607431768211456", "0x1F",
    "1f64", "1kg", "0.1_5", "1_000",
    "3.141592653589793238462643383279502884197169399375105820974944", "9.8 m", "\"text\"",
    "'c'", "true", "1/3", "(1 - 1)", "(0.1 + 0.2 - 0.3)",
];

/// Names of structs.
#[rustfmt::skip]
pub(super) const STRUCTS: &[&str] = &[
    "Pendulum", "Pendulum", "Pendulum", "Pendulum", "S", "T", "R", "N", "r#type", "f64",
    "Option", "Self", "pendulum", "Vec", "Transfer", "Scalar", "Clone", "K",
];
