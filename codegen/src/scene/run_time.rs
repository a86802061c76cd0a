//! Scenes of trees that are computed as they are described, with equations that no
//! description changes.

use super::Scene;
use super::layout::Layout;
use super::resolve::resolve_scene;
use crate::description::Description;
use crate::report::{Faults, OutputMessage, SizeMessage};

/// Outputs that hold for every tree, so that they need not be asked for.
const ALWAYS: [&str; 6] = [
    "energies",
    "momenta",
    "modes",
    "positions",
    "forces",
    "taylor",
];

/// Outputs that are derived for one tree.
const DERIVED: [&str; 1] = ["transverse"];

/// Most links.
const MOST: usize = 1 << 16;

/// Checks a description as [`resolve`](super::resolve()) does, and that nothing is asked for which
/// has to be derived. Outputs that hold for every tree, or every one with copies, may be asked
/// for or not.
pub fn resolve_at_run_time(description: &Description, report: &mut Faults) -> Option<Scene> {
    let mut refuse = |name: &proc_macro2::Ident, what: String| {
        report.error(name.span(), OutputMessage::NotAtRunTime { what });
    };
    let mut kept = description.clone();
    let is_single = |name: &proc_macro2::Ident| {
        let all = description.requests.iter();
        all.filter(|request| request.name == *name).count() == 1
    };
    kept.requests.retain(|request| {
        let name = request.name.to_string();
        let derived = DERIVED.contains(&name.as_str());
        if derived {
            refuse(&request.name, format!("emit({name})"));
        }
        let known = ALWAYS.contains(&name.as_str()) && request.forms.is_none();
        // One that is written twice is a mistake.
        let always = known && is_single(&request.name);
        !derived && !always
    });
    let scene = resolve_scene(&kept, report)?;
    if let (Layout::Generations { links, .. }, Some(root)) =
        (scene.layout, description.roots.first())
        && links > MOST
    {
        report.error(root.name.span(), SizeMessage::TooManyLinks { limit: MOST });
    }
    report.is_empty().then_some(scene)
}
