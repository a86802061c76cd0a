//! Trees whose resonant normal form of degree 4 has a closed form.

use super::Scene;

/// Largest number of in-phase modes whose frequencies have a closed form.
const MOST_MODES: usize = 2;

impl Scene {
    /// Returns the reason, in words, why the normal form of the tree has no closed form; `None` if it
    /// has one.
    pub(super) fn normal_form_obstacle(&self) -> Option<String> {
        if self.reduction.is_some() {
            return Some("`in_phase` and `locked` leave links out".to_owned());
        }
        if let Some(orbit) = self.orbits.iter().find(|orbit| orbit.is_of_unequal()) {
            return Some(format!("the copies of `{}` differ", orbit.node));
        }
        if self.orbits.len() > MOST_MODES {
            let modes = self.orbits.len();
            return Some(format!("the motion in phase has {modes} modes"));
        }
        if !(self.spring_dampers.is_empty() && self.translational.is_empty()) {
            return Some("springs or friction act between links".to_owned());
        }
        let mut links = self.links.iter();
        if let Some(link) =
            links.find(|link| !(link.com.lateral.is_zero() && link.pivot.lateral.is_zero()))
        {
            return Some(format!(
                "the centre of mass or pivot of `{}` is off the axis",
                link.name
            ));
        }
        let mut links = self.links.iter();
        if let Some(link) = links.find(|link| !link.passive.rest.is_zero()) {
            return Some(format!("the spring of `{}` has a rest angle", link.name));
        }
        if self.gravity.is_zero() {
            return Some("there is no gravity".to_owned());
        }
        let is_free = |link: &&super::Link| {
            [&link.mass, &link.com.along, &link.pivot.along]
                .iter()
                .any(|value| value.is_zero())
        };
        let link = self.links.iter().skip(1).find(is_free)?;
        let name = &link.name;
        Some(format!(
            "the motion of `{name}` is independent of its parent's"
        ))
    }
}
