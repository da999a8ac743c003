//! The distribution of the work of a plan to shards.

use super::plan::{Kind, Part, Plan};
use super::proofs::Units;
use crate::audit::Cases;

/// The numbers `first`, `first + step`, … below `end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stride {
    /// The first.
    pub first: u64,
    /// The distance of two neighbours.
    pub step: u64,
    /// The end.
    pub end: u64,
}

impl Stride {
    /// The number found.
    pub fn len(self) -> u64 {
        self.end.saturating_sub(self.first).div_ceil(self.step)
    }

    /// Returns true if there are none.
    pub fn is_empty(self) -> bool {
        self.first >= self.end
    }

    /// Number `j` of them.
    pub fn at(self, j: u64) -> u64 {
        self.first + j * self.step
    }
}

/// The units of a plan, numbered through all parts and dealt one by one.
#[derive(Clone, Debug)]
pub struct Deal {
    /// Units of each part, and how many cases or evaluations one of them is.
    parts: Vec<(u64, u64)>,
    shards: u64,
}

impl Deal {
    /// Deals the work among `shards` shards.
    ///
    /// # Panics
    /// Of a plan that was not checked, or no shards.
    pub fn new(plan: &Plan, shards: u64) -> Deal {
        assert!(shards > 0, "a campaign has a shard");
        let units = |part: &Part| match part.kind {
            Kind::Hunt => (part.hunts, part.evaluations),
            Kind::Proof => (
                Units::of(part).expect("the plan was checked").count() as u64,
                1,
            ),
            Kind::Audit | Kind::Candidate => {
                let method = part.method();
                let variant = part.variant(&*method).expect("the plan was checked");
                (Cases::new(&variant, &part.settings()).len() as u64, 1)
            }
        };
        Deal {
            parts: plan.parts.iter().map(units).collect(),
            shards,
        }
    }

    /// Returns the number of shards.
    pub fn shards(&self) -> u64 {
        self.shards
    }

    /// The units of the parts that shard `k` holds.
    pub fn of(&self, k: u64) -> Vec<Stride> {
        let n = self.shards;
        let mut before = 0;
        let mut of_part = |units: u64| {
            let first = (k + n - before % n) % n;
            before = (before % n + units % n) % n;
            Stride {
                first,
                step: n,
                end: units,
            }
        };
        self.parts.iter().map(|p| of_part(p.0)).collect()
    }

    /// Units of all shards.
    pub fn units(&self) -> u64 {
        let units = self.parts.iter().map(|p| p.0);
        units.fold(0, u64::saturating_add)
    }

    /// Cases and evaluations of a shard.
    pub fn work_of(&self, k: u64) -> u64 {
        let strides = self.of(k).into_iter().zip(&self.parts);
        strides.map(|(s, p)| s.len().saturating_mul(p.1)).sum()
    }

    /// Cases and evaluations of all shards.
    pub fn work(&self) -> u64 {
        let each = self.parts.iter().map(|(n, each)| n.saturating_mul(*each));
        each.fold(0, u64::saturating_add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::first_rectangles;

    #[test]
    fn every_unit_is_dealt_once() {
        for shards in [1, 2, 7, 64] {
            let deal = Deal {
                parts: vec![(10, 1), (0, 1), (3, 100), (129, 1)],
                shards,
            };
            let mut seen: Vec<(usize, u64)> = Vec::new();
            let mut sizes = Vec::new();
            for k in 0..shards {
                let before = seen.len();
                for (part, stride) in deal.of(k).into_iter().enumerate() {
                    seen.extend((0..stride.len()).map(|j| (part, stride.at(j))));
                }
                sizes.push(seen.len() - before);
            }
            assert!(sizes.iter().max().unwrap() - sizes.iter().min().unwrap() <= 1);
            seen.sort();
            let expected = deal.parts.iter().enumerate();
            let expected: Vec<(usize, u64)> = expected
                .flat_map(|(p, (n, _))| (0..*n).map(move |i| (p, i)))
                .collect();
            assert_eq!(seen, expected, "{shards}");
            let work: u64 = (0..shards).map(|k| deal.work_of(k)).sum();
            assert_eq!((work, deal.units()), (deal.work(), 142));
        }
    }

    #[test]
    fn strides_count_and_number() {
        for (first, step, end, expected) in [
            (0, 1, 0, vec![]),
            (3, 2, 3, vec![]),
            (5, 2, 3, vec![]),
            (2, 7, 3, vec![2]),
            (1, 3, 7, vec![1, 4]),
            (1, 3, 8, vec![1, 4, 7]),
        ] {
            let stride = Stride { first, step, end };
            let found: Vec<u64> = (0..stride.len()).map(|j| stride.at(j)).collect();
            assert_eq!(found, expected);
            assert_eq!(stride.is_empty(), expected.is_empty());
        }
    }

    /// A unit is a case, a rectangle, or a hunt.
    #[test]
    fn work_is_counted_by_kind() {
        let of = |part: &str| {
            let text = format!("name = \"x\"\n[[part]]\nmethods = [\"faddeeva\"]\n{part}");
            let plan = Plan::read(&crate::machine::Source::toml(text)).unwrap();
            let deal = Deal::new(&plan, 3);
            let shards: u64 = (0..deal.shards()).map(|k| deal.work_of(k)).sum();
            assert_eq!((deal.shards(), shards), (3, deal.work()));
            (deal.units(), deal.work())
        };
        assert_eq!(of("cases = 12\nregions = [\"mid\"]"), (12, 12));
        assert_eq!(of("cases = 12\nregions = [\"mid\", \"far\"]"), (24, 24));
        let program = "kind = \"candidate\"\nexec = \"true\"\ncases = 7\nregions = [\"mid\"]";
        assert_eq!(of(program), (7, 7));
        let hunts = "kind = \"hunt\"\nhunts = 5\nevaluations = 40";
        assert_eq!(of(hunts), (5, 200));
        let n = first_rectangles(Some(0.01)).len() as u64;
        assert_eq!(of("kind = \"proof\"\nwithin = 0.01"), (n, n));
    }

    /// A count that is too large is the largest number.
    #[test]
    fn endless_work_does_not_come_round() {
        let deal = Deal {
            parts: vec![(u64::MAX, 3), (2, 1)],
            shards: 2,
        };
        assert_eq!((deal.units(), deal.work()), (u64::MAX, u64::MAX));
        assert_eq!(
            deal.of(1)[1],
            Stride {
                first: 0,
                step: 2,
                end: 2
            }
        );
        assert_eq!(
            deal.of(0)[1],
            Stride {
                first: 1,
                step: 2,
                end: 2
            }
        );
    }
}
