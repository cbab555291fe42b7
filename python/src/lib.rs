//! The extension module of the Python package `guideway`.
//!
//! | module | purpose |
//! |---|---|
//! | `read` | `open` |
//! | `layout` | class `Layout`: save, check, route, compare, edit, draw |
//! | `build_args` | options of networks |
//! | `tables` | edges, nodes, stations and sampled points as Arrow tables |
//! | `features` | edges, nodes and stations with GeoArrow geometry |
//! | `from_tables` | one table of tables of edges and nodes |
//! | `stream` | the Arrow C stream interface, in and out |
//! | `tiles` | class `Tiler` and `tiles`: tiles by their addresses |
//! | `check_many` | findings of many files |
//! | `items` | arguments that are lists of any kind |
//! | `answers` | findings, routes and changes as Python objects |
//! | `picture` | class `Picture`: pixels, PNG, SVG |
//! | `widget` | what `guideway/_widget.py` shows in notebooks |
//! | `error`, `signals` | exceptions; Ctrl-C and progress while Rust works |

mod answers;
mod build_args;
mod check_many;
mod error;
mod features;
mod from_tables;
mod items;
mod layout;
mod picture;
mod read;
mod signals;
mod stream;
mod tables;
mod tiles;
mod widget;

use pyo3::prelude::*;

/// Path layouts of automated guided vehicles: read, check, edit, draw, convert.
#[pymodule]
mod _guideway {
    #[pymodule_export]
    use crate::answers::{Change, Finding, Loss, Route, RouteStep};
    #[pymodule_export]
    use crate::check_many::check_many;
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
    #[pymodule_export]
    use crate::tiles::{Tiler, tiles};
    #[pymodule_export]
    use crate::widget::{
        widget_check, widget_engine, widget_layout, widget_letters, widget_missing, widget_module,
        widget_symbols,
    };
}
