//! Which characters the terminal shows, by what the locale is called.

use std::env;

/// Whether the locale of this process has no Unicode.
#[must_use]
pub fn is_without_unicode() -> bool {
    let names = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().filter_map(env::var_os);
    let name = names.map(|name| name.to_string_lossy().into_owned()).find(|name| !name.is_empty());
    // Without a named locale the terminal may be of any kind; most have Unicode.
    name.is_some_and(|name| names_no_unicode(&name))
}

/// `C` and `POSIX` are ASCII; others tell the encoding behind a dot, or not at all.
fn names_no_unicode(locale: &str) -> bool {
    let (name, codeset) = locale.split_once('.').unwrap_or((locale, ""));
    let codeset = codeset.split('@').next().unwrap_or_default();
    match codeset {
        "" => ["C", "POSIX"].contains(&name),
        _ => !["utf8", "utf-8"].contains(&&*codeset.to_ascii_lowercase()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_locale_says_what_it_has() {
        for without in ["C", "POSIX", "de_DE.ISO-8859-1", "ru_RU.KOI8-R", "en_GB.iso885915@euro"] {
            assert!(names_no_unicode(without), "{without}");
        }
        for with in ["C.UTF-8", "C.utf8", "en_US.UTF-8", "de_DE", "en_IE.utf8@euro"] {
            assert!(!names_no_unicode(with), "{with}");
        }
    }
}
