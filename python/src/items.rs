//! Items of arguments that are lists: of Python, NumPy, pandas, polars or pyarrow.

use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::error::bad_argument;

/// Methods by which other types become lists of Python.
const AS_LIST: [&str; 3] = ["to_pylist", "to_list", "tolist"];

/// A number, or a list of numbers.
pub(crate) enum Numbers {
    One(u32),
    Many(Vec<u32>),
}

impl Numbers {
    /// Length of a list.
    pub(crate) fn len(&self) -> Option<usize> {
        match self {
            Self::One(_) => None,
            Self::Many(all) => Some(all.len()),
        }
    }

    /// A number of the list, or the only one.
    pub(crate) fn get(&self, at: usize) -> u32 {
        match self {
            Self::One(number) => *number,
            Self::Many(all) => all[at],
        }
    }
}

/// The numbers of an argument.
pub(crate) fn numbers(name: &str, argument: &Bound<'_, PyAny>) -> PyResult<Numbers> {
    if let Ok(number) = argument.extract() {
        return Ok(Numbers::One(number));
    }
    let all = items(argument).and_then(|items| {
        let items = items.into_iter();
        items.map(|item| item.extract()).collect()
    });
    all.map(Numbers::Many).map_err(|_| {
        let message = format!("{name} is neither a whole number from 0 nor a list of such");
        bad_argument(message, "Give numbers such as 3 or [0, 1, 2]")
    })
}

/// The items of a list of any kind. A text is no list of its letters.
pub(crate) fn items<'py>(argument: &Bound<'py, PyAny>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    if argument.is_instance_of::<PyString>() {
        return Err(bad_argument("a text is no list", "Put it into a list"));
    }
    for method in AS_LIST {
        if argument.hasattr(method)? {
            return argument.call_method0(method)?.try_iter()?.collect();
        }
    }
    argument.try_iter()?.collect()
}
