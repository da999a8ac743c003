//! The common part of drawings of mechanisms: the frame, and the place of a point of the plane in
//! it.

/// A point of the plane in metres.
pub type Point = [f64; 2];

pub(super) const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 70.0;
const HEAD: f64 = 56.0;
pub(super) const INK: &str = "#1d2125";
pub(super) const SOFT: &str = "#5b646d";
pub(super) const PAPER: &str = "#ffffff";

/// From metres, y up, to the drawing, y down.
pub struct View {
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
        View::framed([range(0), range(1)], [WIDTH, MARGIN, HEAD])
    }

    /// A view of that extent: a page of that width with that margin, and a head above.
    pub fn framed([[x0, x1], [y0, y1]]: [[f64; 2]; 2], [width, margin, head]: [f64; 3]) -> View {
        let size = (x1 - x0).max(y1 - y0);
        // A mechanism without size has a place.
        let size = if size > 0.0 { size } else { 1.0 };
        let scale = (width - 2.0 * margin) / size;
        let slack = 0.5 * (size - (x1 - x0)) * scale;
        View {
            scale,
            left: margin + slack - x0 * scale,
            top: head + margin + y1 * scale,
            height: head + 2.0 * margin + (y1 - y0) * scale,
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

#[cfg(test)]
mod tests {
    use super::*;

    /// 860 by as much as is needed, 70 from the edges and 56 more from the upper one, in the middle
    /// of the page.
    #[test]
    fn the_larger_side_fills_the_frame() {
        for (points, height, places) in [
            // A square.
            (
                &[[0.0, 0.0], [1.0, 1.0]][..],
                1056.0,
                &[
                    ([0.0, 0.0], (70.0, 986.0)),
                    ([1.0, 1.0], (930.0, 126.0)),
                    ([0.5, 0.25], (500.0, 771.0)),
                ][..],
            ),
            // Wide and away from the origin.
            (
                &[[5.0, 3.0], [1.0, 2.0]],
                411.0,
                &[([1.0, 2.0], (70.0, 341.0)), ([5.0, 3.0], (930.0, 126.0))],
            ),
            // High, with a point that is nowhere.
            (
                &[[-1.0, 0.0], [0.0, 4.0], [f64::NAN, f64::INFINITY]],
                1056.0,
                &[([-1.0, 0.0], (392.5, 986.0)), ([0.0, 4.0], (607.5, 126.0))],
            ),
            // Less than a metre.
            (
                &[[0.0, 0.0], [0.43, 0.0]],
                196.0,
                &[([0.0, 0.0], (70.0, 126.0)), ([0.43, 0.0], (930.0, 126.0))],
            ),
            // Of no size.
            (&[[3.0, -2.0]], 196.0, &[([3.0, -2.0], (500.0, 126.0))]),
        ] {
            let view = View::new(points.iter().copied());
            assert!((view.height - height).abs() < 1e-9, "{points:?}");
            for (p, due) in places {
                let (x, y) = view.at(*p);
                let far = (x - due.0).hypot(y - due.1);
                assert!(far < 1e-9, "{points:?}: {p:?} at {x}, {y}");
            }
        }
    }

    #[test]
    fn lines_have_hundredths() {
        let view = View::new([[0.0, 0.0], [3.0, 3.0]].into_iter());
        let line = view.line([[0.0, 0.0], [1.0, 2.0]].into_iter());
        assert_eq!(line, "70.00,986.00 356.67,412.67");
    }
}
