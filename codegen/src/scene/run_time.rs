//! Scenes of trees that are described at run time. Their equations are general code for any tree.

use super::layout::Layout;
use super::outputs::Support;
use super::resolve::resolve_scene;
use super::{Requests, Scene};
use crate::description::Description;
use crate::report::{Faults, OutputMessage, SizeMessage};

/// Largest number of links.
const MOST: usize = 1 << 16;

/// Checks a description as [`resolve`](super::resolve()) does, and reports requested outputs that
/// would have to be derived. Outputs that are available for every tree, or for every tree with
/// copies, need not be requested.
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
        let mut flags = Requests::FLAGS.iter();
        let flag = flags.find(|(name, _)| request.name == name);
        match flag.map(|(_, support)| support) {
            // One that is written twice is a mistake.
            Some(Support::Everywhere | Support::RunTime) => {
                request.forms.is_some() || !is_single(&request.name)
            }
            None if request.name == "gradient" => {
                refuse(&request.name, "emit(gradient)".to_owned());
                false
            }
            Some(Support::RunTimeCopies) | None => true,
            Some(Support::WrittenOut) => {
                refuse(&request.name, format!("emit({})", request.name));
                false
            }
        }
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
