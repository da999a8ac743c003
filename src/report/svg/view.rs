//! What drawings of mechanisms share: the frame, and where a point of the plane is in it.

/// A point of the plane in metres.
pub type Point = [f64; 2];

pub(super) const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 70.0;
const HEAD: f64 = 56.0;
pub(super) const INK: &str = "#1d2125";
pub(super) const SOFT: &str = "#5b646d";
pub(super) const PAPER: &str = "#ffffff";

/// From metres, y up, to the drawing, y down.
pub(super) struct View {
    pub scale: f64,
    left: f64,
    top: f64,
    pub height: f64,
}

impl View {
    pub fn new(points: impl Iterator<Item = Point> + Clone) -> View {
        let range = |i: usize| {
            let all = points.clone().map(|p| p[i]).filter(|x| x.is_finite());
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
                [a.min(x), b.max(x)]
            })
        };
        let ([x0, x1], [y0, y1]) = (range(0), range(1));
        let size = (x1 - x0).max(y1 - y0).max(f64::MIN_POSITIVE);
        let scale = (WIDTH - 2.0 * MARGIN) / size;
        let slack = 0.5 * (size - (x1 - x0)) * scale;
        View {
            scale,
            left: MARGIN + slack - x0 * scale,
            top: HEAD + MARGIN + y1 * scale,
            height: HEAD + 2.0 * MARGIN + (y1 - y0) * scale,
        }
    }

    pub fn at(&self, p: Point) -> (f64, f64) {
        (self.left + p[0] * self.scale, self.top - p[1] * self.scale)
    }

    /// The coordinates of a line through points.
    pub fn line(&self, points: impl Iterator<Item = Point>) -> String {
        let text = |p: Point| {
            let (x, y) = self.at(p);
            format!("{x:.2},{y:.2}")
        };
        points.map(text).collect::<Vec<_>>().join(" ")
    }
}
