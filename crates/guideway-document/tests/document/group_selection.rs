//! Levels and vehicle types in the selection: selected, found, changed, deleted, copied.

use guideway_document::{
    Document, Elements, Group, LevelContent, LevelFact, PropertyRef, SelectMode, TypeUse, located,
    search_groups,
};
use guideway_layout::{Layout, Value};
use guideway_scene::Table;
use guideway_spline::Affine;

use crate::groups::{check_history, levels};
use crate::random_groups::facts;
use crate::site::{document_of, p, square};

fn tug() -> Group {
    Group::VehicleType("tug".into())
}

fn select(document: &mut Document, groups: impl IntoIterator<Item = Group>) {
    let mut all = Elements::default();
    groups.into_iter().for_each(|group| all.insert_group(group));
    document.select_elements(&all, SelectMode::Replace);
}

fn selected(document: &Document) -> Vec<Group> {
    document.selected().groups().collect()
}

fn types(document: &Document) -> Vec<String> {
    let names = document.layout().vehicle_type_names();
    names.into_iter().map(str::to_owned).collect()
}

#[test]
fn levels_and_types_are_selected_beside_elements() {
    let mut document = document_of(square());
    select(
        &mut document,
        [
            Group::Level(1),
            Group::Level(7),
            Group::VehicleType("x".into()),
        ],
    );
    assert_eq!(
        selected(&document),
        [Group::Level(1)],
        "others do not exist"
    );
    document.select_elements(&Elements::of_group(&tug()), SelectMode::Add);
    document.select([2].into_iter().collect(), SelectMode::Add);
    assert_eq!(selected(&document), [Group::Level(1), tug()]);
    assert!(document.selected().has_elements());
    document.select_elements(&Elements::of_group(&Group::Level(1)), SelectMode::Remove);
    assert_eq!(selected(&document), [tug()]);
    document.select([2].into_iter().collect(), SelectMode::Replace);
    assert!(!document.selected().has_groups());
}

#[test]
fn members_are_the_elements_of_a_level_and_the_paths_open_to_a_type() {
    let mut document = document_of(square());
    document
        .set_vehicle_types(Table::Paths, &[1].into_iter().collect(), &["stacker"])
        .unwrap();
    let rows = |group: &Group| {
        let members = document.members(group);
        Table::ALL.map(|of| members.rows(of).len())
    };
    assert_eq!(rows(&Group::Level(0)), [4, 4, 2]);
    assert_eq!(rows(&Group::Level(1)), [0; 3]);
    assert_eq!(
        rows(&tug()),
        [3, 4, 0],
        "paths without types are open to all"
    );
    let bounds = document.bounds_of_all(&Elements::of_group(&Group::Level(0)));
    let bounds = bounds.unwrap();
    assert_eq!((bounds.min, bounds.max), (p(0.0, -1.0), p(11.0, 10.0)));
}

#[test]
fn levels_and_types_are_found_by_a_part_of_their_names() {
    let mut document = document_of(square());
    document
        .set_level_fact(&[1].into_iter().collect(), LevelFact::Name("Tug loft"))
        .unwrap();
    let found = search_groups(document.layout(), "TUG");
    assert_eq!(found, [Group::Level(1), tug()]);
    assert_eq!(found[0].id(document.layout()), Some("upper"));
    assert_eq!(search_groups(document.layout(), ""), []);
    assert!(located(&guideway_layout::Place::default()).is_none());
}

#[test]
fn the_selection_follows_new_rows_and_names() {
    let mut document = document_of(square());
    document.create_level(&facts(Some("roof"), None)).unwrap();
    select(&mut document, [Group::Level(2), tug()]);
    document.delete_level(1, LevelContent::Keep).unwrap();
    assert_eq!(selected(&document), [Group::Level(1), tug()]);
    document.change_vehicle_type("tug", "tugger", &[]).unwrap();
    let tugger = Group::VehicleType("tugger".into());
    assert_eq!(selected(&document), [Group::Level(1), tugger.clone()]);
    document.undo();
    document.undo();
    assert_eq!(selected(&document), [Group::Level(2), tug()]);
    document.redo();
    document.redo();
    assert_eq!(selected(&document), [Group::Level(1), tugger]);
}

#[test]
fn one_fact_of_several_levels_or_types_is_set_in_one_step() {
    let layout = square();
    let mut document = document_of(layout.clone());
    let both = [0, 1].into_iter().collect();
    document
        .set_level_fact(&both, LevelFact::Elevation(Some(4.5)))
        .unwrap();
    let names = ["stacker", "tug"].map(str::to_owned).into_iter().collect();
    document
        .set_type_property(&names, "maxSpeed", Some(Value::Float(1.2)))
        .unwrap();
    let heights = document.layout().levels.iter().map(|l| l.elevation_m);
    assert!(heights.eq([Some(4.5); 2]));
    let speeds = document.layout().vehicle_types.iter();
    let speeds = speeds.map(|t| t.attributes.value(0, "maxSpeed"));
    assert!(speeds.eq([Some(Value::Float(1.2)); 2]));
    check_history(&layout, &mut document);
    document.take_journal_entries();
    // Two levels cannot have one identifier: the first keeps its own too.
    let before = document.state();
    assert!(document.set_level_fact(&both, LevelFact::Id("x")).is_err());
    assert_eq!(document.layout().levels[0].id, "ground");
    assert_eq!(document.state(), before);
    assert!(document.take_journal_entries().is_empty());
    document.undo();
    document.undo();
    assert!(!document.is_changed(), "each is one step");
}

#[test]
fn a_refused_edit_of_several_keeps_what_can_be_redone() {
    let mut document = document_of(square());
    document.create_level(&facts(Some("roof"), None)).unwrap();
    document.undo();
    let both = [0, 1].into_iter().collect();
    assert!(document.set_level_fact(&both, LevelFact::Id("x")).is_err());
    assert_eq!(document.redo(), Some("create level"));
}

#[test]
fn selected_levels_types_and_elements_are_deleted_in_one_step() {
    let layout = square();
    let mut document = document_of(layout.clone());
    document.create_level(&facts(Some("roof"), None)).unwrap();
    select(&mut document, [Group::Level(0), Group::Level(1), tug()]);
    document.select([2].into_iter().collect(), SelectMode::Add);
    let chosen = document.selected().clone();
    document
        .delete_all(
            &chosen,
            LevelContent::MoveTo(Some(2)),
            TypeUse::Replace("stacker"),
        )
        .unwrap();
    let (ids, [paths, ..]) = levels(&document);
    assert_eq!((ids, paths), (vec!["roof"], vec![Some("roof"); 3]));
    assert_eq!(types(&document), ["stacker"]);
    assert!(document.selected().is_empty());
    assert_eq!(document.undo_redo_names().0, Some("delete"));
    check_history(&layout, &mut document);
}

#[test]
fn a_deletion_that_would_open_a_path_changes_nothing() {
    let mut document = document_of(square());
    let only = [2].into_iter().collect();
    document
        .set_vehicle_types(Table::Paths, &only, &["tug"])
        .unwrap();
    document.take_journal_entries();
    let state = document.state();
    select(&mut document, [Group::Level(1), tug()]);
    let chosen = document.selected().clone();
    let refused = document.delete_all(&chosen, LevelContent::Delete, TypeUse::Remove);
    assert!(refused.unwrap_err().to_string().contains("`cd`"));
    assert_eq!((document.state(), types(&document).len()), (state, 2));
    assert_eq!(selected(&document), [Group::Level(1), tug()]);
    assert!(document.take_journal_entries().is_empty());
}

#[test]
fn a_level_is_copied_with_all_that_is_on_it() {
    let mut layout = square();
    layout.levels[0].name = Some("Ground floor".into());
    layout.levels[0].elevation_m = Some(1.5);
    let mut document = document_of(layout.clone());
    let clip = document
        .clip(&Elements::of_group(&Group::Level(0)))
        .unwrap();
    let pasted = document.paste(&clip, Affine::IDENTITY, Some(1)).unwrap();
    assert_eq!(Table::ALL.map(|of| pasted.rows(of).len()), [4, 4, 2]);
    let copy = document.layout().levels.last().unwrap();
    assert_eq!(
        (&*copy.id, copy.name.as_deref()),
        ("ground 2", Some("Ground floor 2"))
    );
    assert_eq!(copy.elevation_m, Some(1.5));
    let on_copy = document.elements_of_level(2);
    assert_eq!(Table::ALL.map(|of| on_copy.rows(of).len()), [4, 4, 2]);
    assert_eq!(selected(&document), [Group::Level(2)]);
    assert!(
        !document.selected().has_elements(),
        "they go with their level"
    );
    assert_eq!(document.undo_redo_names().0, Some("paste"));
    check_history(&layout, &mut document);
}

#[test]
fn a_copied_type_may_use_what_the_original_may() {
    let layout = square();
    let mut document = document_of(layout.clone());
    let of_tug = PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type: Some("tug"),
    };
    let speed = Some(Value::Float(0.5));
    let first = [0].into_iter().collect();
    document.set_property(of_tug, &first, speed).unwrap();
    let clip = document.clip(&Elements::of_group(&tug())).unwrap();
    assert!(clip.has_groups());
    document.paste(&clip, Affine::IDENTITY, None).unwrap();
    assert_eq!(selected(&document), [Group::VehicleType("tug 2".into())]);
    let paths = &document.layout().paths;
    assert!(paths.vehicle_types().of(0).eq(["tug", "stacker", "tug 2"]));
    assert_eq!(paths.value_for(0, "tug 2", "maxSpeed"), speed);
    assert!(
        document
            .layout()
            .nodes
            .vehicle_types()
            .of(3)
            .eq(["tug", "tug 2"])
    );
    check_history(&layout, &mut document);
    // A file without the type gets it with the properties that it has everywhere.
    let mut other = document_of(Layout::default());
    other.paste(&clip, Affine::IDENTITY, None).unwrap();
    assert_eq!(types(&other), ["tug"]);
}

#[test]
fn all_levels_are_shown_when_the_only_shown_one_is_undone() {
    let mut document = document_of(square());
    let row = document.create_level(&facts(Some("roof"), None)).unwrap();
    document.show_level(Some(row));
    assert!(document.scene().draw_order().is_empty());
    document.undo();
    assert_eq!(
        (document.level(), document.scene().draw_order().len()),
        (None, 4)
    );
}
