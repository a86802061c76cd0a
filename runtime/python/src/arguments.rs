//! Arguments of Python functions: converted, or rejected with a sentence that begins with the
//! argument's name.

use std::path::PathBuf;

use numpy::{AllowTypeChange, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods, PyUntypedArray};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};

use crate::arrays::{Numbers, Times};
use crate::memory::{bytes, need, shown};

/// Largest number of characters of a rejected value that are shown.
const SHOWN: usize = 60;

/// A type to which Python arguments are converted.
///
/// PyO3 itself omits the name of the argument from its messages, and names Rust types in them.
pub(crate) trait Argument<'a, 'py>: Sized {
    /// Converts the argument with this name.
    ///
    /// # Errors
    /// TypeError that names the argument, the accepted values and the value that was given.
    fn of(name: &str, object: &'a Bound<'py, PyAny>) -> PyResult<Self>;
}

/// Returns the error that an argument is not of the kind `accepted`.
pub(crate) fn refused(name: &str, accepted: &str, object: &Bound<'_, PyAny>) -> PyErr {
    PyTypeError::new_err(format!("{name} must be {accepted}, got {}", value(object)))
}

/// Formats a value as Python writes it, cut after some characters.
pub(crate) fn value(object: &Bound<'_, PyAny>) -> String {
    let text = object.repr().map_or_else(
        |_| "a value without a repr".to_owned(),
        |text| text.to_string(),
    );
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// A real number of Python or NumPy, or an array with one number.
impl Argument<'_, '_> for f64 {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let is_plain = object.is_instance_of::<PyFloat>() || object.is_exact_instance_of::<PyInt>();
        if let (true, Ok(number)) = (is_plain, object.extract()) {
            return Ok(number);
        }
        let numbers = Numbers::converted(name, "a real number", object)?;
        match numbers.to_vec()[..] {
            [number] => Ok(number),
            _ => {
                let shape = shown(numbers.shape());
                let text = format!("{name} must be one real number, got an array of shape {shape}");
                Err(PyTypeError::new_err(text))
            }
        }
    }
}

impl Argument<'_, '_> for i128 {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let number = object.extract();
        number.map_err(|_| refused(name, "a whole number", object))
    }
}

impl Argument<'_, '_> for bool {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let truth = object.extract();
        truth.map_err(|_| refused(name, "True or False", object))
    }
}

impl<'a> Argument<'a, '_> for &'a str {
    fn of(name: &str, object: &'a Bound<'_, PyAny>) -> PyResult<Self> {
        match object.cast::<PyString>() {
            Ok(text) => text.to_str(),
            Err(_) => Err(refused(name, "a str", object)),
        }
    }
}

impl Argument<'_, '_> for String {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        <&str>::of(name, object).map(str::to_owned)
    }
}

impl Argument<'_, '_> for PathBuf {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path = object.extract();
        path.map_err(|_| refused(name, "a path: a str or a pathlib.Path", object))
    }
}

impl<'a, 'py, T: Argument<'a, 'py>> Argument<'a, 'py> for Option<T> {
    fn of(name: &str, object: &'a Bound<'py, PyAny>) -> PyResult<Self> {
        match object.is_none() {
            true => Ok(None),
            false => T::of(name, object).map(Some),
        }
    }
}

impl<'py, T: for<'b> Argument<'b, 'py>> Argument<'_, 'py> for Vec<T> {
    fn of(name: &str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        if object.is_instance_of::<PyString>() {
            let text = format!(
                "{name} must be a list, got one str; write [{}]",
                value(object)
            );
            return Err(PyTypeError::new_err(text));
        }
        let items = object.try_iter();
        let items = items.map_err(|_| refused(name, "a list", object))?;
        let items = items.enumerate();
        items
            .map(|(index, item)| T::of(&format!("{name}[{index}]"), &item?))
            .collect()
    }
}

impl<'py, const N: usize> Argument<'_, 'py> for [f64; N] {
    fn of(name: &str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let numbers = Vec::<f64>::of(name, object).ok();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        numbers.ok_or_else(|| refused(name, &format!("{N} numbers"), object))
    }
}

/// Entries of a Python dict whose keys are names, in order.
pub(crate) struct Entries<T>(pub(crate) Vec<(String, T)>);

impl<'py, T: for<'b> Argument<'b, 'py>> Argument<'_, 'py> for Entries<T> {
    fn of(name: &str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let named = object.cast::<PyMapping>();
        let named = named.map_err(|_| refused(name, "a dict", object))?;
        let items = named.items()?;
        let entries = items.iter().map(|entry| {
            let (key, item): (Bound<'py, PyAny>, Bound<'py, PyAny>) = entry.extract()?;
            let key = String::of(&format!("each key of {name}"), &key)?;
            let item = T::of(&format!("{name}[{key:?}]"), &item)?;
            Ok((key, item))
        });
        entries.collect::<PyResult<_>>().map(Self)
    }
}

impl<'py> Argument<'_, 'py> for Numbers<'py> {
    fn of(name: &str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let numbers = match object.cast::<PyArrayDyn<f64>>() {
            Ok(array) if object.is_exact_instance_of::<PyUntypedArray>() => {
                Self::from(array.readonly())
            }
            _ => Self::converted(name, "real numbers", object)?,
        };
        // Computations take two copies of them.
        need(&format!("copies of {name}"), bytes(numbers.shape(), 2))?;
        Ok(numbers)
    }
}

impl<'py> Argument<'_, 'py> for Times<'py> {
    fn of(name: &str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let numbers = Numbers::of(name, object)?;
        let is_span = object.is_instance_of::<PyTuple>() && numbers.shape() == [2];
        Ok(Self { numbers, is_span })
    }
}

impl<'py> Numbers<'py> {
    /// Converts everything that NumPy can convert to an array; rejects numbers of which a part
    /// would be lost.
    pub(crate) fn converted(
        name: &str,
        accepted: &str,
        object: &Bound<'py, PyAny>,
    ) -> PyResult<Self> {
        let wrong =
            |reason: &str| PyTypeError::new_err(format!("{name} must be {accepted}{reason}"));
        // NumPy makes NaN of None, and numbers of text.
        if object.is_none() || object.is_instance_of::<PyString>() {
            return Err(refused(name, accepted, object));
        }
        if is_masked(object)? {
            return Err(wrong(
                ", got masked ones, and the mask would be lost: take those that are not masked, \
                 or fill them, `filled(numpy.nan)` where NaN means missing",
            ));
        }
        let numpy = object.py().import("numpy")?;
        let array = numpy.call_method1("asarray", (object,)).map_err(|error| {
            let reason = error.value(object.py());
            wrong(&format!(
                "; NumPy makes no array of {}: {reason}",
                value(object)
            ))
        })?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        match &*kind {
            "b" | "i" | "u" | "f" | "O" => {}
            "c" => {
                return Err(wrong(
                    ", got complex ones, whose imaginary parts would be lost: give `.real`",
                ));
            }
            _ => {
                let dtype = array.getattr("dtype")?;
                return Err(wrong(&format!(", got {} of dtype {dtype}", value(object))));
            }
        }
        let array: PyResult<PyArrayLikeDyn<'py, f64, AllowTypeChange>> = array.extract();
        let array = array.map_err(|_| refused(name, accepted, object))?;
        Ok(Self::from((*array).clone()))
    }
}

/// Returns true if some of the numbers are masked, in an array or in a list of arrays.
fn is_masked(object: &Bound<'_, PyAny>) -> PyResult<bool> {
    let test = object
        .py()
        .import("numpy")?
        .getattr("ma")?
        .getattr("is_masked")?;
    if test.call1((object,))?.is_truthy()? {
        return Ok(true);
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        for part in object.try_iter()? {
            if test.call1((part?,))?.is_truthy()? {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// Defines functions for `#[pyo3(from_py_with = ...)]`, one for each name of an argument.
macro_rules! named {
    ($($name:ident)*) => {
        /// Conversions of Python arguments, one function for each argument name.
        pub(crate) mod named {
            use pyo3::prelude::*;

            use super::Argument;

            $(pub(crate) fn $name<'a, 'py, T: Argument<'a, 'py>>(
                object: &'a Bound<'py, PyAny>,
            ) -> PyResult<T> {
                T::of(stringify!($name), object)
            })*
        }
    };
}

named! {
    actions alpha atol axis bound columns count decimal definition degree delimiter dense_output dots drop_repeated
    duration first_step form frame_rate frequencies frequency friction fundamentals gravity
    horizons interval intervals into least likelihood max_step max_steps method methods mirrored
    most name noise nonnegative offsets omega order outliers pair parameters path pivot point
    precision recording relative_to remove_mean right rtol sample_limit sample_rate sector
    seed settling sheet smallest stable starts step step_limit t t0 text targets theta threads time
    tolerance torques transverse trend unit unknown until vary weights window within x y y0 y_down zero
}
