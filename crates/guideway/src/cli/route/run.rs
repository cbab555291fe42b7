//! Arguments of `route`; finds the way and prints it.

use std::path::PathBuf;

use clap::ValueEnum;
use guideway::formats::Target;
use guideway::layout::{Layout, UserError};
use guideway::network::{Route, RouteOptions, Router};
use serde_json::{Value, json};

use super::geojson;
use crate::cli::error::{Exit, usage_error};
use crate::cli::input::{self, Input};
use crate::cli::layout_output::{LayoutOutput, target_parser};
use crate::cli::output::{Output, print};
use crate::cli::{text, values};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Layout file; the content decides the format
    #[arg(value_name = "SITE", value_parser = Input::parser())]
    input: Input,
    /// Station or node where the vehicle starts, by identifier or name
    from: String,
    /// Station or node where the vehicle ends
    to: String,
    /// Vehicle type; needed where the layout has several
    #[arg(long, value_name = "TYPE")]
    vehicle_type: Option<String>,
    /// Form of the route: a list, JSON (the same as --json), or GeoJSON with a line per path
    #[arg(long, default_value = "list")]
    format: Format,
    /// Also write the route: GeoJSON, an order of VDA 5050 (.vda5050.json), or any other format.
    /// `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Format of the file, in place of that of its extension
    #[arg(long = "to", value_name = "FORMAT", value_parser = target_parser())]
    output_format: Option<Target>,
    /// Speed on paths without a limit, in m/s [default: 1]
    #[arg(long, value_name = "SPEED", value_parser = values::positive, allow_hyphen_values = true)]
    speed: Option<f64>,
    /// Rotation speed where none is stated, in degrees per second [default: 28.6]
    #[arg(long, value_name = "SPEED", value_parser = values::positive, allow_hyphen_values = true)]
    rotation_speed: Option<f64>,
    /// Largest lateral acceleration, in m/s²: it slows vehicles in bends
    #[arg(long, value_name = "VALUE", value_parser = values::positive, allow_hyphen_values = true)]
    lateral_acceleration: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    List,
    Json,
    Geojson,
}

impl Args {
    fn options(&self) -> RouteOptions {
        let default = RouteOptions::default();
        let rotation = self.rotation_speed.map(f64::to_radians);
        RouteOptions {
            speed_m_s: self.speed.unwrap_or(default.speed_m_s),
            rotation_speed_rad_s: rotation.unwrap_or(default.rotation_speed_rad_s),
            lateral_acceleration_m_s2: self.lateral_acceleration,
            ..default
        }
    }
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    if out.is_json() && args.format == Format::Geojson {
        return Err(usage_error(
            "--json and --format geojson select different reports",
            "Omit --json",
        ));
    }
    let form = Output::new(out.is_json() || args.format != Format::List, false);
    let output = args.output.as_deref().map(|path| {
        let inputs = [args.input.path.as_path()];
        LayoutOutput::new(path, args.output_format, inputs, &form)
    });
    let output = output.transpose()?;
    let (layout, read_ms) = input::read_all(std::slice::from_ref(&args.input), out)?;
    let progress = out.progress("searching");
    let vehicle_type = args.vehicle_type.as_deref();
    let vehicle_type = vehicle_type.or_else(|| layout.paths.vehicle_types().only_name());
    let router = Router::new(&layout, vehicle_type, &args.options())?;
    let graph_ms = progress.finish();
    let progress = out.progress("searching");
    let route = router.route(&router.place(&args.from)?, &router.place(&args.to)?)?;
    let search_ms = progress.finish();
    if let Some(output) = &output {
        let route = route.layout(&layout);
        output.write(&route, output.target(&route)?, out)?;
    }
    let body = json!({
        "file": args.input.path.to_string_lossy(),
        "from": args.from,
        "to": args.to,
        "vehicle_type": vehicle_type,
        "length_m": route.length_m,
        "time_s": route.time_s,
        "paths": rows_json(&layout, &route),
        "output": args.output.as_ref().map(|output| output.to_string_lossy()),
        "ms": {
            "read": read_ms, "graph": graph_ms, "search": search_ms,
            "total": read_ms + graph_ms + search_ms,
        },
    });
    let list = || table(args, &layout, &route);
    match args.format {
        Format::List => {
            let out = out.beside(args.output.as_deref());
            out.report("route", &body, list)?;
        }
        Format::Json => Output::new(true, false).report("route", &body, list)?,
        Format::Geojson => print(&geojson::bytes(&layout, &route)?)?,
    }
    Ok(Exit::Clean)
}

fn rows_json(layout: &Layout, route: &Route) -> Vec<Value> {
    let rows = route.rows.iter();
    rows.map(|row| {
        json!({
            "path": layout.paths.id(row.path as usize),
            "backward": row.is_backward,
            "from": layout.nodes.id(row.from),
            "to": layout.nodes.id(row.to),
            "turn_deg": row.turn_rad.to_degrees(),
            "turn_s": row.turn_s,
            "length_m": row.length_m,
            "speed_m_s": row.speed_m_s,
            "drive_s": row.drive_s,
            "end_s": row.end_s,
        })
    })
    .collect()
}

fn table(args: &Args, layout: &Layout, route: &Route) -> String {
    let name = |text: &str| text::single_line(text, 40);
    let mut words = String::new();
    for row in &route.rows {
        if row.turn_s > 0.0 {
            let (angle, at) = (row.turn_rad.to_degrees(), name(layout.nodes.id(row.from)));
            words += &format!(
                "{:>9.1} s  turn by {angle:.1}° at {at}\n",
                row.end_s - row.drive_s
            );
        }
        words += &format!(
            "{:>9.1} s  {} to {}: {} at {} m/s{}\n",
            row.end_s,
            name(layout.paths.id(row.path as usize)),
            name(layout.nodes.id(row.to)),
            text::meters(row.length_m),
            text::number(row.speed_m_s),
            if row.is_backward {
                ", against the path"
            } else {
                ""
            }
        );
    }
    let length = text::meters(route.length_m);
    let paths = text::counted(route.rows.len() as u64, "path");
    let (from, to) = (name(&args.from), name(&args.to));
    words + &format!("{from} to {to}: {paths}, {length}, {:.1} s\n", route.time_s)
}
