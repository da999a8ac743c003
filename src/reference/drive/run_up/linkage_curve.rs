//! The exact coefficient functions of a linkage, panel by panel along its branch.

use super::linkage_panel::{Mechanism, Panel};
use crate::class_iii::{Configuration, ExactAngle, Geometry, Linkage, Masses, Mode};
use crate::{Ball, Undecided};
use rug::Rational;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// The exact functions of a class-III linkage on one branch, computed where they are asked for.
///
/// A turn is cut into equal panels, the first of which begins at the start angle.
pub struct LinkageCurve {
    bits: u32,
    pub(super) panels: u32,
    pub(super) offset: ExactAngle,
    mechanism: Mechanism,
    linkage: Linkage,
    masses: Masses,
    start: Configuration,
    chain: Mutex<Chain>,
}

/// I_n and M_o at equal steps.
type Nodes = (Vec<Ball>, Vec<Ball>);

/// The computed centres and panels, forward and backward from the start, and the nodes by their
/// number.
#[derive(Default)]
struct Chain {
    forward: Vec<Link>,
    backward: Vec<Link>,
    nodes: BTreeMap<u32, Nodes>,
    closed: Option<bool>,
}

struct Link {
    configuration: Configuration,
    panel: Option<Arc<Panel>>,
}

impl LinkageCurve {
    /// The linkage on the branch of `start`, a configuration at the crank angle `offset`; the turn
    /// is cut into `panels` panels. More panels cost more Taylor models of lower degree.
    pub fn new(
        geometry: &Geometry,
        masses: &Masses,
        offset: &ExactAngle,
        start: &Configuration,
        panels: u32,
        bits: u32,
    ) -> LinkageCurve {
        LinkageCurve {
            bits,
            // Half a panel must stay well below a radian.
            panels: panels.max(12),
            offset: offset.clone(),
            mechanism: Mechanism::new(geometry, masses, bits),
            linkage: Linkage::new(geometry, bits),
            masses: masses.clone(),
            start: start.clone(),
            chain: Mutex::default(),
        }
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    pub(super) fn undecided(&self, reason: impl Into<String>) -> Undecided {
        Undecided::new(self.bits, reason)
    }

    /// `offset + π k/panels`.
    fn angle(&self, k: i64) -> Ball {
        let part = Rational::from((k, self.panels));
        self.offset.to_ball(self.bits) + Ball::pi(self.bits) * Ball::rational(self.bits, &part)
    }

    fn follow(&self, from: &Configuration, a: &Ball, b: &Ball) -> Result<Configuration, Undecided> {
        self.linkage
            .follow(from, a, b)
            .ok_or_else(|| self.undecided("the linkage cannot be followed over the turn"))
    }

    /// Returns true if the branch is back after one turn.
    fn closes(&self, chain: &mut Chain) -> Result<bool, Undecided> {
        if let Some(known) = chain.closed {
            return Ok(known);
        }
        let n = self.panels as usize;
        self.extend(&mut chain.forward, n - 1, 1)?;
        let last = &chain.forward[n - 1].configuration;
        let end = self.follow(
            last,
            &self.angle(2 * n as i64 - 1),
            &self.angle(2 * n as i64),
        )?;
        let closed = self.is_back(&end)?;
        chain.closed = Some(closed);
        Ok(closed)
    }

    /// Returns true if the configuration after one turn touches that of the start and no other of
    /// all assembly modes, which are disjoint.
    pub(super) fn is_back(&self, end: &Configuration) -> Result<bool, Undecided> {
        let modes = self.linkage.modes(&self.offset.to_ball(self.bits))?;
        let touched = |by: &Configuration| -> Vec<bool> {
            let touches = |m: &Mode| {
                let mut pairs = m.configuration.balls().into_iter().zip(by.balls());
                pairs.all(|(x, y)| x.overlaps(y))
            };
            modes.iter().map(touches).collect()
        };
        let (own, there) = (touched(&self.start), touched(end));
        let one = |v: &[bool]| v.iter().filter(|&&x| x).count() == 1;
        Ok(one(&own) && own == there)
    }

    /// Follows the centres of the panels 0, 1, … (or −1, −2, …) up to number `last`.
    fn extend(&self, chain: &mut Vec<Link>, last: usize, sign: i64) -> Result<(), Undecided> {
        for i in chain.len()..=last {
            let at = self.angle(sign * (2 * i as i64 + 1));
            let configuration = match chain.last() {
                Some(link) => {
                    let before = self.angle(sign * (2 * i as i64 - 1));
                    self.follow(&link.configuration, &before, &at)?
                }
                None => self.follow(&self.start, &self.angle(0), &at)?,
            };
            chain.push(Link {
                configuration,
                panel: None,
            });
        }
        Ok(())
    }

    pub(super) fn panel(&self, index: i64) -> Result<Arc<Panel>, Undecided> {
        let mut guard = self.chain.lock().unwrap_or_else(|e| e.into_inner());
        let chain = &mut *guard;
        let n = i64::from(self.panels);
        let mut index = index;
        if !(-n..n).contains(&index) {
            if !self.closes(chain)? {
                return Err(self.undecided("the linkage is not back after one turn of the crank"));
            }
            index = index.rem_euclid(n);
        }
        let (list, i, sign) = if index >= 0 {
            (&mut chain.forward, index as usize, 1)
        } else {
            (&mut chain.backward, (-1 - index) as usize, -1)
        };
        self.extend(list, i, sign)?;
        if let Some(panel) = &list[i].panel {
            return Ok(panel.clone());
        }
        let h = Ball::pi(self.bits) / Ball::integer(self.bits, n);
        let panel = self
            .mechanism
            .panel(&self.angle(2 * index + 1), &list[i].configuration, &h)
            .ok_or_else(|| self.undecided("a panel of the linkage is too wide for its proof"))?;
        let panel = Arc::new(panel);
        list[i].panel = Some(panel.clone());
        Ok(panel)
    }

    /// I_n and M_o at the angles `offset + 2π j/nodes`, from the enclosed configurations there.
    ///
    /// # Errors
    /// [`Undecided`] when the linkage cannot be followed over the turn, or is not back after it.
    pub fn nodes(&self, nodes: u32) -> Result<Nodes, Undecided> {
        let mut chain = self.chain.lock().unwrap_or_else(|e| e.into_inner());
        if let Some(known) = chain.nodes.get(&nodes) {
            return Ok(known.clone());
        }
        let angle = |j: u32| {
            let part = Rational::from((2 * j, nodes));
            self.offset.to_ball(self.bits) + Ball::pi(self.bits) * Ball::rational(self.bits, &part)
        };
        let mut here = self.start.clone();
        let (mut inertia, mut moment) = (Vec::new(), Vec::new());
        for j in 0..nodes {
            if j > 0 {
                here = self.follow(&here, &angle(j - 1), &angle(j))?;
            }
            let r = self
                .linkage
                .reduce(&self.linkage.kinematics(&here)?, &self.masses);
            inertia.push(r.inertia);
            moment.push(r.moment);
        }
        // The nodes lead around as well as the panels do.
        let closed = match chain.closed {
            Some(known) => known,
            None => {
                let end = self.follow(&here, &angle(nodes - 1), &angle(nodes))?;
                self.is_back(&end)?
            }
        };
        chain.closed = Some(closed);
        if !closed {
            return Err(self.undecided("the linkage is not back after one turn of the crank"));
        }
        let found = (inertia, moment);
        chain.nodes.insert(nodes, found.clone());
        Ok(found)
    }
}
