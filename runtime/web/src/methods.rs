//! Methods by name.

use branched_pendulum::integrate::{AnyIntegrator, Method};
use wasm_bindgen::prelude::wasm_bindgen;

/// Steps after which one frame is given up.
const STEP_LIMIT: u64 = 20_000;

/// A method that a reader can choose.
#[wasm_bindgen(getter_with_clone)]
#[derive(Clone, Debug, PartialEq)]
pub struct MethodChoice {
    /// The name by which [`Pendulum::set_method`](crate::Pendulum::set_method) knows it.
    #[wasm_bindgen(readonly)]
    pub name: String,
    /// The name for readers.
    #[wasm_bindgen(readonly)]
    pub title: String,
    /// True if it takes a tolerance; it takes the length of its steps (s) otherwise.
    #[wasm_bindgen(readonly)]
    pub adaptive: bool,
}

/// Returns the methods that there are: all of the runtime's but Taylor series, which are derived
/// for compiled trees.
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

/// Returns a method with a tolerance, or with a step (s).
pub(crate) fn integrator(name: &str, setting: f64) -> Result<AnyIntegrator<f64>, String> {
    let method: Method = name.parse().map_err(|error| format!("{error}"))?;
    Ok(method.with(setting).with_step_limit(STEP_LIMIT))
}
