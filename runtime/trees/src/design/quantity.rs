//! Quantities of a tree that may be targets of a design.

use branched_pendulum::analysis::SectorModes;
use branched_pendulum::analysis::normal_form::{DegreeEstimate, Tongues};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::sectors::{Sector, Sectors};
use branched_pendulum::system::Model;
use branched_pendulum_measure::design::DesignError;

use super::DesignSettings;
use crate::description::TreeDescription;
use crate::in_phase::DifferenceGrowth;
use crate::normal_form::TreeNormalForm;
use crate::symmetric::Symmetry;
use crate::tree::PendulumTree;

/// Name of the sector in which all copies move in phase.
const IN_PHASE: &str = "in_phase";

/// Number of angles behind the first one with growth that are scanned for the same tongue by the
/// lower degree.
const BEHIND: usize = 16;

/// Coupling between sectors, relative to the largest entry of a matrix, from which on the modes of
/// one sector are not those of the tree.
const COUPLED: f64 = 1e-9;

/// Quantity of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeQuantity {
    /// Frequency of a mode, by its place in ascending order.
    Mode(usize),
    /// Frequency of a mode in phase.
    InPhase(usize),
    /// Frequency of a mode of the difference between copies, in the sector with this index.
    Difference {
        /// Index of the sector.
        sector: usize,
        /// Place of the mode in the sector.
        mode: usize,
    },
    /// Smallest angle of release from which a difference grows.
    Threshold,
    /// Growth rate of a difference after a release.
    Growth,
}

impl TreeQuantity {
    /// Returns the unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Mode(_) | Self::InPhase(_) | Self::Difference { .. } => "Hz",
            Self::Threshold => "degrees",
            Self::Growth => "1/s",
        }
    }
}

/// Value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuantityValue {
    /// The value, in the unit of the quantity.
    pub value: f64,
    /// Error of a value by the normal form: the difference between the two highest degrees.
    pub error: Option<f64>,
}

impl QuantityValue {
    fn exact(value: f64) -> Self {
        Self { value, error: None }
    }

    fn of(estimate: DegreeEstimate) -> Self {
        Self {
            value: estimate.value,
            error: Some(estimate.error()),
        }
    }
}

/// Names of the quantities that a tree has.
pub(super) struct QuantityNames(Vec<(String, TreeQuantity)>);

/// Names of the quantities of the difference between copies, in words.
const OF_COPIES: &str =
    "and of trees with copies, written as `* 2`, f_1, d_1, threshold and growth";

impl QuantityNames {
    pub(super) fn of(description: &TreeDescription, copies: Option<&Copies>) -> Self {
        let sectors = Symmetry::of(&description.scene).sectors;
        let links: usize = sectors.iter().map(|own| own.coordinates().len()).sum();
        let mode = |mode| (format!("mode_{}", mode + 1), TreeQuantity::Mode(mode));
        let mut all: Vec<(String, TreeQuantity)> = (0..links).map(mode).collect();
        let pair = copies.and_then(|copies| copies.groups().first());
        let Some(&[one, other, ..]) = pair.map(Vec::as_slice) else {
            return Self(all);
        };
        let in_phase = sectors.iter().find(|own| own.name() == IN_PHASE);
        let in_phase = in_phase.map_or(0, |own| own.coordinates().len());
        let mode = |mode| (format!("f_{}", mode + 1), TreeQuantity::InPhase(mode));
        all.extend((0..in_phase).map(mode));
        if in_phase == 2 {
            all.push(("f_+".to_owned(), TreeQuantity::InPhase(0)));
            all.push(("f_-".to_owned(), TreeQuantity::InPhase(1)));
        }
        if let Some(sector) = sectors.iter().position(|own| parts(own, one, other)) {
            let count = sectors.get(sector).map_or(0, |own| own.coordinates().len());
            let of = |mode| TreeQuantity::Difference { sector, mode };
            all.extend((0..count).map(|mode| (format!("d_{}", mode + 1), of(mode))));
            if count == 1 {
                all.push(("f_d".to_owned(), of(0)));
            }
        }
        all.push(("threshold".to_owned(), TreeQuantity::Threshold));
        all.push(("window".to_owned(), TreeQuantity::Threshold));
        all.push(("growth".to_owned(), TreeQuantity::Growth));
        Self(all)
    }

    pub(super) fn quantity(&self, name: &str) -> Result<TreeQuantity, DesignError> {
        let found = self.0.iter().find(|(own, _)| own == name);
        found.map(|(_, own)| *own).ok_or_else(|| {
            let mut quantities: Vec<String> = self.0.iter().map(|(own, _)| own.clone()).collect();
            if !quantities.iter().any(|own| own == "threshold") {
                quantities.push(OF_COPIES.to_owned());
            }
            DesignError::UnknownQuantity {
                name: name.to_owned(),
                quantities,
            }
        })
    }
}

/// Returns true if a coordinate of the sector is a difference between two links.
fn parts(sector: &Sector, one: usize, other: usize) -> bool {
    let mut all = sector.coordinates().iter();
    all.any(|coordinate| {
        let weight = |link: usize| {
            let mut weights = coordinate.weights().iter();
            weights.find(|(own, _)| *own == link).map(|own| own.1)
        };
        weight(one).zip(weight(other)).is_some_and(|(a, b)| a != b)
    })
}

/// Computes quantities of one tree; several quantities share the modes and the normal form.
pub(super) struct Evaluation<'a> {
    tree: &'a PendulumTree,
    settings: &'a DesignSettings,
    modes: Option<(Vec<f64>, SectorModes)>,
    form: Option<(TreeNormalForm, f64)>,
}

impl<'a> Evaluation<'a> {
    pub(super) fn new(tree: &'a PendulumTree, settings: &'a DesignSettings) -> Self {
        Self {
            tree,
            settings,
            modes: None,
            form: None,
        }
    }

    /// Returns the value of a quantity, or the reason why it has none.
    pub(super) fn value(&mut self, quantity: TreeQuantity) -> Result<QuantityValue, String> {
        let in_block = |(_, sectors): &(Vec<f64>, SectorModes), index: usize, mode: usize| {
            if sectors.mass_off_block.max(sectors.stiffness_off_block) > COUPLED {
                return Err(
                    "the tree rests with its copies apart; help: name the mode by its \
                            place in ascending order, as in `mode_1`"
                        .to_owned(),
                );
            }
            let block = sectors.blocks.get(index);
            let found = block.and_then(|block| block.modes.frequencies_hz.get(mode));
            Ok(found.copied().unwrap_or(f64::NAN))
        };
        match quantity {
            TreeQuantity::Mode(mode) => {
                let (all, _) = self.modes()?;
                let frequency = all.get(mode).copied().unwrap_or(f64::NAN);
                Ok(QuantityValue::exact(frequency))
            }
            TreeQuantity::InPhase(mode) => {
                let sectors = self.tree.sectors();
                let index = sectors.iter().position(|own| own.name() == IN_PHASE);
                let index = index.unwrap_or(usize::MAX);
                Ok(QuantityValue::exact(in_block(self.modes()?, index, mode)?))
            }
            TreeQuantity::Difference { sector, mode } => {
                Ok(QuantityValue::exact(in_block(self.modes()?, sector, mode)?))
            }
            TreeQuantity::Threshold => self.threshold().map(QuantityValue::of),
            TreeQuantity::Growth => self.growth().map(QuantityValue::of),
        }
    }

    /// Returns the frequencies of all modes, and the modes of each sector.
    fn modes(&mut self) -> Result<&(Vec<f64>, SectorModes), String> {
        if self.modes.is_none() {
            let tree = self.tree;
            let rest = tree.stable_equilibrium(&vec![0.0; tree.links()]);
            let theta = rest.map_err(|error| error.to_string())?.theta;
            let all = tree.modes(&theta).map_err(|error| error.to_string())?;
            let matrices = [tree.mass_matrix(&theta), tree.stiffness_matrix(&theta)];
            let blocks = SectorModes::new(tree.sectors(), &matrices[0], &matrices[1]);
            let blocks = blocks.map_err(|error| error.to_string())?;
            self.modes = Some((all.frequencies_hz, blocks));
        }
        self.modes.as_ref().ok_or_else(String::new)
    }

    /// Returns the normal form, and the rate (1/s) at which friction damps a difference.
    fn form(&mut self) -> Result<&(TreeNormalForm, f64), String> {
        if self.form.is_none() {
            let copies = self.settings.copies.as_ref();
            let copies = copies.ok_or("the tree has no copies")?;
            let differences = DifferenceGrowth::new(self.tree, copies, Vec::new(), 1.0);
            let differences = differences.map_err(|error| error.to_string())?;
            if differences.system().start(&self.settings.release).is_none() {
                return Err("the copies do not start in phase: give them the same angle".to_owned());
            }
            let decay = differences.decay();
            let form = self.tree.normal_form(copies, self.settings.form.clone());
            self.form = Some((form.map_err(|error| error.to_string())?, decay));
        }
        self.form.as_ref().ok_or_else(String::new)
    }

    fn threshold(&mut self) -> Result<DegreeEstimate, String> {
        let settings = self.settings;
        let (form, decay) = self.form()?;
        let predict = |degrees: f64| {
            let mut release = settings.release.clone();
            for link in &settings.scanned {
                if let Some(angle) = release.values.get_mut(*link) {
                    *angle = degrees.to_radians();
                }
            }
            form.predict(&release)
        };
        let (all, least) = (&settings.angles_deg, settings.least + decay);
        // Nothing behind the first tongue, or the first angle without a prediction, matters.
        let is_last = |degrees: &f64| match predict(*degrees) {
            Ok(prediction) => prediction.excess(least).value >= 0.0,
            Err(_) => true,
        };
        let first = all.iter().position(is_last).unwrap_or(all.len());
        let scanned = all.get(..first + BEHIND).unwrap_or(all);
        let found = Tongues::along(scanned, least, predict);
        let first = found.tongues.first();
        let before = found
            .refused
            .first()
            .filter(|([from, _], _)| first.is_none_or(|tongue| *from < tongue.edges[0].value));
        let last = settings.angles_deg.last().copied().unwrap_or(f64::NAN);
        match (first, before) {
            (_, Some(([from, _], refusal))) => Err(format!(
                "no growth is predicted below {from:.1}°, and from there on nothing: {refusal}"
            )),
            (None, None) => Err(format!("no growth is predicted up to {last}°")),
            (Some(tongue), None) if tongue.is_cut[0] => Err(format!(
                "a difference already grows from the smallest angle, {}°",
                tongue.edges[0].value
            )),
            (Some(tongue), None) => Ok(tongue.edges[0]),
        }
    }

    fn growth(&mut self) -> Result<DegreeEstimate, String> {
        let settings = self.settings;
        let (form, decay) = self.form()?;
        let prediction = form
            .predict(&settings.release)
            .map_err(|error| error.to_string())?;
        let excess = prediction.excess(*decay);
        match excess.value.is_finite() {
            true => Ok(excess),
            false => Err("no resonance is near by which the difference could grow".to_owned()),
        }
    }
}
