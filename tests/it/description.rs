//! Compares the model description with the promised names, and the documentation with the description.

use fmu_export::{Causality, Kind, Variable, VariableId};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism, RealVariable, RestitutionSource, Rocking,
    Softening, Solver, TieSide,
};
use rocking_wall::wall::{Parameters, usage};
use scene::Scene;

use crate::page;

const XML: &str = include_str!("../../modelDescription/modelDescription.xml");
const PAGE: &str = include_str!("../../modelDescription/documentation/index.html");

fn variables() -> Vec<&'static Variable> {
    page::variables::<Unit>()
}

#[test]
fn the_names_others_rely_on_are_there_in_their_order() {
    let expected = "
        a_g a_bottom a_top drift
        u u_dot overturned u_ddot u_ratio restoring_force damping_force reaction_bottom reaction_top
        impulse_bottom impulse_top overturn_time u_max
        mechanism height thickness width density gravity hinge_ratio
        overburden overburden_eccentricity eccentricity_mode
        force_law a1 a3 d1 softening
        damping_model xi c_bar
        impact restitution_source restitution
        u_start u_dot_start solver tolerance newmark_step
        mass effective_mass participation F0 F0_negative u_ins u_ins_negative omega1
        xi_used restitution_used
        tie_height tie_stiffness tie_slack tie_strength tie_side rocking tie_force
        tie_ultimate tie_elongation tie_elongation_negative tie_broken tie_break_time
        body_mass centroid_height inertia arm arm_inner load_force load_height load_arm load_mass
        load_mass_height load_inertia thrust thrust_height";
    let names: Vec<_> = variables().iter().map(|variable| variable.name).collect();
    assert_eq!(names, expected.split_whitespace().collect::<Vec<_>>());
    // FMPy plots every output, and stops above 17
    let outputs = variables().iter().filter(|variable| variable.causality == Causality::Output).count();
    assert_eq!(outputs, 15);
    let references: Vec<_> = variables().iter().map(|variable| variable.reference).collect();
    assert!(references.iter().copied().eq(1..=78), "{references:?}");
}

#[test]
fn items_have_the_names_others_rely_on_and_count_from_one() {
    macro_rules! items {
        ($($type:ident: $names:literal),+ $(,)?) => {$(
            let names: Vec<_> = $type::ALL.iter().map(|item| item.name()).collect();
            assert_eq!(names, $names.split(' ').collect::<Vec<_>>());
            assert!($type::ALL.iter().map(|item| item.value()).eq((1..).take(names.len())), "{names:?}");
            for item in $type::ALL {
                assert_eq!($type::from_value(item.value()), Some(*item));
                assert_eq!($type::from_name(item.name()), Some(*item));
                assert!(!item.description().is_empty(), "{item:?}");
            }
        )+};
    }
    items! {
        Mechanism: "parapet vertical_spanning rigid_body",
        EccentricityMode: "fixed_to_wall follows_pivot",
        ForceLaw: "rigid_linear bilinear trilinear",
        Softening: "parallel rotated chord",
        DampingModel: "none constant_coefficient free_standing_block constant_ratio stiffness_proportional",
        Impact: "none restitution",
        RestitutionSource: "analytic calibrated momentum impulses",
        TieSide: "positive negative both",
        Rocking: "two_sided one_sided_positive one_sided_negative",
        Solver: "automatic exact adaptive newmark",
    }
}

#[test]
fn the_head_of_the_scene_names_every_table_of_parameters() {
    let scene = include_str!("../../crates/scene/src/lib.rs");
    let head = scene.split("\n\n").next().unwrap();
    for (group, _) in scene::GROUPS {
        assert!(head.contains(&format!("`[{group}]`")), "{group}");
    }
}

#[test]
fn every_variable_says_what_it_is() {
    for variable in variables() {
        assert!(variable.description.len() > 10, "{}", variable.name);
        assert!(!variable.description.ends_with('.'), "{}", variable.name);
        let real = matches!(variable.kind, Kind::Real { .. });
        assert_eq!(variable.unit.is_some(), real, "{}", variable.name);
    }
    let mut reals = 0;
    for line in XML.lines().filter(|line| line.trim_start().starts_with("<Real declaredType=")) {
        // Importers ignore units and nominal values of types.
        assert!(line.contains(" unit=\"") && line.contains(" nominal=\""), "{line}");
        reals += 1;
    }
    assert_eq!(reals, RealVariable::ALL.len());
}

#[test]
fn the_frame_is_complete() {
    for text in [
        &format!("version=\"{}\"", env!("CARGO_PKG_VERSION")),
        "guid=\"{fingerprint}\"",
        "variableNamingConvention=\"structured\"",
        "author=\"The rocking-wall authors\"",
        "license=\"MIT OR Apache-2.0\"",
        "generationTool=\"rocking-wall\"",
        "numberOfEventIndicators=\"3\"",
        "completedIntegratorStepNotNeeded=\"false\"",
        "needsExecutionTool=\"false\"",
        "canHandleVariableCommunicationStepSize=\"true\"",
        "canInterpolateInputs=\"true\"",
        "maxOutputDerivativeOrder=\"1\"",
        "canRunAsynchronuously=\"false\"",
        "canBeInstantiatedOnlyOncePerProcess=\"false\"",
        "canNotUseMemoryManagementFunctions=\"true\"",
        "canGetAndSetFMUstate=\"true\"",
        "canSerializeFMUstate=\"true\"",
        "providesDirectionalDerivative=\"true\"",
        "<DefaultExperiment startTime=\"0\" stopTime=\"30\" stepSize=\"0.01\" tolerance=\"1e-8\"/>",
    ] {
        assert!(XML.contains(text), "{text}");
    }
    for category in
        ["logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal", "logEvents", "logAll"]
    {
        assert!(XML.contains(&format!("<Category name=\"{category}\"")), "{category}");
    }
    // A date would make every build a different FMU; the comment says so.
    assert!(XML.contains("generationDateAndTime is") && !XML.contains("generationDateAndTime="));
}

/// What importers show is the factor times the value: 1 m/s² is 1/9.80665 g.
#[test]
fn the_factor_of_g_is_that_of_standard_gravity() {
    let behind = XML.split("<DisplayUnit name=\"g\" factor=\"").nth(1).unwrap();
    let factor = behind.split('"').next().unwrap();
    assert_eq!(factor.parse(), Ok(1.0 / ground_motion::STANDARD_GRAVITY));
}

/// Importers show the first display unit where a variable states none: -1 s, not -1000 ms.
#[test]
fn times_are_shown_in_seconds() {
    let time = XML.split("<SimpleType name=\"Time\"").nth(1).and_then(|rest| rest.split("</").next());
    assert!(time.is_some_and(|time| time.contains("displayUnit=\"s\"")), "{time:?}");
}

#[test]
fn documents_name_every_variable_and_choice() {
    let read = |file: &str| std::fs::read_to_string(crate::root().join(file)).unwrap();
    let (list, manual) = (read("docs/variables.md"), read("docs/model.md"));
    for variable in variables() {
        assert!(list.contains(&format!("`{}`", variable.name)), "docs/variables.md lacks {}", variable.name);
        let Kind::Enumeration { items, .. } = &variable.kind else { continue };
        let (_, line) = list.split_once(&format!("`{}` {{", variable.name)).unwrap();
        let line = line.split('}').next().unwrap();
        for name in items.iter().map(|item| item.name) {
            let is_listed =
                line.split(|c: char| ",*".contains(c) || c.is_whitespace()).any(|own| own == name);
            assert!(is_listed, "docs/variables.md: add {name} to {}", variable.name);
        }
    }
    for model in DampingModel::ALL.iter().filter(|model| model.ratio().is_some()) {
        let row = format!("\n| {}", model.name());
        assert!(manual.contains(&row), "docs/model.md: add {} to the table of C(u)", model.name());
    }
}

#[test]
fn the_documentation_lists_every_variable_with_its_default() {
    for variable in variables() {
        let (name, row) = (variable.name, page::row(PAGE, variable));
        let condition = usage(&Parameters::default()).find(|usage| usage.name == name).unwrap().condition;
        let place = format!("{{where {name}}}");
        assert_eq!(row.contains(&place), !condition.is_empty(), "{name}: {place} in {row}");
        if let Kind::Enumeration { items, .. } = &variable.kind {
            for item in *items {
                let entry = format!("<dt>{} <code>{}</code></dt>", item.value, item.name);
                assert!(row.contains(&entry), "documentation/index.html: add {entry} to {name}");
            }
        }
    }
    let rows = PAGE.matches("<tr><td><code>").count();
    assert_eq!(rows, variables().len(), "the page lists a variable that is none");
}

#[test]
fn the_documentation_needs_nothing_from_outside() {
    page::assert_needs_nothing_from_outside(PAGE);
}

/// Outputs of a tie that yields are listed where the tie yields, each elongation on the sides it is for.
#[test]
fn outputs_of_ties_are_listed_where_they_matter() {
    let outputs = ["tie_force", "tie_elongation", "tie_elongation_negative", "tie_broken", "tie_break_time"];
    let yields = Parameters {
        tie_height: 3.0,
        tie_stiffness: 1e6,
        tie_strength: 5e3,
        tie_ultimate: 0.0,
        ..Parameters::default()
    };
    let one_side = [true, true, false, true, true];
    for (parameters, listed) in [
        (yields.clone(), one_side),
        (Parameters { tie_side: TieSide::Negative, ..yields.clone() }, [true, false, true, true, true]),
        (Parameters { tie_side: TieSide::Both, ..yields.clone() }, [true; 5]),
        (Parameters { tie_ultimate: 0.1, ..yields.clone() }, one_side),
        (Parameters { tie_ultimate: -1.0, ..yields.clone() }, [true, false, false, false, false]),
        (Parameters { tie_strength: 0.0, ..yields.clone() }, [true, false, false, false, false]),
        (Parameters { tie_stiffness: 0.0, ..yields }, [false; 5]),
    ] {
        // as in the FMU of the scene
        let scene = Scene { parameters, ..Scene::default() };
        assert_eq!(outputs.map(|name| scene.uses(name)), listed, "{:?}", scene.parameters);
    }
}
