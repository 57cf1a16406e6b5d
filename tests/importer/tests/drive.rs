//! Drives the packed FMUs from Rust by the importer `fmi`.

#![allow(missing_docs, clippy::unwrap_used, reason = "a test")]

use std::path::{Path, PathBuf};

use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation, Common};
use fmi::fmi3::import::Fmi3Import;
use fmi::fmi3::{CoSimulation as _, Common as _, Fmi3Model as _, GetSet as _};
use fmi::schema::fmi3::{TypeDefinition, Variable};
use fmi::traits::FmiImport as _;

fn archive() -> PathBuf {
    let path = std::env::var_os("ROCKING_WALL_FMU")
        .expect("ROCKING_WALL_FMU names the FMU; `cargo xtask test` sets it");
    PathBuf::from(path)
}

/// The FMI 3.0 unit that is made beside an FMI 2.0 one.
fn of_fmi3(path: &Path) -> PathBuf {
    path.with_file_name("fmi3").join(path.file_name().unwrap())
}

/// The value reference of a variable of the wall, in both versions.
fn reference(name: &str) -> u32 {
    let mut zip = zip::ZipArchive::new(std::fs::File::open(archive()).unwrap()).unwrap();
    let text = std::io::read_to_string(zip.by_name("modelDescription.xml").unwrap()).unwrap();
    let element = text.split('<').find(|element| element.contains(&format!("name=\"{name}\""))).unwrap();
    element.split("valueReference=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
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
    let bits = |history: &[f64]| history.iter().map(|u| u.to_bits()).collect::<Vec<_>>();
    let history = by_fmi();
    assert_eq!(bits(&history), bits(&by_fmi3()));
    assert!(history.iter().any(|u| *u < 0.0), "the wall has rocked to the other side");
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
