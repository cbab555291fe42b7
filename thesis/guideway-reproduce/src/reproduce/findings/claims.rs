//! The claims of the thesis, each with the function that judges it; takes a run and returns its
//! findings.

use super::finding::{Finding, Verdict};
use super::judgment::Judgment;
use super::{build, frame, most_paths};
use crate::reproduce::Run;

struct Claim {
    title: &'static str,
    section: &'static str,
    text: &'static str,
    judge: fn(&Run) -> Judgment,
}

const CLAIMS: [Claim; 16] = [
    Claim {
        title: "More paths per pixel than by tessellation",
        section: "5.3, table 5.1",
        text: "Per-pixel intersection draws more paths at 60 frames per second than tessellation.",
        judge: most_paths::more_paths,
    },
    Claim {
        title: "Memory",
        section: "5.3, table 5.1",
        text: "Per-pixel intersection needs more memory than tessellation.",
        judge: most_paths::more_memory,
    },
    Claim {
        title: "Fewer pixels inside the grid",
        section: "5.3.2, tables 5.2 and 5.3",
        text: "The more pixels are inside the grid, the longer per-pixel intersection takes.",
        judge: frame::occupancy,
    },
    Claim {
        title: "Magnifying, per pixel",
        section: "5.3, figure 5.3",
        text: "Magnifying makes frames faster, because paths outside the view cost nothing.",
        judge: frame::zoom_of_grid,
    },
    Claim {
        title: "Magnifying, by tessellation",
        section: "5.3, figure 5.3",
        text: "Magnifying makes frames faster, because paths outside the view cost nothing.",
        judge: frame::zoom_of_tessellation,
    },
    Claim {
        title: "Bottleneck of tessellation",
        section: "5.3.1",
        text: "Geometry throughput is the limiting factor: the patches that have to be processed.",
        judge: frame::bottleneck,
    },
    Claim {
        title: "Culling is cheap",
        section: "5.3.1, figure 5.4",
        text: "View frustum culling has a small impact on the time of a frame.",
        judge: frame::culling,
    },
    Claim {
        title: "Overlap and tessellation",
        section: "5.3.1",
        text: "Tessellation performs similarly in both datasets.",
        judge: frame::overlap,
    },
    Claim {
        title: "Sampling",
        section: "5.3.2, figure 5.5",
        text: "Sampling scales linearly with the number of paths.",
        judge: build::sampling,
    },
    Claim {
        title: "Overlap and the grid's build",
        section: "5.3.2, figure 5.5",
        text: "Counting and binning take longer in D2, where more paths share a cell.",
        judge: build::contention,
    },
    Claim {
        title: "Prefix sum",
        section: "6.3",
        text: "The prefix sum is the fastest of the four phases.",
        judge: build::prefix_sum,
    },
    Claim {
        title: "A parallel prefix sum",
        section: "6.3",
        text: "A work-efficient parallel prefix sum would be faster than the naive one.",
        judge: build::scan,
    },
    Claim {
        title: "Lines at the borders of cells",
        section: "4.3.3",
        text: "Filing a line under the cells of its box is enough to draw it.",
        judge: frame::borders,
    },
    Claim {
        title: "Layouts that change",
        section: "6.1.1",
        text: "The grid is too slow to build for layouts that change while they are shown.",
        judge: build::dynamic,
    },
    Claim {
        title: "A linear quadtree",
        section: "6.1.1, 6.3",
        text: "A linear quadtree is faster to build than the grid, but slower to query.",
        judge: build::quadtree,
    },
    Claim {
        title: "An AABB tree",
        section: "6.1.1",
        text: "An AABB tree follows layouts that change better than the grid, but can become \
               unbalanced.",
        judge: build::tree,
    },
];

/// Judges every claim by the measurements of a run.
pub fn findings(run: &Run) -> Vec<Finding> {
    let finding = |claim: &Claim| {
        let (verdict, evidence) = match (claim.judge)(run) {
            Some((true, evidence)) => (Verdict::Holds, evidence),
            Some((false, evidence)) => (Verdict::DoesNotHold, evidence),
            None => {
                let evidence = "This run lacks the measurements for a verdict.";
                (Verdict::NotMeasured, evidence.to_owned())
            }
        };
        Finding {
            title: claim.title.to_owned(),
            section: claim.section.to_owned(),
            claim: claim.text.to_owned(),
            verdict,
            evidence,
        }
    };
    CLAIMS.iter().map(finding).collect()
}
