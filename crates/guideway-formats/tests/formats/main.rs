//! Tests of all formats in one program: one link step instead of one per format.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod arrow;
mod arrow_network;
mod arrow_part;
mod arrow_rows;
mod arrow_tables;
mod arrow_types;
mod arrow_write;
mod common;
mod dxf;
mod dxf_write;
mod encodings;
mod geojson;
mod geojson_crs;
mod geojson_properties;
mod geojson_write;
mod growth;
mod lanelet2;
#[path = "../conversion_law/law.rs"]
#[allow(dead_code, reason = "the law test uses more of it")]
mod law;
mod lif;
mod lif_levels;
mod lif_real;
mod lif_save;
mod lif_schema;
mod lif_texts;
mod lif_trajectory;
mod lif_write;
mod nav2_write;
mod networks;
mod opendrive;
mod opendrive_cases;
mod opentcs;
mod opentcs_columns;
mod opentcs_files;
mod opentcs_write;
mod other_files;
mod parts;
mod refusals;
mod right_findings;
mod rmf;
mod rmf_site;
mod rmf_write;
mod ros_map;
mod round_trip;
mod same;
mod sequences;
mod sniff;
mod svg;
mod svg_cases;
mod svg_transforms;
mod svg_write;
mod vda5050;
mod vda5050_write;
