//! Inputs as named fields: one declaration gives the layout, the type that solver, reference and
//! laws work on, and how it is taken from numbers in a row.

use crate::audit::{Input, Layout};
use rug::{Float, Rational};
use std::fmt::Debug;

/// A number of an input: `f64` for solvers, an exact fraction for references.
pub trait Number: Clone + Debug + 'static {
    /// How an input hands it out: by value if it is small, else by reference.
    type Of<'a>: Copy + Debug;
    /// Hands it out.
    fn of(&self) -> Self::Of<'_>;
    /// The nearest `f64`.
    fn nearest(&self) -> f64;
    /// The same of what is handed out.
    fn near(of: Self::Of<'_>) -> f64;
}

impl Number for f64 {
    type Of<'a> = f64;
    fn of(&self) -> f64 {
        *self
    }
    fn nearest(&self) -> f64 {
        *self
    }
    fn near(of: f64) -> f64 {
        of
    }
}

macro_rules! by_reference {
    ($($number:ty),*) => {$(
        impl Number for $number {
            type Of<'a> = &'a $number;
            fn of(&self) -> &$number {
                self
            }
            fn nearest(&self) -> f64 {
                self.to_f64()
            }
            fn near(of: &$number) -> f64 {
                of.to_f64()
            }
        }
    )*};
}
by_reference!(Rational, Float);

/// One line of a declaration.
#[derive(Clone)]
pub struct Field {
    /// As the layout shows it.
    pub input: Input,
    /// The name of the field in Rust, behind those of the groups that hold it:
    /// `linkage.geometry.l1`.
    pub path: String,
    /// Tells whether it is data; if not, it counts or chooses.
    pub is_data: bool,
}

/// Numbers in a row with the length of each field.
pub struct Row<'a, T> {
    numbers: &'a [T],
    /// None where every field is one number.
    lengths: Option<std::vec::IntoIter<usize>>,
}

impl<'a, T: Number> Row<'a, T> {
    pub(super) fn new(numbers: &'a [T], lengths: Vec<usize>) -> Row<'a, T> {
        let lengths = Some(lengths.into_iter());
        Row { numbers, lengths }
    }

    pub(super) fn of_singles(numbers: &'a [T]) -> Row<'a, T> {
        let lengths = None;
        Row { numbers, lengths }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    pub(super) fn list(&mut self) -> Option<&'a [T]> {
        let length = match &mut self.lengths {
            Some(lengths) => lengths.next()?,
            None => 1,
        };
        let (list, rest) = self.numbers.split_at_checked(length)?;
        self.numbers = rest;
        Some(list)
    }

    pub(super) fn number(&mut self) -> Option<T::Of<'a>> {
        let [number] = self.list()? else {
            return None;
        };
        Some(number.of())
    }
}

/// An input as a type.
pub trait Fields<'a, T: Number>: Copy {
    /// The declaration.
    fn fields() -> Vec<Field>;
    /// Returns the layout of its numbers, which is made once.
    fn layout() -> &'static Layout;
    /// Takes an input apart. Returns nothing if its numbers are not laid out as declared.
    fn unpack(numbers: &'a [T]) -> Option<Self> {
        let layout = Self::layout();
        if (0..layout.parts()).all(|part| layout.is_single(part)) {
            let mut row = Row::of_singles(numbers);
            return Self::take(&mut row).filter(|_| row.is_empty());
        }
        let nearest: Vec<f64> = numbers.iter().map(T::nearest).collect();
        Self::take(&mut Row::new(numbers, layout.lengths(&nearest).ok()?))
    }
    /// Takes it from the beginning of a row.
    fn take(row: &mut Row<'a, T>) -> Option<Self>;
}

/// Declares an input:
///
/// ```text
/// pub struct Triangle {
///     a: number "a", "m";                      one number
///     side: choice "side (1 or -1)", "1";      one that chooses or counts
///     weights: list "weights[n]", "kg";        several
///     ends: choices "ends[n]", "1";            several that choose
///     base: (Base);                            the fields of another input
/// }
/// ```
///
/// The texts are those of [`Layout`](crate::audit::Layout).
macro_rules! inputs {
    (
        $(#[$doc:meta])*
        pub struct $name:ident {
            $($(#[$about:meta])* $field:ident: $shape:tt $($text:literal, $unit:literal)?;)*
        }
    ) => {
        $(#[$doc])*
        pub struct $name<'a, T: $crate::methods::inputs::Number = f64> {
            $(
                #[doc = concat!("Field `", stringify!($field), "`"$(, ": `", $text, "`, unit ", $unit)?, ".")]
                $(#[$about])*
                pub $field: $crate::methods::inputs::inputs!(@type $shape 'a T),
            )*
        }

        impl<T: $crate::methods::inputs::Number> Clone for $name<'_, T> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<T: $crate::methods::inputs::Number> Copy for $name<'_, T> {}

        impl<T: $crate::methods::inputs::Number> std::fmt::Debug for $name<'_, T> {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.debug_struct(stringify!($name))$(.field(stringify!($field), &self.$field))*.finish()
            }
        }

        impl<'a, T: $crate::methods::inputs::Number> $crate::methods::inputs::Fields<'a, T> for $name<'a, T> {
            fn fields() -> Vec<$crate::methods::inputs::Field> {
                let mut all = Vec::new();
                $($crate::methods::inputs::inputs!(@declare all $field $shape 'a T $($text, $unit)?);)*
                all
            }
            fn layout() -> &'static $crate::audit::Layout {
                static LAYOUT: std::sync::OnceLock<$crate::audit::Layout> = std::sync::OnceLock::new();
                LAYOUT.get_or_init(|| {
                    let fields = <Self as $crate::methods::inputs::Fields<'a, T>>::fields();
                    $crate::audit::Layout::of_inputs(fields.into_iter().map(|f| f.input).collect())
                })
            }
            fn take(row: &mut $crate::methods::inputs::Row<'a, T>) -> Option<Self> {
                Some($name { $($field: $crate::methods::inputs::inputs!(@take row $shape)?),* })
            }
        }

        impl $name<'_> {
            /// The numbers in a row.
            pub fn to_vec(self) -> Vec<f64> {
                let mut all = Vec::new();
                $($crate::methods::inputs::inputs!(@put all self.$field, $shape);)*
                all
            }

            /// Its single numbers, to be changed.
            pub fn numbers_mut(&mut self) -> Vec<&mut f64> {
                #[allow(unused_mut, reason = "an input of lists alone has none")]
                let mut all = Vec::new();
                $($crate::methods::inputs::inputs!(@change all self.$field, $shape);)*
                all
            }
        }
    };
    (@type list $a:lifetime $t:ident) => { &$a [$t] };
    (@type choices $a:lifetime $t:ident) => { &$a [$t] };
    (@type ($group:ident) $a:lifetime $t:ident) => { $group<$a, $t> };
    (@type $one:ident $a:lifetime $t:ident) => { <$t as $crate::methods::inputs::Number>::Of<$a> };
    (@declare $all:ident $field:ident ($group:ident) $a:lifetime $t:ident) => {
        let fields = <$group<$a, $t> as $crate::methods::inputs::Fields<$a, $t>>::fields();
        $all.extend(fields.into_iter().map(|f| $crate::methods::inputs::Field {
            path: format!("{}.{}", stringify!($field), f.path),
            ..f
        }))
    };
    (@declare $all:ident $field:ident choice $a:lifetime $t:ident $text:literal, $unit:literal) => {
        $all.extend([$crate::methods::inputs::Field {
            input: $crate::audit::Input { name: $text, unit: $unit },
            path: stringify!($field).into(),
            is_data: false,
        }])
    };
    (@declare $all:ident $field:ident choices $a:lifetime $t:ident $text:literal, $unit:literal) => {
        $crate::methods::inputs::inputs!(@declare $all $field choice $a $t $text, $unit)
    };
    (@declare $all:ident $field:ident $data:ident $a:lifetime $t:ident $text:literal, $unit:literal) => {
        $all.extend([$crate::methods::inputs::Field {
            input: $crate::audit::Input { name: $text, unit: $unit },
            path: stringify!($field).into(),
            is_data: true,
        }])
    };
    (@take $row:ident list) => { $row.list() };
    (@take $row:ident choices) => { $row.list() };
    (@take $row:ident ($group:ident)) => { $crate::methods::inputs::Fields::take($row) };
    (@take $row:ident $one:ident) => { $row.number() };
    (@put $all:ident $value:expr, list) => { $all.extend_from_slice($value) };
    (@put $all:ident $value:expr, choices) => { $all.extend_from_slice($value) };
    (@put $all:ident $value:expr, ($group:ident)) => { $all.extend($value.to_vec()) };
    (@put $all:ident $value:expr, $one:ident) => { $all.extend([$value]) };
    (@change $all:ident $value:expr, list) => {};
    (@change $all:ident $value:expr, choices) => {};
    (@change $all:ident $value:expr, ($group:ident)) => { $all.extend($value.numbers_mut()) };
    (@change $all:ident $value:expr, $one:ident) => { $all.extend([&mut $value]) };
}
pub(super) use inputs;

#[cfg(test)]
mod tests {
    use super::*;

    inputs! {
        pub struct Base {
            length: number "l", "m";
            ends: choices "ends[n]", "1";
        }
    }

    inputs! {
        pub struct Prism {
            height: number "h", "m";
            kind: choice "kind", "1";
            base: (Base);
            weights: list "weights[n]", "kg";
        }
    }

    const LENGTHS: [usize; 5] = [1, 1, 1, 2, 3];
    const NUMBERS: [f64; 8] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];

    fn taken(numbers: &[f64]) -> Option<Prism<'_>> {
        Prism::take(&mut Row::new(numbers, LENGTHS.to_vec()))
    }

    #[test]
    fn fields_are_declared_in_their_order() {
        let fields = <Prism<'_, f64> as Fields<'_, f64>>::fields();
        let shown: Vec<_> = fields
            .iter()
            .map(|f| (f.input.name, f.input.unit, f.is_data))
            .collect();
        let due = [
            ("h", "m", true),
            ("kind", "1", false),
            ("l", "m", true),
            ("ends[n]", "1", false),
            ("weights[n]", "kg", true),
        ];
        assert_eq!(shown, due);
        let paths: Vec<&str> = fields.iter().map(|f| f.path.as_str()).collect();
        let due = ["height", "kind", "base.length", "base.ends", "weights"];
        assert_eq!(paths, due);
    }

    #[test]
    fn numbers_are_taken_and_given_back_in_their_order() {
        let mut prism = taken(&NUMBERS).unwrap();
        assert_eq!(
            (prism.height, prism.kind, prism.base.length),
            (1.0, 2.0, 3.0)
        );
        assert_eq!(
            (prism.base.ends, prism.weights),
            (&[4.0, 5.0][..], &[6.0, 7.0, 8.0][..])
        );
        assert_eq!(prism.to_vec(), NUMBERS);
        for single in prism.numbers_mut() {
            *single = -*single;
        }
        assert_eq!(prism.to_vec(), [-1.0, -2.0, -3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(
            format!("{:?}", prism.base),
            "Base { length: -3.0, ends: [4.0, 5.0] }"
        );
    }

    #[test]
    fn what_is_too_short_is_not_taken() {
        for length in 0..8 {
            assert!(taken(&NUMBERS[..length]).is_none(), "{length}");
        }
        // Numbers and lengths that are left over are for others.
        let longer = [&NUMBERS[..], &[9.0]].concat();
        let mut row = Row::new(&longer, [&LENGTHS[..], &[1]].concat());
        assert!(Prism::take(&mut row).is_some() && !row.is_empty());
        assert_eq!(row.number(), Some(9.0));
        assert!(row.is_empty() && row.number().is_none());
    }

    #[test]
    fn one_number_is_no_list() {
        let numbers = [1.0, 2.0];
        assert_eq!(Row::new(&numbers, vec![2]).number(), None);
        assert_eq!(Row::new(&numbers, vec![0, 2]).number(), None);
        assert_eq!(Row::new(&numbers, vec![2]).list(), Some(&numbers[..]));
        assert_eq!(Row::new(&numbers, Vec::new()).list(), None);
        let mut singles = Row::of_singles(&numbers);
        assert_eq!(
            [singles.number(), singles.number(), singles.number()],
            [Some(1.0), Some(2.0), None]
        );
    }

    #[test]
    fn the_nearest_number_is_that_of_any_type() {
        let third = Rational::from((1, 3));
        let float = Float::with_val(80, &third);
        assert_eq!(
            [third.nearest(), Rational::near(third.of())],
            [1.0 / 3.0; 2]
        );
        assert_eq!([float.nearest(), Float::near(float.of())], [1.0 / 3.0; 2]);
        assert_eq!([0.5f64.nearest(), f64::near(0.5f64.of())], [0.5; 2]);
    }
}
