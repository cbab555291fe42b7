//! Tests of the command line; each runs the program itself.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

#[cfg(unix)]
mod action;
mod arrow;
mod bench;
mod checks;
mod diff;
mod edit;
mod envelope;
mod first_hour;
mod grammar;
mod hostile;
mod lines;
mod network;
mod pictures;
mod public_files;
mod render;
mod render_files;
mod reports;
mod reproduce;
mod ros_map;
mod route;
mod sarif;
mod schema;
mod several;
mod share;
mod site_repository;
mod support;
mod tasks;
mod tiles;
#[cfg(unix)]
mod view;
