//! The identities of texts in Unreal: a namespace and a key, joined by a comma (`PortableObjectPipeline` of Unreal 5).

/// Returns the context of a text in a PO file. A backslash marks commas inside the two parts.
pub(crate) fn unreal_identity(namespace: &str, key: &str) -> String {
    format!("{},{}", namespace.replace(',', "\\,"), key.replace(',', "\\,"))
}

/// Returns the key of a context with a namespace; `None` without one.
pub(crate) fn unreal_key(context: &str) -> Option<String> {
    let mut is_escaped = false;
    for (at, character) in context.char_indices() {
        match character {
            _ if is_escaped => is_escaped = false,
            ',' => return context.get(at + 1..).map(|key| key.replace("\\,", ",")),
            '\\' => is_escaped = true,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_key_comes_back(namespace in "[a-z,]{0,4}", key in "[a-z/,|]{0,8}") {
            let context = unreal_identity(&namespace, &key);
            prop_assert_eq!(unreal_key(&context), Some(key));
        }
    }
}
