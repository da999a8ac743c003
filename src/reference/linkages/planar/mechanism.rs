//! A mechanism in exact data.

use super::loops::Loops;
use super::parts::{Body, Drive, Frame, Joint, MechanismError};
use super::real::Real;

/// Bodies and joints with one degree of freedom by count.
///
/// Coordinates: the angles ψ of the bodies' axes in the order of the bodies, then one displacement
/// for every slide and slot in the order of the joints.
#[derive(Clone, Debug)]
pub struct Mechanism {
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Joint>,
    pub(super) loops: Loops,
}

impl Mechanism {
    /// Checks the parts and closes the loops.
    ///
    /// ```
    /// use mechaudit_reference::planar::{Attachment, Body, Joint, Mechanism};
    /// use rug::Rational;
    /// // A parallelogram: crank, coupler, rocker.
    /// let q = |x: i32, y: i32| [Rational::from(x), Rational::from(y)];
    /// let bodies = ["crank", "coupler", "rocker"].map(Body::massless).to_vec();
    /// let pin = |a, b| Joint::Pin { a, b };
    /// let joints = vec![
    ///     pin(Attachment::ground(q(0, 0)), Attachment::body(0, q(0, 0))),
    ///     pin(Attachment::body(0, q(1, 0)), Attachment::body(1, q(0, 0))),
    ///     pin(Attachment::ground(q(2, 0)), Attachment::body(2, q(0, 0))),
    ///     pin(Attachment::body(1, q(2, 0)), Attachment::body(2, q(1, 0))),
    /// ];
    /// assert_eq!(Mechanism::new(bodies, joints)?.coordinates(), 3);
    /// # Ok::<(), mechaudit_reference::planar::MechanismError>(())
    /// ```
    ///
    /// # Errors
    /// See [`MechanismError`].
    pub fn new(bodies: Vec<Body>, joints: Vec<Joint>) -> Result<Mechanism, MechanismError> {
        check(&bodies, &joints)?;
        let loops = Loops::close(&bodies, &joints)?;
        let (coordinates, equations) = (loops.coordinates, loops.equations());
        if equations + 1 != coordinates {
            return Err(MechanismError::Freedom {
                coordinates,
                equations,
            });
        }
        Ok(Mechanism {
            bodies,
            joints,
            loops,
        })
    }

    /// The number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.loops.coordinates
    }

    /// The bodies.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    pub(super) fn check_drive(&self, drive: &Drive) -> Result<(), MechanismError> {
        let known = drive.0.iter().all(|(i, _)| *i < self.coordinates());
        let some = drive.0.iter().any(|(_, k)| !k.is_zero());
        (known && some).then_some(()).ok_or(MechanismError::Drive)
    }
}

fn check(bodies: &[Body], joints: &[Joint]) -> Result<(), MechanismError> {
    for body in bodies {
        if body.mass < 0 || body.inertia < 0 {
            return Err(MechanismError::Negative(body.name.clone()));
        }
    }
    let exists = |f: &Frame| f.body().is_none_or(|i| i < bodies.len());
    for (joint, j) in joints.iter().enumerate() {
        let (frames, direction) = match j {
            Joint::Pin { a, b } => ([a.frame, b.frame], None),
            Joint::Slide {
                a, b, direction, ..
            }
            | Joint::Slot { a, b, direction } => ([a.frame, b.frame], Some(direction)),
            Joint::Gear { a, b, carrier, .. } => {
                if !exists(carrier) {
                    return Err(MechanismError::Missing { joint });
                }
                ([*a, *b], None)
            }
            Joint::Rack { pinion, slide, .. } => {
                let Some(Joint::Slide { a, .. } | Joint::Slot { a, .. }) = joints.get(*slide)
                else {
                    return Err(MechanismError::Missing { joint });
                };
                ([*pinion, a.frame], None)
            }
        };
        if !frames.iter().all(exists) {
            return Err(MechanismError::Missing { joint });
        }
        if frames[0] == frames[1] {
            return Err(MechanismError::Itself { joint });
        }
        if direction.is_some_and(|d| d.iter().all(Real::is_zero)) {
            return Err(MechanismError::Direction { joint });
        }
    }
    Ok(())
}
