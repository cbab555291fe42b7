//! The `record!` macro: defines a struct of the needed fields of a JSON object and its
//! deserialization, which skips all other fields.

/// Defines a record. Its field `repeated` holds the last key that occurred twice;
/// `has_other` states that the object has members that the record does not know.
///
/// `with &[names]` at the end adds a field `attributes` with the attributes of these names, and
/// with all members that the record does not know.
macro_rules! record {
    ($(#[doc = $doc:literal])* $name:ident $(<$life:lifetime>)? {
        $($field:ident: $type:ty = $key:literal,)*
    }) => {
        $(#[doc = $doc])*
        #[derive(Debug, Default)]
        pub(crate) struct $name $(<$life>)? {
            $(pub(crate) $field: Field<$type>,)*
            pub(crate) repeated: Option<&'static str>,
            pub(crate) has_other: bool,
        }

        record!(@impl $name $(<$life>)? { $($field = $key,)* });
    };
    ($(#[doc = $doc:literal])* $name:ident <$life:lifetime> {
        $($field:ident: $type:ty = $key:literal,)*
    } with $names:expr) => {
        $(#[doc = $doc])*
        #[derive(Debug, Default)]
        pub(crate) struct $name <$life> {
            $(pub(crate) $field: Field<$type>,)*
            pub(crate) attributes: crate::json::Attributes<$life>,
            pub(crate) repeated: Option<&'static str>,
            pub(crate) has_other: bool,
        }

        impl crate::json::HasAttributes for $name<'_> {
            const NAMES: &'static [&'static str] = $names;
        }

        impl<$life> FromJson<$life> for $name<$life> {
            record!(@read $life, crate::json::AttributeKey::of::<Self>, {
                |record: &mut Self, key, object: &mut A| -> Result<(), A::Error> {
                    if let Some(name) = record.attributes.read::<Self, A>(key, object)? {
                        record.repeated = Some(name);
                    }
                    Ok(())
                }
            } $($field = $key,)*);
        }
    };
    (@impl $name:ident { $($body:tt)* }) => {
        impl<'de> FromJson<'de> for $name {
            record!(@read 'de, |_: &str| None::<std::convert::Infallible>, {
                |_: &mut Self, never, _: &mut A| -> Result<(), A::Error> { match never {} }
            } $($body)*);
        }
    };
    (@impl $name:ident <$life:lifetime> { $($body:tt)* }) => {
        impl<$life> FromJson<$life> for $name<$life> {
            record!(@read $life, |_: &str| None::<std::convert::Infallible>, {
                |_: &mut Self, never, _: &mut A| -> Result<(), A::Error> { match never {} }
            } $($body)*);
        }
    };
    (@read $life:lifetime, $other:expr, { $read_other:expr } $($field:ident = $key:literal,)*) => {
        fn from_object<A: MapAccess<$life>>(mut object: A) -> Result<Field<Self>, A::Error> {
            #[allow(non_camel_case_types, reason = "a variant for each field, under its name")]
            enum Name<T> { $($field,)* Other(Option<T>) }
            let other = $other;
            let name = |key: &str| match key {
                $($key => Name::$field,)*
                _ => Name::Other(other(key)),
            };
            let read_other = $read_other;
            let mut record = Self::default();
            $(let mut $field = false;)*
            while let Some(key) = object.next_key_seed(Key(name))? {
                match key {
                    $(Name::$field => {
                        record.$field = object.next_value()?;
                        if std::mem::replace(&mut $field, true) {
                            record.repeated = Some($key);
                        }
                    })*
                    Name::Other(Some(key)) => read_other(&mut record, key, &mut object)?,
                    Name::Other(None) => {
                        record.has_other = true;
                        object.next_value::<IgnoredAny>()?;
                    }
                }
            }
            Ok(Field::Value(record))
        }
    };
}
pub(crate) use record;
