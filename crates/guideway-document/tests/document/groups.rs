//! Levels and vehicle types: created, renamed, changed and deleted.

use guideway_document::{
    Document, Elements, JournalEntry, LevelContent, LevelFacts, OperationError, PropertyRef,
    TypeUse, replay,
};
use guideway_layout::{CompareOptions, Layout, Quantity, Value, Zone, differences};
use guideway_scene::Table;

use crate::random_groups::facts;
use crate::site::{document_of, p, square};

fn named(id: &str) -> LevelFacts<'_> {
    facts(Some(id), None)
}

/// The identifiers of the levels, and that of each path, node and station.
pub(crate) fn levels(document: &Document) -> (Vec<&str>, [Vec<Option<&str>>; 3]) {
    let layout = document.layout();
    let id = |level: u32| layout.levels[level as usize].id.as_str();
    let of_rows = Table::ALL.map(|of| {
        let rows = document.existing(of);
        rows.map(|row| of.level(layout, row).map(id)).collect()
    });
    (
        layout.levels.iter().map(|l| l.id.as_str()).collect(),
        of_rows,
    )
}

/// Undoes all steps, redoes them, and replays the journal; each must give the same layout.
pub(crate) fn check_history(before: &Layout, document: &mut Document) {
    let exact = CompareOptions {
        tolerance_m: 0.0,
        relative_tolerance: 0.0,
    };
    let same = |a: &Layout, b: &Layout| {
        assert_eq!(differences(a, b, &exact), []);
        assert_eq!(differences(b, a, &exact), []);
        assert_eq!(a.levels, b.levels);
    };
    let after = document.to_layout();
    let entries = document.take_journal_entries();
    let journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
    let mut recovered = document_of(before.clone());
    replay(&journal, &mut recovered, |_| true);
    same(&after, &recovered.to_layout());
    let steps = std::iter::from_fn(|| document.undo()).count();
    same(before, &document.to_layout());
    assert_eq!(std::iter::from_fn(|| document.redo()).count(), steps);
    same(&after, &document.to_layout());
}

#[test]
fn a_level_is_created_renamed_and_takes_elements() {
    let mut layout = square();
    let attributes = &mut layout.nodes.attributes;
    attributes.set(0, "mapId", Value::Text("ground"));
    attributes.set(1, "mapId", Value::Text("elsewhere"));
    let mut document = document_of(layout.clone());
    let roof = document.create_level(&LevelFacts {
        name: Some("Roof"),
        ..facts(Some("roof"), Some(9.5))
    });
    assert_eq!(roof, Ok(2));
    assert_eq!(document.create_level(&LevelFacts::default()), Ok(3));
    assert_eq!(document.create_level(&LevelFacts::default()), Ok(4));
    let elements = document.elements_of_level(0);
    document.set_level(&elements, Some(2)).unwrap();
    document
        .change_level(
            2,
            &LevelFacts {
                name: Some("Roof"),
                ..facts(Some("top"), Some(9.5))
            },
        )
        .unwrap();
    document.change_level(0, &named("floor")).unwrap();
    let (ids, [paths, nodes, _]) = levels(&document);
    assert_eq!(ids, ["floor", "upper", "top", "level", "level 2"]);
    assert!(
        paths
            .iter()
            .chain(&nodes)
            .all(|level| *level == Some("top"))
    );
    let level = &document.layout().levels[2];
    assert_eq!(
        (level.name.as_deref(), level.elevation_m),
        (Some("Roof"), Some(9.5))
    );
    check_history(&layout, &mut document);
}

#[test]
fn the_maps_of_nodes_follow_the_name_of_their_level() {
    let mut layout = square();
    let attributes = &mut layout.nodes.attributes;
    attributes.set(0, "mapId", Value::Text("ground"));
    attributes.set(1, "mapId", Value::Text("elsewhere"));
    let mut document = document_of(layout.clone());
    document.change_level(0, &named("floor")).unwrap();
    let map = |row| document.layout().nodes.attributes.value(row, "mapId");
    let text = |text| Some(Value::Text(text));
    assert_eq!(
        [map(0), map(1), map(2)],
        [text("floor"), text("elsewhere"), None]
    );
    let moved = Elements {
        nodes: [0, 1].into_iter().collect(),
        ..Elements::default()
    };
    document.set_level(&moved, Some(1)).unwrap();
    let map = |row| document.layout().nodes.attributes.value(row, "mapId");
    assert_eq!([map(0), map(1)], [text("upper"), text("elsewhere")]);
    check_history(&layout, &mut document);
}

#[test]
fn a_wrong_name_of_a_level_changes_nothing() {
    let mut document = document_of(square());
    let taken = document
        .change_level(0, &named("upper"))
        .unwrap_err()
        .to_string();
    assert!(taken.contains("another level is called `upper`"), "{taken}");
    assert!(document.create_level(&named("ground")).is_err());
    assert!(document.create_level(&named("")).is_err());
    let unknown = document
        .change_level(9, &named("x"))
        .unwrap_err()
        .to_string();
    assert!(unknown.contains("no level in row 9"), "{unknown}");
    assert!(document.create_level(&facts(None, Some(f64::NAN))).is_err());
    assert!(!document.is_changed() && document.take_journal_entries().is_empty());
}

#[test]
fn a_level_with_elements_is_deleted_only_with_a_word_about_them() {
    let mut layout = square();
    layout.zones.push(Zone {
        id: "keep out".into(),
        outline_m: vec![p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0)],
        level: Some(0),
        ..Zone::default()
    });
    let mut document = document_of(layout.clone());
    let refused = document.delete_level(0, LevelContent::Keep).unwrap_err();
    let text = refused.to_string();
    assert!(
        text.contains("`ground` has 4 paths, 4 nodes, 2 stations and 1 zones"),
        "{text}"
    );
    let itself = document.delete_level(0, LevelContent::MoveTo(Some(0)));
    assert!(matches!(itself, Err(OperationError::SameLevel { .. })));
    assert!(
        document
            .delete_level(0, LevelContent::MoveTo(Some(7)))
            .is_err()
    );
    assert!(!document.is_changed());
    // A path that was deleted before comes back on its level when all is undone.
    document.delete(&Elements::of_paths([3]), false).unwrap();
    document
        .delete_level(0, LevelContent::MoveTo(Some(1)))
        .unwrap();
    let (ids, [paths, ..]) = levels(&document);
    assert_eq!((ids, paths), (vec!["upper"], vec![Some("upper"); 3]));
    assert_eq!(document.layout().zones[0].level, Some(0));
    check_history(&layout, &mut document);
}

#[test]
fn a_level_goes_with_its_elements_or_leaves_them_on_none() {
    for (content, left) in [(LevelContent::Delete, 0), (LevelContent::MoveTo(None), 4)] {
        let layout = square();
        let mut document = document_of(layout.clone());
        document.delete_level(0, content).unwrap();
        let (ids, [paths, nodes, _]) = levels(&document);
        assert_eq!((ids, paths.len(), nodes.len()), (vec!["upper"], left, left));
        assert!(paths.iter().chain(&nodes).all(Option::is_none));
        check_history(&layout, &mut document);
    }
}

#[test]
fn shown_levels_stay_when_others_are_deleted() {
    let mut document = document_of(square());
    document.create_level(&named("roof")).unwrap();
    document.show_level(Some(1));
    document
        .delete_level(0, LevelContent::MoveTo(Some(2)))
        .unwrap();
    assert_eq!(document.level(), Some(0), "the upper one has another row");
    assert!(document.shows_level(Some(0)) && !document.shows_level(Some(1)));
    assert!(
        document.scene().draw_order().is_empty(),
        "all is on the hidden roof"
    );
    document.delete_level(0, LevelContent::Keep).unwrap();
    assert_eq!(
        (document.level(), document.scene().draw_order().len()),
        (None, 4)
    );
}

#[test]
fn a_vehicle_type_is_created_renamed_and_followed() {
    let layout = square();
    let mut document = document_of(layout.clone());
    document.create_vehicle_type("crane", &[]).unwrap();
    let speed = Some(Value::Float(0.5));
    document
        .change_vehicle_type("tug", "tug", &[("maxSpeed", speed)])
        .unwrap();
    let of_tug = PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type: Some("tug"),
    };
    document
        .set_property(of_tug, &[0].into_iter().collect(), speed)
        .unwrap();
    document.change_vehicle_type("tug", "tugger", &[]).unwrap();
    let layout_now = document.layout();
    assert!(
        layout_now
            .paths
            .vehicle_types()
            .of(0)
            .eq(["tugger", "stacker"])
    );
    assert!(layout_now.nodes.vehicle_types().of(3).eq(["tugger"]));
    assert_eq!(layout_now.paths.value_for(0, "tugger", "maxSpeed"), speed);
    let table = layout_now.vehicle_types.iter().map(|t| t.id.as_str());
    assert!(table.eq(["crane", "tugger"]));
    let column = layout_now.vehicle_types[1]
        .attributes
        .get("maxSpeed")
        .unwrap();
    assert_eq!(column.quantity, Some(Quantity::Speed));
    for (old, new) in [
        ("tugger", "stacker"),
        ("crane", "tugger"),
        ("crane", ""),
        ("x", "y"),
    ] {
        assert!(
            document.change_vehicle_type(old, new, &[]).is_err(),
            "{old} to {new}"
        );
    }
    assert!(document.create_vehicle_type("stacker", &[]).is_err());
    check_history(&layout, &mut document);
}

#[test]
fn the_maker_in_a_name_follows_a_new_name() {
    let mut layout = square();
    let mut maker = guideway_layout::VehicleType {
        id: "Acme Works Tug 3".into(),
        ..Default::default()
    };
    maker
        .attributes
        .set(0, "manufacturer", Value::Text("Acme Works"));
    maker.attributes.set(0, "seriesName", Value::Text("Tug 3"));
    layout.vehicle_types.push(maker);
    let mut document = document_of(layout.clone());
    document
        .change_vehicle_type("Acme Works Tug 3", "Acme Works Tug 4", &[])
        .unwrap();
    let part = |document: &Document, part| {
        let value = document.layout().vehicle_types[0].attributes.value(0, part);
        value.map(|value| value.to_string())
    };
    assert_eq!(part(&document, "seriesName").as_deref(), Some("Tug 4"));
    document
        .change_vehicle_type("Acme Works Tug 4", "Other Tug", &[])
        .unwrap();
    assert_eq!(part(&document, "manufacturer"), None);
    check_history(&layout, &mut document);
}

#[test]
fn a_vehicle_type_in_use_is_deleted_only_with_a_word_about_its_paths() {
    let layout = square();
    let mut document = document_of(layout.clone());
    let only = [1].into_iter().collect();
    document
        .set_vehicle_types(Table::Paths, &only, &["tug"])
        .unwrap();
    let keep = document
        .delete_vehicle_type("tug", TypeUse::Keep)
        .unwrap_err();
    let text = keep.to_string();
    assert!(
        text.contains("2 paths and 4 nodes name the vehicle type `tug`"),
        "{text}"
    );
    let opens = document
        .delete_vehicle_type("tug", TypeUse::Remove)
        .unwrap_err();
    assert!(
        opens
            .to_string()
            .contains("`bc` would be open to all types"),
        "{opens}"
    );
    assert!(
        document
            .delete_vehicle_type("tug", TypeUse::Replace("tug"))
            .is_err()
    );
    assert!(
        document
            .delete_vehicle_type("tug", TypeUse::Replace("x"))
            .is_err()
    );
    let both = PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type: Some("tug"),
    };
    let rows = [0, 1].into_iter().collect();
    document
        .set_property(both, &rows, Some(Value::Float(0.5)))
        .unwrap();
    document
        .delete_vehicle_type("tug", TypeUse::Replace("stacker"))
        .unwrap();
    let paths = &document.layout().paths;
    assert!(
        paths.vehicle_types().of(0).eq(["stacker"]) && paths.vehicle_types().of(1).eq(["stacker"])
    );
    let speed = |row| paths.value_for(row, "stacker", "maxSpeed");
    let number = |value| Some(Value::Float(value));
    assert_eq!([speed(0), speed(1)], [number(1.5), number(0.5)]);
    document
        .set_vehicle_types(Table::Paths, &rows, &["stacker", "crane"])
        .unwrap();
    document
        .delete_vehicle_type("stacker", TypeUse::Remove)
        .unwrap();
    assert!(document.layout().paths.vehicle_types().of(1).eq(["crane"]));
    let stacker = ["stacker".to_owned()].into();
    assert_eq!(document.count_users_of_types(&stacker), [0, 0]);
    check_history(&layout, &mut document);
}
