//! Pages from templates with gaps `{{name}}`.

/// What all pages begin with: their head, and the style they share.
const HEAD: &str = include_str!("page.html");
/// How all pages print. It stands last, so that it overrides the styles of single pages.
const PAPER: &str = include_str!("paper.css");

/// Makes a page of its own from a template of its body, which may begin with a style. One of the parts is the
/// title.
///
/// # Panics
/// If a gap has no content, or content no gap.
pub fn page(template: &str, parts: &[(&str, &str)]) -> String {
    filled(&[HEAD, template, "<style>\n", PAPER, "</style>\n</html>\n"].concat(), parts)
}

/// Fills each gap of a template with the content of its name. One pass fills all gaps, so that braces inside
/// the contents stay as they are.
///
/// # Panics
/// If a gap has no content, or content no gap.
fn filled(template: &str, parts: &[(&str, &str)]) -> String {
    let mut page =
        String::with_capacity(template.len() + parts.iter().map(|part| part.1.len()).sum::<usize>());
    let mut used = vec![false; parts.len()];
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let gap = after.split_once("}}");
        let place = gap.and_then(|(name, _)| parts.iter().position(|part| part.0 == name));
        let (Some((_, after)), Some(place)) = (gap, place) else {
            panic!("a gap without content at {:?}", after.chars().take(20).collect::<String>())
        };
        page.push_str(before);
        page.push_str(parts[place].1);
        used[place] = true;
        rest = after;
    }
    assert!(used.iter().all(|&used| used), "content without a gap: {used:?}");
    page + rest
}

#[cfg(test)]
mod tests {
    use super::filled;

    #[test]
    fn what_fills_a_gap_is_not_filled_again() {
        let page =
            filled("<b>{{title}}</b>{{body}}{{title}}", &[("body", "{{title}}"), ("title", "{{body}} {{")]);
        assert_eq!(page, "<b>{{body}} {{</b>{{title}}{{body}} {{");
    }

    #[test]
    #[should_panic(expected = "without content")]
    fn a_gap_without_content_is_a_mistake() {
        filled("{{titel}}", &[("title", "")]);
    }

    #[test]
    #[should_panic(expected = "without a gap")]
    fn content_without_a_gap_is_a_mistake() {
        filled("{{title}}", &[("title", ""), ("body", "")]);
    }
}
