//! Arguments that several commands share: a scene, a record and how to read it.

use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use files::TomlFile;
use ground_motion::{
    Acceleration, Format, GroundMotion, MAX_FILE_BYTES, Record, RecordOptions, SyntheticMotion, Warning,
    parse, parse_channels, read,
};
use rocking_wall::simulation::Excitation;
use run::record_facts;
use run::records::folder_files;
use scene::{Scene, set_names};

use crate::output::Console;

/// A scene and what replaces parts of it.
#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// Scene file (TOML); without one the defaults of the model description
    pub(crate) scene: Option<PathBuf>,
    /// Set a parameter, such as `xi=0.03` or `force_law=trilinear`; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
}

/// A record file and how to read it.
#[derive(Debug, Args)]
pub(crate) struct RecordArguments {
    /// Accelerogram, in any format `wall record` reads, or `-` for standard input; it replaces the motion of
    /// a scene
    #[arg(long, value_name = "FILE", group = "recorded")]
    pub(crate) record: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
}

/// How to read records, which needs an argument of the group `recorded`, and what replaces or scales them.
#[derive(Debug, Args)]
pub(crate) struct MotionArguments {
    /// Unit of the record: m/s2, cm/s2, mm/s2 or g; needed where the file does not state its own
    #[arg(long, requires = "recorded")]
    unit: Option<String>,
    /// Time between samples in s, for a record that does not state it
    #[arg(long, requires = "recorded", value_name = "SECONDS")]
    record_step: Option<f64>,
    /// Column of a table (CSV or text)
    #[arg(long, requires = "recorded")]
    column: Option<String>,
    /// Channel of a record with several, by its number; `wall record` without it shows all
    #[arg(long, requires = "recorded")]
    channel: Option<String>,
    #[arg(long, requires = "recorded", help = format_help())]
    format: Option<String>,
    /// Use the project's synthetic motion
    #[arg(long, conflicts_with = "recorded")]
    pub(crate) synthetic: bool,
    /// Seed of the synthetic motion, by default 1; another seed gives another motion of its kind
    #[arg(long, requires = "synthetic", conflicts_with = "recorded", value_name = "NUMBER")]
    seed: Option<u64>,
    /// Factor on the motion given here
    #[arg(long, conflicts_with = "pga", value_name = "FACTOR")]
    pub(crate) scale: Option<f64>,
    /// Peak acceleration to scale the motion given here to, in m/s2 or with its unit, such as 0.3g
    #[arg(long, value_name = "M_PER_S2")]
    pub(crate) pga: Option<Acceleration>,
}

fn format_help() -> String {
    let names = Format::ALL.map(Format::name).join(", ");
    format!("Format of the record ({names}), if its content does not tell")
}

impl SceneArguments {
    /// The scene of the file, or the default one.
    pub(crate) fn load(&self, console: &Console<'_>) -> Result<Scene> {
        let Some(path) = &self.scene else { return Ok(Scene::default()) };
        let scene = Scene::read(path).map_err(|error| {
            if path.is_file() && path.extension().is_none_or(|ending| ending != "toml") {
                anyhow!("{error}; a scene is a TOML file, and a record goes after --record")
            } else if let Some(command) = command_of(path) {
                anyhow!("{error}; this file is no scene: {command} takes it")
            } else {
                error.into()
            }
        })?;
        warn_of_motion(console, path, &scene);
        Ok(scene)
    }

    /// Returns the files that the scene was read from.
    pub(crate) fn inputs<'a>(&'a self, scene: &'a Scene) -> impl Iterator<Item = &'a PathBuf> {
        self.scene.iter().chain(&scene.files)
    }

    /// Names the scene's file in an error about its parameters.
    pub(crate) fn named<T, E: Into<anyhow::Error>>(&self, outcome: Result<T, E>) -> Result<T> {
        outcome.map_err(|error| match &self.scene {
            Some(path) => error.into().context(path.display().to_string()),
            None => error.into(),
        })
    }
}

/// Finds the command of a file that has the keys of a study or of walls.
fn command_of(path: &Path) -> Option<&'static str> {
    let text = std::fs::read_to_string(path).ok()?;
    let file = TomlFile::new("", &text).ok()?;
    let commands = [("models", "wall study ida"), ("walls", "wall check")];
    commands.into_iter().find(|(key, _)| file.table().contains_key(*key)).map(|(_, command)| command)
}

/// Applies `--set` to a scene, after a motion may have changed the start.
pub(crate) fn apply_set(set: &[String], scene: &mut Scene) -> Result<()> {
    for assignment in set {
        let Some((name, value)) = assignment.split_once('=') else {
            bail!("--set {assignment}: expected NAME=VALUE, such as --set xi=0.03");
        };
        scene.set(name.trim(), value).with_context(|| format!("--set {assignment}"))?;
    }
    Ok(())
}

/// Reads the name of a file that takes a picture; names without an ending are those of devices.
pub(crate) fn svg_file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match path.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("svg") => {
            Err("a picture is SVG; give a file that ends in .svg")
        }
        _ => Ok(path),
    })
}

/// Replaces what Rust says of a text that is no number, and says how a parameter is given.
pub(crate) fn in_plain_words(refused: &clap::Error) -> String {
    let mut message = refused.to_string();
    if let (ErrorKind::UnknownArgument, Some(ContextValue::String(option))) =
        (refused.kind(), refused.get(ContextKind::InvalidArg))
        && let Some(name) = set_names().find(|name| option.strip_prefix("--") == Some(name))
    {
        message.extend(["\n", name, " is a parameter of a wall: give it as --set ", name, "=VALUE\n"]);
    }
    [
        ("invalid float literal", "expected a number with a decimal point, such as 0.3"),
        ("invalid digit found in string", "expected a whole number"),
        ("cannot parse integer from empty string", "expected a whole number"),
        ("cannot parse float from empty string", "expected a number"),
        ("number too large to fit in target type", "expected a smaller number"),
        ("number too small to fit in target type", "expected a larger number"),
        ("number would be zero for non-zero type", "expected a number from 1 on"),
    ]
    .into_iter()
    .fold(message, |text, (rust, plain)| text.replace(rust, plain))
}

/// Refuses the first option that is given, and says why.
pub(crate) fn refuse<const N: usize>(options: [(&str, bool); N], why: &str) -> Result<()> {
    match options.into_iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => bail!("{option} {why}"),
        None => Ok(()),
    }
}

/// Warns about a scene's own motion: accelerations that no record has, and a vertical record.
pub(crate) fn warn_of_motion(console: &Console<'_>, path: &Path, scene: &Scene) {
    let vertical = Warning::Vertical.to_string();
    let vertical = scene.motion_notes.contains(&vertical).then_some(vertical);
    let of_motion = scene.excitation.as_ref().and_then(Excitation::warning);
    let warnings = vertical.into_iter().chain(of_motion.map(|warning| warning.to_string()));
    console.warn(warnings.map(|warning| format!("{}: {warning}", path.display())));
}

/// Reads a record, and warns about what its check finds; `-` is standard input.
pub(crate) fn read_record(console: &Console<'_>, path: &Path, options: &RecordOptions) -> Result<Record> {
    let record = match standard_input(path)? {
        Some(bytes) => parse(STDIN, bytes, options)?,
        None => read(path, options)?,
    };
    let name = named(path).display();
    console.warn(record.check().warnings.iter().map(|warning| format!("{name}: {warning}")));
    Ok(record)
}

/// Lists record files; in place of a folder the files in it.
pub(crate) fn record_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            files.extend(folder_files(path).with_context(|| format!("{}: cannot be read", path.display()))?);
        } else {
            files.push(path.clone());
        }
    }
    Ok(files)
}

/// Name of standard input in messages.
const STDIN: &str = "standard input";

/// Returns the path of a record as messages show it.
pub(crate) fn named(path: &Path) -> &Path {
    if path.as_os_str() == "-" { Path::new(STDIN) } else { path }
}

/// Reads standard input, up to the size of the largest record, if `path` is `-`.
fn standard_input(path: &Path) -> Result<Option<Vec<u8>>> {
    if path.as_os_str() != "-" {
        return Ok(None);
    }
    let mut bytes = Vec::new();
    std::io::stdin().lock().take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).context(STDIN)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        bail!("{STDIN}: expected a record of at most {MAX_FILE_BYTES} bytes, found more; shorten it");
    }
    Ok(Some(bytes))
}

/// Returns the name of a record's file without its folder.
pub(crate) fn short_name(path: &Path) -> String {
    ground_motion::file_name(named(path))
}

/// What the project's synthetic motion is called.
pub(crate) const SYNTHETIC: &str = "synthetic motion";

impl RecordArguments {
    /// The motion given, scaled, and a note on it.
    pub(crate) fn load(&self, console: &Console<'_>) -> Result<Option<(GroundMotion, String)>> {
        let MotionArguments { synthetic, scale, pga, .. } = &self.motion;
        let (motion, note) = match &self.record {
            Some(path) => self.read(console, path)?,
            None if *synthetic => (self.motion.synthetic()?, SYNTHETIC.to_owned()),
            None if scale.is_some() || pga.is_some() => {
                bail!(
                    "--scale and --pga act on a motion given with --record or --synthetic; give one of them"
                );
            }
            None => return Ok(None),
        };
        Ok(Some((self.motion.scaled(console, motion)?, note)))
    }

    /// Reads a record and describes it.
    pub(crate) fn read(&self, console: &Console<'_>, path: &Path) -> Result<(GroundMotion, String)> {
        let record = read_record(console, path, &self.motion.options()?)?;
        let name = short_name(path);
        Ok((record.motion, format!("record {name} ({})", record.format.description())))
    }
}

impl MotionArguments {
    /// How records are read.
    fn options(&self) -> Result<RecordOptions> {
        Ok(RecordOptions {
            unit: self.unit.as_deref().map(str::parse).transpose()?,
            step: self.record_step,
            column: self.column.clone(),
            channel: self.channel.clone(),
            format: self.format.as_deref().map(str::parse).transpose()?,
        })
    }

    /// Makes the synthetic motion.
    fn synthetic(&self) -> Result<GroundMotion> {
        let usual = SyntheticMotion::default();
        Ok(SyntheticMotion { seed: self.seed.unwrap_or(usual.seed), ..usual }.motion()?)
    }

    /// Reads every channel of a record, or the one that is asked for, and scales them; without a path the
    /// channel of the synthetic motion. `-` is standard input.
    pub(crate) fn channels(&self, console: &Console<'_>, path: Option<&Path>) -> Result<Vec<Record>> {
        let options = self.options()?;
        let mut records = match path {
            None => {
                let csv = record_facts::samples(&self.synthetic()?);
                parse_channels(SYNTHETIC, csv.into_bytes(), &options)?
            }
            Some(path) => match standard_input(path)? {
                Some(bytes) => parse_channels(STDIN, bytes, &options)?,
                None => ground_motion::read_channels(path, &options)?,
            },
        };
        for record in &mut records {
            record.motion = self.scaled(console, record.motion.clone())?;
        }
        Ok(records)
    }

    /// Scales a motion as the arguments say, and warns about accelerations that no record has.
    pub(crate) fn scaled(&self, console: &Console<'_>, motion: GroundMotion) -> Result<GroundMotion> {
        let scaled = match (self.scale, self.pga) {
            (Some(factor), _) => motion.checked_scaled(factor)?,
            (None, Some(pga)) => motion.scaled_to_peak(pga.0)?,
            // the reader has already warned
            (None, None) => return Ok(motion),
        };
        console.warn(scaled.warning());
        Ok(scaled)
    }
}
