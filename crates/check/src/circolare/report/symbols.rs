//! The symbols of a report.

use crate::words::formulas::formula;
use crate::words::markup::{paragraph, table};
use crate::words::{Language, Sentence, say};

/// Symbols that no heading or row of a report explains, and what they mean in English and Italian;
/// displacements are positive outwards.
const SYMBOLS: [[&str; 3]; 19] = [
    [
        "u",
        "displacement at mid-height of a parapet, at the centroid of the masonry (z_G) of a body of parts, \
         at the hinge of a strip; u > 0: outwards",
        "spostamento a mezza altezza (ribaltamento), alla quota z_G del baricentro della muratura (corpo \
         composto di parti) o alla cerniera intermedia; u > 0: verso l'esterno",
    ],
    [
        "u_ins",
        "u at which the wall overturns, hinges at the edges",
        "u di ribaltamento, con le cerniere agli spigoli",
    ],
    [
        "u_0, d_0",
        "u and d at which the force of the wall vanishes",
        "u e d di annullamento della forza della parete",
    ],
    [
        "d, a",
        "spectral displacement and acceleration of the mechanism",
        "spostamento e accelerazione spettrali del meccanismo",
    ],
    [
        "S_a",
        "acceleration that a check of the activation demands",
        "accelerazione richiesta da una verifica all'attivazione",
    ],
    ["d_y, a_y", "end of the elastic branch", "fine del ramo elastico"],
    ["k_0", "slope of the line that falls to u_0", "pendenza della retta che si annulla a u_0"],
    [
        "h, b, l",
        "height, thickness and width of the wall",
        "altezza, spessore e larghezza considerata della parete",
    ],
    [
        "h_1, h_2",
        "heights of the bodies below and above the hinge",
        "altezze dei corpi sotto e sopra la cerniera intermedia",
    ],
    ["W, O", "own weight, overburden", "peso proprio, carico in sommità"],
    [
        "c",
        "eccentricity of the overburden, positive outwards (u > 0)",
        "eccentricità del carico in sommità, positiva verso l'esterno (u > 0)",
    ],
    [
        "r",
        "share of the overburden's mass that moves with the wall",
        "frazione della massa del carico in sommità che si muove con la parete",
    ],
    [
        "t_b, t_m, t_t",
        "set-backs of the hinges at the base, in the middle, at the top",
        "arretramenti delle cerniere alla base, intermedia e in sommità",
    ],
    [
        "κ",
        "share of f_d in the rectangular stress block; in [C8.7.1.7] the factor of the mechanism",
        "quota di f_d nel diagramma rettangolare; nella [C8.7.1.7] coefficiente del meccanismo",
    ],
    ["y, i", "height of the tie, spacing of its bars", "quota della catena, interasse delle barre"],
    [
        "g_0, e_p",
        "slack of the tie, plastic elongation at which it breaks",
        "gioco della catena, suo allungamento plastico a rottura",
    ],
    ["a_1", "end of the elastic branch as a fraction of u_ins", "fine del ramo elastico, frazione di u_ins"],
    ["ξ, ξ_k", "damping of the mechanism, of the building", "smorzamento del meccanismo, dell'edificio"],
    [
        "η",
        "√[10/(5 + ξ)], ξ in %, at least 0.55 [3.2.4]",
        "√[10/(5 + ξ)], ξ in %, non minore di 0,55 [3.2.4]",
    ],
];

/// The symbols as a table.
pub(in crate::circolare) fn list(language: Language) -> String {
    let rows = SYMBOLS.map(|[symbol, en, it]| [formula(symbol), Sentence::new(en, it).markup(language)]);
    let said = say! {
        "Numbers are rounded where they are printed; results come from those that are not.",
        "I valori intermedi sono stampati arrotondati; i risultati derivano da quelli non arrotondati."
    };
    table(&[], &rows) + &paragraph(&said, language)
}
