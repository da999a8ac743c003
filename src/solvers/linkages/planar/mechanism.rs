//! A mechanism of one degree of freedom, checked and taken apart.

use super::chain::Chain;
use super::check::{check, largest};
use super::error::MechanismError;
use super::model::Description;
use super::structure::{Structure, structure};
use super::triad::Triad;
use super::windings::Windings;

/// A planar mechanism whose drive determines its motion.
#[derive(Clone, Debug)]
pub struct Mechanism {
    description: Description,
    structure: Structure,
    pub(super) chain: Chain,
    /// For each group, whether it is a triad of pins.
    pub(super) triads: Vec<Option<Triad>>,
    pub(super) windings: Windings,
}

impl Mechanism {
    /// Checks a description, counts its degrees of freedom and takes it apart into Assur groups.
    ///
    /// The count is that of the structure: it holds for dimensions in general. Special ones, such
    /// as those of a parallelogram with a third crank, may move although the count says that they
    /// do not; they are refused as over-constrained.
    ///
    /// ```
    /// use mechaudit_solvers::planar::{Description, Drive, GROUND, GroupKind, Mechanism};
    /// // A four-bar linkage, lengths in metres.
    /// let mut d = Description::new();
    /// let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(|name| d.body(name));
    /// d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    /// d.pin("A", &[(crank, [0.10, 0.0]), (coupler, [0.0, 0.0])]);
    /// d.pin("B", &[(coupler, [0.40, 0.0]), (rocker, [0.30, 0.0])]);
    /// d.pin("C", &[(GROUND, [0.35, 0.0]), (rocker, [0.0, 0.0])]);
    /// d.drive = Drive::Angle { body: crank, from: GROUND };
    /// let linkage = Mechanism::new(d)?;
    /// let groups = &linkage.structure().groups;
    /// assert_eq!(groups[0].kind, GroupKind::Driver);
    /// assert_eq!((groups[1].kind, groups[1].order), (GroupKind::Assur { class: 2 }, 2));
    /// let modes = linkage.assembly_modes(1.0);
    /// assert!(modes.complete && modes.states.len() == 2);
    /// # Ok::<(), mechaudit_solvers::planar::MechanismError>(())
    /// ```
    ///
    /// # Errors
    /// [`MechanismError`].
    pub fn new(description: Description) -> Result<Mechanism, MechanismError> {
        check(&description)?;
        let structure = structure(&description)?;
        let largest = largest(&description)?;
        let metres = 2f64.powi(largest.log2().floor() as i32);
        let chain = Chain::new(&description, &structure, metres);
        for block in &chain.blocks {
            let placed = block.bodies.iter().all(|b| chain.order.contains(b));
            if !placed || block.unknowns.len() != block.rows.len() {
                let bodies = block
                    .bodies
                    .iter()
                    .map(|&b| description.bodies[b].clone())
                    .collect();
                return Err(MechanismError::Hanging { bodies });
            }
        }
        let triads = chain.blocks.iter().map(|b| Triad::of(&chain, b)).collect();
        let windings = Windings::new(&description, &chain);
        Ok(Mechanism {
            description,
            structure,
            chain,
            triads,
            windings,
        })
    }

    /// Returns what it was made from.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Its Assur groups.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Returns whether the drive is a displacement, in metres, rather than an angle, in radians.
    pub fn drive_is_displacement(&self) -> bool {
        self.chain.linear
    }

    /// Radians or metres of one unit of the chain's drive.
    fn drive_unit(&self) -> f64 {
        match self.chain.linear {
            true => self.chain.metres,
            false => 1.0,
        }
    }

    /// The drive in the chain's unit.
    pub(super) fn inner_drive(&self, drive: f64) -> f64 {
        drive / self.drive_unit()
    }

    /// The drive in radians or metres.
    pub(super) fn outer_drive(&self, drive: f64) -> f64 {
        drive * self.drive_unit()
    }
}
