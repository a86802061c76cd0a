//! Sectors (differences between copies) that are declared small: in the truncated forms of a
//! budget, or with differences that act back on an in-phase motion.

use proc_macro2::{Ident, Span};

use super::Scene;
use super::coordinates::symmetric_coordinates;
use super::sectors::sectors;
use crate::description::RequestForm;
use crate::report::{Faults, OutputMessage, nearest};

/// Reads the names of the sectors whose differences act back on the in-phase motion; empty means
/// all sectors.
pub(super) fn acting(
    span: Span,
    forms: Option<&[RequestForm]>,
    damaged: bool,
    report: &mut Faults,
) -> Vec<Ident> {
    let Some(forms) = forms else {
        return Vec::new();
    };
    if forms.is_empty() && !damaged {
        report.error(span, OutputMessage::NoSmallSector);
    }
    for RequestForm {
        name,
        value,
        members,
    } in forms
    {
        if value.is_some() || members.is_some() {
            let (name, span) = (name.to_string(), name.span());
            report.error(span, OutputMessage::RequestForms { name });
        }
    }
    forms.iter().map(|form| form.name.clone()).collect()
}

/// Finds the sectors whose differences act back. Adds mistakes to `report`.
pub(super) fn resolve_acting(
    resolved: Option<&(Span, Vec<Ident>)>,
    scene: &mut Scene,
    report: &mut Faults,
) {
    let Some((_, named)) = resolved else {
        return;
    };
    let sectors = scene.transverse_sectors();
    if named.is_empty() {
        scene.requests.small = (0..sectors.len()).collect();
        return;
    }
    let names: Vec<&str> = sectors.iter().map(|sector| sector.name.as_str()).collect();
    let small = resolve_sectors(
        named,
        &names,
        |name| names.iter().position(|known| *known == name),
        report,
    );
    scene.requests.small = small;
}

/// Finds the sectors that are declared small. Adds mistakes to `report`.
pub(super) fn resolve_small(resolved: &[Ident], scene: &mut Scene, report: &mut Faults) {
    if resolved.is_empty() {
        return;
    }
    let known = sectors(&symmetric_coordinates(scene));
    let differences = known.iter().filter(|sector| sector.difference.is_some());
    let names: Vec<&str> = differences.map(|sector| sector.name.as_str()).collect();
    let find = |name: &str| {
        let found = known.iter().find(|sector| sector.name == name);
        found.and_then(|sector| sector.difference)
    };
    let small = resolve_sectors(resolved, &names, find, report);
    if let Some(budget) = &mut scene.requests.budget {
        budget.small = small;
    }
}

/// Finds the sector of each given name; reports unknown and repeated names.
fn resolve_sectors<S: PartialEq>(
    written: &[Ident],
    names: &[&str],
    find: impl Fn(&str) -> Option<S>,
    report: &mut Faults,
) -> Vec<S> {
    let mut sectors = Vec::new();
    for ident in written {
        let name = ident.to_string();
        match find(&name) {
            Some(sector) if sectors.contains(&sector) => {
                report.error(ident.span(), OutputMessage::DuplicateRequest { name });
            }
            Some(sector) => sectors.push(sector),
            None => {
                let nearest = nearest(&name, names).map(str::to_owned);
                let known = names.join("`, `");
                report.error(
                    ident.span(),
                    OutputMessage::UnknownSector {
                        name,
                        nearest,
                        known,
                    },
                );
            }
        }
    }
    sectors
}
