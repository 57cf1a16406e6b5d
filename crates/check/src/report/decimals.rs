//! Decimal commas, which Italian has.

/// Returns a text with decimal commas, and semicolons between the numbers of a list. Clauses and
/// dates stay: they have more than one point, or follow NTC or a letter, as NTC 8.3, C8.7, 17.1.2018.
/// Values of keys have commas as all numbers of a sentence have.
pub(super) fn with_commas(text: &str) -> String {
    let belongs = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut written = String::with_capacity(text.len());
    // whether the word before is a number, and that has decimals
    let (mut before, mut rest) = (None, text);
    while let Some(from) = rest.find(belongs) {
        let (between, word) = rest.split_at(from);
        let word = &word[..word.find(|letter| !belongs(letter) && letter != '.').unwrap_or(word.len())];
        let word = word.trim_end_matches('.');
        let is_clause = between.starts_with(' ') && written.ends_with("NTC") || word.matches('.').count() > 1;
        let after_whole = word.trim_start_matches(|letter: char| letter.is_ascii_digit());
        let decimals = after_whole
            .strip_prefix('.')
            .filter(|decimals| decimals.starts_with(|c: char| c.is_ascii_digit()));
        // a point that no digit follows is that of a file, such as 1.csv
        let is_number =
            after_whole.len() < word.len() && (decimals.is_some() || !word.contains('.')) && !is_clause;
        let own = is_number.then_some(decimals.is_some());
        let is_list = before.is_some() && own.is_some() && before.max(own) == Some(true);
        let is_comma = between.trim_end_matches(['-', '−']) == ", ";
        written += &if is_list && is_comma { between.replacen(',', ";", 1) } else { between.to_owned() };
        written += &if is_number { word.replacen('.', ",", 1) } else { word.to_owned() };
        (before, rest) = (own, &rest[from + word.len()..]);
    }
    written + rest
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
            ("wall 0.1.0 of 1.5e6 Pa, a1.csv, 1.csv", "wall 0.1.0 of 1,5e6 Pa, a1.csv, 1.csv"),
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
