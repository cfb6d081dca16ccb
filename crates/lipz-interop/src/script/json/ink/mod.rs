//! Lines of compiled stories of Ink, collected along the paths that Ink's runtime can take.
//!
//! A story consists of containers, whose items run in order: texts start with `^`, a line ends with `\n`, and tags are
//! between `#` and `/#`. Strings and conditions are between `ev` and `/ev`, and are not displayed. The format is described
//! in `ink_JSON_runtime_format.md` of the Ink project.

mod container;
mod content;
mod line;

use super::ExportedLine;
use crate::json::Node;
use container::{Container, ContainerStack};
use content::ContentReader;
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
            let mut reader = ContentReader { story: self, stack: &stack, depth, flow, run: Vec::new() };
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
