//! Warnings about files of records, in both languages.

use ::report::number;
use ground_motion::{STANDARD_GRAVITY, Unit, Warning};
use run::records::{Reason, RecordWarning};

use super::{Language, Sentence};

/// A warning about the file of a record.
pub(crate) fn of_record(warning: &RecordWarning) -> Sentence {
    let said = match &warning.reason {
        Reason::Of(own) => in_italian(own),
        Reason::LeftOut => "componente verticale, esclusa; per usarla nominare il file".to_owned(),
    };
    Sentence::new(warning.to_string(), format!("{}: {said}", warning.path.display()))
}

fn in_italian(warning: &Warning) -> String {
    let shown = |value: f64| Language::It.decimal(&number(value, 4));
    match warning {
        Warning::NoMotion => "ogni campione vale 0".to_owned(),
        Warning::Step { step } => format!(
            "passo: {} s tra i campioni è insolito per un accelerogramma; i tempi sono in {}?",
            shown(*step),
            // a step that is warned of is far above this, or far below
            if *step > 0.01 {
                "millisecondi, o numeri di campione"
            } else {
                "minuti, ore, giorni o altra unità"
            }
        ),
        Warning::Baseline { last, peak } => format!(
            "linea di base: alla fine il suolo ha {} m/s, con un massimo di {} m/s; è da correggere",
            shown(*last),
            shown(*peak)
        ),
        Warning::Unit { peak, unit, others } => {
            let peak = shown(*peak);
            format!(
                "unità: un picco di {peak} g non è credibile; i campioni sono davvero in {unit}?{}",
                credible(others)
            )
        }
        Warning::Strength { peak } => format!(
            "moto: un picco di {} g non è credibile; controllare la scala, e l'unità di PGA o ampiezza",
            shown(peak / STANDARD_GRAVITY)
        ),
        Warning::MissingStart { part } => {
            format!("inizio: il primo campione ha il {:.0} % del picco; manca l'inizio?", 100.0 * part)
        }
        Warning::MissingTail { part } => {
            format!("fine: l'ultimo secondo ha il {:.0} % del picco; manca la fine?", 100.0 * part)
        }
        Warning::StatedPeak { peak, stated } => {
            format!("picco: i campioni hanno {} m/s², il file dichiara {} m/s²", shown(*peak), shown(*stated))
        }
        Warning::Vertical => {
            "componente verticale: la parete è scossa in orizzontale; usarne una orizzontale".to_owned()
        }
        Warning::Surplus { found, stated } => {
            format!("campioni: il file ne dichiara {stated} e ne ha {found}; si usano i primi {stated}")
        }
        Warning::Unclosed => "fine: manca la riga che chiude il canale; i campioni ci sono tutti".to_owned(),
        Warning::Gap { line, found, usual, more } => format!(
            "campioni: la riga {line} ha {found} numeri, le altre {usual}, e altre {more} differiscono; \
             se ne manca uno, i successivi sono in anticipo{}",
            if *found == 0 {
                ", e dopo una riga vuota o di commento può iniziare un altro record"
            } else {
                ""
            }
        ),
        Warning::FirstNumber { first } => format!(
            "campioni: il primo, {}, è il numero dei successivi o il loro passo; se non è un campione, \
             iniziare la riga con #",
            shown(*first)
        ),
        Warning::Spike { place, peak, others } => format!(
            "picco isolato: il campione {place} ha {} g, gli altri al più {} g; correggerlo se sta per un \
             valore mancante, come -999",
            shown(peak / STANDARD_GRAVITY),
            shown(others / STANDARD_GRAVITY)
        ),
        Warning::StatedStep { step, stated } => format!(
            "passo: il file ha {} s tra i campioni; valgono i {} s dichiarati",
            shown(*step),
            shown(*stated)
        ),
    }
}

/// The units that would give a credible peak.
fn credible(units: &[Unit]) -> String {
    let units: Vec<_> = units.iter().map(|unit| unit.name()).collect();
    if units.is_empty() { String::new() } else { format!(" Sarebbe credibile con {}", units.join(" o ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Words of the English warnings that no Italian one has.
    const ENGLISH: &str = "the of is are with and at from its not all others other samples sample peak step \
                           unit tail start vertical baseline every ground records missing numbers \
                           line be would";

    #[test]
    fn each_warning_is_italian_and_says_what_the_english_one_says() {
        let others = vec![Unit::MetrePerSecondSquared, Unit::CentimetrePerSecondSquared];
        for (warning, said) in [
            (Warning::NoMotion, "ogni campione vale 0"),
            (Warning::Step { step: 20.0 }, "20 s tra i campioni è insolito"),
            (Warning::Step { step: 0.2 }, "in millisecondi, o numeri di campione?"),
            (Warning::Step { step: 1e-5 }, "in minuti, ore, giorni o altra unità?"),
            (Warning::Baseline { last: 0.1, peak: 0.5 }, "0,1 m/s, con un massimo di 0,5 m/s"),
            (Warning::Unit { peak: 9.0, unit: Unit::StandardGravity, others }, "con m/s2 o cm/s2"),
            (
                Warning::Strength { peak: 98.0665 },
                "10 g non è credibile; controllare la scala, e l'unità di PGA",
            ),
            (Warning::MissingStart { part: 0.5 }, "50 %"),
            (Warning::MissingTail { part: 0.5 }, "50 %"),
            (Warning::StatedPeak { peak: 1.5, stated: 2.5 }, "1,5 m/s², il file dichiara 2,5 m/s²"),
            (Warning::Vertical, "in orizzontale"),
            (Warning::Surplus { found: 9, stated: 8 }, "ne dichiara 8 e ne ha 9"),
            (Warning::Unclosed, "manca la riga"),
            (Warning::Gap { line: 3, found: 0, usual: 8, more: 1 }, "può iniziare un altro record"),
            (Warning::FirstNumber { first: 100.0 }, "il primo, 100,"),
            (Warning::Spike { place: 7, peak: 98.0665, others: 0.0 }, "come -999"),
            (Warning::StatedStep { step: 0.01, stated: 0.02 }, "valgono i 0,02 s dichiarati"),
        ] {
            let italian = in_italian(&warning);
            assert!(italian.contains(said), "{italian}");
            let of_english = |word: &str| ENGLISH.split_whitespace().any(|own| own == word);
            let left = italian.split(|c: char| !c.is_alphabetic()).find(|word| of_english(word));
            assert!(left.is_none(), "{left:?} of {italian}");
        }
    }
}
