//! The constants in the equations of one link of a tree in loops.

use super::offsets::unit;
use super::{Link, Offset, Quantity};
use crate::exact::ExactError;

/// A link about its pivot.
pub(super) struct Turning {
    pub(super) mass: Quantity,
    /// m d, d in the unit of length of the centre of mass.
    pub(super) moment: Quantity,
    /// I + m d² of both components.
    pub(super) inertia: Quantity,
    /// I.
    central: Quantity,
}

impl Turning {
    pub(super) fn of(link: &Link) -> Result<Self, ExactError> {
        let Offset { along, lateral } = &link.com;
        let mut inertia = vec![link.inertia.clone(), product([&link.mass, along, along])];
        if !lateral.is_zero() {
            inertia.push(product([&link.mass, lateral, lateral]));
        }
        Ok(Self {
            mass: link.mass.clone(),
            inertia: Quantity::sum(inertia),
            moment: product([&link.mass, unit(&link.com)]),
            central: link.inertia.clone(),
        })
    }
}

pub(super) fn product<const N: usize>(factors: [&Quantity; N]) -> Quantity {
    Quantity::product(factors.into_iter().cloned())
}

pub(super) fn half(value: &Quantity) -> Quantity {
    // Division by an exact number other than zero.
    let quotient = value.clone().divided_by(Quantity::integer(2));
    quotient.unwrap_or_else(|_| Quantity::zero())
}

/// 1/J alone.
pub(super) fn leaf(body: &Turning) -> Result<Vec<Quantity>, ExactError> {
    let mut row = vec![Quantity::zero(); 6];
    row[1] = Quantity::integer(1).divided_by(body.inertia.clone())?;
    Ok(row)
}

/// The constants of a link with children at distance ℓ, in units in which ℓ is
/// one: the children's answers are in units of their own lever ℓ_j, those of
/// leaves are without unit.
///
/// A leaf pulls at its pivot with Φ = m I/J + (m² d²/J) u uᵀ, other children with
/// Φ = m + (what they answer)/ℓ_j².
pub(super) fn inner(
    body: &Turning,
    lever: &Quantity,
    copies: &Quantity,
    child: &Turning,
    next: Option<&Quantity>,
) -> Result<Vec<Quantity>, ExactError> {
    let moment = product([&body.moment, lever]);
    let share = product([copies, lever, lever, &child.mass]);
    let (rest, square, ratio, reach) = match next {
        None => {
            let turning = product([&child.moment, lever]);
            (
                product([&share, &child.central]).divided_by(child.inertia.clone())?,
                product([&turning, &turning]).divided_by(child.inertia.clone())?,
                turning.clone(),
                turning.divided_by(child.inertia.clone())?,
            )
        }
        Some(next) => {
            let ratio = lever.clone().divided_by(next.clone())?;
            (share, product([&ratio, &ratio]), ratio.clone(), ratio)
        }
    };
    Ok(vec![
        rest,
        body.inertia.clone(),
        moment,
        square,
        ratio,
        reach,
    ])
}
