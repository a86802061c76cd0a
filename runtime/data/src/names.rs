//! Meanings of columns, derived from their names.

use super::units::{FRAME, Unit};
use super::write::Column;

/// Meaning of a column, derived from its unit and its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    Time,
    Frame,
    Angle,
    /// The unit shows that it is not an angle.
    OtherUnit,
    /// The name shows that it is not an angle but this quantity.
    OtherName(&'static str),
    /// Neither the unit nor the name shows a meaning.
    Unsaid,
}

pub(super) const ANGLE: &[&str] = &[
    "theta", "th", "θ", "ϑ", "phi", "φ", "ϕ", "psi", "ψ", "angle", "angles", "winkel", "ángulo",
    "angulo", "angolo",
];
const COORDINATE: &str = "a coordinate";
const VELOCITY: &str = "a velocity";
const ACCELERATION: &str = "an acceleration";
const FORCE: &str = "a force";
const MOMENTUM: &str = "a momentum";
const ENERGY: &str = "an energy or a power";

const OTHERS: [(&str, &[&str]); 9] = [
    (COORDINATE, &["x", "y", "z", "posx", "posy", "xpos", "ypos"]),
    (
        VELOCITY,
        &[
            "v",
            "vx",
            "vy",
            "vel",
            "velocity",
            "velocities",
            "angvel",
            "speed",
            "omega",
            "ω",
            "gyro",
            "rate",
            "rates",
            "qd",
            "dq",
            "qdot",
            "vitesse",
            "geschwindigkeit",
            "velocidad",
            "velocità",
        ],
    ),
    (
        ACCELERATION,
        &[
            "acc",
            "ax",
            "ay",
            "accel",
            "acceleration",
            "accelerations",
            "angacc",
            "qdd",
            "ddq",
            "beschleunigung",
            "accélération",
            "aceleración",
        ],
    ),
    (
        "a torque",
        &[
            "tau",
            "τ",
            "torque",
            "torques",
            "moment",
            "drehmoment",
            "effort",
        ],
    ),
    (FORCE, &["force", "forces", "kraft", "fx", "fy"]),
    (
        "a current or a voltage",
        &["current", "currents", "courant", "strom", "voltage", "pwm"],
    ),
    (MOMENTUM, &["momentum", "momenta", "impulse"]),
    (ENERGY, &["energy", "energies", "power", "energie"]),
    ("a score", &["likelihood", "score", "confidence"]),
];

/// Letters that have a meaning only if another column exists, as an acceleration next to a
/// velocity, or a rate or an energy next to an angle; and the letter with which they are merely
/// consecutive names.
const LETTERS: [(&str, &str, &str); 5] = [
    ("a", ACCELERATION, "b"),
    ("w", VELOCITY, "u"),
    ("e", ENERGY, "d"),
    ("p", MOMENTUM, "q"),
    ("f", FORCE, "g"),
];

/// Returns the words of a name in lower case, without numbers at their ends; `jointVel` is two
/// words.
pub(super) fn words(name: &str) -> Vec<String> {
    let mut spaced = String::with_capacity(name.len());
    let mut before = ' ';
    for letter in name.chars() {
        if letter.is_uppercase() && before.is_alphanumeric() && !before.is_uppercase() {
            spaced.push(' ');
        }
        spaced.push(letter);
        before = letter;
    }
    let apart = spaced.split(|c: char| !c.is_alphanumeric());
    let words = apart.map(|word| {
        let digit = |c: char| c.is_ascii_digit() || ('\u{2080}'..='\u{2089}').contains(&c);
        word.trim_end_matches(digit).to_lowercase()
    });
    words.filter(|word| !word.is_empty()).collect()
}

/// Returns the quantity, other than an angle, that the words name. Rates of angles are such
/// quantities: `dtheta`, `theta_dot`.
fn other(words: &[String]) -> Option<&'static str> {
    let is_angle = |word: &str| ANGLE.contains(&word);
    let last = words.len().wrapping_sub(1);
    for (index, word) in words.iter().enumerate() {
        for (quantity, names) in OTHERS {
            // A single letter must be the first or the last word.
            let is_whole = word.chars().count() > 1 || index == 0 || index == last;
            if is_whole && names.contains(&word.as_str()) {
                return Some(quantity);
            }
        }
        let before = index.checked_sub(1).map(|before| words[before].as_str());
        for (prefix, suffix, quantity) in [("dd", "ddot", ACCELERATION), ("d", "dot", VELOCITY)] {
            let is_rate = word.strip_prefix(prefix).is_some_and(is_angle)
                || word.strip_suffix(suffix).is_some_and(is_angle)
                || (word == suffix || word == prefix) && before.is_some_and(is_angle);
            if is_rate {
                return Some(quantity);
            }
        }
    }
    None
}

impl Meaning {
    /// Returns the meaning of a column in a table with the columns `all`.
    pub(crate) fn of(column: &Column, all: &[Column]) -> Self {
        if is_frame(column) {
            return Self::Frame;
        }
        match Unit::named(&column.unit) {
            Some(Unit::Time(_)) => return Self::Time,
            Some(Unit::Angle(_)) => return Self::Angle,
            Some(Unit::Length | Unit::Other) => return Self::OtherUnit,
            None if !column.unit.is_empty() => return Self::OtherUnit,
            None if is_time(&column.name) => return Self::Time,
            None => {}
        }
        let own = words(&column.name);
        let is_angle = |words: &[String]| words.iter().any(|word| ANGLE.contains(&word.as_str()));
        match other(&own) {
            // An angle about an axis.
            Some(COORDINATE) if is_angle(&own) => return Self::Angle,
            Some(quantity) => return Self::OtherName(quantity),
            None if is_angle(&own) => return Self::Angle,
            None => {}
        }
        let letter = LETTERS.iter().find(|(letter, _, beside)| {
            own == [*letter] && all.iter().all(|column| column.name != *beside)
        });
        let says_more = |column: &Column| {
            let words = words(&column.name);
            other(&words).is_some() || is_angle(&words)
        };
        match letter {
            Some((_, quantity, _)) if all.iter().any(says_more) => Self::OtherName(quantity),
            _ => Self::Unsaid,
        }
    }
}

/// Returns true if a name means time.
pub(crate) fn is_time(name: &str) -> bool {
    const TIMES: [&str; 21] = [
        "t",
        "time",
        "times",
        "zeit",
        "temps",
        "tiempo",
        "tempo",
        "tijd",
        "tid",
        "čas",
        "время",
        "時間",
        "时间",
        "timestamp",
        "timestamps",
        "stamp",
        "stamps",
        "seconds",
        "elapsed",
        "millis",
        "micros",
    ];
    let name = name.trim().to_lowercase();
    TIMES.contains(&name.as_str()) || words(&name).last().is_some_and(|word| word == "time")
}

/// Returns true if a column counts frames.
pub(crate) fn is_frame(column: &Column) -> bool {
    if column.unit == FRAME {
        return true;
    }
    let name = column.name.trim().to_lowercase();
    const COUNTS: [&str; 9] = [
        "", "step", "index", "sample", "n", "i", "frame", "frames", "picture",
    ];
    let numbered = ["number", "no", "nr", "num", "id", "index", "idx"];
    let words = words(&name);
    let is_numbered = matches!(&words[..], [frame, number]
        if frame == "frame" && numbered.contains(&number.as_str()));
    COUNTS.contains(&name.as_str()) || is_numbered
}

/// Returns a name without characters that rarely distinguish names: `left_a` becomes `left a`.
pub(crate) fn plain(name: &str) -> String {
    let apart = name.split([' ', '_']).filter(|part| !part.is_empty());
    apart.collect::<Vec<_>>().join(" ")
}

/// Name of the point in tables with only one tracked point.
const SINGLE: &str = "point";

/// Returns the point and the axis (`x`, `y` or `likelihood`) of a column with coordinates, if its
/// name has one of the forms `NAME x`, `NAME_x`, `NAME.X`, `x_NAME`, `x1`, `p1x`, `nameX`, or `x`.
pub(super) fn coordinate(name: &str) -> Option<(String, &'static str)> {
    const AXES: [(&str, &str); 5] = [
        ("x", "x"),
        ("X", "x"),
        ("y", "y"),
        ("Y", "y"),
        ("likelihood", "likelihood"),
    ];
    let separators = [' ', '_', '.', ':'];
    let named = |point: &str, axis| {
        let point = point.trim_matches(separators);
        (!point.is_empty()).then(|| (point.to_owned(), axis))
    };
    for (word, axis) in AXES {
        if name == word {
            return Some((SINGLE.to_owned(), axis));
        }
        if let Some(point) = name.strip_suffix(word) {
            let is_apart = point.ends_with(separators)
                || point.ends_with(|c: char| c.is_ascii_digit())
                || word == "X" && point.ends_with(char::is_lowercase)
                || word == "Y" && point.ends_with(char::is_lowercase);
            if is_apart {
                return named(point, axis);
            }
        }
    }
    for (word, axis) in AXES {
        if let Some(point) = name.strip_prefix(word)
            && point.starts_with(|c: char| separators.contains(&c) || c.is_ascii_digit())
        {
            return named(point, axis);
        }
    }
    None
}

/// Returns names in quotation marks for a sentence: the first of many, and the number of the
/// others.
pub(crate) fn quoted(names: &[impl AsRef<str>]) -> String {
    const MOST: usize = 8;
    let mut reported: Vec<String> = names
        .iter()
        .take(MOST)
        .map(|name| format!("`{}`", name.as_ref()))
        .collect();
    if names.len() > MOST {
        reported.push(format!("and {} more", names.len() - MOST));
    }
    reported.join(", ")
}
