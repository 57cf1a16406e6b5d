//! Variables of a scene, computed by the library of an FMU through the C interface of FMI 2.0.
#![allow(unsafe_code, reason = "the library is loaded and called")]

use std::env::consts::{ARCH, DLL_SUFFIX, OS};
use std::ffi::{CStr, CString};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use evidence::verification::Quantity;
use fmu_export::VariableId;
use fmu_export::ffi::types::{
    Boolean, CO_SIMULATION, CallbackFunctions, Component, Integer, OK, Real, Status, Text, Type,
    ValueReference, WARNING,
};
use libloading::Library;
use rocking_wall::scene::Scene;
use rocking_wall::simulation::segment_of;
use rocking_wall::variables::{IntegerVariable, RealVariable};
use rocking_wall::wall::{Kinematics, Support};
use scene_fmu::General;

type Instantiate =
    unsafe extern "C" fn(Text, Type, Text, Text, *const CallbackFunctions, Boolean, Boolean) -> Component;
type Plain = unsafe extern "C" fn(Component) -> Status;
type Setup = unsafe extern "C" fn(Component, Boolean, Real, Real, Boolean, Real) -> Status;
type Set<T> = unsafe extern "C" fn(Component, *const ValueReference, usize, *const T) -> Status;
type SetDerivatives =
    unsafe extern "C" fn(Component, *const ValueReference, usize, *const Integer, *const Real) -> Status;
type DoStep = unsafe extern "C" fn(Component, Real, Real, Boolean) -> Status;
type GetReal = unsafe extern "C" fn(Component, *const ValueReference, usize, *mut Real) -> Status;
type Free = unsafe extern "C" fn(Component);

/// The library of an FMU, loaded from a folder of its own.
pub(super) struct Fmu {
    path: PathBuf,
    general: General,
    guid: CString,
    /// Closed before its folder is deleted.
    library: Option<Library>,
    folder: PathBuf,
}

impl Fmu {
    /// Opens the FMI 2.0 unit at `path` and loads its library. Code of the library runs, whoever made it.
    pub(super) fn open(path: &Path) -> Result<Self> {
        let general = General::open(path)?;
        let platform = match (OS, ARCH) {
            ("linux", "x86_64") => "linux64",
            ("windows", "x86_64") => "win64",
            ("macos", _) => "darwin64",
            _ => bail!("FMI 2.0 has no name for {ARCH} on {OS}; verify the FMU on another machine"),
        };
        let file = format!("binaries/{platform}/{}{DLL_SUFFIX}", general.description.model_identifier());
        let name = path.display();
        let content = general.archive.get(&file).with_context(|| {
            format!("{name}: has no {file}; give an FMI 2.0 unit built for this platform (cargo xtask fmu)")
        })?;
        let folder = std::env::temp_dir().join(format!("wall-verify-{}", std::process::id()));
        // fails if the folder is someone else's
        std::fs::create_dir(&folder).with_context(|| folder.display().to_string())?;
        let guid = CString::new(general.description.declared_guid())?;
        let mut fmu = Self { path: path.to_owned(), guid, library: None, folder, general: general.clone() };
        let library = fmu.folder.join(format!("wall{DLL_SUFFIX}"));
        std::fs::write(&library, content).with_context(|| library.display().to_string())?;
        // SAFETY: loading runs the initialisers of the library, and nothing can check that they are sound.
        // The user asks for that by naming the FMU.
        let loaded = unsafe { Library::new(&library) };
        fmu.library = Some(loaded.with_context(|| format!("{name}: {file} cannot be loaded"))?);
        Ok(fmu)
    }

    /// A function of the standard by its name.
    fn function<T: Copy>(&self, name: &CStr) -> Result<T> {
        let library = self.library.as_ref().context("the library is loaded")?;
        // SAFETY: `T` is the type of FMI 2.0 for the function of that name.
        let symbol = unsafe { library.get::<T>(name.to_bytes_with_nul()) };
        let missing = || format!("{}: {} is missing", self.path.display(), name.to_string_lossy());
        Ok(*symbol.with_context(missing)?)
    }

    fn reference(&self, name: &str) -> Option<ValueReference> {
        self.general.description.reference(name)
    }

    /// Computes quantities of a scene; none of a scene that an FMU cannot have.
    pub(super) fn values(&self, scene: &Scene, quantities: &[Quantity]) -> Result<Vec<Option<f64>>> {
        let parameters = &scene.parameters;
        if parameters.kinematics != Kinematics::Linear || parameters.multilinear.is_some() {
            return Ok(vec![None; quantities.len()]);
        }
        let motion = scene.support_motion()?;
        let motion = motion.as_deref();
        let instance = Instance::new(self)?;
        instance.set_parameters(scene)?;
        if motion.is_some() {
            instance.set_inputs(segment_of(motion, 0.0, 0.0).from)?;
        }
        instance.initialize()?;
        let (mut now, mut values) = (0.0, Vec::new());
        for &Quantity { name, time } in quantities {
            // bounded by the samples of the motion
            while now < time {
                let segment = segment_of(motion, now, time - now);
                if motion.is_some() {
                    instance.set_inputs(segment.from)?;
                    instance.set_rates(segment.from, segment.to, segment.duration)?;
                }
                instance.step(now, segment.duration)?;
                now = if segment.duration >= time - now { time } else { now + segment.duration };
            }
            values.push(instance.get(name)?);
        }
        Ok(values)
    }
}

impl Drop for Fmu {
    fn drop(&mut self) {
        drop(self.library.take());
        // a temporary folder that stays does no harm
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// An instance for co-simulation.
struct Instance<'a> {
    fmu: &'a Fmu,
    component: Component,
}

impl<'a> Instance<'a> {
    fn new(fmu: &'a Fmu) -> Result<Self> {
        let instantiate: Instantiate = fmu.function(c"fmi2Instantiate")?;
        let (name, nothing) = (c"verify".as_ptr(), std::ptr::null());
        // SAFETY: every text ends with NUL and outlives the call; the general FMU needs no resources, and no
        // callback as logging is off.
        let component =
            unsafe { instantiate(name, CO_SIMULATION, fmu.guid.as_ptr(), nothing, std::ptr::null(), 0, 0) };
        ensure!(!component.is_null(), "{}: fmi2Instantiate refuses", fmu.path.display());
        Ok(Self { fmu, component })
    }

    fn expect(&self, status: Status, call: &str) -> Result<()> {
        let path = self.fmu.path.display();
        ensure!(matches!(status, OK | WARNING), "{path}: {call} returns status {status}, expected 0 or 1");
        Ok(())
    }

    /// The references of variables.
    fn references(&self, names: &[&str]) -> Result<Vec<ValueReference>> {
        let missing = |name: &str| format!("{}: has no variable {name}", self.fmu.path.display());
        let reference = |name: &&str| self.fmu.reference(name).with_context(|| missing(name));
        names.iter().map(reference).collect()
    }

    fn set_parameters(&self, scene: &Scene) -> Result<()> {
        let parameters = &scene.parameters;
        let real = |id: &RealVariable| Some((id.variable().name, parameters.real(*id)?));
        let (names, values): (Vec<_>, Vec<Real>) = RealVariable::ALL.iter().filter_map(real).unzip();
        self.set(c"fmi2SetReal", &names, &values)?;
        let integer = |id: &IntegerVariable| Some((id.variable().name, parameters.integer(*id)?));
        let (names, values): (Vec<_>, Vec<Integer>) = IntegerVariable::ALL.iter().filter_map(integer).unzip();
        self.set(c"fmi2SetInteger", &names, &values)
    }

    /// Sets variables by a function of the standard for values of their type.
    fn set<T>(&self, name: &CStr, names: &[&str], values: &[T]) -> Result<()> {
        let references = self.references(names)?;
        assert_eq!(references.len(), values.len(), "a value for each variable");
        let set: Set<T> = self.fmu.function(name)?;
        // SAFETY: the instance lives; both lists have the length stated.
        let status = unsafe { set(self.component, references.as_ptr(), values.len(), values.as_ptr()) };
        self.expect(status, &name.to_string_lossy())
    }

    fn set_inputs(&self, support: Support) -> Result<()> {
        self.set(c"fmi2SetReal", &INPUTS, &inputs(support))
    }

    /// Sets the rates of the inputs over a step.
    fn set_rates(&self, from: Support, to: Support, duration: f64) -> Result<()> {
        let (from, mut rates) = (inputs(from), inputs(to));
        rates.iter_mut().zip(from).for_each(|(rate, from)| *rate = (*rate - from) / duration);
        let references = self.references(&INPUTS)?;
        let set: SetDerivatives = self.fmu.function(c"fmi2SetRealInputDerivatives")?;
        let orders = [1; INPUTS.len()];
        // SAFETY: the instance lives; the three lists have the length stated.
        let status =
            unsafe { set(self.component, references.as_ptr(), rates.len(), orders.as_ptr(), rates.as_ptr()) };
        self.expect(status, "fmi2SetRealInputDerivatives")
    }

    fn initialize(&self) -> Result<()> {
        let setup: Setup = self.fmu.function(c"fmi2SetupExperiment")?;
        // SAFETY: the instance lives. No tolerance, from 0 s on, without end.
        self.expect(unsafe { setup(self.component, 0, 0.0, 0.0, 0, 0.0) }, "fmi2SetupExperiment")?;
        for name in [c"fmi2EnterInitializationMode", c"fmi2ExitInitializationMode"] {
            let call: Plain = self.fmu.function(name)?;
            // SAFETY: the instance lives.
            self.expect(unsafe { call(self.component) }, &name.to_string_lossy())?;
        }
        Ok(())
    }

    fn step(&self, from: f64, duration: f64) -> Result<()> {
        let step: DoStep = self.fmu.function(c"fmi2DoStep")?;
        // SAFETY: the instance lives.
        self.expect(unsafe { step(self.component, from, duration, 1) }, "fmi2DoStep")
    }

    /// Returns a variable, `None` if the FMU does not have it.
    fn get(&self, name: &str) -> Result<Option<f64>> {
        let Some(reference) = self.fmu.reference(name) else { return Ok(None) };
        let get: GetReal = self.fmu.function(c"fmi2GetReal")?;
        let mut value = f64::NAN;
        // SAFETY: the instance lives; one reference and one place for its value.
        let status = unsafe { get(self.component, &raw const reference, 1, &raw mut value) };
        self.expect(status, "fmi2GetReal").map(|()| Some(value))
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        if let Ok(free) = self.fmu.function::<Free>(c"fmi2FreeInstance") {
            // SAFETY: the instance lives, and nothing uses it afterwards.
            unsafe { free(self.component) }
        }
    }
}

const INPUTS: [&str; 3] = ["a_bottom", "a_top", "drift"];

/// The inputs of a motion of the supports.
fn inputs(Support { bottom, top, drift }: Support) -> [Real; INPUTS.len()] {
    [bottom, top, drift]
}
