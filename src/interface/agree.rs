//! Is a host struct the same bytes as the shader's struct of that name?
//!
//! Needs nothing but a module `reflected` in scope where it is used, as `shader_build::generate` writes
//! it.

/// Stops the build unless the struct named agrees with the shader's: each field's offset and size, the
/// whole size, and that neither side has a field which the list lacks. The error names the field.
///
/// ```text
/// agree!(Light { position, intensity, radius });
/// ```
macro_rules! agree {
    ($name:ident { $($field:ident),+ $(,)? }) => {
        // A field that the list forgets is missing here, and rustc names it (in a pattern made by a
        // macro it would not).
        const _: fn($name) -> $name = |host| $name { $($field: host.$field),+ };
        const _: reflected::$name::Fields = reflected::$name::Fields { $($field: ()),+ };
        $(
            const _: () = assert!(
                core::mem::offset_of!($name, $field) == reflected::$name::$field,
                concat!(stringify!($name), ".", stringify!($field),
                    ": its offset is not the shader's")
            );
            const _: () = {
                const fn size_of_target<T, F>(_: fn(&T) -> &F) -> usize {
                    core::mem::size_of::<F>()
                }
                assert!(
                    size_of_target(|host: &$name| &host.$field) == reflected::$name::sizes::$field,
                    concat!(stringify!($name), ".", stringify!($field),
                        ": its size is not the shader's")
                );
            };
        )+
        const _: () = assert!(
            core::mem::size_of::<$name>() == reflected::$name::SIZE,
            concat!(stringify!($name), ": its size is not the shader's")
        );
    };
}

pub(crate) use agree;
