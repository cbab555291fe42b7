//! The icon of the window: a lane that turns, between two nodes.

use eframe::egui::IconData;

/// Side in pixels.
const SIDE: u32 = 64;
const PAPER: [f32; 3] = [43.0, 92.0, 150.0];
const INK: [f32; 3] = [255.0, 255.0, 255.0];
/// Half the width of the lane, and the radius of a node, in pixels.
const LANE: f32 = 3.5;
const NODE: f32 = 8.0;
/// Radius of the corners of the paper, in pixels.
const CORNER: f32 = 12.0;
/// The lane: a quarter of a circle about this center, in pixels; y down.
const CENTER: [f32; 2] = [14.0, 14.0];
const RADIUS: f32 = 35.0;

/// Draws the icon.
pub(crate) fn window_icon() -> IconData {
    let pixels = (0..SIDE * SIDE).flat_map(|index| {
        let at = [index % SIDE, index / SIDE].map(|side| side as f32 + 0.5);
        pixel(at)
    });
    IconData {
        rgba: pixels.collect(),
        width: SIDE,
        height: SIDE,
    }
}

/// The color of a pixel, whose coverage is that of a ramp one pixel wide.
fn pixel(at: [f32; 2]) -> [u8; 4] {
    let distance = |[x, y]: [f32; 2]| (at[0] - x).hypot(at[1] - y);
    let covered = |outside: f32| (0.5 - outside).clamp(0.0, 1.0);
    let [x, y] = CENTER;
    let is_on_arc = at[0] >= x && at[1] >= y;
    let lane = match is_on_arc {
        true => covered((distance(CENTER) - RADIUS).abs() - LANE),
        false => 0.0,
    };
    let ends = [[x + RADIUS, y], [x, y + RADIUS]];
    let nodes = ends.map(|end| covered(distance(end) - NODE));
    let ink = nodes.into_iter().fold(lane, f32::max);
    let half = SIDE as f32 / 2.0;
    let beyond = at.map(|side| ((side - half).abs() - (half - CORNER)).max(0.0));
    let paper = covered(beyond[0].hypot(beyond[1]) - CORNER);
    let mix = |channel: usize| PAPER[channel] + (INK[channel] - PAPER[channel]) * ink;
    let [r, g, b] = [0, 1, 2].map(|channel| mix(channel).round() as u8);
    [r, g, b, (255.0 * paper).round() as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_lane_nodes_and_clear_corners() {
        let icon = window_icon();
        assert_eq!(icon.rgba.len(), 4 * (SIDE * SIDE) as usize);
        let at = |x: u32, y: u32| {
            let start = 4 * (y * SIDE + x) as usize;
            <[u8; 4]>::try_from(&icon.rgba[start..start + 4]).unwrap()
        };
        assert_eq!(at(0, 0)[3], 0);
        assert_eq!(at(49, 14), [255; 4], "a node");
        assert_eq!(at(38, 38), [255; 4], "the lane");
        assert_eq!(at(20, 20), [43, 92, 150, 255]);
    }
}
