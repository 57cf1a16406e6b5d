//! Decimal commas, which Italian has.

/// Returns a text with decimal commas, and semicolons between the numbers of a list. Clauses and
/// dates stay: they have more than one point, or follow NTC or a letter, as NTC 8.3, C8.7, 17.1.2018.
/// Values of keys have commas as all numbers of a sentence have.
pub(super) fn with_commas(text: &str) -> String {
    let mut written = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_in_word = written.ends_with(|c: char| c.is_alphanumeric() || c == '.' || c == '_');
        let word = if first.is_ascii_digit() && !is_in_word {
            let number = number(rest);
            let is_clause = written.ends_with("NTC ") || followed(&rest[number.len()..]);
            if is_clause || !number.contains('.') {
                written += number;
            } else {
                written += &number.replacen('.', ",", 1);
            }
            number
        } else if rest.starts_with(", ") && separates(&written, &rest[2..]) {
            written += "; ";
            ", "
        } else {
            written.push(first);
            &rest[..first.len_utf8()]
        };
        rest = &rest[word.len()..];
    }
    written
}

/// The digits with which a text begins, with one point between digits.
fn number(text: &str) -> &str {
    let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let whole = digits(text);
    let decimals = text[whole..].strip_prefix('.').map_or(0, digits);
    if decimals == 0 { &text[..whole] } else { &text[..whole + 1 + decimals] }
}

/// Whether a number is only the beginning of a clause or of a date.
fn followed(rest: &str) -> bool {
    rest.strip_prefix('.').is_some_and(|rest| rest.starts_with(char::is_alphanumeric))
}

/// Whether a comma stands between two numbers, one of them with decimals.
fn separates(before: &str, after: &str) -> bool {
    let after = after.trim_start_matches(['-', '−']);
    let next = number(after);
    let last = before.trim_end_matches(|c: char| c.is_ascii_digit());
    let is_decimal =
        last.strip_suffix(',').is_some_and(|whole| whole.ends_with(|c: char| c.is_ascii_digit()));
    let is_in_word = last.ends_with(|c: char| c.is_alphabetic() || c == '_');
    let is_number =
        last.len() < before.len() && !is_in_word && !next.is_empty() && !followed(&after[next.len()..]);
    is_number && (is_decimal || next.contains('.'))
}

#[cfg(test)]
mod tests {
    use super::with_commas;

    #[test]
    fn points_of_numbers_are_commas_and_those_of_clauses_stay() {
        for (text, written) in [
            ("ζ = <b>0.4886</b>, FC = 1.35 (C8.5.4).", "ζ = <b>0,4886</b>, FC = 1,35 (C8.5.4)."),
            ("NTC 8.3, 7.3.6; [C7.2.10], Tab. 3.2.IV", "NTC 8.3, 7.3.6; [C7.2.10], Tab. 3.2.IV"),
            ("D.M. 17.1.2018, 21.1.2019 n. 7", "D.M. 17.1.2018, 21.1.2019 n. 7"),
            ("wall 0.1.0 of 1.5e6 Pa, a1.csv", "wall 0.1.0 of 1,5e6 Pa, a1.csv"),
            ("hinge_range = [0.1, 0.9], a 0.9.", "hinge_range = [0,1; 0,9], a 0,9."),
            ("con tie_slack = 0.01. Per a1 = 0.05", "con tie_slack = 0,01. Per a1 = 0,05"),
            ("SLC.displacement = 0.3 m, u_0 = 0.25 m", "SLC.displacement = 0,3 m, u_0 = 0,25 m"),
            ("zeta_E = 0.5, a_g = 0.25, height = 7.5", "zeta_E = 0,5, a_g = 0,25, height = 7,5"),
            ("rocking_side = positive, [0.1, 0.2]", "rocking_side = positive, [0,1; 0,2]"),
            ("α0, 2.191, and F_0, 0.5", "α0, 2,191, and F_0, 0,5"),
            ("(0, 0.2), (4, -0.01)", "(0; 0,2), (4; -0,01)"),
            ("0.32 s. 24.61 kN, 3 piani", "0,32 s. 24,61 kN, 3 piani"),
            ("42.048°, 13.926°", "42,048°, 13,926°"),
        ] {
            assert_eq!(with_commas(text), written);
        }
    }
}
