//! A scene as its FMU carries it: `resources/scene.bin`. Text is read where the FMU is packaged, not here.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use fmu_export::{Failure, StateCodec};
use ground_motion::GroundMotion;

use crate::choices::TieSide;
use crate::simulation::Excitation;
use crate::wall::{Hollow, Kinematics, Load, Opening, Parameters, Part, Profile, TieNumbers};

/// The first bytes of the file: what it is, and the version of its layout.
const KIND: &str = "rocking-wall scene 3";

/// The parameters of a wall, and what moves its supports.
///
/// ```
/// use rocking_wall::unit::UnitScene;
/// use rocking_wall::wall::Parameters;
///
/// let scene = UnitScene { parameters: Parameters { height: 2.5, ..Parameters::default() }, motion: None };
/// assert_eq!(UnitScene::read(&scene.bytes())?, scene);
/// # Ok::<(), fmu_export::Failure>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnitScene {
    /// The wall and its solver. Only the variables of the description, the kinematics, parts, further ties
    /// and the points of a multilinear law are carried.
    pub parameters: Parameters,
    /// The motion of the supports, interpolated between samples.
    pub motion: Option<Excitation>,
}

impl UnitScene {
    /// Returns the bytes of the file.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let written = self.clone().transfer(&mut StateCodec::writing(&mut bytes));
        debug_assert!(written.is_ok(), "only reading fails");
        bytes
    }

    /// Reads the bytes of the file.
    ///
    /// Parts of a wall are taken as they were checked when the FMU was packaged.
    ///
    /// # Errors
    /// If they are not a scene of this layout, or have a value that the description or a record cannot have.
    pub fn read(bytes: &[u8]) -> Result<Self, Failure> {
        let (mut scene, mut codec) = (Self::default(), StateCodec::reading(bytes));
        scene.transfer(&mut codec)?;
        codec.finish()?;
        Ok(scene)
    }

    fn transfer(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        let mut kind = KIND.to_owned();
        codec.text(&mut kind)?;
        if kind != KIND {
            return Err(Failure(format!("is {kind:?} where {KIND:?} is expected: package the FMU again")));
        }
        self.parameters.transfer(codec)?;
        codec.item(&mut self.parameters.kinematics, &Kinematics::ALL)?;
        let points = self.parameters.multilinear.take();
        let mut numbers = points.as_deref().map(<[[f64; 2]]>::as_flattened).unwrap_or_default().to_vec();
        transfer_numbers(&mut numbers, codec)?;
        let points: Arc<[[f64; 2]]> = numbers.as_chunks().0.into();
        self.parameters.multilinear = (!points.is_empty()).then_some(points);
        transfer_profile(&mut self.parameters, codec)?;
        transfer_ties(&mut self.parameters.further_ties, codec)?;
        let motion = self.motion.take();
        let mut records = motion.as_ref().map_or([None, None, None], Excitation::records_of_supports);
        for record in &mut records {
            transfer_record(record, codec)?;
        }
        let [bottom, top, drift] = records;
        self.motion = bottom.map(|bottom| {
            let motion = Excitation::new(bottom, top);
            match drift {
                Some(drift) => motion.with_drift(drift),
                None => motion,
            }
        });
        Ok(())
    }

    /// Returns the motion, which all units of the process share that have the same.
    pub(super) fn shared_motion(self) -> Option<Arc<Excitation>> {
        static MOTIONS: Mutex<Vec<Weak<Excitation>>> = Mutex::new(Vec::new());

        let motion = self.motion?;
        let mut motions = MOTIONS.lock().unwrap_or_else(PoisonError::into_inner);
        motions.retain(|known| known.strong_count() > 0);
        let known = motions.iter().filter_map(Weak::upgrade).find(|known| **known == motion);
        Some(known.unwrap_or_else(|| {
            let motion = Arc::new(motion);
            motions.push(Arc::downgrade(&motion));
            motion
        }))
    }
}

/// The ties after the first, with the numbers that their bars have given them.
#[cold]
fn transfer_ties(ties: &mut Arc<[TieNumbers]>, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
    let of_tie = |tie: &TieNumbers| {
        let TieNumbers { height, stiffness, slack, strength, ultimate, side, bar: _ } = *tie;
        [height, stiffness, slack, strength, ultimate, f64::from(side.value())]
    };
    let mut numbers: Vec<f64> = ties.iter().flat_map(of_tie).collect();
    transfer_numbers(&mut numbers, codec)?;
    let read = numbers.as_chunks().0.iter().map(|&[height, stiffness, slack, strength, ultimate, side]| {
        let side = TieSide::ALL.iter().copied().find(|known| f64::from(known.value()) == side);
        let side = side.ok_or_else(|| Failure("a tie has no such side: package the FMU again".to_owned()))?;
        Ok(TieNumbers { height, stiffness, slack, strength, ultimate, side, bar: None })
    });
    *ties = read.collect::<Result<_, Failure>>()?;
    Ok(())
}

/// The parts, openings and loads of a wall, if it has parts.
#[cold]
fn transfer_profile(parameters: &mut Parameters, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
    let of = parameters.profile.take();
    let lists = of.as_ref().map(|of| (of.parts(), of.openings(), of.loads()));
    let (parts, openings, loads) = lists.unwrap_or_default();
    let parts = parts.iter().flat_map(|part| {
        let Part { base, height, thickness: [t0, t1], width: [w0, w1], outer: [o0, o1], density } = *part;
        [base, height, t0, t1, w0, w1, o0, o1, density]
    });
    let openings = openings.iter().flat_map(|opening| {
        let Opening { base, height, width, hollow } = *opening;
        // an opening through the wall has no thickness of its own
        let Hollow { thickness, outer } = hollow.unwrap_or(Hollow { thickness: 0.0, outer: 0.0 });
        [base, height, width, thickness, outer]
    });
    let loads = loads.iter().flat_map(|load| {
        let Load { force, height, inside, moving_mass, mass, thrust, .. } = *load;
        [force, height, inside, moving_mass.unwrap_or(0.0), mass, thrust]
    });
    let mut numbers: [Vec<f64>; 3] = [parts.collect(), openings.collect(), loads.collect()];
    for numbers in &mut numbers {
        transfer_numbers(numbers, codec)?;
    }
    let [parts, openings, loads] = &numbers;
    if parts.is_empty() {
        return Ok(());
    }
    let parts = parts.as_chunks().0.iter().map(|&[base, height, t0, t1, w0, w1, o0, o1, density]| Part {
        base,
        height,
        thickness: [t0, t1],
        width: [w0, w1],
        outer: [o0, o1],
        density,
    });
    let openings = openings.as_chunks().0.iter().map(|&[base, height, width, thickness, outer]| Opening {
        base,
        height,
        width,
        hollow: (thickness != 0.0).then_some(Hollow { thickness, outer }),
    });
    let loads = loads.as_chunks().0.iter().map(|&[force, height, inside, moving_mass, mass, thrust]| Load {
        moving_mass: Some(moving_mass),
        mass,
        thrust,
        ..Load::resting(force, height, inside)
    });
    let profile = Profile::of_checked(parts.collect(), openings.collect(), loads.collect());
    parameters.profile = Some(Arc::new(profile));
    Ok(())
}

/// A record, if there is one: its step and its samples; no samples stand for none.
fn transfer_record(record: &mut Option<GroundMotion>, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
    let mut step = record.as_ref().map_or(0.0, GroundMotion::step);
    let mut samples = record.as_ref().map(|record| record.samples().to_vec()).unwrap_or_default();
    codec.f64(&mut step)?;
    transfer_numbers(&mut samples, codec)?;
    if codec.is_reading() && !samples.is_empty() {
        let read = GroundMotion::new(step, samples).map_err(|error| Failure(error.to_string()))?;
        *record = Some(read);
    }
    Ok(())
}

/// Numbers with their count.
fn transfer_numbers(numbers: &mut Vec<f64>, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    codec.bytes(&mut bytes)?;
    *numbers = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    Ok(())
}
