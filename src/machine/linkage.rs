//! The file that describes a linkage. Every quantity is a string with its unit.

use super::class_iii;
use super::dyad::{self, Dyad};
use super::planar;
use super::source::{Refusal, Source};
use serde::Deserialize;
use serde::de::IgnoredAny;

/// A linkage of one of the known types.
pub enum Linkage {
    /// Of class III.
    ClassIii(Box<class_iii::Linkage>),
    /// Four-bar or slider-crank.
    Dyad(Box<Dyad>),
    /// Bodies and joints of any structure.
    Planar(Box<planar::Machine>),
}

/// The type alone; everything else is read by the type's own section.
#[derive(Deserialize)]
struct Head {
    #[serde(rename = "type")]
    linkage: Option<Type>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Type {
    ClassIii,
    FourBar,
    SliderCrank,
    Planar,
}

impl Linkage {
    /// Returns true if the source names a type, as the descriptions of linkages do.
    pub fn names_type(source: &Source) -> bool {
        #[derive(Deserialize)]
        struct Any {
            #[serde(rename = "type")]
            linkage: Option<IgnoredAny>,
        }
        source.parse::<Any>().is_ok_and(|any| any.linkage.is_some())
    }

    /// Returns true for a mechanism of bodies and joints.
    ///
    /// # Errors
    /// [`Refusal`].
    #[cfg(feature = "report")]
    pub(super) fn is_planar(source: &Source) -> Result<bool, Refusal> {
        let head: Head = source.parse()?;
        Ok(matches!(head.linkage, Some(Type::Planar)))
    }

    /// Reads the description of a linkage.
    ///
    /// ```
    /// use mechaudit_cli::machine::{Linkage, Source};
    /// let source = Source::toml(r#"
    ///     type = "four-bar"
    ///     [geometry]
    ///     crank = "10 cm"
    ///     coupler = "30 cm"
    ///     rocker = "2.5 dm"
    ///     frame = "350 mm"
    /// "#);
    /// let Linkage::Dyad(linkage) = Linkage::read(&source)? else { unreachable!() };
    /// assert_eq!(linkage.shape.type_name(), "four-bar");
    ///
    /// let longer = Source::toml("type = \"four-bar\"\n[geometry]\ncrank = \"10 s\"");
    /// let Err(e) = Linkage::read(&longer) else { unreachable!() };
    /// assert_eq!(
    ///     e.to_string(),
    ///     "line 3: geometry.crank = \"10 s\" is not a length; write it for instance in cm"
    /// );
    /// # Ok::<(), mechaudit_cli::machine::Refusal>(())
    /// ```
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn read(source: &Source) -> Result<Linkage, Refusal> {
        let head: Head = source.parse()?;
        let Some(linkage) = head.linkage else {
            let rule = "type is missing: it is \"class-iii\", \"four-bar\", \"slider-crank\" or \"planar\"";
            return Err(source.breach("type", rule));
        };
        Ok(match linkage {
            Type::ClassIii => Linkage::ClassIii(Box::new(class_iii::Linkage::read(source)?)),
            Type::FourBar => Linkage::Dyad(Box::new(dyad::four_bar(source)?)),
            Type::SliderCrank => Linkage::Dyad(Box::new(dyad::slider_crank(source)?)),
            Type::Planar => Linkage::Planar(Box::new(planar::Machine::read(source)?)),
        })
    }
}
