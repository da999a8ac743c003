//! A position of a mechanism and the paths of its points as DXF, for CAD.
//!
//! Layers: `GROUND` fixed pivots, `LINKS` bodies and pitch circles, `GUIDES`, `JOINTS` circles
//! about the moving points, `NAMES`, and `PATH_` with the point's name for each path. R2007, the
//! first version whose text is UTF-8.

use crate::motion::{Motion, Point};
use crate::symbolic;
use file::Writer;
use rug::Rational;

mod file;

/// Decimals of a coordinate.
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
}

/// A unit of length that the file is in.
#[derive(Clone, Debug)]
pub struct Unit {
    name: String,
    /// In metres.
    metres: f64,
    /// The format's number of the unit.
    number: u32,
}

impl Unit {
    /// The unit of that name.
    ///
    /// # Errors
    /// [`NotDxf::Unit`].
    pub fn of(name: &str) -> Result<Unit, NotDxf> {
        let refused = || NotDxf::Unit { unit: name.into() };
        let unit = symbolic::unit(name).map_err(|_| refused())?;
        let known = [
            (6, (1, 1)),
            (14, (1, 10)),
            (5, (1, 100)),
            (4, (1, 1000)),
            (13, (1, 1_000_000)),
            (1, (254, 10_000)),
            (2, (3048, 10_000)),
        ];
        let length = symbolic::unit("m").map_err(|_| refused())?.dimension;
        let same =
            |k: &&(u32, (u32, u32))| unit.dimension == length && unit.scale == Rational::from(k.1);
        let (number, (over, under)) = *known.iter().find(same).ok_or_else(refused)?;
        Ok(Unit {
            name: name.into(),
            metres: f64::from(over) / f64::from(under),
            number,
        })
    }
}

struct Sheet<'a> {
    entities: Writer,
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
    let layers = layers(motion);
    let mut sheet = Sheet {
        entities: Writer::beyond(layers.len()),
        motion,
        metres: unit.metres,
        size,
    };
    sheet.parts();
    sheet.points();
    Ok(file::whole(unit.number, &layers, &sheet.entities))
}

/// The layers with their colours.
fn layers(motion: &Motion) -> Vec<(String, u8)> {
    let traced = motion.points.iter().filter(|p| p.is_traced());
    let paths = traced.zip(PATHS.iter().cycle());
    let paths = paths.map(|(p, colour)| (path_layer(p), *colour));
    let fixed = COLOURS.map(|(name, colour)| (name.to_string(), colour));
    fixed.into_iter().chain(paths).collect()
}

impl Sheet<'_> {
    fn place(&self, at: [f64; 2]) -> [f64; 2] {
        at.map(|x| x / self.metres)
    }

    /// At the position that is shown.
    fn shown(&self, point: usize) -> [f64; 2] {
        self.motion.points[point].at(self.motion.start)
    }

    fn line(&mut self, layer: &str, ends: [usize; 2]) {
        let [a, b] = ends.map(|p| self.place(self.shown(p)));
        self.entities.entity("LINE", layer, "AcDbLine");
        self.entities.point(0, a);
        self.entities.point(1, b);
    }

    fn polyline(&mut self, layer: &str, places: &[[f64; 2]], closed: bool) {
        self.entities.entity("LWPOLYLINE", layer, "AcDbPolyline");
        self.entities.pair(90, places.len());
        self.entities.pair(70, u32::from(closed));
        for p in places {
            let [x, y] = self.place(*p);
            self.entities.number(10, x);
            self.entities.number(20, y);
        }
    }

    fn circle(&mut self, layer: &str, at: [f64; 2], radius: f64) {
        self.entities.entity("CIRCLE", layer, "AcDbCircle");
        self.entities.point(0, self.place(at));
        self.entities.number(40, radius);
    }

    fn name(&mut self, text: &str, at: [f64; 2], height: f64) {
        self.entities.entity("TEXT", "NAMES", "AcDbText");
        self.entities.point(0, at);
        self.entities.number(40, height);
        self.entities.pair(1, text);
        self.entities.pair(100, "AcDbText");
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
            let radius = wheel.radius / self.metres;
            self.circle("LINKS", self.shown(wheel.centre), radius);
        }
    }

    fn points(&mut self) {
        let motion = self.motion;
        let (radius, height) = (0.008 * self.size, 0.025 * self.size);
        for p in motion.points.iter().filter(|p| !p.label.is_empty()) {
            let at = p.at(motion.start);
            let layer = if p.path.len() > 1 { "JOINTS" } else { "GROUND" };
            self.circle(layer, at, radius);
            let beside = self.place(at).map(|x| x + 1.5 * radius);
            self.name(&p.label, beside, height);
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
