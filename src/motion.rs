//! A mechanism in motion: what an animation shows beside its quantities, and a drawing of one
//! position.
//!
//! Everything is computed where the mechanism is known; what shows it scales and rounds.

mod class_iii;
pub use class_iii::class_iii;

/// A mechanism over its drive.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The moving mechanism.
    pub name: String,
    /// The drive.
    pub drive: Drive,
    /// True if the first position follows the last.
    pub closed: bool,
    /// The number of the position shown first.
    pub start: usize,
    /// Points in the order in which the parts name them.
    pub points: Vec<Point>,
    /// Links between two points, by their indices.
    pub links: Vec<[usize; 2]>,
    /// Links of three points or more, and blocks on guides: their corners in order.
    pub plates: Vec<Vec<usize>>,
    /// Lines along which something slides.
    pub guides: Vec<[usize; 2]>,
    /// Pitch circles.
    pub wheels: Vec<Wheel>,
    /// Quantities over the drive.
    pub courses: Vec<Course>,
}

/// The coordinate that everything is a function of.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Its symbol.
    pub symbol: &'static str,
    /// Its unit: `°` or `m`.
    pub unit: &'static str,
    /// Its value at each position.
    pub values: Vec<f64>,
}

/// A point of the mechanism.
#[derive(Clone, Debug)]
pub struct Point {
    /// Its name; empty for a corner that nobody asks for.
    pub label: String,
    /// True if links turn about it and it does not move.
    pub pivot: bool,
    /// Where it is, in metres: one place if it is fixed, else one for each position.
    pub path: Vec<[f64; 2]>,
}

/// A pitch circle.
#[derive(Clone, Copy, Debug)]
pub struct Wheel {
    /// The index of its centre.
    pub centre: usize,
    /// In metres.
    pub radius: f64,
}

/// A quantity over the drive.
#[derive(Clone, Debug)]
pub struct Course {
    /// Its symbol, or the name of its column.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Computed, by variant of the data, at each position; NaN where it is not determined.
    pub variants: Vec<(String, Vec<f64>)>,
    /// As printed: drive and value.
    pub printed: Vec<(f64, f64)>,
}

impl Point {
    /// A fixed point about which links turn.
    pub fn fixed(label: impl Into<String>, at: [f64; 2]) -> Point {
        Point {
            label: label.into(),
            pivot: true,
            path: vec![at],
        }
    }

    /// A moving point, or a corner without a name.
    pub fn moving(label: impl Into<String>, path: Vec<[f64; 2]>) -> Point {
        Point {
            label: label.into(),
            pivot: false,
            path,
        }
    }

    /// Where it is at the position of that number.
    pub fn at(&self, k: usize) -> [f64; 2] {
        self.path[k.min(self.path.len() - 1)]
    }

    /// Returns true if it has a name and moves.
    pub fn is_traced(&self) -> bool {
        self.path.len() > 1 && !self.label.is_empty()
    }
}

impl Motion {
    /// Adds a point and returns its index.
    pub fn add(&mut self, point: Point) -> usize {
        self.points.push(point);
        self.points.len() - 1
    }

    /// Least and largest coordinates of everything drawn: `[[x, x], [y, y]]`, in metres.
    pub fn extent(&self) -> [[f64; 2]; 2] {
        let mut rounds: Vec<[f64; 2]> = Vec::new();
        for w in &self.wheels {
            for [x, y] in &self.points[w.centre].path {
                rounds.extend([-w.radius, w.radius].map(|r| [x + r, y + r]));
            }
        }
        let places = || self.points.iter().flat_map(|p| &p.path).chain(&rounds);
        [0, 1].map(|i| {
            let along = || places().map(|p| p[i]).filter(|x| x.is_finite());
            let least = along().fold(f64::INFINITY, f64::min);
            [least, along().fold(f64::NEG_INFINITY, f64::max)]
        })
    }

    /// The larger side of [`Motion::extent`].
    pub fn size(&self) -> f64 {
        let [x, y] = self.extent();
        (x[1] - x[0]).max(y[1] - y[0])
    }

    /// A fixed guide as far as something slides on it: where that is and the guide's angle at each
    /// position.
    pub fn add_guide(&mut self, along: &[([f64; 2], f64)]) {
        let Some(&(origin, angle)) = along.first() else {
            return;
        };
        let (sin, cos) = angle.sin_cos();
        let travel = |(p, _): &([f64; 2], f64)| (p[0] - origin[0]) * cos + (p[1] - origin[1]) * sin;
        let travels = || along.iter().map(travel);
        let slack = 0.07 * self.size();
        let low = travels().fold(0.0, f64::min) - slack;
        let high = travels().fold(0.0, f64::max) + slack;
        let ends = [low, high].map(|s| {
            let at = [origin[0] + s * cos, origin[1] + s * sin];
            self.add(Point::moving("", vec![at]))
        });
        self.guides.push(ends);
    }

    /// A block of a size that can be seen, along a guide: where it is and the guide's angle at each
    /// position.
    pub fn add_block(&mut self, along: &[([f64; 2], f64)]) {
        let size = self.size();
        let corner = |a: f64, b: f64| {
            let path = along.iter().map(|([x, y], angle)| {
                let (sin, cos) = angle.sin_cos();
                let (a, b) = (a * size, b * size);
                [x + a * cos - b * sin, y + a * sin + b * cos]
            });
            Point::moving("", path.collect())
        };
        let corners = [
            (-0.035, -0.02),
            (0.035, -0.02),
            (0.035, 0.02),
            (-0.035, 0.02),
        ];
        let plate = corners.map(|(a, b)| self.add(corner(a, b)));
        self.plates.push(plate.to_vec());
    }
}

/// The indices of the corners of the convex hull, counter-clockwise (Andrew's monotone chain).
pub fn hull(corners: &[[f64; 2]]) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..corners.len()).collect();
    let key = |k: &usize| corners[*k];
    sorted.sort_by(|a, b| {
        let ([ax, ay], [bx, by]) = (key(a), key(b));
        ax.total_cmp(&bx).then(ay.total_cmp(&by))
    });
    let turn = |a: usize, b: usize, c: usize| {
        let [a, b, c] = [a, b, c].map(|k| corners[k]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let half = |points: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for p in points {
            while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let lower = half(&mut sorted.iter().copied());
    let upper = half(&mut sorted.iter().rev().copied());
    [lower, upper].concat()
}

#[cfg(test)]
mod tests;
