//! All isolated solutions of bilinear equations by continuation in the complex projective plane.
//!
//! The equations `(x₀, x)ᵀ M_k (y₀, y) = 0` of [`super::isotropic`] are deformed from products of
//! random linear forms, whose C(2n, n) solutions are the ways to let n of the first and n of the
//! second factors vanish. With a random complex constant between the two systems, every isolated
//! solution is the end of a path, with probability one (Morgan & Sommese, *A homotopy for solving
//! general polynomial systems that respects m-homogeneous structures*, Appl. Math. Comput. 24
//! (1987)). Paths are followed in random affine patches of both projective spaces, so none of them
//! runs to infinity; their ends there are recognised by x₀ = 0 or y₀ = 0.
//!
//! The equations are Hermitian, so the solutions come in pairs (x, y), (ȳ, x̄), or are real: y =
//! x̄. A solution whose partner is missing tells that a path has jumped.

use super::isotropic::Bilinear;
use num_complex::Complex64;

/// The largest n that is tried: C(12, 6) = 924 paths.
pub(super) const MOST_UNKNOWNS: usize = 6;

const ZERO: Complex64 = Complex64::new(0.0, 0.0);
const ONE: Complex64 = Complex64::new(1.0, 0.0);

/// Rounds of Newton's method in one step, and the size of the last correction of a regular end.
const ROUNDS: usize = 4;
const EXACT: f64 = 1e-13;
/// So far before its end a path tells whether it goes to infinity.
const BEFORE_END: f64 = 1e-8;
/// A path is given up where its steps become shorter.
const SHORTEST: f64 = 1e-12;

/// The ends of all paths.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    /// x of the solutions with y = x̄, near enough for Newton's method.
    pub real: Vec<Vec<Complex64>>,
    /// Solutions that are not real, partners counted.
    pub complex: usize,
    /// Paths that end at infinity.
    pub infinite: usize,
    /// Ends that are singular.
    pub singular: usize,
    /// Real ends that are singular: two or more that have merged, or are about to.
    pub merged: usize,
    /// Paths that could not be followed, and partners that are missing.
    pub lost: usize,
}

/// Constants without a pattern, the same in every run (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    /// On the unit circle.
    fn phase(&mut self) -> Complex64 {
        Complex64::from_polar(1.0, std::f64::consts::TAU * self.next())
    }

    /// Of sizes between a half and one.
    fn vector(&mut self, n: usize) -> Vec<Complex64> {
        (0..n)
            .map(|_| self.phase() * (0.5 + 0.5 * self.next()))
            .collect()
    }
}

/// Solves a complex system in place by elimination with partial pivoting; `false` if singular.
fn solve(a: &mut [Complex64], b: &mut [Complex64]) -> bool {
    let n = b.len();
    for k in 0..n {
        let pivot =
            (k..n).max_by(|&i, &j| a[i * n + k].norm_sqr().total_cmp(&a[j * n + k].norm_sqr()));
        let pivot = pivot.unwrap_or(k);
        if pivot != k {
            for c in k..n {
                a.swap(k * n + c, pivot * n + c);
            }
            b.swap(k, pivot);
        }
        let d = a[k * n + k];
        if d == ZERO || !d.is_finite() {
            return false;
        }
        let inverse = d.inv();
        for r in k + 1..n {
            let m = a[r * n + k] * inverse;
            if m != ZERO {
                for c in k + 1..n {
                    let v = a[k * n + c];
                    a[r * n + c] -= m * v;
                }
                let v = b[k];
                b[r] -= m * v;
            }
        }
    }
    for r in (0..n).rev() {
        let mut sum = b[r];
        for c in r + 1..n {
            sum -= a[r * n + c] * b[c];
        }
        b[r] = sum / a[r * n + r];
    }
    true
}

/// The deformation.
struct Homotopy {
    /// n + 1.
    width: usize,
    /// `M_k` and `γ_k a_k b_kᵀ`, row by row.
    target: Vec<Vec<Complex64>>,
    start: Vec<Vec<Complex64>>,
    factors: Vec<[Vec<Complex64>; 2]>,
    patches: [Vec<Complex64>; 2],
}

/// Memory of one path.
struct Work {
    matrix: Vec<Complex64>,
    right: Vec<Complex64>,
    slope: [Vec<Complex64>; 4],
    point: Vec<Complex64>,
}

fn product(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn norm(v: &[Complex64]) -> f64 {
    v.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt()
}

/// Returns whether Newton's method has settled after corrections of `last` and `size`: once one is
/// within the goal, and not where they no longer halve; `None` where another is needed.
fn judged(size: f64, last: f64, goal: f64) -> Option<bool> {
    match size <= goal {
        true => Some(true),
        false if size <= 0.5 * last => None,
        false => Some(false),
    }
}

/// How long the steps along a path are: doubled after some that were good, halved after one that
/// was not.
struct Pace {
    step: f64,
    longest: f64,
    /// Steps since it last changed, and how many double it.
    good: u32,
    enough: u32,
}

impl Pace {
    fn new(longest: f64, enough: u32) -> Pace {
        Pace {
            step: 0.5 * longest,
            longest,
            good: 0,
            enough,
        }
    }

    /// The end of the next step.
    fn next(&self, t: f64) -> f64 {
        (t + self.step).min(1.0)
    }

    fn accept(&mut self) {
        self.good += 1;
        if self.good >= self.enough {
            (self.step, self.good) = ((2.0 * self.step).min(self.longest), 0);
        }
    }

    /// `false` if the steps become too short.
    fn refuse(&mut self) -> bool {
        (self.step, self.good) = (0.5 * self.step, 0);
        self.step >= SHORTEST
    }
}

/// How a path has ended.
struct Arrival {
    t: f64,
    regular: bool,
    /// The smaller share of x₀ in x and y₀ in y, and what it was [`BEFORE_END`] or more before.
    share: f64,
    earlier: f64,
}

/// Returns whether Newton's method ended where the prediction was: good to four digits, lest it
/// find another path.
fn is_close(found: &[Complex64], predicted: &[Complex64]) -> bool {
    let moved: Vec<Complex64> = found.iter().zip(predicted).map(|(a, b)| a - b).collect();
    norm(&moved) <= 1e-4 * norm(found)
}

impl Homotopy {
    fn new(forms: &[Bilinear], seed: u64) -> Homotopy {
        let width = forms.len() / 2 + 1;
        let mut random = Random(seed);
        let target: Vec<Vec<Complex64>> = forms
            .iter()
            .map(|m| {
                let flat: Vec<Complex64> = m.concat();
                let size = norm(&flat);
                flat.iter().map(|z| z / size).collect()
            })
            .collect();
        let factors: Vec<[Vec<Complex64>; 2]> = forms
            .iter()
            .map(|_| [random.vector(width), random.vector(width)])
            .collect();
        let gamma = random.phase();
        let start = factors
            .iter()
            .map(|[a, b]| {
                let size = norm(a) * norm(b);
                a.iter()
                    .flat_map(|x| b.iter().map(move |y| gamma * x * y / size))
                    .collect()
            })
            .collect();
        let patches = [random.vector(width), random.vector(width)];
        Homotopy {
            width,
            target,
            start,
            factors,
            patches,
        }
    }

    /// The start at which the first factors in `set` vanish, and the second ones of the others.
    fn beginning(&self, set: &[bool]) -> Option<Vec<Complex64>> {
        let w = self.width;
        let half = |side: usize, pick: bool| -> Option<Vec<Complex64>> {
            let rows = set.iter().zip(&self.factors).filter(|(s, _)| **s == pick);
            let mut a: Vec<Complex64> = rows.flat_map(|(_, f)| f[side].clone()).collect();
            a.extend(&self.patches[side]);
            let mut b = vec![ZERO; w];
            b[w - 1] = ONE;
            solve(&mut a, &mut b).then_some(b)
        };
        let mut x = half(0, true)?;
        x.extend(half(1, false)?);
        Some(x)
    }

    /// Jacobian into `work.matrix`; residual and derivative by t into the two slices.
    fn evaluate(
        &self,
        t: f64,
        v: &[Complex64],
        matrix: &mut [Complex64],
        residual: &mut [Complex64],
        rate: Option<&mut [Complex64]>,
    ) {
        let w = self.width;
        let n = 2 * w;
        let (x, y) = v.split_at(w);
        matrix.fill(ZERO);
        let mut rates = rate;
        let rows = matrix.chunks_exact_mut(n);
        for (k, ((to, from), row)) in self.target.iter().zip(&self.start).zip(rows).enumerate() {
            let (mut f, mut df) = (ZERO, ZERO);
            for i in 0..w {
                let mut by_x = ZERO;
                let mut change = ZERO;
                for j in 0..w {
                    let (a, b) = (to[i * w + j], from[i * w + j]);
                    let m = a * t + b * (1.0 - t);
                    by_x += m * y[j];
                    row[w + j] += m * x[i];
                    change += (a - b) * y[j];
                }
                row[i] = by_x;
                f += by_x * x[i];
                df += change * x[i];
            }
            residual[k] = -f;
            if let Some(r) = rates.as_deref_mut() {
                r[k] = -df;
            }
        }
        for (side, z) in [x, y].into_iter().enumerate() {
            let k = n - 2 + side;
            matrix[k * n + side * w..][..w].copy_from_slice(&self.patches[side]);
            residual[k] = ONE - product(&self.patches[side], z);
            if let Some(r) = rates.as_deref_mut() {
                r[k] = ZERO;
            }
        }
    }

    /// The tangent dv/dt.
    fn slope(&self, t: f64, v: &[Complex64], work: &mut Work, into: usize) -> bool {
        let mut rate = std::mem::take(&mut work.slope[into]);
        self.evaluate(t, v, &mut work.matrix, &mut work.right, Some(&mut rate));
        let good = solve(&mut work.matrix, &mut rate);
        work.slope[into] = rate;
        good
    }

    /// Newton's method at a fixed t; whether it settles.
    fn correct(
        &self,
        t: f64,
        v: &mut [Complex64],
        work: &mut Work,
        rounds: usize,
        goal: f64,
    ) -> bool {
        let mut last = f64::MAX;
        for _ in 0..rounds {
            self.evaluate(t, v, &mut work.matrix, &mut work.right, None);
            if !solve(&mut work.matrix, &mut work.right) {
                return false;
            }
            let size = norm(&work.right) / norm(v);
            v.iter_mut().zip(&work.right).for_each(|(z, d)| *z += d);
            if let Some(settled) = judged(size, last, goal) {
                return settled;
            }
            last = size;
        }
        false
    }

    /// The smaller share of x₀ in x and y₀ in y.
    fn share(&self, v: &[Complex64]) -> f64 {
        let (x, y) = v.split_at(self.width);
        let part = |z: &[Complex64]| z[0].norm() / norm(z);
        part(x).min(part(y))
    }

    /// Follows a path from t = 0.
    fn follow(&self, v: &mut Vec<Complex64>, careful: bool) -> Arrival {
        let n = 2 * self.width;
        let zeros = || vec![ZERO; n];
        let mut work = Work {
            matrix: vec![ZERO; n * n],
            right: zeros(),
            slope: [zeros(), zeros(), zeros(), zeros()],
            point: zeros(),
        };
        let (mut pace, goal) = if careful {
            (Pace::new(0.02, 8), 1e-11)
        } else {
            (Pace::new(0.1, 3), 1e-9)
        };
        let (mut t, mut earlier) = (0.0, 1.0);
        let mut trial = v.clone();
        while t < 1.0 {
            let to = pace.next(t);
            let good = self.predict(t, to - t, v, &mut work, &mut trial) && {
                let predicted = trial.clone();
                self.correct(to, &mut trial, &mut work, ROUNDS, goal)
                    && is_close(&trial, &predicted)
            };
            if good {
                std::mem::swap(v, &mut trial);
                t = to;
                pace.accept();
                if t <= 1.0 - BEFORE_END {
                    earlier = self.share(v);
                }
            } else if !pace.refuse() {
                break;
            }
        }
        Arrival {
            t,
            regular: t == 1.0 && self.correct(1.0, v, &mut work, ROUNDS, EXACT),
            share: self.share(v),
            earlier,
        }
    }

    /// A step of the classical Runge–Kutta method.
    fn predict(
        &self,
        t: f64,
        h: f64,
        v: &[Complex64],
        work: &mut Work,
        out: &mut [Complex64],
    ) -> bool {
        if !self.slope(t, v, work, 0) {
            return false;
        }
        for (k, part) in [(1, 0.5), (2, 0.5), (3, 1.0)] {
            let mut point = std::mem::take(&mut work.point);
            for i in 0..v.len() {
                point[i] = v[i] + work.slope[k - 1][i] * (part * h);
            }
            let good = self.slope(t + part * h, &point, work, k);
            work.point = point;
            if !good {
                return false;
            }
        }
        let s = &work.slope;
        for i in 0..v.len() {
            out[i] = v[i] + (s[0][i] + (s[1][i] + s[2][i]) * 2.0 + s[3][i]) * (h / 6.0);
        }
        true
    }
}

impl Arrival {
    fn fate(&self) -> Fate {
        // A regular end is known to rounding. Others are as near as the last step, and what goes to
        // infinity comes nearer to it with a root of 1 − t.
        let approaches = !self.regular && self.share < 1e-2 && self.share < 0.5 * self.earlier;
        match () {
            () if !(self.regular || self.t > 1.0 - 1e-6) => Fate::Lost,
            () if self.share < 1e-9 || approaches => Fate::Infinite,
            () => Fate::Finite,
        }
    }
}

/// A finite end: x and y.
struct Finite {
    x: Vec<Complex64>,
    y: Vec<Complex64>,
    regular: bool,
}

fn distance(a: &[Complex64], b: &[Complex64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(p, q)| (p - q.conj()).norm())
        .fold(0.0, f64::max)
}

/// Where a path has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    Finite,
    Infinite,
    Lost,
}

/// All solutions of 2n bilinear equations in n + n unknowns.
pub(super) fn all(forms: &[Bilinear]) -> Ends {
    let first = run(forms, 1, false);
    match first.lost {
        0 => first,
        // Other constants and shorter steps.
        _ => run(forms, 2, true),
    }
}

fn run(forms: &[Bilinear], seed: u64, careful: bool) -> Ends {
    let homotopy = Homotopy::new(forms, seed);
    let w = homotopy.width;
    let mut ends = Ends::default();
    let mut finite: Vec<Finite> = Vec::new();
    for set in subsets(forms.len(), forms.len() / 2) {
        let end = homotopy.beginning(&set).map(|mut v| {
            let arrival = homotopy.follow(&mut v, careful);
            (arrival.fate(), v, arrival.regular)
        });
        match end {
            Some((Fate::Finite, v, regular)) => {
                let affine = |z: &[Complex64]| z[1..].iter().map(|c| c / z[0]).collect::<Vec<_>>();
                let (x, y) = (affine(&v[..w]), affine(&v[w..]));
                ends.singular += usize::from(!regular);
                finite.push(Finite { x, y, regular });
            }
            Some((Fate::Infinite, ..)) => ends.infinite += 1,
            Some((Fate::Lost, ..)) | None => ends.lost += 1,
        }
    }
    sort(finite, &mut ends);
    ends
}

/// Real ends, pairs, and partners that are missing.
fn sort(finite: Vec<Finite>, ends: &mut Ends) {
    let scale = |f: &Finite| 1.0 + f.x.iter().chain(&f.y).map(|z| z.norm()).fold(0.0, f64::max);
    for (k, f) in finite.iter().enumerate() {
        let near = if f.regular { 1e-7 } else { 1e-3 } * scale(f);
        let twin = finite[..k].iter().any(|g| {
            let same = |a: &[Complex64], b: &[Complex64]| {
                a.iter()
                    .zip(b)
                    .all(|(p, q)| (p - q).norm() <= 1e-8 * scale(f))
            };
            f.regular && g.regular && same(&f.x, &g.x) && same(&f.y, &g.y)
        });
        if twin {
            // Two paths never end in one regular solution.
            ends.lost += 1;
            continue;
        }
        if distance(&f.y, &f.x) <= near {
            ends.merged += usize::from(!f.regular);
            ends.real.push(f.x.clone());
            continue;
        }
        ends.complex += 1;
        let partner = |g: &Finite| distance(&g.x, &f.y) <= near && distance(&g.y, &f.x) <= near;
        if f.regular && !finite.iter().any(partner) {
            ends.lost += 1;
        }
    }
}

/// All choices of k among n.
fn subsets(n: usize, k: usize) -> impl Iterator<Item = Vec<bool>> {
    (0u32..1 << n)
        .filter(move |bits| bits.count_ones() as usize == k)
        .map(move |bits| (0..n).map(|i| bits >> i & 1 == 1).collect())
}

#[cfg(test)]
mod tests;
