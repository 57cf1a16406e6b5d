//! Warnings about files of records, in both languages.

use ::report::number;
use ground_motion::{STANDARD_GRAVITY, Warning};
use run::records::RecordWarning;

use super::{Language, Sentence};

/// A warning about the file of a record.
pub(crate) fn of_record(warning: &RecordWarning) -> Sentence {
    let said = match &warning.of {
        Some(own) => in_italian(own),
        None => "componente verticale, esclusa; per usarla nominare il file".to_owned(),
    };
    Sentence::new(warning.to_string(), format!("{}: {said}", warning.path.display()))
}

fn in_italian(warning: &Warning) -> String {
    let shown = |value: f64| Language::It.decimal(&number(value, 4));
    match warning {
        Warning::NoMotion => "ogni campione vale 0".to_owned(),
        Warning::Step { step } => format!(
            "passo: {} s tra i campioni è insolito per un accelerogramma; i tempi sono in secondi?",
            shown(*step)
        ),
        Warning::Baseline { last, peak } => format!(
            "linea di base: alla fine il suolo ha {} m/s, con un massimo di {} m/s; è da correggere",
            shown(*last),
            shown(*peak)
        ),
        Warning::Unit { peak, unit, .. } => {
            format!("unità: un picco di {} g non è credibile; i campioni sono in {unit}?", shown(*peak))
        }
        Warning::Strength { peak } => format!(
            "moto: un picco di {} g non è credibile; controllare la scala e l'unità",
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
             se ne manca uno, i successivi sono in anticipo"
        ),
        Warning::FirstNumber { first } => format!(
            "campioni: il primo, {}, è il numero dei successivi o il loro passo; se non è un campione, \
             iniziare la riga con #",
            shown(*first)
        ),
        Warning::Spike { place, peak, others } => format!(
            "picco isolato: il campione {place} ha {} g, gli altri al più {} g; correggerlo se sta per un \
             valore mancante",
            shown(peak / STANDARD_GRAVITY),
            shown(others / STANDARD_GRAVITY)
        ),
        Warning::StatedStep { step, stated } => {
            format!(
                "passo: il file ha {} s tra i campioni; valgono i {} s dichiarati",
                shown(*step),
                shown(*stated)
            )
        }
        // one that is not known here
        other => other.to_string(),
    }
}
