//! Positions of links: docs and formulas of the functions, and the runtime's trait.

use super::Emission;
use crate::functions::{LINK_PROPERTIES, PointKind};
use crate::mechanics::expression::{Expr, NamedFormula};
use crate::mechanics::{LinkPositions, RelativePosition};
use crate::scene::{Layout, LinkId};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Returns the plural noun for a kind of points.
fn points(kind: PointKind) -> &'static str {
    match kind {
        PointKind::Pivot => "the pivots of the links",
        PointKind::Centre => "the centres of mass",
        PointKind::End => "the ends of the links",
    }
}

/// Returns the documentation of the properties of the links.
pub(super) fn link_properties_meaning() -> Vec<String> {
    let mut lines = vec![
        "Masses, moments of inertia and points of the links, one row for each link:".to_owned(),
        String::new(),
    ];
    let columns = LINK_PROPERTIES.iter().enumerate();
    lines.extend(columns.map(|(column, meaning)| format!("{}. {meaning}", column + 1)));
    lines.push(String::new());
    lines.push(
        "`Positions::properties_of` returns them by name, with the parent of each link.".into(),
    );
    lines
}

impl Emission<'_> {
    /// Returns the documentation of the positions of points.
    pub(super) fn point_positions_meaning(&self, kind: PointKind) -> Vec<String> {
        vec![format!(
            "Positions x, y (in m) of {} at angles `theta` (in rad), relative to the root's pivot; x points to the side to which positive angles move a link's end, y upwards.{}",
            points(kind),
            self.frame_note()
        )]
    }

    /// Returns the documentation of the velocities of points.
    pub(super) fn point_velocities_meaning(&self, kind: PointKind) -> Vec<String> {
        vec![format!(
            "Velocities ẋ, ẏ (in m/s) of {} at angles `theta` (in rad) and angular velocities `omega` (in rad/s).{}",
            points(kind),
            self.frame_note()
        )]
    }

    /// Returns the documentation of the torques of forces on points.
    pub(super) fn point_torques_meaning(&self, kind: PointKind) -> Vec<String> {
        vec![
                format!(
                    "Generalized torques Q = Jᵀ F (in N m) of `forces` F_x, F_y (in N) on {} at angles `theta` (in rad): their power is Q·ω.",
                    points(kind)
                ),
                String::new(),
                "With the forces S_c on the subtree of each child c:".into(),
                String::new(),
                "```text".into(),
                match kind {
                    PointKind::Pivot => "Q_i = Σ (∂r_c/∂θ_i)·S_c",
                    PointKind::Centre | PointKind::End => "Q_i = (∂r_i/∂θ_i)·F_i + Σ (∂r_c/∂θ_i)·S_c",
                }
                .into(),
                "```".into(),
                String::new(),
                match self.scene.stands() {
                    true => "A force on another point r of link i has the torques of the same force on the point r_i, plus F × (r − r_i) on link i, because positive angles are clockwise. A clockwise couple on a link is directly a torque on that link.",
                    false => "A force on another point r of link i has the torques of the same force on the point r_i, plus (r − r_i) × F on link i. A couple on a link is directly a torque on that link.",
                }
                .into(),
            ]
    }

    /// Returns the formulas of the steps from pivot to pivot, and from the pivots to the points.
    pub(super) fn positions_formulas(&self, kind: PointKind, rate: bool) -> Vec<NamedFormula> {
        let Some(links) = &self.mechanics.positions else {
            return Vec::new();
        };
        let part = |relative: &RelativePosition| match rate {
            false => relative.position.clone(),
            true => relative.velocity.clone(),
        };
        let mut formulas = Vec::new();
        for (link, positions) in self.scene.links.iter().zip(links) {
            if let (Some(step), Some(LinkId(parent))) = (&positions.pivot, link.parent) {
                let parent = &self.scene.links[parent].name;
                formulas.extend(steps(&link.name, "", Some(parent), part(step), rate));
            }
        }
        for (link, positions) in self.scene.links.iter().zip(links) {
            if let Some((mark, relative)) = point(kind, positions) {
                formulas.extend(steps(&link.name, mark, None, part(relative), rate));
            }
        }
        formulas
    }

    /// Emits `impl Positions`; slices of a wrong length give NaN.
    pub(super) fn positions_trait(&self) -> Option<TokenStream> {
        if !self.scene.requests.positions {
            return None;
        }
        let (name, runtime) = (&self.item.ident, self.runtime());
        let body = match self.scene.layout {
            Layout::Unrolled => self.unrolled_positions(),
            Layout::Links | Layout::Generations { .. } => self.strip_positions(),
        };
        Some(quote! {
            impl<T: #runtime::Scalar> #runtime::Positions<T> for #name<T> {
                #body
            }
        })
    }

    fn unrolled_positions(&self) -> TokenStream {
        let (runtime, links) = (self.runtime(), self.links());
        let parents = self.scene.links.iter().map(|link| match link.parent {
            Some(LinkId(parent)) => {
                let parent = Literal::usize_unsuffixed(parent);
                quote!(::core::option::Option::Some(#parent))
            }
            None => quote!(::core::option::Option::None),
        });
        let filled = |inputs: [&str; 2], output: &str, functions: [&str; 3]| {
            let [first, second] = inputs.map(super::tokens::ident);
            let output = super::tokens::ident(output);
            let [pivot, centre, end] = functions.map(super::tokens::ident);
            let call = |function| match first == second {
                true => quote!(self.#function(#first)),
                false => quote!(self.#function(#first, #second)),
            };
            let (pivot, centre, end) = (call(pivot), call(centre), call(end));
            let second_name = match first == second {
                true => quote!(_),
                false => quote!(#second),
            };
            quote! {
                #runtime::emitted::fill(#first, #second, #output, |#first, #second_name| match point {
                    #runtime::system::LinkPoint::Pivot => #pivot,
                    #runtime::system::LinkPoint::Centre => #centre,
                    #runtime::system::LinkPoint::End => #end,
                });
            }
        };
        let points = filled(["theta", "theta"], "points", ["pivots", "centres", "ends"]);
        let velocities = filled(
            ["theta", "omega"],
            "velocities",
            ["pivot_velocities", "centre_velocities", "end_velocities"],
        );
        let torques = filled(
            ["theta", "forces"],
            "torques",
            ["pivot_torques", "centre_torques", "end_torques"],
        );
        self.positions_functions(
            quote! {
                const PARENTS: [::core::option::Option<usize>; #links] = [#(#parents),*];
                #runtime::emitted::properties(&PARENTS, &self.link_properties(), link)
            },
            points,
            velocities,
            torques,
        )
    }

    fn strip_positions(&self) -> TokenStream {
        self.positions_functions(
            quote!(self.properties.of(link)),
            quote!(self.properties.points_into(point, theta, points);),
            quote!(self.properties.velocities_into(point, theta, omega, velocities);),
            quote!(self.properties.torques_into(point, theta, forces, torques);),
        )
    }

    fn positions_functions(
        &self,
        properties: TokenStream,
        points: TokenStream,
        velocities: TokenStream,
        torques: TokenStream,
    ) -> TokenStream {
        let runtime = self.runtime();
        let stands = self.scene.stands().then(|| {
            quote!(
                #[inline]
                fn stands(&self) -> bool {
                    true
                }
            )
        });
        quote! {
            #stands

            fn properties_of(
                &self,
                link: usize,
            ) -> ::core::option::Option<#runtime::system::LinkProperties<T>> {
                #properties
            }

            fn points_into(
                &self,
                point: #runtime::system::LinkPoint,
                theta: &[T],
                points: &mut [[T; 2]],
            ) {
                #points
            }

            fn point_velocities_into(
                &self,
                point: #runtime::system::LinkPoint,
                theta: &[T],
                omega: &[T],
                velocities: &mut [[T; 2]],
            ) {
                #velocities
            }

            fn point_torques_into(
                &self,
                point: #runtime::system::LinkPoint,
                theta: &[T],
                forces: &[[T; 2]],
                torques: &mut [T],
            ) {
                #torques
            }
        }
    }
}

/// Returns the index by which formulas denote a kind of points, and the position of this point on
/// the link; `None` for pivots.
fn point(kind: PointKind, link: &LinkPositions) -> Option<(&'static str, &RelativePosition)> {
    match kind {
        PointKind::Pivot => None,
        PointKind::Centre => Some(("c", &link.centre)),
        PointKind::End => Some(("e", &link.end)),
    }
}

/// Returns the formulas of x and y of a point minus those of its reference point.
fn steps(
    link: &str,
    mark: &str,
    parent: Option<&str>,
    values: [Expr; 2],
    rate: bool,
) -> impl Iterator<Item = NamedFormula> {
    let from = parent.unwrap_or(link).to_owned();
    let link = link.to_owned();
    let mark = mark.to_owned();
    ["x", "y"]
        .into_iter()
        .zip(values)
        .map(move |(axis, right)| {
            let (text, latex) = match rate {
                false => (axis.to_owned(), axis.to_owned()),
                true => (format!("{axis}̇"), format!("\\dot {axis}")),
            };
            let tex = |name: &str| format!("\\mathrm{{{}}}", name.replace('_', "\\_"));
            let (own, own_tex) = match mark.is_empty() {
                true => (link.clone(), tex(&link)),
                false => (format!("{mark},{link}"), format!("{mark},{}", tex(&link))),
            };
            let left = format!("{text}_{own} − {text}_{from}");
            let latex = format!("{latex}_{{{own_tex}}} - {latex}_{{{}}}", tex(&from));
            NamedFormula::new(left, latex, &right)
        })
}
