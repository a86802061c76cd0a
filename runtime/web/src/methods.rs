//! Methods by name.

use branched_pendulum::integrate::{AnyIntegrator, Method};
use wasm_bindgen::prelude::wasm_bindgen;

/// Number of steps after which the computation of one frame is abandoned.
const STEP_LIMIT: u64 = 20_000;

/// An integration method that the user can choose.
#[wasm_bindgen(getter_with_clone)]
#[derive(Clone, Debug, PartialEq)]
pub struct MethodChoice {
    /// Name of the method for [`Pendulum::set_method`](crate::Pendulum::set_method).
    #[wasm_bindgen(readonly)]
    pub name: String,
    /// The name for readers.
    #[wasm_bindgen(readonly)]
    pub title: String,
    /// True if the method takes a tolerance; otherwise it takes the length of its steps (s).
    #[wasm_bindgen(readonly)]
    pub adaptive: bool,
}

/// Returns all methods that can be chosen: those of the runtime except Taylor series.
#[wasm_bindgen]
pub fn methods() -> Vec<MethodChoice> {
    let methods = Method::ALL
        .iter()
        .filter(|&&method| method != Method::Taylor);
    let choice = |method: &Method| MethodChoice {
        name: method.to_string(),
        title: method.title().to_owned(),
        adaptive: method.is_adaptive(),
    };
    methods.map(choice).collect()
}

/// Creates a method with a tolerance, or with a step length (s).
pub(crate) fn integrator(name: &str, setting: f64) -> Result<AnyIntegrator<f64>, String> {
    let method: Method = name.parse().map_err(|error| format!("{error}"))?;
    Ok(method.with(setting).with_step_limit(STEP_LIMIT))
}
