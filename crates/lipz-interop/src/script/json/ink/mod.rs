//! Lines of compiled stories of Ink, collected along the paths that Ink's runtime can take.
//!
//! A story consists of containers, whose items run in order: texts start with `^`, a line ends with `\n`, and tags are
//! between `#` and `/#`. Strings and conditions are between `ev` and `/ev`, and are not displayed. The format is described
//! in `ink_JSON_runtime_format.md` of the Ink project.

mod container;
mod line;

use super::ExportedLine;
use crate::json::Node;
use container::{Container, ContainerStack, resolve};
use line::{FinishedLines, InkLines};
use lipz_diagnostics::{Code, Diagnostic, Span};

/// The deepest nesting of containers, not counting those at the ends of others.
const MAX_DEPTH: usize = 100;

/// The deepest nesting of all containers. Each gather of a knot can be inside the one before.
const MAX_CONTAINERS: usize = 1000;

/// Returns the lines of a story that have IDs, ordered by position.
pub(super) fn lines(story: Node<'_>) -> (Vec<ExportedLine>, Option<Diagnostic>) {
    let mut reading =
        StoryReader { out: FinishedLines::default(), too_deep: None, repeatable_bytes: story.line.text.len() };
    if let Some(root) = story.get(&["root"]) {
        reading.run_apart(&ContainerStack::new(), root, MAX_DEPTH);
    }
    let too_deep = reading.too_deep.map(|span| {
        let message = "the containers of the story are nested too deeply";
        Diagnostic::at(Code::ForeignSyntax, span, message).help("divide the content into more knots or stitches")
    });
    (reading.out.into_lines(), too_deep)
}

struct StoryReader {
    out: FinishedLines,
    /// The first container that is too deep.
    too_deep: Option<Span>,
    /// The remaining bytes of texts that labels of choices and lines share. In a compiled story, each is used once.
    repeatable_bytes: usize,
}

/// The alternatives of the current line.
#[derive(Default)]
struct StoryFlow {
    /// Those that go on with the next item.
    lines: InkLines,
    /// Those that go on after a `nop`: at the end of a condition or sequence.
    waiting: InkLines,
}

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

impl StoryReader {
    /// Reads content that runs only if a divert leads to it.
    fn run_apart<'s>(&mut self, stack: &ContainerStack<'s>, node: Node<'s>, depth: usize) {
        let mut flow = self.run(stack, node, InkLines::start(), depth);
        flow.lines.finish(&mut self.out);
        flow.waiting.finish(&mut self.out);
    }

    /// Reads a container, which continues these lines.
    fn run<'s>(&mut self, around: &ContainerStack<'s>, node: Node<'s>, lines: InkLines, depth: usize) -> StoryFlow {
        let Some(depth) = depth.checked_sub(1) else {
            self.too_deep.get_or_insert(Span::new(node.line.at, node.line.at + 1));
            return StoryFlow { lines, ..StoryFlow::default() };
        };
        let (mut flow, mut stack) = (StoryFlow { lines, ..StoryFlow::default() }, around.clone());
        let mut waiting_outside = InkLines::default();
        let mut next = Some(node);
        // A container at the end of another, such as a gather, does not count as nested.
        while let Some(container) = next.take().and_then(Container::read) {
            stack.push(container.clone());
            let mut reader = ContainerReader { story: self, stack: &stack, depth, flow, run: Vec::new() };
            next = reader.items(&container.items);
            let run = reader.run;
            flow = reader.flow;
            for (name, node) in container.named.iter().filter(|(name, _)| !run.contains(name)) {
                if name != "s" || !container.has_shared_text() {
                    self.run_apart(&stack, *node, depth);
                }
            }
            if let Some(node) = next.filter(|_| stack.len() > MAX_CONTAINERS) {
                self.too_deep.get_or_insert(Span::new(node.line.at, node.line.at + 1));
                break;
            }
            if next.is_some() {
                waiting_outside.join(std::mem::take(&mut flow.waiting), &mut self.out);
            }
        }
        flow.waiting.join(waiting_outside, &mut self.out);
        flow
    }
}

/// A container that is being read.
struct ContainerReader<'r, 's> {
    story: &'r mut StoryReader,
    /// With this container.
    stack: &'r ContainerStack<'s>,
    depth: usize,
    flow: StoryFlow,
    /// The names of the content that diverts here led to.
    run: Vec<String>,
}

impl<'s> ContainerReader<'_, 's> {
    /// Reads items. If the last one is a container, returns it instead.
    fn items(&mut self, items: &[Node<'s>]) -> Option<Node<'s>> {
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
            self.divert(Divert { path, is_conditional: is_true("c"), is_variable: is_true("var") });
        } else if of("->t->").is_some() {
            self.flow.lines.continue_elsewhere();
        } else if let Some((tag, node)) = of("#").and_then(|node| Some((node.string()?, node))) {
            // Until version 20 of the format.
            self.flow.lines.tag(&tag, node, &mut self.story.out);
        }
    }

    fn divert(&mut self, divert: Divert) {
        match self.destination(&divert) {
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
