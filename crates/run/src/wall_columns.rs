//! Names of the columns of a table of walls: parameters, what only a check reads, and the Italian of both.

/// Columns that only a check reads, and their keys in its table `[check]`.
pub(crate) const OF_CHECK: [(&str, &str); 10] = [
    ("height_ratio", "building.height_ratio"),
    ("before_activation", "before_activation"),
    ("young_modulus", "young_modulus"),
    ("overburden_mass", "overburden_mass"),
    ("hinge", "hinge"),
    ("hinge_levels", "hinge_levels"),
    ("masonry_strength", "masonry_strength"),
    ("confidence_factor", "confidence_factor"),
    ("knowledge_level", "knowledge_level"),
    ("at_activation", "tie.at_activation"),
];

/// Italian names of columns, in small letters.
const ITALIAN: [(&str, &str); 26] = [
    ("parete", "name"),
    ("nome", "name"),
    ("scena", "scene"),
    ("meccanismo", "mechanism"),
    ("altezza", "height"),
    ("spessore", "thickness"),
    ("larghezza", "width"),
    ("massa volumica", "density"),
    ("carico in sommità", "overburden"),
    ("eccentricità", "overburden_eccentricity"),
    ("posizione della cerniera", "hinge_ratio"),
    ("quota della catena", "tie_height"),
    ("rigidezza della catena", "tie_stiffness"),
    ("resistenza della catena", "tie_strength"),
    ("gioco della catena", "tie_slack"),
    ("allungamento a rottura", "tie_ultimate"),
    ("quota relativa", "height_ratio"),
    ("prima dell'attivazione", "before_activation"),
    ("modulo di elasticità", "young_modulus"),
    ("massa solidale", "overburden_mass"),
    ("cerniera", "hinge"),
    ("livelli", "hinge_levels"),
    ("resistenza della muratura", "masonry_strength"),
    ("fattore di confidenza", "confidence_factor"),
    ("livello di conoscenza", "knowledge_level"),
    ("catena all'attivazione", "at_activation"),
];

/// Italian choices in cells, in small letters.
const CHOICES: [(&str, &str); 11] = [
    ("ribaltamento semplice", "parapet"),
    ("parapetto", "parapet"),
    ("flessione verticale", "vertical_spanning"),
    ("rigida", "rigid"),
    ("legge", "law"),
    ("trave", "beam"),
    ("minimo moltiplicatore", "least_alpha0"),
    ("più sfavorevole", "worst"),
    ("fornita", "given"),
    ("snervamento", "yield"),
    ("nessuno", "none"),
];

/// The name of a column, which may be Italian.
pub(crate) fn column(name: &str) -> &str {
    of(&ITALIAN, name)
}

/// A choice in a cell, which may be Italian.
pub(crate) fn choice(cell: &str) -> &str {
    of(&CHOICES, cell)
}

fn of<'a>(names: &'a [(&str, &str)], name: &'a str) -> &'a str {
    let plain = name.trim().to_lowercase().replace('_', " ");
    names.iter().find(|(italian, _)| *italian == plain).map_or(name, |(_, own)| own)
}

/// The key of `[check]` that a column has; `None` of a parameter of the wall.
pub(crate) fn key_of_check(column: &str) -> Option<&'static str> {
    OF_CHECK.into_iter().find(|(name, _)| *name == column).map(|(_, key)| key)
}
