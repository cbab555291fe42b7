//! [`Findings`]: findings in compact form, merged over vehicle types and written in words.

use guideway_layout::text_format::counted;
use guideway_layout::{
    Code, Diagnostics, DisplayPosition, Layout, Member, Place, Severity, element_name,
    element_place,
};
use guideway_spline::Point;

/// Vehicle types that are analyzed. Each costs a pass over all paths.
pub(super) const MAX_TYPES: usize = 64;

/// A fault of a network.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Detail {
    /// A part of the network with a node, apart from the largest one.
    Part { nodes: u32, paths: u32 },
    /// A one-way part.
    OneWay { nodes: u32, can_enter: bool },
    /// A node that can be entered and not left.
    Trap,
    /// The end of a two-way path, without station.
    Spur,
    /// One-way paths that lead to each other.
    HeadOn { paths: u32 },
    /// Vehicles of a type cannot come, or go.
    Access { can_come: bool, can_go: bool },
    /// A station without node.
    NoNode,
    /// No path leads to the nodes of a station.
    NoPath,
    /// A turn that no rotation is permitted for.
    Turn { from: u32, to: u32, angle_rad: f64 },
    /// Vehicles must drive back.
    Reverse { from: u32, to: u32 },
    /// Speed in a bend.
    Speed {
        speed: f64,
        radius_m: f64,
        limit: f64,
        at: Point<f64>,
    },
}

struct Finding {
    code: Code,
    severity: Severity,
    element: Member,
    detail: Detail,
    vehicle_type: u32,
}

/// Findings of all vehicle types.
#[derive(Default)]
pub(super) struct Findings {
    list: Vec<Finding>,
    /// Vehicle type that is analyzed.
    pub(super) vehicle_type: u32,
}

impl Findings {
    /// Adds a finding with the severity of its code.
    pub(super) fn add(&mut self, code: Code, element: Member, detail: Detail) {
        self.add_as(code.severity(), code, element, detail);
    }

    pub(super) fn add_as(
        &mut self,
        severity: Severity,
        code: Code,
        element: Member,
        detail: Detail,
    ) {
        self.list.push(Finding {
            code,
            severity,
            element,
            detail,
            vehicle_type: self.vehicle_type,
        });
    }

    /// Reports equal findings of several vehicle types as one.
    pub(super) fn report(
        mut self,
        layout: &Layout,
        types: &[Option<&str>],
        found: &mut Diagnostics,
    ) {
        // Ways that are not in the layout may lead on to other levels.
        if layout
            .refused
            .iter()
            .any(|path| path.code == Code::CrossLevel)
        {
            let of_ways = [Code::DeadEnd, Code::OneWayPart, Code::UnreachableStation];
            let on_ways = |finding: &&mut Finding| of_ways.contains(&finding.code);
            let findings = self.list.iter_mut().filter(on_ways);
            findings.for_each(|finding| finding.severity = Severity::Info);
        }
        self.list
            .sort_by_key(|f| (f.code, std::cmp::Reverse(f.severity), f.element));
        let is_same = |a: &Finding, b: &Finding| {
            (a.code, a.severity, a.element) == (b.code, b.severity, b.element)
        };
        for group in self.list.chunk_by(is_same) {
            let first = &group[0];
            let names = || of_types(group, types);
            found.push_as(
                first.severity,
                first.code,
                || place(layout, first.element),
                || message(layout, first.detail) + &names(),
                remedy(first.detail),
            );
        }
    }
}

/// The vehicle types of a finding, unless it is about all of them.
fn of_types(group: &[Finding], types: &[Option<&str>]) -> String {
    let mut rows: Vec<u32> = group.iter().map(|finding| finding.vehicle_type).collect();
    rows.dedup();
    if rows.len() >= types.len()
        || matches!(group[0].element, Member::Station(_)) && is_of_all(group)
    {
        return String::new();
    }
    let names = rows.iter().filter_map(|&row| types[row as usize]);
    let names: Vec<String> = names.take(4).map(|name| format!("\"{name}\"")).collect();
    let more = rows.len() - names.len();
    let rest = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    let plural = if rows.len() == 1 { "" } else { "s" };
    format!(", for vehicle type{plural} {}{rest}", names.join(", "))
}

fn is_of_all(group: &[Finding]) -> bool {
    matches!(group[0].detail, Detail::NoNode | Detail::NoPath)
}

fn place(layout: &Layout, element: Member) -> Place {
    let id = match element {
        Member::Path(row) => layout.paths.id(row as usize),
        Member::Node(row) => layout.nodes.id(row),
        Member::Station(row) => layout.stations.id(row),
    };
    element_place(element, id)
}

fn message(layout: &Layout, detail: Detail) -> String {
    let path = |row: u32| element_name("path", row as usize, layout.paths.id(row as usize));
    match detail {
        Detail::Part { nodes, paths } => {
            let (nodes, paths) = (counted(nodes.into(), "node"), counted(paths.into(), "path"));
            format!("no path connects this part of {nodes} and {paths} with the largest part")
        }
        Detail::OneWay {
            nodes,
            can_enter: true,
        } => {
            let nodes = counted(nodes.into(), "node");
            format!("vehicles can enter this part of {nodes}, but not leave it")
        }
        Detail::OneWay { nodes, .. } => {
            let nodes = counted(nodes.into(), "node");
            format!("vehicles can leave this part of {nodes}, but not enter it")
        }
        Detail::Trap => "vehicles can enter this node, but not leave it".to_owned(),
        Detail::Spur => "a two-way path ends here, without a station".to_owned(),
        Detail::HeadOn { paths } => {
            format!("{paths} one-way paths lead to this node, and none leads away")
        }
        Detail::Access { can_come, can_go } => match (can_come, can_go) {
            (false, false) => "vehicles can neither reach nor leave it".to_owned(),
            (false, true) => "vehicles cannot reach it".to_owned(),
            _ => "vehicles can reach it, but not leave it".to_owned(),
        },
        Detail::NoNode => "it has no node, so no vehicle can stop there".to_owned(),
        Detail::NoPath => "no path leads to its node".to_owned(),
        Detail::Turn {
            from,
            to,
            angle_rad,
        } => format!(
            "from {} to {} the heading jumps by {:.1}°, and neither permits rotation here",
            path(from),
            path(to),
            angle_rad.to_degrees()
        ),
        Detail::Reverse { from, to } if from == to => format!(
            "vehicles must drive back along {}, which permits no rotation here and states no \
             orientation",
            path(from)
        ),
        Detail::Reverse { from, to } => format!(
            "vehicles must drive back from {} to {}, which permit no rotation here and state no \
             orientation",
            path(from),
            path(to)
        ),
        Detail::Speed {
            speed,
            radius_m,
            limit,
            at,
        } => format!(
            "{:.2} m/s² sideways at {} m/s in a bend of radius {radius_m:.3} m at {}, above \
             {limit} m/s²; at most {:.2} m/s fit",
            speed * speed / radius_m,
            speed as f32,
            DisplayPosition(at),
            (limit * radius_m).sqrt()
        ),
    }
}

fn remedy(detail: Detail) -> &'static str {
    match detail {
        Detail::Part { .. } => "Connect the part by a path, or move its ends to a common node",
        Detail::OneWay { .. } | Detail::Trap => "Add a path back, or make a path two-way",
        Detail::Spur => "Add a station, or remove the path",
        Detail::HeadOn { .. } => "Reverse one of the paths, or make them two-way",
        Detail::Access { .. } => "Connect its node in both directions",
        Detail::NoNode => "Name a node of the station, or place it near a path",
        Detail::NoPath => "Connect its node by a path that the vehicles may use",
        Detail::Turn { .. } => "Round the corner, or permit rotation at the node",
        Detail::Reverse { .. } => "State the orientation of the vehicles, or permit rotation",
        Detail::Speed { .. } => "Lower the speed, or widen the bend",
    }
}
