//! Tests of all formats in one program: one link step instead of one per format.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod arrow;
mod arrow_network;
mod arrow_rows;
mod arrow_tables;
mod arrow_write;
mod common;
mod dxf;
mod dxf_write;
mod geojson;
mod geojson_write;
mod lanelet2;
mod lif;
mod lif_real;
mod lif_save;
mod lif_texts;
mod lif_trajectory;
mod lif_write;
mod networks;
mod opendrive;
mod opentcs;
mod opentcs_files;
mod opentcs_write;
mod refusals;
mod right_findings;
mod rmf;
mod ros_map;
mod round_trip;
mod same;
mod sniff;
mod svg;
mod svg_write;
mod vda5050;
