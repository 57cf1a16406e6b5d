//! A scene as the text of a scene file.

use std::fmt::Write;

use fmu_export::VariableId as _;
use rocking_wall::variables::GROUPS;
use rocking_wall::wall::{
    Bar, Hollow, Kinematics, Load, OF_RECTANGLE, Opening, Parameters, Part, Profile, is_computable, usage,
};

use crate::body::{LOAD, OPENING, PART};
use crate::keys::{BAR, KINEMATICS, OF_BAR, POINTS, TIE_GROUP};
use crate::parameter::parameter_text;
use crate::storeys::Floors;
use crate::{DEFAULT_THRESHOLDS, Scene};

/// Writes a scene file that reads as `scene`. `motion` is the text of its `[motion]` table, or empty.
pub fn to_toml(scene: &Scene, motion: &str) -> String {
    let mut text = String::new();
    // writing to a String cannot fail
    let _ = writeln!(text, "title = {}", quoted(&scene.title));
    let _ = writeln!(text, "stop_time = {:?}\noutput_step = {:?}", scene.stop_time, scene.output_step);
    if scene.thresholds != DEFAULT_THRESHOLDS {
        let _ = writeln!(text, "thresholds = {:?}", scene.thresholds);
    }
    let inputs: Vec<_> = scene.inputs.iter().map(|input| format!("{:?}", input.variable().name)).collect();
    let _ = writeln!(text, "inputs = [{}]", inputs.join(", "));
    let parameters = &scene.parameters;
    for (group, names) in GROUPS {
        if group == TIE_GROUP && !parameters.further_ties.is_empty() {
            for tie in parameters.ties() {
                let _ = write!(text, "\n[[{group}]]\n{}", group_text(&parameters.tied_by(tie), group, names));
            }
        } else {
            let _ = write!(text, "\n[{group}]\n{}", group_text(parameters, group, names));
        }
    }
    text.extend(scene.floors.iter().map(Floors::to_toml));
    if !motion.is_empty() {
        let _ = write!(text, "\n[motion]\n{motion}");
    }
    text
}

/// Writes the parameters of a group; of the ties the first.
fn group_text(parameters: &Parameters, group: &str, names: &[&str]) -> String {
    let usages: Vec<_> = usage(parameters).collect();
    // leaves out a parameter at its start value that has no effect beside the others, or that is computed
    let is_left_out = |name: &str| {
        let is_computed = is_computable(name);
        usages.iter().any(|usage| usage.name == name && usage.is_start && (!usage.matters || is_computed))
    };
    let mut text = String::new();
    if group == "geometry" && parameters.kinematics != Kinematics::default() {
        let _ = writeln!(text, "{KINEMATICS} = {:?}", parameters.kinematics.name());
    }
    if let ("geometry", Some(profile)) = (group, &parameters.profile) {
        text.push_str(&profile_text(profile));
    }
    // a bar whose numbers have been changed since is none
    let tie = parameters.ties().next().filter(|tie| tie.weaker_part(parameters.width).is_some());
    let bar = tie.and_then(|tie| tie.bar).filter(|_| group == TIE_GROUP);
    text.extend(bar.map(|bar| format!("{BAR} = {{ {} }}\n", bar_text(&bar))));
    for name in names {
        match (&parameters.multilinear, *name) {
            (Some(points), "force_law") => {
                let _ = writeln!(text, "force_law = \"multilinear\"");
                let points: Vec<_> = points.iter().map(|[u, f]| format!("[{u:?}, {f:?}]")).collect();
                let _ = writeln!(text, "{POINTS} = [{}]", points.join(", "));
            }
            (_, name) if parameters.profile.is_some() && OF_RECTANGLE.contains(&name) => {}
            (_, name) if is_left_out(name) || (bar.is_some() && OF_BAR.contains(&name)) => {}
            _ => {
                if let Some(value) = parameter_text(parameters, name) {
                    let _ = writeln!(text, "{name} = {value}");
                }
            }
        }
    }
    text
}

/// Writes the numbers of a bar as they stand in its table.
fn bar_text(bar: &Bar) -> String {
    let numbers = Bar::NUMBERS.iter().enumerate();
    let given = numbers.filter_map(|(at, number)| Some(format!("{} = {:?}", number.key(), bar.get(at)?)));
    given.collect::<Vec<_>>().join(", ")
}

/// Writes a text as a basic TOML string.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            c if c.is_control() => quoted.extend(format!("\\u{:04X}", u32::from(c)).chars()),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// Writes a profile as keys of `[geometry]`, one a line.
fn profile_text(profile: &Profile) -> String {
    let parts = profile.parts().iter().map(|part| {
        let Part { base, height, thickness, width, outer, density } = part;
        format!(
            "{{ base = {base:?}, height = {height:?}, thickness = {thickness:?}, width = {width:?}, \
             density = {density:?}, outer = {outer:?} }}"
        )
    });
    let openings = profile.openings().iter().map(|opening| {
        let Opening { base, height, width, hollow } = opening;
        let hollow = hollow.map_or(String::new(), |Hollow { thickness, outer }| {
            format!(", thickness = {thickness:?}, outer = {outer:?}")
        });
        format!("{{ base = {base:?}, height = {height:?}, width = {width:?}{hollow} }}")
    });
    let loads = profile.loads().iter().map(|load| {
        let Load { force, height, inside, moving_mass, mass, thrust, thrust_lasts } = load;
        let share = moving_mass.map_or(String::new(), |share| format!(", moving_mass = {share:?}"));
        let mass = if *mass == 0.0 { String::new() } else { format!(", mass = {mass:?}") };
        let lasts = if *thrust_lasts { ", thrust_lasts = true" } else { "" };
        format!(
            "{{ force = {force:?}, height = {height:?}, inside = {inside:?}{share}{mass}, \
             thrust = {thrust:?}{lasts} }}"
        )
    });
    let lists = [(PART, parts.collect::<Vec<_>>()), (OPENING, openings.collect()), (LOAD, loads.collect())];
    let mut text = String::new();
    for (key, items) in lists.into_iter().filter(|(_, items)| !items.is_empty()) {
        text.extend([key, " = [", &items.join(", "), "]\n"]);
    }
    text
}
