//! A position of a mechanism and the paths of its points as DXF, for CAD.
//!
//! Layers: `GROUND` fixed pivots, `LINKS` bodies and pitch circles, `GUIDES`, `JOINTS` circles
//! about the moving points, `NAMES`, and `PATH_` with the point's name for each path. R2007, the
//! first version whose text is UTF-8.

use crate::machine::quantity;
use crate::motion::{Motion, Point};
use dxf::entities::{Circle, Entity, EntityType, Line, LwPolyline, Text};
use dxf::enums::{AcadVersion, Units};
use dxf::tables::Layer;
use dxf::{Color, Drawing, LwPolylineVertex, Point as Place};
use rug::Rational;

/// Decimals that the format's writer gives a coordinate.
const DECIMALS: i32 = 12;
/// Significant digits of the drawing's size below which it is refused.
const DIGITS: i32 = 6;
/// Largest coordinate whose text stays readable for every program.
const MOST: f64 = 1e15;
/// AutoCAD's colour index of ground, links, guides, joints and names, and those of the paths in
/// turn.
const COLOURS: [(&str, u8); 5] = [
    ("GROUND", 8),
    ("LINKS", 7),
    ("GUIDES", 9),
    ("JOINTS", 5),
    ("NAMES", 7),
];
const PATHS: [u8; 5] = [30, 5, 3, 6, 8];

/// Why a motion has no DXF file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotDxf {
    /// A unit that the format does not know.
    #[error("a DXF file cannot be in {unit}; it can be in m, dm, cm, mm, um, in, ft")]
    Unit {
        /// The unit.
        unit: String,
    },
    /// Coordinates would lose their digits.
    #[error(
        "the mechanism is {size:e} {unit} large, and coordinates of a DXF file have {DECIMALS} decimals: choose another unit of length by --units"
    )]
    Size {
        /// In the file's unit.
        size: f64,
        /// The unit.
        unit: String,
    },
    /// A point without a place.
    #[error("a coordinate of {point} is not finite")]
    NotFinite {
        /// Its name.
        point: String,
    },
    /// The message of the writer.
    #[error("{0}")]
    Writing(String),
}

/// A unit of length that the file is in.
#[derive(Clone, Debug)]
pub struct Unit {
    name: String,
    /// In metres.
    metres: f64,
    units: Units,
}

impl Unit {
    /// The unit of that name.
    ///
    /// # Errors
    /// [`NotDxf::Unit`].
    pub fn of(name: &str) -> Result<Unit, NotDxf> {
        let refused = || NotDxf::Unit { unit: name.into() };
        let unit = quantity::unit(name).map_err(|_| refused())?;
        let known = [
            (Units::Meters, (1, 1)),
            (Units::Decimeters, (1, 10)),
            (Units::Centimeters, (1, 100)),
            (Units::Millimeters, (1, 1000)),
            (Units::Microns, (1, 1_000_000)),
            (Units::Inches, (254, 10_000)),
            (Units::Feet, (3048, 10_000)),
        ];
        let length = quantity::unit("m").map_err(|_| refused())?.dimension;
        let same = |k: &&(Units, (u32, u32))| {
            unit.dimension == length && unit.scale == Rational::from(k.1)
        };
        let (units, (over, under)) = *known.iter().find(same).ok_or_else(refused)?;
        Ok(Unit {
            name: name.into(),
            metres: f64::from(over) / f64::from(under),
            units,
        })
    }
}

struct Sheet<'a> {
    drawing: Drawing,
    motion: &'a Motion,
    metres: f64,
    size: f64,
}

/// The position that is shown first, and the paths.
///
/// # Errors
/// [`NotDxf`].
pub fn draw(motion: &Motion, unit: &Unit) -> Result<Vec<u8>, NotDxf> {
    let bad = |p: &&Point| p.path.iter().flatten().any(|x| !x.is_finite());
    if let Some(p) = motion.points.iter().find(bad) {
        let point = p.label.clone();
        return Err(NotDxf::NotFinite { point });
    }
    let size = motion.size() / unit.metres;
    let largest = motion
        .extent()
        .as_flattened()
        .iter()
        .fold(0.0f64, |m, x| m.max(x.abs()));
    if !(size >= 10f64.powi(DIGITS - DECIMALS)) || !(largest / unit.metres <= MOST) {
        let unit = unit.name.clone();
        return Err(NotDxf::Size { size, unit });
    }
    let mut drawing = Drawing::new();
    let header = &mut drawing.header;
    header.version = AcadVersion::R2007;
    header.default_drawing_units = unit.units;
    // The same file whenever it is written.
    (header.creation_date, header.creation_date_universal) = Default::default();
    (header.update_date, header.update_date_universal) = Default::default();
    (header.fingerprint_guid, header.version_guid) = Default::default();
    let mut sheet = Sheet {
        drawing,
        motion,
        metres: unit.metres,
        size,
    };
    sheet.layers();
    sheet.parts();
    sheet.points();
    let mut bytes = Vec::new();
    let written = sheet.drawing.save(&mut bytes);
    written.map_err(|e| NotDxf::Writing(e.to_string()))?;
    Ok(bytes)
}

impl Sheet<'_> {
    fn layers(&mut self) {
        let traced = self.motion.points.iter().filter(|p| p.is_traced());
        let paths = traced
            .zip(PATHS.iter().cycle())
            .map(|(p, c)| (path_layer(p), *c));
        let fixed = COLOURS.map(|(name, colour)| (name.to_string(), colour));
        for (name, colour) in fixed.into_iter().chain(paths) {
            let color = Color::from_index(colour);
            self.drawing.add_layer(Layer {
                name,
                color,
                ..Default::default()
            });
        }
    }

    fn add(&mut self, layer: &str, part: EntityType) {
        let mut entity = Entity::new(part);
        entity.common.layer = layer.into();
        self.drawing.add_entity(entity);
    }

    fn place(&self, [x, y]: [f64; 2]) -> Place {
        Place::new(x / self.metres, y / self.metres, 0.0)
    }

    /// At the position that is shown.
    fn shown(&self, point: usize) -> [f64; 2] {
        self.motion.points[point].at(self.motion.start)
    }

    fn line(&mut self, layer: &str, ends: [usize; 2]) {
        let [a, b] = ends.map(|p| self.place(self.shown(p)));
        self.add(layer, EntityType::Line(Line::new(a, b)));
    }

    fn polyline(&mut self, layer: &str, places: &[[f64; 2]], closed: bool) {
        let vertex = |p: &[f64; 2]| {
            let Place { x, y, .. } = self.place(*p);
            LwPolylineVertex {
                x,
                y,
                ..Default::default()
            }
        };
        let mut line = LwPolyline {
            vertices: places.iter().map(vertex).collect(),
            ..Default::default()
        };
        line.set_is_closed(closed);
        self.add(layer, EntityType::LwPolyline(line));
    }

    fn circle(&mut self, layer: &str, at: [f64; 2], radius: f64) {
        let circle = Circle::new(self.place(at), radius);
        self.add(layer, EntityType::Circle(circle));
    }

    fn parts(&mut self) {
        let motion = self.motion;
        motion.links.iter().for_each(|l| self.line("LINKS", *l));
        motion.guides.iter().for_each(|l| self.line("GUIDES", *l));
        for plate in &motion.plates {
            let corners: Vec<[f64; 2]> = plate.iter().map(|p| self.shown(*p)).collect();
            self.polyline("LINKS", &corners, true);
        }
        for wheel in &motion.wheels {
            self.circle(
                "LINKS",
                self.shown(wheel.centre),
                wheel.radius / self.metres,
            );
        }
    }

    fn points(&mut self) {
        let motion = self.motion;
        let (radius, height) = (0.008 * self.size, 0.025 * self.size);
        for p in motion.points.iter().filter(|p| !p.label.is_empty()) {
            let at = p.at(motion.start);
            let layer = if p.path.len() > 1 { "JOINTS" } else { "GROUND" };
            self.circle(layer, at, radius);
            let Place { x, y, .. } = self.place(at);
            let location = Place::new(x + 1.5 * radius, y + 1.5 * radius, 0.0);
            let name = Text {
                location,
                text_height: height,
                value: p.label.clone(),
                ..Default::default()
            };
            self.add("NAMES", EntityType::Text(name));
            if p.is_traced() {
                self.polyline(&path_layer(p), &p.path, motion.closed);
            }
        }
    }
}

fn path_layer(point: &Point) -> String {
    format!("PATH_{}", point.label)
}

#[cfg(test)]
mod tests;
