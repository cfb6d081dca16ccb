//! The content of one container of a story, in the order in which it runs.

use super::container::{ContainerStack, resolve};
use super::line::InkLines;
use super::{StoryFlow, StoryReader};
use crate::json::Node;

/// An open part of an expression.
#[derive(PartialEq)]
enum Expression {
    Values,
    String,
}

/// A divert, and the options that matter here.
struct Divert {
    path: String,
    is_conditional: bool,
    is_variable: bool,
}

/// The target of a divert.
enum Destination<'s> {
    /// Named content of the container with the divert: an alternative of a condition or sequence.
    Alternative(String, Node<'s>),
    /// The text that the label of a choice and its line share.
    SharedText(ContainerStack<'s>, Node<'s>),
    /// The `nop` after the alternatives.
    EndOfAlternative,
    Elsewhere,
}

/// A container that is being read.
pub(super) struct ContentReader<'r, 's> {
    pub(super) story: &'r mut StoryReader,
    /// With this container.
    pub(super) stack: &'r ContainerStack<'s>,
    pub(super) depth: usize,
    pub(super) flow: StoryFlow,
    /// The names of the content that diverts here led to.
    pub(super) run: Vec<String>,
}

impl<'s> ContentReader<'_, 's> {
    /// Reads items. If the last one is a container, returns it instead.
    pub(super) fn items(&mut self, items: &[Node<'s>]) -> Option<Node<'s>> {
        let mut expressions = Vec::new();
        let mut is_thread = false;
        for (index, item) in items.iter().enumerate() {
            let token = item.string();
            if let Some(token) = &token {
                self.token(token, *item, &mut expressions);
            } else if !expressions.is_empty() {
                continue;
            } else if item.is_array() {
                if self.flow.lines.is_empty() {
                    self.flow.lines = InkLines::start();
                }
                if index + 1 == items.len() {
                    return Some(*item);
                }
                self.nested(*item);
            } else if item.is_object() && !is_thread {
                self.object(*item);
            }
            is_thread = token.as_deref() == Some("thread");
        }
        None
    }

    fn token(&mut self, token: &str, item: Node<'_>, expressions: &mut Vec<Expression>) {
        let (lines, out) = (&mut self.flow.lines, &mut self.story.out);
        match token {
            "ev" => expressions.push(Expression::Values),
            "str" => expressions.push(Expression::String),
            "/ev" => drop(expressions.pop_if(|open| *open == Expression::Values)),
            "/str" => drop(expressions.pop_if(|open| *open == Expression::String)),
            "out" if *expressions == [Expression::Values] => lines.vary(out),
            _ if !expressions.is_empty() => {}
            "#" => lines.open_tag(out),
            "/#" => lines.close_tag(),
            "\n" => lines.end(),
            "<>" => lines.glue(),
            "nop" => {
                lines.join(std::mem::take(&mut self.flow.waiting), out);
                if lines.is_empty() {
                    *lines = InkLines::start();
                }
            }
            "end" | "done" | "->->" | "~ret" => lines.finish(out),
            token => {
                if let Some(text) = token.strip_prefix('^') {
                    lines.text(text, item, out);
                }
            }
        }
    }

    /// Reads a container among the items.
    fn nested(&mut self, node: Node<'s>) {
        let lines = std::mem::take(&mut self.flow.lines);
        let flow = self.story.run(self.stack, node, lines, self.depth);
        self.flow.lines = flow.lines;
        self.flow.waiting.join(flow.waiting, &mut self.story.out);
    }

    fn object(&mut self, node: Node<'s>) {
        let members = node.members();
        let of = |known: &str| members.iter().find(|(name, _)| name == known).map(|(_, node)| *node);
        let is_true = |known: &str| of(known).is_some_and(|node| node.line.text == "true");
        if let Some(path) = of("->").and_then(Node::string) {
            self.divert(&Divert { path, is_conditional: is_true("c"), is_variable: is_true("var") });
        } else if of("->t->").is_some() {
            self.flow.lines.continue_elsewhere();
        } else if let Some((tag, node)) = of("#").and_then(|node| Some((node.string()?, node))) {
            // Until version 20 of the format.
            self.flow.lines.tag(&tag, node, &mut self.story.out);
        }
    }

    fn divert(&mut self, divert: &Divert) {
        match self.destination(divert) {
            Destination::Alternative(name, node) => {
                self.run.push(name);
                let lines = self.flow.lines.clone();
                let flow = self.story.run(self.stack, node, lines, self.depth);
                self.flow.waiting.join(flow.lines, &mut self.story.out);
                self.flow.waiting.join(flow.waiting, &mut self.story.out);
                if !divert.is_conditional {
                    self.flow.lines = InkLines::default();
                }
            }
            Destination::SharedText(stack, node) => {
                let Some(rest) = self.story.repeatable_bytes.checked_sub(node.line.text.len()) else { return };
                self.story.repeatable_bytes = rest;
                let lines = std::mem::take(&mut self.flow.lines);
                let flow = self.story.run(&stack, node, lines, self.depth);
                self.flow.lines = flow.lines;
                self.flow.lines.join(flow.waiting, &mut self.story.out);
            }
            Destination::EndOfAlternative => {
                self.flow.waiting.join(std::mem::take(&mut self.flow.lines), &mut self.story.out);
            }
            Destination::Elsewhere if divert.is_conditional => {}
            Destination::Elsewhere => {
                self.flow.lines.continue_elsewhere();
                self.flow.lines.finish(&mut self.story.out);
            }
        }
    }

    fn destination(&self, divert: &Divert) -> Destination<'s> {
        if divert.is_variable {
            // In this variable, a choice stores the end of the shared text.
            return if divert.path == "$r" { Destination::EndOfAlternative } else { Destination::Elsewhere };
        }
        let own = divert.path.strip_prefix(".^.").filter(|name| !self.run.iter().any(|run| run == name));
        let named = self.stack.last().map_or(&[][..], |container| &container.named);
        if let Some((name, node)) = own.and_then(|name| named.iter().find(|(known, _)| known == name)) {
            return Destination::Alternative(name.clone(), *node);
        }
        let last_step = divert.path.rsplit('.').next().unwrap_or_default();
        if last_step != "s" && last_step.parse::<usize>().is_err() {
            return Destination::Elsewhere;
        }
        match resolve(self.stack, &divert.path) {
            Some((_, node)) if node.string().as_deref() == Some("nop") => Destination::EndOfAlternative,
            Some((stack, node)) if last_step == "s" && stack.last().is_some_and(|last| last.has_shared_text()) => {
                Destination::SharedText(stack, node)
            }
            _ => Destination::Elsewhere,
        }
    }
}
