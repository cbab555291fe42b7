//! Ends: nodes that vehicles enter and do not leave, and ends of two-way paths without a station.
//!
//! Where no way leads in a circle and there is no station, the paths are a way and not a network:
//! its end is information.

use guideway_layout::{Code, Layout, Member, Severity};

use super::components::Components;
use super::finding::{Detail, Findings};
use crate::arcs::Arcs;

pub(super) fn check(
    layout: &Layout,
    arcs: &Arcs,
    components: &Components,
    findings: &mut Findings,
) {
    let is_way = !components.has_circle() && layout.stations.is_empty();
    let trap = if is_way {
        Severity::Info
    } else {
        Code::DeadEnd.severity()
    };
    let mut has_station = vec![false; layout.nodes.len()];
    for station in 0..layout.stations.len() as u32 {
        for &node in layout.stations.nodes(station) {
            has_station[node as usize] = true;
        }
    }
    for node in 0..arcs.node_count() {
        // Turns in place lead nowhere.
        let away = |&&row: &&u32| arcs.get(row).from != arcs.get(row).to;
        let mut leaving = arcs.leaving(node).iter().filter(away);
        let mut entering = arcs.entering(node).iter().filter(away);
        let entered = entering.clone().count() as u32;
        let element = Member::Node(node);
        match leaving.next() {
            None if entered >= 2 => {
                findings.add(Code::HeadOn, element, Detail::HeadOn { paths: entered });
            }
            None if entered == 1 => findings.add_as(trap, Code::DeadEnd, element, Detail::Trap),
            Some(&first) if entered > 0 && !has_station[node as usize] => {
                let back_to = arcs.get(first).to;
                let is_spur = leaving.all(|&row| arcs.get(row).to == back_to)
                    && entering.all(|&row| arcs.get(row).from == back_to);
                if is_spur {
                    findings.add_as(Severity::Info, Code::DeadEnd, element, Detail::Spur);
                }
            }
            _ => {}
        }
    }
}
