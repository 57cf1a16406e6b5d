//! What NTC 10.2 asks of a calculation by a program: which it is, and why its results are acceptable.

use crate::sections::origin::Origin;
use crate::words::markup::{paragraph, table};
use crate::words::say;

/// Title, author, version, licence and validation of the program, and the box of the judgement.
pub(super) fn section(origin: &Origin<'_>) -> String {
    let language = origin.report.language;
    let [authors, license, source] =
        [env!("CARGO_PKG_AUTHORS"), env!("CARGO_PKG_LICENSE"), env!("CARGO_PKG_REPOSITORY")];
    let validation = say! {
        "The formulas of the code beside independent programs and hand calculations: docs/verification.md; \
         motion beside published tests: docs/validation.md. Both are part of the program.",
        "Formule della norma a confronto con programmi indipendenti e calcoli manuali: docs/verification.md; \
         moto a confronto con prove pubblicate: docs/validation.md. Entrambi fanno parte del programma."
    };
    let rows = [
        (say!("title", "titolo"), "rocking-wall".to_owned()),
        (say!("version", "versione"), origin.program.to_owned()),
        (say!("author", "autore"), authors.to_owned()),
        (say!("licence", "licenza"), license.to_owned()),
        (say!("source", "codice sorgente"), source.trim_start_matches("https://").to_owned()),
    ];
    let rows = rows.map(|(name, text)| {
        [name.markup(language), format!("<span translate=\"no\">{}</span>", ::report::escaped(&text))]
    });
    let validated = [[say!("validation", "validazione").markup(language), validation.markup(language)]];
    let judgement = say! {
        "Judgement of the designer on the acceptability of the results (NTC 10.2)",
        "Giudizio motivato di accettabilità dei risultati (NTC 10.2)"
    };
    let how = say! {
        "Every number of this report stands with its formula and the numbers put in, so that it can be \
         checked by hand.",
        "Ogni numero di questa relazione è riportato con la formula e i valori sostituiti, per il controllo \
         manuale."
    };
    let rows = [rows.as_slice(), validated.as_slice()].concat();
    let boxed = format!("<div class=\"box\"><p>{}</p></div>", judgement.markup(language));
    format!("<div class=\"together\">{}{}{boxed}</div>", table(&[], &rows), paragraph(&how, language))
}
