//! The common parts of all HTML pages.

const STYLE: &str = include_str!("page.css");

/// Returns an HTML file without scripts, in light and dark colours: a title, and below it `body`, which is HTML.
pub fn html_page(title: &str, body: &str) -> String {
    let title = html(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n\
         <h1>{title}</h1>\n{body}</html>\n"
    )
}

/// Escapes a text for HTML.
pub fn html(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in lipz_diagnostics::escape::text(text).chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            character => out.push(character),
        }
    }
    out
}
