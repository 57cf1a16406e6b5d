//! Symbols and formulas as markup.

use ::report::escaped;

/// Symbols with an index that sentences and tables have. Names of keys, files and walls may look alike.
const SYMBOLS: [&str; 43] = [
    "a_0", "a_1", "a_max", "a_g", "a_g,SLD", "a_g,cap", "a_s", "a_y", "a_Z", "C_U", "d_0", "d_1", "d_s",
    "d_SLC", "d_SLV", "d_u", "d_y", "f_d", "f_m", "N_y", "S_a", "S_d", "S_e", "S_eZ", "S_S", "S_T", "T_1",
    "T_B", "T_C", "T_D", "T_R", "T_s", "T_SLC", "T_SLV", "u_0", "u_ins", "u_r", "u_y", "k_0", "V_N", "V_R",
    "z_G", "ξ_k",
];

/// A text as markup: what stands between grave accents, and symbols with an index, are formulas.
pub(crate) fn markup(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts.map(|(index, part)| if index % 2 == 1 { formula(part) } else { with_symbols(part) }).collect()
}

/// A text as markup with its symbols as formulas: `a_g`, `zeta_E`, `alpha0`.
fn with_symbols(text: &str) -> String {
    let belongs = |letter: char| letter.is_alphanumeric() || matches!(letter, '_' | ',' | '.');
    let (mut markup, mut rest) = (String::new(), text);
    while let Some(from) = rest.find(|letter: char| letter.is_alphanumeric() || letter == '_') {
        markup += &escaped(&rest[..from]);
        rest = &rest[from..];
        // the point of a file's name belongs to it
        let word = leading(rest, belongs).trim_end_matches([',', '.']);
        rest = &rest[word.len()..];
        match word {
            "zeta_E" | "ζ_E" => markup += &formula("ζ_E"),
            "alpha0" | "α0" => markup += &formula("α0"),
            "F0" => markup += &formula("F0"),
            _ if SYMBOLS.contains(&word) => markup += &formula(word),
            _ => markup += &escaped(word),
        }
    }
    markup + &escaped(rest)
}

/// A formula as markup: single letters are italic, what follows `_`, and digits behind a letter, are indices;
/// the number behind `^` is a power.
pub(crate) fn formula(text: &str) -> String {
    let (mut markup, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        if !first.is_alphabetic() {
            markup.push_str(&escaped(&first.to_string()));
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let word = leading(rest, char::is_alphabetic);
        rest = &rest[word.len()..];
        let is_symbol = word.chars().count() == 1 && word != "π";
        let [open, close] = if is_symbol { ["<i>", "</i>"] } else { ["", ""] };
        markup.extend([open, word, close]);
        // e*_w
        if rest.starts_with("*_") {
            markup.push('*');
            rest = &rest[1..];
        }
        let index = match rest.strip_prefix('_') {
            Some(after) => {
                rest = after;
                leading(rest, |letter| letter.is_alphabetic() || letter.is_ascii_digit() || letter == ',')
            }
            None if is_symbol => leading(rest, |letter| letter.is_ascii_digit()),
            None => "",
        };
        // a comma at the end separates
        let index = index.trim_end_matches(',');
        if !index.is_empty() {
            markup.extend(["<sub>", index, "</sub>"]);
            rest = &rest[index.len()..];
        }
    }
    raised(&markup)
}

/// Raises the powers of a formula as markup: the number behind `^`.
pub(crate) fn raised(markup: &str) -> String {
    let mut parts = markup.split('^');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let power = leading(part, |letter| letter.is_ascii_digit() || matches!(letter, '.' | ',' | '−'));
        text.extend(["<sup>", power, "</sup>", &part[power.len()..]]);
    }
    text
}

pub(crate) fn leading(text: &str, belongs: impl Fn(char) -> bool) -> &str {
    &text[..text.find(|letter| !belongs(letter)).unwrap_or(text.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_of_sentences_are_formulas() {
        let written = "<i>ζ</i><sub>E</sub> of <i>a</i><sub>g,SLD</sub>, and <i>T</i><sub>C</sub>* of \
                       <i>α</i><sub>0</sub> by tie_strength &gt; 1.";
        assert_eq!(markup("zeta_E of a_g,SLD, and T_C* of alpha0 by tie_strength > 1."), written);
        assert_eq!(markup("u_start of a_g.csv, `T0`."), "u_start of a_g.csv, <i>T</i><sub>0</sub>.");
        assert_eq!(formula("κ_1 T^−0.5"), "<i>κ</i><sub>1</sub> <i>T</i><sup>−0.5</sup>");
    }
}
