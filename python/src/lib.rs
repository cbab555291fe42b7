//! The extension module of the Python package `guideway`.
//!
//! | module | purpose |
//! |---|---|
//! | `read` | `open` |
//! | `layout` | class `Layout`: save, check, route, compare, edit, draw |
//! | `build_args` | options of networks |
//! | `tables` | edges, nodes, stations and sampled points as Arrow tables |
//! | `stream` | the Arrow C stream interface, in and out |
//! | `answers` | findings, routes and changes as Python objects |
//! | `picture` | class `Picture`: pixels, PNG, SVG |
//! | `error`, `signals` | exceptions; Ctrl-C and progress while Rust works |

mod answers;
mod build_args;
mod error;
mod layout;
mod picture;
mod read;
mod signals;
mod stream;
mod tables;

use pyo3::prelude::*;

/// Path layouts of automated guided vehicles: read, check, edit, draw, convert.
#[pymodule]
mod _guideway {
    #[pymodule_export]
    use crate::answers::{Change, Finding, Loss, Route, RouteStep};
    #[pymodule_export]
    use crate::error::GuidewayError;
    #[pymodule_export]
    use crate::layout::PyLayout;
    #[pymodule_export]
    use crate::picture::PyPicture;
    #[pymodule_export]
    use crate::read::open;
    #[pymodule_export]
    use crate::tables::Table;
}
