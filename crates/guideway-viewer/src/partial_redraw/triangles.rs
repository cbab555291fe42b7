//! The triangles of a frame with the pixels that they may touch, and those of some pixels alone.

use eframe::egui::{ClippedPrimitive, Color32, Mesh, Rect, TextureId};
use eframe::epaint::{Primitive, Vertex};

use super::pixel_rect::PixelRect;

/// Below everything. The panels of the window cover it.
const BACKGROUND: Color32 = Color32::BLACK;

/// The meshes of a frame, in the order in which they are drawn.
pub(super) struct FrameTriangles {
    meshes: Vec<ClippedMesh>,
    /// Size of the window in pixels.
    pub(super) size: [u32; 2],
    /// Pixels per point.
    pub(super) scale: f32,
}

/// A mesh, the pixels that show it, and those of each of its triangles.
struct ClippedMesh {
    mesh: Mesh,
    clip: PixelRect,
    triangles: Vec<PixelRect>,
}

/// One triangle of a frame.
pub(super) struct Triangle {
    pub(super) texture: TextureId,
    pub(super) clip: PixelRect,
    pub(super) corners: [Vertex; 3],
    /// The pixels that it may touch, at least one.
    pub(super) pixels: PixelRect,
}

impl Triangle {
    /// The part of the texture between its corners.
    pub(super) fn uv(&self) -> Rect {
        Rect::from_points(&self.corners.map(|corner| corner.uv))
    }
}

impl FrameTriangles {
    /// Takes what egui would draw. The window has no paint callbacks, which are left out.
    pub(super) fn new(primitives: Vec<ClippedPrimitive>, size: [u32; 2], scale: f32) -> Self {
        let meshes = primitives.into_iter().filter_map(|primitive| {
            let Primitive::Mesh(mesh) = primitive.primitive else {
                return None;
            };
            let clip = PixelRect::of_clip(primitive.clip_rect, scale, size);
            (!clip.is_empty()).then(|| ClippedMesh::new(mesh, clip, size, scale))
        });
        Self {
            meshes: meshes.collect(),
            size,
            scale,
        }
    }

    /// The triangles that touch pixels, in the order in which they are drawn.
    pub(super) fn visible(&self) -> impl Iterator<Item = Triangle> {
        self.meshes.iter().flat_map(|clipped| {
            let corners = clipped.mesh.indices.as_chunks().0;
            let visible = corners.iter().zip(&clipped.triangles);
            let visible = visible.filter(|(_, pixels)| !pixels.is_empty());
            visible.map(|(corners, pixels)| Triangle {
                texture: clipped.mesh.texture_id,
                clip: clipped.clip,
                corners: clipped.corners(*corners),
                pixels: *pixels,
            })
        })
    }

    /// The primitives that draw the frame in these rectangles and nothing elsewhere.
    pub(super) fn within(&self, rects: &[PixelRect]) -> Vec<ClippedPrimitive> {
        let mut parts = Vec::new();
        for &rect in rects {
            let mut background = Mesh::default();
            let everywhere = PixelRect::whole(self.size).to_clip(self.scale);
            background.add_colored_rect(everywhere, BACKGROUND);
            let meshes = self.meshes.iter().filter_map(|mesh| mesh.within(rect));
            let meshes = std::iter::once((background, rect)).chain(meshes);
            parts.extend(meshes.map(|(mesh, clip)| ClippedPrimitive {
                clip_rect: clip.to_clip(self.scale),
                primitive: Primitive::Mesh(mesh),
            }));
        }
        parts
    }
}

impl ClippedMesh {
    fn new(mesh: Mesh, clip: PixelRect, size: [u32; 2], scale: f32) -> Self {
        let mut clipped = Self {
            mesh,
            clip,
            triangles: Vec::new(),
        };
        let pixels = clipped.mesh.indices.as_chunks().0.iter().map(|corners| {
            let corners = clipped.corners(*corners).map(|corner| corner.pos);
            PixelRect::around(corners, scale, size).intersect(clip)
        });
        clipped.triangles = pixels.collect();
        clipped
    }

    fn corners(&self, indices: [u32; 3]) -> [Vertex; 3] {
        indices.map(|index| self.mesh.vertices[index as usize])
    }

    /// The triangles that touch a rectangle, and the part of it that shows them. Those that do not
    /// are points, which draw nothing: a software device draws two triangles as one rectangle where
    /// their places in the list suit, with other last bits, so each keeps its place and neighbors.
    fn within(&self, rect: PixelRect) -> Option<(Mesh, PixelRect)> {
        let clip = self.clip.intersect(rect);
        if clip.is_empty() {
            return None;
        }
        if rect.contains(self.clip) {
            return Some((self.mesh.clone(), clip));
        }
        let touches: Vec<bool> = self
            .triangles
            .iter()
            .map(|pixels| !pixels.intersect(rect).is_empty())
            .collect();
        if !touches.contains(&true) {
            return None;
        }
        let mut part = Mesh::with_texture(self.mesh.texture_id);
        part.indices.reserve(self.mesh.indices.len());
        let mut new_indices = vec![None; self.mesh.vertices.len()];
        for (number, corners) in self.mesh.indices.as_chunks::<3>().0.iter().enumerate() {
            let neighbors = number.saturating_sub(1)..touches.len().min(number + 2);
            if !touches[neighbors].contains(&true) {
                part.indices.extend([0; 3]);
                continue;
            }
            for &old in corners {
                let new = *new_indices[old as usize].get_or_insert_with(|| {
                    part.vertices.push(self.mesh.vertices[old as usize]);
                    part.vertices.len() as u32 - 1
                });
                part.indices.push(new);
            }
        }
        Some((part, clip))
    }
}
