//! A scene for the advisor: exact equations, starts, outputs, and candidates.

use branched_pendulum::approximate::{Approximation, Linear};
use branched_pendulum::prelude::*;
use branched_pendulum_advice::{AdviceError, Advisor, Candidates, ModelForm, Wanted};

use super::scenes::{
    Branch, BranchInPhase, BranchLoops, Cascade, CascadeInPhase, CascadeWrittenOut, PaperInPhase,
};
use crate::scenes::BranchedDouble;
use branched_pendulum_frame::Failure;

/// Name of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneName {
    /// The paper's pendulum, released near its threshold.
    Paper,
    /// A cascade of 63 rods.
    Cascade,
    /// A branch of 31 springy rods with friction.
    Branch,
}

impl SceneName {
    /// All scenes.
    pub const ALL: [Self; 3] = [Self::Paper, Self::Cascade, Self::Branch];

    /// Returns the name for titles.
    pub fn title(self) -> &'static str {
        match self {
            Self::Paper => "the paper's pendulum near the threshold",
            Self::Cascade => "cascade of 63 links",
            Self::Branch => "branch of 31 links",
        }
    }
}

/// Name of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputName {
    /// All angles, in rad.
    Angles,
    /// The energy, in J.
    Energy,
    /// The ends of all links, in pixels (a thousand per metre).
    Pixels,
    /// The energy transfer into the antiphase mode, in W.
    Transfer,
}

impl OutputName {
    /// Returns the name of the output.
    pub fn word(self) -> &'static str {
        match self {
            Self::Angles => "angles",
            Self::Energy => "energy",
            Self::Pixels => "pixels",
            Self::Transfer => "transfer",
        }
    }
}

/// A question to the advisor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// The scene.
    pub scene: SceneName,
    /// The output that must be right.
    pub output: OutputName,
    /// Largest error of the output, in its unit.
    pub tolerance: f64,
    /// End time, in s.
    pub horizon: f64,
    /// Number of samples a second.
    pub rate: f64,
    /// Number of releases.
    pub starts: u32,
}

/// Pixels per metre.
const PIXELS: f64 = 1000.0;

/// Highest frequency (Hz) of the modes of the branch that the truncated linear model keeps.
const SLOW: f64 = 3.0;

/// Largest drift of the energy after the motion has become unpredictable, in J.
const DRIFT: f64 = 1e-6;

/// Builds the scene of a question and passes it, with the candidates, to `ask`.
///
/// # Errors
/// [`Failure::Advice`].
pub fn with<R>(
    question: &Question,
    ask: impl FnOnce(&Advisor<'_>, &Candidates<'_>) -> Result<R, AdviceError>,
) -> Result<R, Failure> {
    let answer = match question.scene {
        SceneName::Paper => paper(question, ask),
        SceneName::Cascade => cascade(question, ask),
        SceneName::Branch => branch(question, ask),
    };
    answer.map_err(Failure::advice)
}

/// Adds the starts, times and outputs common to all scenes to an advisor. `release` returns the
/// angles of a start, given its deviation from the release of the scene.
fn requests<'a, M: Energy<f64> + Positions<f64>>(
    mut advisor: Advisor<'a>,
    question: &Question,
    model: &'a M,
    release: impl Fn(f64) -> Vec<f64>,
) -> Advisor<'a> {
    let count = (question.horizon * question.rate).round().max(1.0) as u32;
    let sample = |index| question.horizon * f64::from(index) / f64::from(count);
    advisor = advisor.at((1..=count).map(sample).collect());
    for index in 0..question.starts {
        // Starts within a hundredth of a radian; the first is the scene's release.
        let deviation = 0.01 * f64::from(index) / f64::from(question.starts.max(2) - 1);
        advisor = advisor.start(State::at_rest(0.0, &release(deviation)));
    }
    let tolerance = question.tolerance;
    match question.output {
        OutputName::Angles => advisor.wanted(Wanted::angles(tolerance)),
        OutputName::Energy => advisor.wanted(Wanted::energy(model, tolerance)),
        OutputName::Pixels => advisor.wanted(Wanted::pixels(model, PIXELS, tolerance)),
        OutputName::Transfer => advisor,
    }
}

fn paper<R>(
    question: &Question,
    ask: impl FnOnce(&Advisor<'_>, &Candidates<'_>) -> Result<R, AdviceError>,
) -> Result<R, AdviceError> {
    let (model, chain) = (BranchedDouble::new(), PaperInPhase::new());
    let ode = AbsoluteAngles(&model);
    let release = |more: f64| vec![47.8_f64.to_radians() + more, 1e-3, -1e-3];
    let mut advisor = requests(Advisor::new(&ode), question, &model, release)
        .conserved(Wanted::energy(&model, DRIFT));
    if question.output == OutputName::Transfer {
        let transfer = |_: f64, state: &[f64], out: &mut Vec<f64>| {
            let (q, v) = state.split_at(state.len() / 2);
            let (q, v) = (three(q), three(v));
            let (q, v) = (model.to_symmetric(&q), model.to_symmetric(&v));
            out.push(model.transfer_exact_from_rates(&q, &v).total());
        };
        advisor = advisor.wanted(Wanted::new("transfer", "W", question.tolerance, transfer));
    }
    let symmetric = ModelForm::new("symmetric")
        .entry("emit(symmetric)")
        .system("SymmetricCoordinates(&model)")
        .through(
            |state| by_halves(state, |half| model.to_symmetric(half)),
            |state| by_halves(state, |half| model.from_symmetric(half)),
        );
    let in_phase = ModelForm::new("in phase")
        .entry("in_phase(child)")
        .reduced(PaperInPhase::WHOLE);
    let written_out = ModelForm::new("written out");
    let mut candidates = Candidates::new()
        .series(&in_phase, AbsoluteAngles(&chain))
        .series(&written_out, AbsoluteAngles(&model))
        .rates(&symmetric, SymmetricCoordinates(&model));
    if question.starts > 1 {
        candidates = candidates.lanes_with_series(&written_out, AbsoluteAngles(&model));
    }
    ask(&advisor, &candidates)
}

fn cascade<R>(
    question: &Question,
    ask: impl FnOnce(&Advisor<'_>, &Candidates<'_>) -> Result<R, AdviceError>,
) -> Result<R, AdviceError> {
    let (model, written_out, chain) = (
        Cascade::new(),
        CascadeWrittenOut::new(),
        CascadeInPhase::new(),
    );
    let ode = AbsoluteAngles(&model);
    let links = Cascade::LINKS;
    let advisor = requests(Advisor::new(&ode), question, &model, |more| {
        released(links, 0.4 + more)
    })
    .conserved(Wanted::energy(&model, DRIFT));
    // Links are ordered generation by generation in loops, and branch by branch if the tree is
    // written out, or would be without its reduction: Taylor series are written out.
    let places = link_indices(&model, &written_out);
    let out = ModelForm::new("written out")
        .entry("code = unrolled")
        .ordered(&places);
    let in_phase = ModelForm::new("in phase")
        .entry("in_phase(all)")
        .reduced(CascadeInPhase::WHOLE)
        .ordered(&places);
    let candidates = Candidates::new()
        .series(&in_phase, AbsoluteAngles(&chain))
        .rates(&ModelForm::new("loops"), AbsoluteAngles(&model))
        .rates(&out, AbsoluteAngles(&written_out));
    ask(&advisor, &candidates)
}

fn branch<R>(
    question: &Question,
    ask: impl FnOnce(&Advisor<'_>, &Candidates<'_>) -> Result<R, AdviceError>,
) -> Result<R, AdviceError> {
    let (model, loops, chain) = (Branch::new(), BranchLoops::new(), BranchInPhase::new());
    let ode = AbsoluteAngles(&model);
    let links = Branch::LINKS;
    let advisor = requests(Advisor::new(&ode), question, &model, |more| {
        released(links, 0.3 + more)
    });
    let in_loops = ModelForm::new("loops")
        .entry("code = loops")
        .ordered(&link_indices(&model, &loops));
    let in_phase = ModelForm::new("in phase")
        .entry("in_phase(all)")
        .reduced(BranchInPhase::WHOLE);
    let mut candidates = Candidates::new();
    // Models without a linear model are left out.
    if let Ok(all) = Linear::about(&model, &vec![0.0; links]) {
        candidates = linear(candidates, "linear", "", &all, 1.0 / question.rate);
        let slow = all.truncate(SLOW);
        let truncate = format!(".truncate({SLOW:.1})");
        candidates = linear(
            candidates,
            "slow modes",
            &truncate,
            &slow,
            1.0 / question.rate,
        );
    }
    let candidates = candidates
        .series(&in_phase, AbsoluteAngles(&chain))
        .rates(&in_loops, AbsoluteAngles(&loops))
        .series(&ModelForm::new("written out"), AbsoluteAngles(&model));
    ask(&advisor, &candidates)
}

/// Adds a linear model with frames of this length, in `f64` and in `f32`.
fn linear<'a>(
    candidates: Candidates<'a>,
    name: &str,
    truncated: &str,
    linear: &Linear,
    frame: f64,
) -> Candidates<'a> {
    let form = |scalar: &str| {
        ModelForm::new(name).entry("emit(energies)").system(format!(
            "let mut linear = Linear::about(&model, &[0.0; N])?{truncated}.frames::<{scalar}>({frame:?})?; linear.step(&mut state);"
        ))
    };
    let (Ok(mut double), Ok(mut single)) =
        (linear.frames::<f64>(frame), linear.frames::<f32>(frame))
    else {
        return candidates;
    };
    candidates
        .frames(&form("f64"), "f64", frame, move |state: &mut [f64]| {
            double.step(state);
        })
        .frames(&form("f32"), "f32", frame, move |state: &mut [f32]| {
            single.step(state);
        })
}

/// Returns the angles of a release: the root has the given angle, the other links deviate from the
/// vertical by at most a thousandth of a radian.
fn released(links: usize, angle: f64) -> Vec<f64> {
    let below = |link: usize| 0.25 * angle + 5e-4 * ((7 * link % 5) as f64 - 2.0);
    let angle = |link| if link == 0 { angle } else { below(link) };
    (0..links).map(angle).collect()
}

fn three(half: &[f64]) -> [f64; 3] {
    half.try_into().unwrap_or([f64::NAN; 3])
}

/// Applies a map of three values to the angles and to the rates of a state.
fn by_halves(state: &[f64], map: impl Fn(&[f64; 3]) -> [f64; 3]) -> Vec<f64> {
    let (q, v) = state.split_at(state.len() / 2);
    [map(&three(q)), map(&three(v))].concat()
}

/// Returns, for each link of a model, the index of the link with the same name in another model.
fn link_indices<P: Pendulum<f64>, Q: Pendulum<f64>>(model: &P, other: &Q) -> Vec<usize> {
    let (own, others) = (model.link_names().into_iter(), other.link_names());
    let place = |(link, own)| {
        others
            .iter()
            .position(|other| *other == own)
            .unwrap_or(link)
    };
    own.enumerate().map(place).collect()
}
