//! Why a mechanism, a position or a branch is refused.

/// Why a description is no mechanism of one degree of freedom.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MechanismError {
    /// An input is NaN or infinite.
    #[error("{what} is {value}; it has to be finite")]
    NotFinite {
        /// Which input.
        what: String,
        /// Its value in SI units.
        value: f64,
    },
    /// A joint or the drive names a body that there is not.
    #[error("{what} is on body {body}, but the bodies are 0 (ground) to {last}")]
    NoSuchBody {
        /// The joint or drive.
        what: String,
        /// The number.
        body: usize,
        /// The largest number.
        last: usize,
    },
    /// Both sides of a joint or of the drive are on one body.
    #[error("{what} joins {body} to itself")]
    SameBody {
        /// The joint or drive.
        what: String,
        /// The body's name.
        body: String,
    },
    /// A pin needs two bodies.
    #[error("{joint} holds {count} body; a pin joins two or more")]
    LonelyPin {
        /// The joint.
        joint: String,
        /// The number of bodies it holds.
        count: usize,
    },
    /// A rack or a drive by displacement refers to a joint that is not a slide.
    #[error("{what} needs a slide joint, and joint {joint} is none")]
    NoSlide {
        /// The rack or drive.
        what: String,
        /// The joint's number.
        joint: usize,
    },
    /// A gear ratio or pitch radius is zero.
    #[error("{what} is zero")]
    Zero {
        /// Which input.
        what: String,
    },
    /// There are too many bodies or joints.
    #[error("{count} {what}; at most {most} are possible")]
    TooMany {
        /// Bodies or joints.
        what: &'static str,
        /// Their number.
        count: usize,
        /// The largest number allowed.
        most: usize,
    },
    /// All dimensions are zero, or they differ too much.
    #[error(
        "the largest coordinate of a joint is {largest_m} m; it has to be from 1e-100 m to 1e100 m"
    )]
    Size {
        /// The largest coordinate in metres.
        largest_m: f64,
    },
    /// Joints hold some bodies more often than they need.
    #[error("over-constrained: {what} is redundant among {}", bodies.join(", "))]
    OverConstrained {
        /// The joint, or the drive.
        what: String,
        /// The bodies that are held without it.
        bodies: Vec<String>,
    },
    /// The drive moves what cannot move.
    #[error("locked: {what} has nothing to move, {} hold one another", bodies.join(", "))]
    Locked {
        /// The drive.
        what: String,
        /// The bodies that are rigid together.
        bodies: Vec<String>,
    },
    /// The drive does not determine the motion.
    #[error(
        "with the drive held, {} can still move, in {freedoms} degree{} of freedom",
        bodies.join(", "), if *freedoms == 1 { "" } else { "s" }
    )]
    Loose {
        /// How many, the drive held.
        freedoms: usize,
        /// The bodies that can still move.
        bodies: Vec<String>,
    },
    /// Bodies that no pin, slide or slot connects to the rest.
    #[error("{} hang on no pin, slide or slot", bodies.join(", "))]
    Hanging {
        /// The bodies.
        bodies: Vec<String>,
    },
}

/// Why there is no position.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PositionError {
    /// The drive's value is NaN, infinite or so large that floats no longer tell positions apart.
    #[error("the drive at {value} is out of range: finite and at most 1e6 in size")]
    Drive {
        /// The value.
        value: f64,
    },
    /// The branch ends or meets others.
    #[error(
        "the branch cannot be followed beyond {drive} of the drive: the mechanism is singular there"
    )]
    Ends {
        /// The last value of the drive that was reached.
        drive: f64,
    },
    /// The mechanism stays nearly singular.
    #[error(
        "gave up at {drive} of the drive after {steps} steps: the mechanism stays nearly singular"
    )]
    TooManySteps {
        /// The last value of the drive that was reached.
        drive: f64,
        /// Steps taken.
        steps: u32,
    },
}

/// Why it is not said which position is nearest to approximate angles.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NearestError {
    /// Not one angle for each moving body.
    #[error("{given} angles are given for {bodies} moving bodies")]
    Count {
        /// The number given.
        given: usize,
        /// The number of bodies that move.
        bodies: usize,
    },
    /// The drive, an angle or the reach is NaN or infinite.
    #[error("drive, angles and reach have to be finite, and one of them is {value}")]
    NotFinite {
        /// Its value.
        value: f64,
    },
    /// No position has all its angles so near.
    #[error("no position has all angles within {reach} rad of those given")]
    NoneWithin {
        /// The reach in radians.
        reach: f64,
    },
    /// Positions nearly merge or are equally far, modes may be missing, or there are gears or
    /// racks.
    #[error(
        "which position is nearest cannot be told: positions nearly merge or are equally far, or \
         not all of them are found"
    )]
    CannotTell,
}
