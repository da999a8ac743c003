//! All branches over a range of crank angles, and the folds where they begin and end.

use super::assembly::Resultant;
use super::continuation::ContinuationError;
use super::geometry::ClassIii;
use super::kinematics::State;
use super::loops::unit;
use super::positions::{Positions, wrap};
use crate::units::Angle;

/// One configuration with the branch it lies on.
#[derive(Clone, Copy, Debug)]
pub struct BranchSample {
    /// The branch, numbered from 0 in the order of appearance.
    pub branch: usize,
    /// The linkage there.
    pub state: State,
}

/// A singular position in which two branches meet and end (or begin).
#[derive(Clone, Debug, PartialEq)]
pub struct Fold {
    /// Crank angle in radians.
    pub phi1: f64,
    /// Angle φ4 of the merging pair in radians.
    pub phi4: f64,
    /// The branches that meet.
    pub branches: Vec<usize>,
    /// Tells whether they begin here (in the direction of travel) rather than end.
    pub begins: bool,
}

/// Every configuration at a list of crank angles, tagged with its branch.
#[derive(Clone, Debug, Default)]
pub struct BranchMap {
    /// For each crank angle asked for, the configurations there.
    pub rows: Vec<Vec<BranchSample>>,
    /// Number of branches met.
    pub branches: usize,
    /// The folds between the first and the last angle.
    pub folds: Vec<Fold>,
}

impl ClassIii {
    /// Traces all branches over the crank angles, in order.
    ///
    /// Branches are joined only by [`ClassIii::follow`], which proves each step; a configuration
    /// that no branch reaches begins a new one.
    pub fn trace_branches(&self, angles: &[Angle]) -> BranchMap {
        let mut map = BranchMap::default();
        let mut living: Vec<BranchSample> = Vec::new();
        for (row, &phi1) in angles.iter().enumerate() {
            let before = if row == 0 { phi1 } else { angles[row - 1] };
            self.advance(&mut map, &mut living, row == 0, before, phi1);
            map.rows.push(living.clone());
        }
        map
    }

    fn advance(
        &self,
        map: &mut BranchMap,
        living: &mut Vec<BranchSample>,
        first: bool,
        before: Angle,
        phi1: Angle,
    ) {
        let mut open: Vec<Positions> = self.assembly_modes(phi1).modes;
        let mut next = Vec::new();
        let mut ended: Vec<(usize, f64, f64)> = Vec::new();
        for sample in living.iter() {
            match self.follow(&sample.state, phi1) {
                Ok(state) => {
                    let nearest = (0..open.len()).min_by(|&a, &b| {
                        let d = |k: usize| open[k].distance(state.positions);
                        d(a).total_cmp(&d(b))
                    });
                    if let Some(k) = nearest
                        && open[k].distance(state.positions) < 1e-6
                    {
                        open.swap_remove(k);
                    }
                    next.push(BranchSample {
                        branch: sample.branch,
                        state,
                    });
                }
                Err(ContinuationError::Fold { phi1: at }) => {
                    ended.push((sample.branch, at, sample.state.positions.phi4));
                }
                Err(_) => {}
            }
        }
        open.sort_by(|a, b| a.phi4.total_cmp(&b.phi4));
        let mut born: Vec<(usize, f64, f64)> = Vec::new();
        for mode in open {
            let Ok(state) = self.state_near(phi1, mode) else {
                continue;
            };
            let branch = map.branches;
            map.branches += 1;
            if !first && let Err(ContinuationError::Fold { phi1: at }) = self.follow(&state, before)
            {
                born.push((branch, at, mode.phi4));
            }
            next.push(BranchSample { branch, state });
        }
        map.folds.extend(self.pair_folds(ended, false));
        map.folds.extend(self.pair_folds(born, true));
        *living = next;
    }

    /// Groups branch ends by crank angle and refines each.
    fn pair_folds(&self, mut ends: Vec<(usize, f64, f64)>, begins: bool) -> Vec<Fold> {
        ends.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut folds: Vec<Fold> = Vec::new();
        for (branch, at, phi4) in ends {
            let (phi1, phi4) = self.refine_fold(at, phi4).unwrap_or((at, phi4));
            let same = folds
                .iter_mut()
                .find(|f| (f.phi1 - phi1).abs() < 1e-7 && wrap(f.phi4 - phi4).abs() < 1e-3);
            match same {
                Some(f) => f.branches.push(branch),
                None => folds.push(Fold {
                    phi1,
                    phi4,
                    branches: vec![branch],
                    begins,
                }),
            }
        }
        folds
    }

    /// Secant iteration on the squared distance of the merging pair, which passes linearly through
    /// zero at the fold.
    fn refine_fold(&self, near: f64, phi4: f64) -> Option<(f64, f64)> {
        let d = |phi1: f64, at: f64| Resultant::new(&self.l, unit(phi1)).merging(at);
        // From far off the pair's φ4 may be anybody's; beside the fold the extremum nearest to
        // merging is the one.
        let modes = self.assembly_modes(Angle::from_rad(near)).modes;
        let mut at = phi4;
        let mut closest = f64::INFINITY;
        for (i, a) in modes.iter().enumerate() {
            for b in &modes[i + 1..] {
                let gap = wrap(a.phi4 - b.phi4);
                if a.distance(*b) < closest {
                    closest = a.distance(*b);
                    at = b.phi4 + 0.5 * gap;
                }
            }
        }
        let (mut x0, mut x1) = (near - 1e-5, near);
        let (mut f0, _) = d(x0, at)?;
        for _ in 0..20 {
            let (f1, theta) = d(x1, at)?;
            at = theta;
            let step = f1 * (x1 - x0) / (f1 - f0);
            if !step.is_finite() || step.abs() > 1e-3 {
                break;
            }
            (x0, f0) = (x1, f1);
            x1 -= step;
            if step.abs() <= 2.0 * f64::EPSILON * x1.abs() {
                break;
            }
        }
        ((x1 - near).abs() < 1e-3).then_some((x1, wrap(at)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::zinchenko;
    use crate::units::Angle;

    #[test]
    fn the_folds_of_the_unused_pair() {
        let start = 14.426f64.to_radians();
        let angles: Vec<Angle> = (0..=48)
            .map(|k| Angle::from_rad(start + (7.5 * k as f64).to_radians()))
            .collect();
        let map = zinchenko().trace_branches(&angles);
        assert_eq!(map.folds.len(), 2, "{:?}", map.folds);
        for (fold, degrees) in map.folds.iter().zip([217.270876406, 282.845029080]) {
            assert_eq!(fold.branches.len(), 2);
            assert!((fold.phi1.to_degrees() - degrees).abs() < 1e-8, "{fold:?}");
        }
        assert!(!map.folds[0].begins && map.folds[1].begins);
        assert_eq!(map.rows[0].len(), 4);
        assert_eq!(map.rows[30].len(), 2);
        assert_eq!(map.rows[48].len(), 4);
        // Two whole branches, a pair that ends, a pair that begins.
        assert_eq!(map.branches, 6);
        for row in &map.rows {
            for s in row {
                let sign = map
                    .rows
                    .iter()
                    .flatten()
                    .find(|o| o.branch == s.branch)
                    .unwrap();
                assert_eq!(s.state.determinant > 0.0, sign.state.determinant > 0.0);
            }
        }
    }
}

#[cfg(test)]
mod fold_tests;
