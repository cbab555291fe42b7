//! What is read and written of each format, in one program, which is sooner linked than one for each.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod arrow;
mod arrow_write;
mod common;
mod dxf;
mod dxf_write;
mod geojson;
mod geojson_write;
mod lanelet2;
mod lif;
mod lif_rest;
mod lif_write;
mod opendrive;
mod opentcs;
mod rmf;
mod round_trip;
mod same;
mod sniff;
mod svg;
mod svg_write;
mod vda5050;
