//! [`GuidewayError`]: the exception of every failure, with the code, message and remedy that the
//! command shows.

use guideway::layout::UserError;
use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;

create_exception!(
    guideway,
    GuidewayError,
    PyException,
    "A file, a value or an option that Guideway cannot take.\n\n\
     `code` is a stable name of the kind of failure, `message` says what failed and where, \
     `remedy` says what to do."
);

/// Makes an exception of an error.
pub(crate) fn exception(error: impl Into<UserError>) -> PyErr {
    let UserError {
        code,
        message,
        remedy,
    } = error.into();
    let raised = GuidewayError::new_err(format!("{message}. {remedy}"));
    Python::attach(|py| {
        let value = raised.value(py);
        for (name, text) in [("code", code), ("message", &message), ("remedy", &remedy)] {
            if let Err(error) = value.setattr(name, text) {
                return error;
            }
        }
        raised
    })
}

/// An exception about an argument.
pub(crate) fn bad_argument(message: impl Into<String>, remedy: impl Into<String>) -> PyErr {
    exception(UserError::new("argument", message, remedy))
}
