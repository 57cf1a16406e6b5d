//! The bodies above the levels at which a façade may open: what is said of each, and of all.

use run::drawing::View;
use serde_json::{Map, Value, json};

use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::outcome::Checked;
use crate::circolare::statement::resultants::Resultants;
use crate::sections::drawing;
use crate::words::names::Side;
use crate::words::{Language, Sentence, above, say};

impl Checked<'_> {
    /// The sides that differ of this level.
    pub(super) fn sides_at(&self) -> Vec<(Option<f64>, Side, &SideVerdict)> {
        self.sides().map(|(side, verdict)| (self.stated_level(), side, verdict)).collect()
    }

    /// Whether there is one body whose sides are alike: its numbers need no heading.
    pub(super) fn is_one(&self) -> bool {
        self.outcome.alike && self.statement.hinge_levels.len() == 1
    }

    /// The body above the lowest level: the others are parts of it.
    pub(super) fn lowest(&self) -> &Self {
        self.beside.iter().fold(self, |lowest, other| if other.level < lowest.level { other } else { lowest })
    }

    /// A height above the level as one above the base of the wall \[m\].
    pub(super) fn above_base(&self, height: f64) -> f64 {
        height + self.stated_level().unwrap_or(0.0)
    }

    /// A side, and the level above which the wall turns where levels are stated.
    pub(super) fn told(&self, side: Side) -> Sentence {
        above(crate::words::side(self.which(side)), self.stated_level())
    }

    /// The heading of what belongs to the body above this level; empty where none is stated.
    pub(super) fn heading(&self, language: Language) -> String {
        let head = self.stated_level().map(|z| say!("Body above {z} m", "Corpo sopra {z} m", z));
        head.map_or_else(String::new, |head| format!("<h3>{}</h3>\n", head.markup(language)))
    }

    /// A sentence about this level, which it names where there are several.
    pub(super) fn of_level(&self, said: Sentence) -> Sentence {
        match self.stated_level().filter(|_| self.statement.hinge_levels.len() > 1) {
            None => said,
            Some(level) => {
                said.framed(|said| say!("above {level} m: {said}", "sopra {level} m: {said}", level, said))
            }
        }
    }

    /// Warnings of all levels, those of all alike once.
    pub(super) fn warnings(&self) -> Vec<Sentence> {
        let levels = self.levels();
        let mut warnings: Vec<Sentence> = Vec::new();
        for level in &levels {
            for warning in &level.outcome.warnings {
                let is_of_all = levels.iter().all(|other| other.outcome.warnings.contains(warning));
                let told = if is_of_all { warning.clone() } else { level.of_level(warning.clone()) };
                if !warnings.contains(&told) {
                    warnings.push(told);
                }
            }
        }
        warnings
    }

    /// The bodies above all levels to scale, beside each other, and the front of the lowest.
    pub(super) fn drawn(&self, language: Language) -> String {
        let (levels, lowest) = (self.levels(), self.lowest());
        let view = if levels.len() > 1 { View::Section } else { View::Whole };
        let figure = |level: &Self| {
            let head = level.heading(language);
            let above = level.stated_level().filter(|_| level.level != lowest.level);
            let figure = drawing::figure(&level.wall, &level.parameters, view, above, language);
            format!("<div>{head}{figure}</div>\n")
        };
        let mut figures: String = levels.iter().map(|level| figure(level)).collect();
        if levels.len() > 1 && !lowest.wall.body().is_rectangle {
            figures += &drawing::figure(&lowest.wall, &lowest.parameters, View::Front, None, language);
        }
        format!("<div class=\"bodies\">\n{figures}</div>\n")
    }

    /// Which resultants the weights have.
    pub(super) fn resultants(&self) -> Sentence {
        let e_star = self.governing().map_or(1.0, |side| side.curve.e_star);
        match self.statement.table.resultants {
            Resultants::Body if e_star == 1.0 => say! {
                "one resultant per body (C8.7.1.1), e* = 1.",
                "una risultante per ogni corpo (C8.7.1.1), e* = 1."
            },
            Resultants::Body => {
                say!("one resultant per body (C8.7.1.1).", "una risultante per ogni corpo (C8.7.1.1).")
            }
            Resultants::Each => say! {
                "a resultant of the own weight and one of each moving load (C8.7.1.1).",
                "una risultante del peso proprio e una di ogni carico che si muove (C8.7.1.1)."
            },
        }
    }

    /// All numbers by their names: of the level that governs, and of each where levels are stated.
    pub(super) fn all_numbers(&self) -> Value {
        let mut json = json!(self.outcome);
        json["warnings"] = json!(self.warnings());
        json["sides"] = self.sides_json();
        if self.stated_level().is_some() {
            let of = |checked: &Self| {
                let mut json = json!({ "level": checked.stated_level(), "sides": checked.sides_json() });
                if let Some(dynamic) = &checked.outcome.dynamic {
                    json["dynamic"] = json!(dynamic);
                }
                json
            };
            json["levels"] = self.levels().into_iter().map(of).collect();
        }
        json
    }

    /// The numbers of the sides by their names.
    fn sides_json(&self) -> Value {
        let mut json = Map::new();
        for (side, verdict) in self.outcome.sides.iter() {
            json.insert(side.key().to_owned(), self.ledger(side, verdict).json().into());
        }
        json.into()
    }
}
