//! What a search found, in words.

use super::{Found, FoundCheck, Sought};
use crate::code::sought::LARGE;
use crate::words::{Language, Sentence, Written, at_most, joined, say};

impl Sought {
    /// What is sought, for people.
    pub(crate) fn title(self) -> Sentence {
        let italian = match self {
            Self::Thickness => "spessore",
            Self::Height => "altezza",
            Self::Thrust => "somma delle spinte",
            Self::Load => "somma dei carichi",
            Self::TieStrength => "resistenza della catena",
            Self::TieStiffness => "rigidezza della catena",
            Self::BarDiameter => "diametro della barra",
        };
        Sentence::new(self.name(), italian)
    }
}

impl FoundCheck {
    /// Its name, and whether it only informs.
    pub(super) fn told(&self) -> Sentence {
        let informs = if self.decides {
            Sentence::default()
        } else {
            say!(" (for information)", " (a titolo informativo)")
        };
        let title = Sentence::new(self.check, self.title.of(Language::It));
        say!("{title}{informs}", "{title}{informs}", title, informs)
    }

    /// From which value on it passes, and by what.
    fn line(&self, sought: Sought) -> Sentence {
        let (check, unit) = (self.told(), sought.unit());
        let bound = |value: f64| {
            let value = at_most(value, 6);
            if sought.is_largest() {
                say!("up to {value} {unit}", "fino a {value} {unit}", value, unit)
            } else {
                say!("from {value} {unit}", "da {value} {unit}", value, unit)
            }
        };
        let passes = match self.value {
            Some(_) if self.everywhere => say!("every value", "ogni valore"),
            Some(value) => bound(value),
            None => {
                let reason = self.reason.as_ref().map(|why| say!("; {why}", "; {why}", why));
                let reason = reason.unwrap_or_default();
                return say!("  {check}: none{reason}", "  {check}: nessun valore{reason}", check, reason);
            }
        };
        let by = if self.rests_on_raise() {
            let itself = self.value_without_raise.map(bound);
            let itself = itself.unwrap_or_else(|| say!("none", "nessun valore"));
            say! {
                ", by the raise of SLD; by displacement {itself}",
                ", assumendo a_g,SLD; in spostamento {itself}", itself
            }
        } else if self.can_be_raised {
            say!(", by displacement", ", in spostamento")
        } else {
            Sentence::default()
        };
        say!("  {check}: {passes}{by}", "  {check}: {passes}{by}", check, passes, by)
    }
}

impl Found {
    /// What was found, in lines of a language.
    pub fn text(&self, language: Language) -> String {
        let mut lines = vec![self.headline()];
        let unit = self.sought.unit();
        for found in &self.checks {
            lines.push(found.line(self.sought));
            lines.extend(found.intervals.iter().map(|ends| {
                let [low, high] = ends.map(|end| at_most(end, 5));
                say! {
                    "    passes from {low} to {high} {unit}, too, and fails beyond",
                    "    soddisfatta anche da {low} a {high} {unit}, e non oltre", low, high, unit
                }
            }));
        }
        lines.extend(self.remarks.iter().map(|remark| say!("  {remark}", "  {remark}", remark)));
        lines.extend(self.force_ratio.map(|ratio| {
            let large = if ratio > LARGE {
                say! {
                    ": a large force for an anchor in masonry",
                    ": un tiro elevato per un ancoraggio nella muratura"
                }
            } else {
                Sentence::default()
            };
            say! {
                "  the tie has {ratio} of W + O{large}",
                "  la catena ha {ratio} di W + O{large}", ratio = at_most(ratio, 3), large
            }
        }));
        joined(&lines, "\n").of(language).to_owned() + "\n"
    }

    fn headline(&self) -> Sentence {
        let (name, unit) = (self.sought.title(), self.sought.unit());
        let [from, to] = self.range.map(|end| at_most(end, 5));
        let target = if self.target == 1.0 {
            Sentence::default()
        } else {
            let symbol = self.symbol.clone();
            say!(" ({symbol} ≥ {target})", " ({symbol} ≥ {target})", symbol, target = self.target)
        };
        let Some(value) = self.value else {
            return say! {
                "no {name} from {from} to {to} {unit} passes{target}",
                "{name}: nessun valore da {from} a {to} {unit} soddisfa la verifica{target}",
                name, from, to, unit, target
            };
        };
        if self.everywhere() {
            return say! {
                "every {name} from {from} to {to} {unit} passes{target}",
                "{name}: ogni valore da {from} a {to} {unit} soddisfa la verifica{target}",
                name, from, to, unit, target
            };
        }
        let extreme = if self.sought.is_largest() {
            say!("largest", "valore massimo")
        } else {
            say!("smallest", "valore minimo")
        };
        let six = |value: f64| Written(format!("{value:.6}"));
        let by = match self.value_without_raise {
            itself if itself == Some(value) => Sentence::default(),
            None => say! {
                ", by the raise of SLD; by displacement none",
                ", assumendo a_g,SLD; in spostamento nessun valore"
            },
            Some(itself) => say! {
                ", by the raise of SLD; by displacement {itself} {unit}",
                ", assumendo a_g,SLD; in spostamento {itself} {unit}", itself = six(itself), unit
            },
        };
        say! {
            "{extreme} {name} that passes{target}: {value} {unit}{by}",
            "{name}, {extreme} che soddisfa la verifica{target}: {value} {unit}{by}",
            extreme, name, target, value = six(value), unit, by
        }
    }
}
