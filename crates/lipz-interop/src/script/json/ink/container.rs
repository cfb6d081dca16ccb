//! Containers of a compiled story, and the paths between them.

use crate::json::Node;
use std::rc::Rc;

/// The containers around an object, from the root of the story inwards.
pub(super) type ContainerStack<'s> = Vec<Rc<Container<'s>>>;

/// A container: an array whose last item is `null`, or an object with further content.
#[derive(Debug)]
pub(super) struct Container<'s> {
    /// The position of the array.
    at: usize,
    /// The content that runs in order.
    pub(super) items: Vec<Node<'s>>,
    /// The content that runs only if a divert leads to it.
    pub(super) named: Vec<(String, Node<'s>)>,
    name: Option<String>,
}

impl<'s> Container<'s> {
    /// Returns the container of an array.
    pub(super) fn read(node: Node<'s>) -> Option<Rc<Container<'s>>> {
        let mut items = node.items()?;
        let last = items.pop_if(|last| last.is_object() || last.line.text == "null");
        let mut members = last.map(Node::members).unwrap_or_default();
        let name = members.iter().find(|(name, _)| name == "#n").and_then(|(_, name)| name.string());
        members.retain(|(name, _)| !name.starts_with('#'));
        Some(Rc::new(Container { at: node.line.at, items, named: members, name }))
    }

    /// Whether the content `s` is the part of a choice that its label and its line share.
    pub(super) fn has_shared_text(&self) -> bool {
        let is_label = |pair: &[Node<'s>]| {
            let [string, divert] = pair else { return false };
            string.string().as_deref() == Some("str")
                && divert.get(&["->"]).and_then(Node::string).as_deref() == Some(".^.s")
        };
        self.items.windows(2).any(is_label)
    }

    /// Returns the object at a step of a path: the index of an item, or a name.
    fn child(&self, step: &str) -> Option<Node<'s>> {
        if let Ok(index) = step.parse::<usize>() {
            return self.items.get(index).copied();
        }
        let named = self.named.iter().find(|(name, _)| name == step).map(|(_, node)| *node);
        let is_of_name = |node: &Node<'s>| Container::read(*node).is_some_and(|of| of.name.as_deref() == Some(step));
        named.or_else(|| self.items.iter().copied().filter(|item| item.is_array()).find(is_of_name))
    }
}

/// Returns the object at a path, and the containers around it. A path that starts with a full stop is relative to the
/// object with the path, whose containers are `stack`.
pub(super) fn resolve<'s>(stack: &ContainerStack<'s>, path: &str) -> Option<(ContainerStack<'s>, Node<'s>)> {
    let (mut around, path) = match path.strip_prefix(".^.") {
        Some(relative) => (stack.clone(), relative),
        None => (stack.get(..1)?.to_vec(), path),
    };
    let mut steps = path.split('.').peekable();
    while steps.next_if_eq(&"^").is_some() {
        around.pop()?;
    }
    let mut target = around.last()?.child(steps.next()?)?;
    for step in steps {
        // Containers around the path are already read.
        let container = match stack.get(around.len()).filter(|container| container.at == target.line.at) {
            Some(known) => Rc::clone(known),
            None => Container::read(target)?,
        };
        target = container.child(step)?;
        around.push(container);
    }
    Some((around, target))
}
