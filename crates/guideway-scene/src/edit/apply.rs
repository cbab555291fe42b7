//! Applies edits to a scene and computes their inverses.

use std::sync::Arc;

use guideway_layout::{NewPath, OwnStyle, for_each_row};

use super::error::EditError;
use super::operation::{Edit, Insertion};
use crate::color::Rgba;
use crate::scene::{Colors, PathState, Scene};

impl Scene {
    /// Applies an edit. Copies the layout first if other owners share it.
    ///
    /// # Errors
    /// When the edit names an unknown row or exceeds the coordinate limit; the scene is unchanged.
    pub fn edit(&mut self, edit: &Edit) -> Result<(), EditError> {
        edit.check(self)?;
        self.apply(edit);
        Ok(())
    }

    /// Applies an edit and returns its inverse, which holds as many bytes as the edit changes.
    ///
    /// Calls `on_accepted` once the edit is certain to succeed, before most of the work: another
    /// thread can apply it at the same time.
    ///
    /// # Errors
    /// As [`Self::edit`].
    pub fn edit_with_undo(
        &mut self,
        edit: &Edit,
        on_accepted: impl FnOnce(&Edit),
    ) -> Result<Edit, EditError> {
        edit.check(self)?;
        if edit.changes_layout() {
            // Copies a shared layout now, so that the observer, then its only other owner, need not
            // copy it too.
            Arc::make_mut(&mut self.layout);
        }
        on_accepted(edit);
        let undo = self.inverse_of(edit);
        self.apply(edit);
        Ok(undo)
    }

    /// The inverse of an edit that is not applied yet.
    fn inverse_of(&self, edit: &Edit) -> Edit {
        match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => {
                let rows: Vec<usize> = paths.iter().map(|&path| path as usize).collect();
                let of_layout = &self.layout.paths;
                Edit::Reshape {
                    paths: Arc::clone(paths),
                    written: Arc::new(of_layout.written_curves().select(&rows)),
                    curves: Arc::new(of_layout.geometry().select(rows)),
                }
            }
            Edit::Restyle(styles) => {
                let own_style = |path: u32| self.layout.paths.own_style(path as usize);
                Edit::Restyle(
                    styles
                        .iter()
                        .map(|&(path, _)| (path, own_style(path)))
                        .collect(),
                )
            }
            Edit::SetStates(states) => {
                let before = states.iter().map(|&(path, _)| (path, self.state(path)));
                Edit::SetStates(before.collect())
            }
            Edit::Insert(paths) => {
                let first = self.row_count() as u32;
                let rows = first..first + paths.len() as u32;
                Edit::SetStates(rows.map(|path| (path, PathState::Removed)).collect())
            }
            Edit::Tables(edit) => Edit::Tables(edit.inverse(self)),
        }
    }

    /// Applies a checked edit.
    fn apply(&mut self, edit: &Edit) {
        match edit {
            Edit::Transform { paths, by } => {
                let layout = Arc::make_mut(&mut self.layout);
                let rows = paths.iter().map(|&path| path as usize);
                layout.paths.transform(rows, *by);
                self.invalidate_bounds();
            }
            Edit::Reshape {
                paths,
                curves,
                written,
            } => {
                let layout = Arc::make_mut(&mut self.layout);
                layout.paths.replace_curves(paths, curves, written);
                self.invalidate_bounds();
            }
            Edit::Restyle(styles) => self.restyle(styles),
            Edit::SetStates(states) => self.set_states(states),
            Edit::Insert(paths) => self.insert(paths),
            Edit::Tables(edit) => self.apply_to_tables(edit),
        }
    }

    fn restyle(&mut self, styles: &[(u32, OwnStyle)]) {
        let row = |style: &(u32, OwnStyle)| style.0;
        self.track_styles(styles, &row, |scene| {
            Arc::make_mut(&mut scene.layout)
                .paths
                .set_own_styles(styles);
            if scene.legend().is_none() {
                scene.follow_own_colors(styles);
            }
        });
    }

    /// Gives restyled paths their own colors.
    fn follow_own_colors(&mut self, styles: &[(u32, OwnStyle)]) {
        let rows = self.row_count();
        let before = std::mem::replace(&mut self.coloring.colors, Colors::One(Rgba::BLACK));
        let (layout, coloring) = (&self.layout, &self.coloring);
        let own = |path: u32| coloring.own_color(layout, path);
        let mut colors = match before {
            Colors::One(one) if styles.iter().all(|&(path, _)| own(path) == one) => {
                self.coloring.colors = before;
                return;
            }
            Colors::One(one) => vec![one; rows],
            Colors::Each(colors) => colors,
        };
        let row = |style: &(u32, OwnStyle)| style.0;
        for_each_row(&mut colors, styles, &row, &|to, &(path, _)| *to = own(path));
        self.coloring.colors = Colors::Each(colors);
    }

    fn set_color(&mut self, path: u32, color: Rgba) {
        let rows = self.row_count();
        match &mut self.coloring.colors {
            Colors::One(one) if *one == color => {}
            Colors::One(one) => {
                let mut colors = vec![*one; rows];
                colors[path as usize] = color;
                self.coloring.colors = Colors::Each(colors);
            }
            Colors::Each(colors) => colors[path as usize] = color,
        }
    }

    fn insert(&mut self, paths: &[Insertion]) {
        let first = self.row_count() as u32;
        let layout = Arc::make_mut(&mut self.layout);
        for path in paths {
            let vehicle_types: Vec<&str> = path.vehicle_types.iter().map(String::as_str).collect();
            let row = layout.paths.push(&NewPath {
                id: &path.id,
                runs: &path.runs,
                start_node: path.start_node,
                end_node: path.end_node,
                direction: path.direction,
                level: path.level,
                vehicle_types: &vehicle_types,
            });
            layout.paths.set_own_style(row, path.style);
            if let Some(from) = path.attributes_of {
                layout.paths.attributes.copy_row(from as usize, row);
                let entries = layout.paths.vehicle_types_mut();
                entries.copy_values(from as usize, row);
                layout.paths.copy_rank(from as usize, row);
            }
            if let Some(rank) = path.rank {
                layout.paths.set_path_rank(row, rank);
            }
            if let Some(curve) = &path.written {
                layout.paths.share_written_curve(row, Arc::clone(curve));
            }
        }
        let rows = self.row_count();
        if let Colors::Each(colors) = &mut self.coloring.colors {
            colors.resize(rows, Rgba::BLACK);
        }
        for (row, path) in (first..).zip(paths) {
            // In a scene colored by a column, a copied path takes the color of its original.
            let color = match path.attributes_of.filter(|_| self.legend().is_some()) {
                Some(from) => self.color(from),
                None => self.own_color(row),
            };
            self.set_color(row, color);
        }
        self.show_new_rows(first as usize);
    }
}
