//! The Arrow C stream interface: tables go to and come from pyarrow, polars, DuckDB and pandas
//! without a copy of their columns.

use std::ffi::CStr;

use arrow_array::RecordBatchReader;
use arrow_array::ffi_stream::{FFI_ArrowArrayStream, RecordBatchStreamReader};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::error::bad_argument;

/// Name that the interface gives its capsules.
const CAPSULE: &CStr = c"arrow_array_stream";

/// Record batches as a capsule of the interface.
pub(crate) fn to_capsule<'py>(
    py: Python<'py>,
    batches: impl RecordBatchReader + Send + 'static,
) -> PyResult<Bound<'py, PyCapsule>> {
    let stream = FFI_ArrowArrayStream::new(Box::new(batches));
    PyCapsule::new_with_value(py, stream, CAPSULE)
}

/// The batches of an object with `__arrow_c_stream__`.
///
/// # Errors
/// When the object has no such method, or it fails.
pub(crate) fn from_object(object: &Bound<'_, PyAny>) -> PyResult<impl RecordBatchReader + Send> {
    if !object.hasattr("__arrow_c_stream__")? {
        let kind = object.get_type();
        return Err(bad_argument(
            format!(
                "{} has no method __arrow_c_stream__",
                kind.fully_qualified_name()?
            ),
            "Pass a table of pyarrow, polars, DuckDB or pandas (2.2 or later)",
        ));
    }
    let capsule = object.call_method0("__arrow_c_stream__")?;
    let capsule = capsule.cast::<PyCapsule>()?;
    let pointer = capsule.pointer_checked(Some(CAPSULE))?;
    #[expect(unsafe_code, reason = "the C interface hands over a pointer")]
    // SAFETY: the name of the capsule says that it points to a stream of the interface; reading
    // takes the stream out and leaves a released one behind, as the interface asks.
    let reader = unsafe { RecordBatchStreamReader::from_raw(pointer.as_ptr().cast()) };
    reader.map_err(|error| bad_argument(error.to_string(), "Pass a table that can be read"))
}
