//! Where the code can be read in two ways: the reading that this check takes.

use crate::circolare::outcome::Checked;
use crate::circolare::statement::states::Source;
use crate::ntc::demand::Demand;
use crate::words::{Sentence, say};

fn any_demand(case: &Checked<'_>, holds: fn(&Demand) -> bool) -> bool {
    case.demands.iter().flatten().any(holds)
}

fn is_at_height(case: &Checked<'_>) -> bool {
    any_demand(case, |demand| demand.floor().is_some())
}

/// Returns whether there is a check of accelerations of a side whose T0 fulfils a condition.
fn is_activated(case: &Checked<'_>, such: fn(f64) -> bool) -> bool {
    let sides = case.outcome.sides.iter();
    sides
        .map(|(_, side)| side)
        .any(|side| (side.checks.sld.is_some() || side.checks.slv_q.is_some()) && such(side.curve.t0))
}

fn is_by_code(case: &Checked<'_>) -> bool {
    case.statement.states.iter().flatten().any(|given| matches!(given.source, Source::Code(_)))
}

/// The readings that bear on this check, with their formulas between grave accents.
#[allow(clippy::too_many_lines, reason = "texts in two languages, one below the other")]
pub(in crate::circolare) fn of(case: &Checked<'_>) -> Vec<Sentence> {
    let at_height = is_at_height(case);
    let raises = case.statement.table.raise_slc
        && case.outcome.sides.iter().any(|(_, side)| side.checks.sld.is_some() && side.checks.slc.is_some());
    let has_modes =
        any_demand(case, |demand| matches!(demand, Demand::Floor(floor) if floor.modes().len() > 1));
    let is_given = any_demand(case, |demand| matches!(demand, Demand::Points(..) | Demand::Records(_)));
    let all = [
        (
            true,
            say! {
                "Lumping: the definitions of C8.7.1.1 speak of one resultant of the forces on each body, and \
                 the check takes one. Distributed mass would give larger capacities.",
                "Risultante: le definizioni di C8.7.1.1 parlano di una risultante delle forze su ogni corpo, \
                 e la verifica ne assume una. La massa distribuita darebbe capacità maggiori."
            },
        ),
        (
            at_height,
            say! {
                "Units of ξ_k: [C7.2.6] and [C7.2.9] are printed with per cent. Taken as a fraction in \
                 `ξ_k^−0.5` and as per cent elsewhere; otherwise the spectrum dips at resonance.",
                "Unità di ξ_k: [C7.2.6] e [C7.2.9] sono scritte in percento. Assunta come frazione in \
                 `ξ_k^−0,5` e in percento altrove; altrimenti lo spettro ha un minimo alla risonanza."
            },
        ),
        (
            true,
            say! {
                "FC: [C8.7.1.3] has it in `a`, so that it lengthens T_SLV and T_SLC. d_0, d_SLV, d_SLC and \
                 `T0` are free of it.",
                "FC: la [C8.7.1.3] lo contiene in `a`, così che allunga T_SLV e T_SLC. d_0, d_SLV, d_SLC e \
                 `T0` ne sono esenti."
            },
        ),
        (
            is_activated(case, |t0| t0 > 0.0),
            say! {
                "[C8.7.1.9] divides a_y by FC, which `a(d)` already has. a_y is read on the curve without FC \
                 and divided once.",
                "La [C8.7.1.9] divide a_y per FC, che `a(d)` contiene già. a_y è letta sulla curva senza FC \
                 e divisa una volta."
            },
        ),
        (
            is_activated(case, |t0| t0 == 0.0) && at_height,
            say! {
                "Demand of the wall that is held: C8.7.1.2.1.5 points to [C7.2.11], C8.7.1.2.1.7 to \
                 [C7.2.8]. [C7.2.11] is for frames. Taken: [C7.2.8].",
                "Domanda della parete vincolata: C8.7.1.2.1.5 rimanda alla [C7.2.11], C8.7.1.2.1.7 alla \
                 [C7.2.8]. La [C7.2.11] è per i telai. Assunta: [C7.2.8]."
            },
        ),
        (
            is_by_code(case),
            say! {
                "Scaling: S_S and T_D depend on a_g; `F0` and `T_C*` on the return period. Taken: the shape \
                 at the a_g of the site, so that ζ_E is a ratio. SLV with `q` takes the shape of SLV, the \
                 floor of SLD that of SLD.",
                "Scala: S_S e T_D dipendono da a_g; `F0` e `T_C*` dal periodo di ritorno. Assunta: la forma \
                 alla a_g del sito, così che ζ_E è un rapporto. SLV con `q` assume la forma dello SLV, il \
                 limite inferiore dato dallo SLD quella dello SLD."
            },
        ),
        (
            raises,
            say! {
                "The rule that the acceleration of activation at SLD is the least one is printed for SLV. It \
                 is taken for SLC, too.",
                "La regola che l'accelerazione di attivazione allo SLD è la minima è scritta per lo SLV. È \
                 assunta anche per lo SLC."
            },
        ),
        (
            !case.wall.ties().is_empty(),
            say! {
                "A tie: actions that last until collapse are asked for d_0 only. `a(d)` is the curve as it \
                 is at d_SLV; at the rupture of the tie it is the value just before.",
                "Catena: azioni presenti fino al collasso sono richieste solo per d_0. `a(d)` è la curva \
                 com'è a d_SLV; alla rottura della catena vale il valore appena prima."
            },
        ),
        (
            has_modes,
            say! {
                "T_1 in the conditions of [C7.2.5] and [C8.7.1.12]: with several modes it is that of the \
                 first.",
                "T_1 nelle condizioni di [C7.2.5] e [C8.7.1.12]: con più modi è quello del primo."
            },
        ),
        (
            at_height,
            say! {
                "Height `z`: not defined for walls; taken as given. The base of a parapet and the mid-height \
                 of a strip wall are recommended.",
                "Quota `z`: non definita per le pareti; assunta come fornita. Si raccomandano la base di un \
                 parapetto e la mezza altezza di una parete tra due piani."
            },
        ),
        (
            is_given,
            say! {
                "Spectra that are given, or of records: the largest S_d from `T0` to T_SLV (SLC likewise), \
                 of the mean spectrum of 7 and more records, of the envelope of fewer.",
                "Spettri forniti, o di accelerogrammi: il massimo S_d da `T0` a T_SLV (lo stesso per SLC), \
                 dello spettro medio con 7 o più accelerogrammi, dell'inviluppo con meno."
            },
        ),
        (
            case.outcome.dynamic.is_some(),
            say! {
                "Runs under records: the skeleton is the capacity curve, which contains FC. Gravity, \
                 overburden, stiffness and strength of a tie are divided by FC; masses and thresholds are \
                 not.",
                "Analisi con accelerogrammi: la curva scheletro è quella di capacità, che contiene FC. Peso, \
                 carico in sommità, rigidezza e resistenza della catena sono divisi per FC; masse e soglie \
                 non lo sono."
            },
        ),
        (
            true,
            say! {
                "Scope: `α` is linear in the displacement (small rotations). Friction of transverse walls \
                 [C8.7.1.2] and sliding are not included; the height of the wall is the engineer's.",
                "Limiti: `α` è lineare nello spostamento (piccole rotazioni). L'attrito delle pareti \
                 trasversali [C8.7.1.2] e lo scorrimento non sono considerati; l'altezza della parete è del \
                 progettista."
            },
        ),
    ];
    all.into_iter().filter_map(|(bears, said)| bears.then_some(said)).collect()
}
