//! `wall package`: an FMU of one scene.
//!
//! It starts from the general FMU and needs no compiler: the library stays, the description keeps the
//! variables that the scene uses, and `resources/` gets the scene and its motion. The guid ends in the
//! scene's fingerprint, so that the library refuses to run without it.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use fmu_export_build::archive::Archive;
use fmu_export_build::{DefaultExperiment, Description, Reduction};
use ground_motion::GroundMotion;
use rocking_wall::scene::{self, GROUPS, Scene};
use rocking_wall::wall::{Kinematics, Parameters, Wall};

use crate::output;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Scene file (TOML)
    scene: PathBuf,
    /// The FMU to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The general FMU to start from
    #[arg(long, value_name = "FILE", default_value = "fmu_out/wall.fmu")]
    base: PathBuf,
}

/// Communication steps of a scene's default experiment: FMPy records at most 1000 samples.
const STEPS: f64 = 1000.0;

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let scene = Scene::read(&arguments.scene)?;
    if scene.parameters.kinematics != Kinematics::Linear {
        bail!(
            "{}: an FMU has small rotations only; set kinematics = linear, or run the scene with \
             `wall simulate`",
            arguments.scene.display()
        );
    }
    output::check_distinct(
        [&arguments.scene, &arguments.base].into_iter().chain(&scene.records),
        [&arguments.output],
    )?;
    let wall = Wall::new(&scene.parameters).with_context(|| arguments.scene.display().to_string())?;
    for warning in wall.warnings() {
        output::warn(&warning.to_string());
    }
    let (archive, counts, _) = of_scene(&scene, General::open(&arguments.base, "--base")?)?;
    output::to_file(&arguments.output, &archive.to_bytes()?)?;
    output::to_stdout(&format!(
        "{}: {}, {} of {} variables\n",
        arguments.output.display(),
        scene.title,
        counts.kept,
        counts.all
    ))
}

/// Variables of a scene's FMU.
pub(crate) struct Counts {
    kept: usize,
    all: usize,
}

/// The general FMU of a model.
pub(crate) struct General {
    pub(crate) archive: Archive,
    pub(crate) description: Description,
    /// Without braces.
    guid: String,
}

impl General {
    /// Opens the general FMU at `path`, which the user names with `option`.
    pub(crate) fn open(path: &Path, option: &str) -> Result<Self> {
        let archive = Archive::open(path).with_context(|| {
            format!(
                "the general FMU is missing or damaged; make it with `cargo xtask fmu`, or name it with \
                 {option}"
            )
        })?;
        let xml = archive.get("modelDescription.xml").context("the base FMU has no modelDescription.xml")?;
        let xml = std::str::from_utf8(xml).context("modelDescription.xml of the base FMU is not UTF-8")?;
        let description = Description::parse(xml).context("modelDescription.xml of the base FMU")?;
        let guid = description.declared_guid();
        let Some(guid) = guid.strip_prefix('{').and_then(|guid| guid.strip_suffix('}')) else {
            bail!("{}: its guid {guid} is not of a general FMU", path.display());
        };
        if guid.contains('-') {
            bail!("{}: is itself an FMU of a scene; give the general one with {option}", path.display());
        }
        let guid = guid.to_owned();
        Ok(Self { archive, description, guid })
    }

    /// Returns the guid of the FMU that contains a payload.
    pub(crate) fn guid_with(&self, payload: &str) -> String {
        format!("{{{}-{}}}", self.guid, scene::fingerprint(payload.as_bytes()))
    }
}

/// Makes the FMU of a scene from the general one. Returns its `resources/scene.toml` too.
pub(crate) fn of_scene(scene: &Scene, mut general: General) -> Result<(Archive, Counts, String)> {
    let mut motion = String::new();
    if let Some(excitation) = &scene.excitation {
        motion = motion_table(&mut general.archive, "motion", excitation.bottom());
        // the tail is in stop_time
        motion.push_str("tail = 0.0\n");
        if let Some(top) = excitation.top() {
            let table = motion_table(&mut general.archive, "motion_top", top);
            motion.push_str("\n[motion.top]\n");
            motion.push_str(&table);
        }
    }
    let text = scene::to_toml(scene, &motion);
    let reduced = reduce(&general.description, scene, &general.guid_with(&text))?;
    let General { mut archive, description, .. } = general;
    archive.insert("resources/scene.toml", text.as_str());
    archive.insert("modelDescription.xml", reduced.to_xml());
    let counts = Counts { kept: reduced.variable_names().count(), all: description.variable_names().count() };
    Ok((archive, counts, text))
}

/// Puts a motion into the archive and returns the keys that read it.
fn motion_table(archive: &mut Archive, name: &str, motion: &GroundMotion) -> String {
    let mut csv = String::new();
    for sample in motion.samples() {
        // writing to a String cannot fail
        let _ = writeln!(csv, "{sample:?}");
    }
    let table = format!(
        "record = \"{name}.csv\"\nunit = \"m/s2\"\nstep = {:?}\nfingerprint = \"{}\"\n",
        motion.step(),
        scene::fingerprint(csv.as_bytes())
    );
    archive.insert(format!("resources/{name}.csv"), csv);
    table
}

fn reduce(base: &Description, scene: &Scene, guid: &str) -> Result<Description> {
    let numbers = GROUPS.iter().flat_map(|(_, names)| names.iter()).filter(|name| scene.uses(name));
    let starts: Vec<_> = numbers
        .filter_map(|name| Some(((*name).to_owned(), scene::parameter_text(&scene.parameters, name)?)))
        .collect();
    let keep = |name: &str| scene.uses(name);
    let description = format!("Rocking wall, one scene: {}", scene.title);
    Ok(base.reduced(&Reduction {
        model_name: &scene.title,
        description: &description,
        guid,
        keep: &keep,
        starts: &starts,
        experiment: DefaultExperiment {
            start: 0.0,
            stop: scene.stop_time,
            step: scene.stop_time / STEPS,
            tolerance: Parameters::default().tolerance,
        },
    })?)
}
