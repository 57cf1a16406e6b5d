//! Drives the packed FMU from Rust: by the importer `fmi`, and by `libloading` where that has no wrapper.

#![allow(unsafe_code, reason = "a library is loaded and called")]
#![allow(missing_docs, clippy::unwrap_used, reason = "a test")]

use std::ffi::{CStr, CString, c_void};
use std::path::{Path, PathBuf};

use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation, Common};
use fmi::fmi3::import::Fmi3Import;
use fmi::fmi3::{CoSimulation as _, Common as _, Fmi3Model as _, GetSet as _};
use fmi::schema::fmi3::{TypeDefinition, Variable};
use fmi::traits::FmiImport as _;
use fmi_sys::fmi2 as standard;
use libloading::Library;

fn archive() -> PathBuf {
    let path = std::env::var_os("ROCKING_WALL_FMU")
        .expect("ROCKING_WALL_FMU names the FMU; `cargo xtask test` sets it");
    PathBuf::from(path)
}

/// The FMI 3.0 unit that is made beside an FMI 2.0 one.
fn of_fmi3(path: &Path) -> PathBuf {
    path.with_file_name("fmi3").join(path.file_name().unwrap())
}

/// A file of the archive.
fn read(name: &str) -> Vec<u8> {
    let mut zip = zip::ZipArchive::new(std::fs::File::open(archive()).unwrap()).unwrap();
    let mut bytes = Vec::new();
    std::io::copy(&mut zip.by_name(name).unwrap(), &mut bytes).unwrap();
    bytes
}

fn description() -> String {
    String::from_utf8(read("modelDescription.xml")).unwrap()
}

/// An attribute of the first element that holds `mark`.
fn attribute(text: &str, mark: &str, name: &str) -> String {
    let element = text.split('<').find(|element| element.contains(mark)).unwrap();
    element.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap().to_owned()
}

fn reference(name: &str) -> u32 {
    attribute(&description(), &format!("name=\"{name}\""), "valueReference").parse().unwrap()
}

const STEP: f64 = 0.01;
const STEPS: u32 = 200;

/// u after each step of the default wall, by the crate fmi.
fn by_fmi() -> Vec<f64> {
    let import: Fmi2Import = fmi::import::from_path(archive()).unwrap();
    let mut wall = import.instantiate_cs("wall", false, false).unwrap();
    assert_eq!(wall.get_version(), "2.0");
    assert_eq!(wall.get_types_platform(), "default");
    wall.setup_experiment(Some(1e-8), 0.0, None).unwrap();
    wall.enter_initialization_mode().unwrap();
    wall.exit_initialization_mode().unwrap();
    let mut history = Vec::new();
    for index in 0..STEPS {
        wall.do_step(f64::from(index) * STEP, STEP, true).unwrap();
        let mut u = [0.0];
        wall.get_real(&[reference("u")], &mut u).unwrap();
        history.push(u[0]);
    }
    wall.terminate().unwrap();
    history
}

/// u after each step of the default wall in FMI 3.0, by the crate fmi.
fn by_fmi3() -> Vec<f64> {
    let import: Fmi3Import = fmi::import::from_path(of_fmi3(&archive())).unwrap();
    let mut wall = import.instantiate_cs("wall", false, false, false, false, &[]).unwrap();
    assert_eq!(wall.get_version(), "3.0");
    wall.enter_initialization_mode(Some(1e-8), 0.0, None).unwrap();
    wall.exit_initialization_mode().unwrap();
    let mut history = Vec::new();
    for index in 0..STEPS {
        let (mut event, mut end, mut early, mut time, mut u) = (true, true, true, 0.0, [0.0]);
        let start = f64::from(index) * STEP;
        wall.do_step(start, STEP, true, &mut event, &mut end, &mut early, &mut time).unwrap();
        assert_eq!((event, end, early, time), (false, false, false, start + STEP));
        wall.get_float64(&[reference("u")], &mut u).unwrap();
        history.push(u[0]);
    }
    wall.terminate().unwrap();
    history
}

#[test]
fn both_versions_agree_bit_for_bit() {
    let bits = |history: Vec<f64>| history.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(by_fmi()), bits(by_fmi3()));
}

/// The floor's FMU and that of a scene are read as they are too.
#[test]
fn every_fmi_3_unit_can_be_read() {
    let floor = std::env::var_os("ROCKING_FLOOR_FMU").expect("`cargo xtask test` sets ROCKING_FLOOR_FMU");
    let floor: Fmi3Import = fmi::import::from_path(of_fmi3(Path::new(&floor))).unwrap();
    let path = std::env::temp_dir().join(format!("rocking-wall-scene-{}.fmu", std::process::id()));
    let program = std::env::var_os("ROCKING_WALL_BIN").expect("`cargo xtask test` sets ROCKING_WALL_BIN");
    let mut package = std::process::Command::new(program);
    package.args(["package", "../../scenes/strip_between_floors.toml", "--base"]);
    assert!(package.arg(of_fmi3(&archive())).arg("-o").arg(&path).status().unwrap().success());
    let strip: Fmi3Import = fmi::import::from_path(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    for (import, variable, unit, nominal) in [
        (&floor, "displacement", "m", 0.01),
        (&floor, "stiffness", "N/m", 1e7),
        (&strip, "u", "m", 0.1),
        (&strip, "drift", "m", 0.01),
        (&strip, "time", "s", 1.0),
    ] {
        let description = import.model_description();
        let variables = &description.model_variables.variables;
        let float = variables.iter().find_map(|found| match found {
            Variable::Float64(float) if float.name == variable => Some(float),
            _ => None,
        });
        let declared = float.unwrap().declared_type.as_deref();
        let types = &description.type_definitions.as_ref().unwrap().type_definitions;
        let of_type = types.iter().find_map(|found| match found {
            TypeDefinition::Float64(float) if Some(&*float.name) == declared => Some(float),
            _ => None,
        });
        let found = of_type.map(|float| (float.unit.as_deref(), float.nominal)).unwrap();
        assert_eq!(found, (Some(unit), Some(nominal)), "{variable}");
    }
}

/// The library of the archive, loaded from a folder of its own.
struct Loaded {
    library: Library,
    folder: PathBuf,
}

impl Loaded {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("rocking-wall-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("wall.so");
        std::fs::write(&path, read("binaries/linux64/wall.so")).unwrap();
        // SAFETY: the library is ours; its initialisation only sets Rust's runtime up.
        let library = unsafe { Library::new(&path) }.unwrap();
        Self { library, folder }
    }

    /// A function of the standard, by its name with a NUL.
    fn function<T: Copy>(&self, name: &CStr) -> T {
        // SAFETY: `T` is the standard's type of the function of that name, and `signatures.rs` compares the
        // two.
        let symbol = unsafe { self.library.get::<T>(name.to_bytes_with_nul()) };
        *symbol.unwrap_or_else(|error| panic!("{}: {error}", name.to_string_lossy()))
    }

    fn instantiate(&self) -> standard::fmi2Component {
        type Instantiate = unsafe extern "C" fn(
            standard::fmi2String,
            standard::fmi2Type,
            standard::fmi2String,
            standard::fmi2String,
            *const standard::fmi2CallbackFunctions,
            standard::fmi2Boolean,
            standard::fmi2Boolean,
        ) -> standard::fmi2Component;
        let instantiate: Instantiate = self.function(c"fmi2Instantiate");
        let guid = CString::new(attribute(&description(), "fmiModelDescription", "guid")).unwrap();
        let kind = standard::fmi2Type_fmi2CoSimulation;
        // SAFETY: every string ends with NUL and outlives the call; NULL callbacks are allowed.
        let wall = unsafe {
            instantiate(c"wall".as_ptr(), kind, guid.as_ptr(), std::ptr::null(), std::ptr::null(), 0, 0)
        };
        assert!(!wall.is_null());
        wall
    }
}

impl Drop for Loaded {
    fn drop(&mut self) {
        // failure to delete the temporary folder does not matter
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

type Plain = unsafe extern "C" fn(standard::fmi2Component) -> standard::fmi2Status;
type Setup = unsafe extern "C" fn(standard::fmi2Component, i32, f64, f64, i32, f64) -> standard::fmi2Status;
type DoStep = unsafe extern "C" fn(standard::fmi2Component, f64, f64, i32) -> standard::fmi2Status;
type GetReal =
    unsafe extern "C" fn(standard::fmi2Component, *const u32, usize, *mut f64) -> standard::fmi2Status;
type Directional = unsafe extern "C" fn(
    standard::fmi2Component,
    *const u32,
    usize,
    *const u32,
    usize,
    *const f64,
    *mut f64,
) -> standard::fmi2Status;

#[test]
fn two_importers_agree_bit_for_bit() {
    let expected = by_fmi();
    let loaded = Loaded::new("drive");
    let wall = loaded.instantiate();
    let setup: Setup = loaded.function(c"fmi2SetupExperiment");
    let step: DoStep = loaded.function(c"fmi2DoStep");
    let get: GetReal = loaded.function(c"fmi2GetReal");
    let call = |name: &CStr| {
        let function: Plain = loaded.function(name);
        // SAFETY: `wall` is an instance of this library and not yet freed.
        assert_eq!(unsafe { function(wall) }, 0, "{}", name.to_string_lossy());
    };
    // SAFETY: as above.
    assert_eq!(unsafe { setup(wall, 1, 1e-8, 0.0, 0, 0.0) }, 0);
    call(c"fmi2EnterInitializationMode");
    call(c"fmi2ExitInitializationMode");
    let u = reference("u");
    for (index, expected) in (0_u32..).zip(&expected) {
        let mut found = f64::NAN;
        // SAFETY: as above; one reference and one place for its value.
        let status = unsafe {
            assert_eq!(step(wall, f64::from(index) * STEP, STEP, 1), 0);
            get(wall, &raw const u, 1, &raw mut found)
        };
        assert_eq!(status, 0);
        assert_eq!(found.to_bits(), expected.to_bits(), "step {index}");
    }
    assert!(expected.iter().any(|u| *u < 0.0), "the wall has rocked to the other side");
    directional_derivative(&loaded, wall);
    states(&loaded, wall);
    call(c"fmi2Terminate");
    let free: unsafe extern "C" fn(standard::fmi2Component) = loaded.function(c"fmi2FreeInstance");
    // SAFETY: as above; not used afterwards.
    unsafe { free(wall) };
}

/// Two unknowns by one known, which the crate fmi 0.8 does not support.
fn directional_derivative(loaded: &Loaded, wall: *mut c_void) {
    let derivative: Directional = loaded.function(c"fmi2GetDirectionalDerivative");
    let unknowns = [reference("u_ddot"), reference("reaction_bottom")];
    let known = [reference("a_bottom")];
    let mut found = [f64::NAN; 2];
    // SAFETY: two unknowns, one known and its seed, two places for the result.
    let status = unsafe {
        derivative(wall, unknowns.as_ptr(), 2, known.as_ptr(), 1, [1.0].as_ptr(), found.as_mut_ptr())
    };
    assert_eq!(status, 0);
    // a parapet: ü = −(3/4) a + …, R = m (a + ü) with m = 2880 kg
    assert!((found[0] + 0.75).abs() < 1e-15, "{found:?}");
    assert!((found[1] - 720.0).abs() < 1e-12, "{found:?}");
}

/// Serialises a state and restores it.
fn states(loaded: &Loaded, wall: *mut c_void) {
    type Get = unsafe extern "C" fn(standard::fmi2Component, *mut standard::fmi2FMUstate) -> u32;
    type Set = unsafe extern "C" fn(standard::fmi2Component, standard::fmi2FMUstate) -> u32;
    type Size = unsafe extern "C" fn(standard::fmi2Component, standard::fmi2FMUstate, *mut usize) -> u32;
    type Serialize = unsafe extern "C" fn(
        standard::fmi2Component,
        standard::fmi2FMUstate,
        *mut standard::fmi2Byte,
        usize,
    ) -> u32;
    let (get, set): (Get, Set) = (loaded.function(c"fmi2GetFMUstate"), loaded.function(c"fmi2SetFMUstate"));
    let size: Size = loaded.function(c"fmi2SerializedFMUstateSize");
    let serialize: Serialize = loaded.function(c"fmi2SerializeFMUstate");
    let free: Get = loaded.function(c"fmi2FreeFMUstate");
    let mut state: standard::fmi2FMUstate = std::ptr::null_mut();
    let mut length = 0;
    // SAFETY: the state is NULL, then one of this instance; the buffer has the length asked for.
    unsafe {
        assert_eq!(get(wall, &raw mut state), 0);
        assert_eq!(size(wall, state, &raw mut length), 0);
        let mut bytes: Vec<standard::fmi2Byte> = vec![0; length];
        assert_eq!(serialize(wall, state, bytes.as_mut_ptr(), length), 0);
        assert!(bytes.iter().any(|&byte| byte != 0));
        assert_eq!(set(wall, state), 0);
        assert_eq!(free(wall, &raw mut state), 0);
    }
    assert!(state.is_null());
}

/// Every function of the standard is exported.
#[test]
fn every_function_can_be_loaded() {
    let loaded = Loaded::new("names");
    let names = include_str!("../../conformance/tests/signatures.rs");
    let names: Vec<_> =
        names.lines().filter_map(|line| line.trim().split_once(": fmi2")).map(|(name, _)| name).collect();
    assert!(names.len() >= 42);
    for name in names {
        let name = CString::new(name).unwrap();
        let _: unsafe extern "C" fn() = loaded.function(&name);
    }
    assert!(Path::new(&loaded.folder).exists());
}
