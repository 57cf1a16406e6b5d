//! A scene as its FMU carries it: `resources/scene.bin`. Text is read where the FMU is packaged, not here.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use fmu_export::{Failure, StateCodec};
use ground_motion::GroundMotion;

use crate::simulation::Excitation;
use crate::wall::Parameters;

/// The first bytes of the file: what it is, and the version of its layout.
const KIND: &str = "rocking-wall scene 1";

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
    /// The wall and its solver. Only the variables of the description and the points of a multilinear law are
    /// carried.
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
        let points = self.parameters.multilinear.take();
        let mut numbers = points.as_deref().map(<[[f64; 2]]>::as_flattened).unwrap_or_default().to_vec();
        transfer_numbers(&mut numbers, codec)?;
        let points: Arc<[[f64; 2]]> = numbers.as_chunks().0.into();
        self.parameters.multilinear = (!points.is_empty()).then_some(points);
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
