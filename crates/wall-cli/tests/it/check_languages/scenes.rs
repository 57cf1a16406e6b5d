//! Scenes of many kinds, each with a table `[check]`.

/// A strip wall in a building, its hinge searched, its hinges set back, in use class IV.
pub(super) const STRIP: &str = r#"
[geometry]
mechanism = "vertical_spanning"
height = 3.5
thickness = 0.3
density = 1800
overburden = 20000
overburden_eccentricity = 0.05
[force_law]
a1 = 0.03
[check]
code = "circolare-2019"
before_activation = "law"
soil = "C"
hinge = "worst"
topography = "T2"
masonry_strength = 1.5e6
masonry_gamma = 2
knowledge_level = "LC2"
use_class = "IV"
height_demand = "printed"
building = { storeys = 3, period = 0.3, height_ratio = 0.6 }
SLD = { ag = 0.08, F0 = 2.45, TC = 0.30, building_damping = 0.05 }
SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }
SLC = { ag = 0.20, F0 = 2.45, TC = 0.34, building_damping = 0.1, displacement = 0.1 }
"#;

/// A loaded parapet, held, on the ground, by the check with q.
pub(super) const LINEAR: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
overburden = 3000
[check]
code = "circolare-2019"
method = "linear"
behaviour_factor = 1.5
before_activation = "rigid"
overburden_mass = 0.5
soil = "A"
topography = 1.1
SLV = { ag = 0.1, F0 = 2.45, TC = 0.32 }
"#;

/// A parapet under spectra of its own place.
pub(super) const SPECTRUM: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
[check]
code = "circolare-2019"
before_activation = "rigid"
SLV = { damping = 0.05, ag = 0.1, spectrum = [[0, 0.2], [0.3, 0.5], [4, 0.05]], spectrum_damping = 0.05 }
SLD = { ag = 0.05, spectrum = [[0, 0.1], [0.3, 0.25], [4, 0.02]], spectrum_damping = 0.05 }
"#;

/// A parapet on a floor under records, on a grid of the hazard.
pub(super) const SITE: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
[[storeys]]
period = 0.3
[check]
code = "circolare-2019"
method = "dynamic"
before_activation = "rigid"
rocking = "one_sided_positive"
soil = "B"
record_scale = "none"
site.grid = "grid.csv"
site.ag_unit = "g/10"
site.coordinates = [42.02, 13.03]
site.nominal_life = 50
site.use_coefficient = 1
SLD = { building_damping = 0.05 }
SLV = { building_damping = 0.1 }
SLC = { building_damping = 0.1 }
records = { synthetic = { count = 3, duration = 10, step = 0.02 } }
"#;

/// A façade with a bar that yields.
pub(super) const TIED: &str = r#"
[geometry]
height = 6.0
thickness = 0.5
density = 1900
overburden = 10e3
overburden_eccentricity = 0.1

[force_law]
a1 = 0.03

[tie]
tie_height = 5.8
tie_side = "positive"

[tie.bar]
diameter = 0.016
length = 6.0
yield_stress = 235e6
ultimate_strain = 0.02
anchor_capacity = 60e3
spacing = 3.0

[check]
code = "circolare-2019"
before_activation = "law"
soil = "C"
overburden_mass = 1.0
rocking = "one_sided_positive"
tie = { at_activation = "yield" }
SLV = { ag = 0.18, F0 = 2.45, TC = 0.34 }

[report]
project = "Messa in sicurezza, the façade"
nominal_life = 50
use_coefficient = 1.0
language = "it"
"#;

/// A parapet by fractions of its displacement, under records.
pub(super) const FRACTIONS: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
[force_law]
a1 = 0.05
[check]
code = "fractions"
records = { synthetic = { count = 7, duration = 10, step = 0.02 } }
"#;

/// A façade of three floors with windows, a vault and a roof that push, which may open at each storey.
pub(super) const FACADE: &str = r#"
[geometry]
mechanism = "parapet"
part = [
  { height = 2.7, thickness = 0.6, density = 1800, width = 3.0 },
  { height = 2.6, thickness = 0.48, density = 1800, width = 3.0 },
  { height = 2.5, thickness = 0.36, density = 1800, width = 3.0 },
]
opening = [{ base = 0.9, height = 1.2, width = 1.0 }, { base = 3.6, height = 1.2, width = 1.0 }]
load = [
  { force = 24e3, height = 2.7, inside = 0.48, moving_mass = 1.0, thrust = 900, thrust_lasts = true },
  { force = 21e3, height = 5.3, inside = 0.38, moving_mass = 0.5 },
  { force = 18e3, height = 7.8, inside = 0.24, moving_mass = 1.0, thrust = 1500 },
]
[check]
code = "circolare-2019"
before_activation = "rigid"
soil = "B"
hinge_levels = [0, 2.7, 5.3]
building = { storeys = 3, period = 0.33, height_ratio = [0.0, 0.346, 0.679] }
SLD = { ag = 0.045, F0 = 2.55, TC = 0.26, building_damping = 0.05 }
SLV = { ag = 0.105, F0 = 2.52, TC = 0.3, building_damping = 0.1 }
"#;

/// A façade with two ties, of which one breaks early.
pub(super) const TWO_TIES: &str = r#"
[geometry]
mechanism = "parapet"
part = [
  { height = 3.4, thickness = 0.5, density = 1800, width = 1.0 },
  { height = 3.2, thickness = 0.4, density = 1800, width = 1.0 },
]
load = [{ force = 8e3, height = 6.6, inside = 0.28, moving_mass = 1.0, thrust = 1200, thrust_lasts = true }]
[[tie]]
tie_height = 3.3
tie_stiffness = 3e6
tie_strength = 6e3
tie_ultimate = 0.3
tie_side = "positive"
[[tie]]
tie_height = 6.5
tie_stiffness = 4e6
tie_strength = 9e3
tie_ultimate = 0.115
tie_side = "positive"
[check]
code = "circolare-2019"
before_activation = "rigid"
soil = "B"
rocking = "one_sided_positive"
tie = { at_activation = "yield" }
SLD = { ag = 0.104, F0 = 2.332, TC = 0.281 }
SLV = { ag = 0.261, F0 = 2.364, TC = 0.347 }
SLC = { ag = 0.334, F0 = 2.4, TC = 0.364 }
"#;

/// A façade with the wedge of a transverse wall and a tie, the crack of which is searched.
pub(super) const WEDGE: &str = r#"
[geometry]
mechanism = "parapet"
part = [
  { height = 6.0, thickness = 0.45, density = 1800, width = 1.0 },
  { base = 0, height = 6.0, thickness = [0, 1.0], outer = 0.45, density = 1800, width = 0.5 },
]
[tie]
tie_height = 5.8
tie_stiffness = 2e7
tie_strength = 20e3
tie_ultimate = 0.1
[check]
code = "circolare-2019"
before_activation = "rigid"
soil = "B"
rocking = "one_sided_positive"
crack_angles = [5, 60]
tie = { at_activation = "yield" }
SLD = { ag = 0.05, F0 = 2.45, TC = 0.28 }
SLV = { ag = 0.15, F0 = 2.4, TC = 0.32 }
"#;

/// A strip of two storeys with a floor, and two ties to it.
pub(super) const TIED_STRIP: &str = r#"
[geometry]
mechanism = "vertical_spanning"
part = [
  { height = 3.3, thickness = 0.5, density = 1800, width = 1.0 },
  { height = 3.2, thickness = 0.36, density = 1800, width = 1.0 },
]
load = [
  { force = 14e3, height = 3.3, inside = 0.4, moving_mass = 1.0 },
  { force = 9.8e3, height = 6.5, inside = 0.18, moving_mass = 1.0 },
]
[[tie]]
tie_height = 3.2
tie_stiffness = 2e7
tie_strength = 6e3
tie_ultimate = 0.05
tie_side = "both"
[[tie]]
tie_height = 3.6
tie_stiffness = 2e7
tie_strength = 4e3
tie_ultimate = 0.05
tie_side = "both"
[check]
code = "circolare-2019"
before_activation = "rigid"
soil = "B"
tie = { at_activation = "yield" }
SLD = { ag = 0.05, F0 = 2.45, TC = 0.28 }
SLV = { ag = 0.15, F0 = 2.4, TC = 0.32 }
"#;
