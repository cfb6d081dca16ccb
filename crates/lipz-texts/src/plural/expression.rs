//! The expressions of `Plural-Forms` in PO files: C expressions of the number `n` (gettext manual, "Plural forms").

/// An expression as a sequence of operations on a stack. Operands come before their operator.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Expression(Vec<Operation>);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Operation {
    Number(u32),
    N,
    Not,
    Binary(Operator),
    /// Chooses between the two values before it, by the value before them.
    Choose,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Operator {
    Or,
    And,
    Equal,
    NotEqual,
    AtMost,
    AtLeast,
    Less,
    Greater,
    Plus,
    Minus,
    Times,
    Divided,
    Modulo,
}

/// The operators with their spelling and rank. Longer spellings come before their beginnings.
const OPERATORS: [(&str, Operator, u8); 13] = [
    ("||", Operator::Or, 1),
    ("&&", Operator::And, 2),
    ("==", Operator::Equal, 3),
    ("!=", Operator::NotEqual, 3),
    ("<=", Operator::AtMost, 4),
    (">=", Operator::AtLeast, 4),
    ("<", Operator::Less, 4),
    (">", Operator::Greater, 4),
    ("+", Operator::Plus, 5),
    ("-", Operator::Minus, 5),
    ("*", Operator::Times, 6),
    ("/", Operator::Divided, 6),
    ("%", Operator::Modulo, 6),
];

/// The longest expression, in bytes. It bounds the time and the depth of recursion; real ones have less than 200.
const LONGEST: usize = 1_000;
/// The deepest nesting of parentheses and choices.
const DEEPEST: usize = 50;

impl Expression {
    /// Parses an expression; `None` if it is invalid or too long.
    pub(super) fn parse(text: &str) -> Option<Expression> {
        let mut parser = Parser { rest: text.trim_end(), operations: Vec::new(), depth: 0 };
        if text.len() > LONGEST {
            return None;
        }
        parser.choice()?;
        parser.rest.is_empty().then_some(Expression(parser.operations))
    }

    /// Returns the value for a number; `None` after a division by zero.
    pub(super) fn value(&self, number: u32) -> Option<u32> {
        let mut stack: Vec<u32> = Vec::new();
        for operation in &self.0 {
            let value = match *operation {
                Operation::Number(value) => value,
                Operation::N => number,
                Operation::Not => u32::from(stack.pop()? == 0),
                Operation::Binary(operator) => {
                    let (right, left) = (stack.pop()?, stack.pop()?);
                    operator.value(left, right)?
                }
                Operation::Choose => {
                    let (no, yes, condition) = (stack.pop()?, stack.pop()?, stack.pop()?);
                    if condition != 0 { yes } else { no }
                }
            };
            stack.push(value);
        }
        stack.pop()
    }
}

impl Operator {
    fn value(self, left: u32, right: u32) -> Option<u32> {
        Some(match self {
            Operator::Or => u32::from(left != 0 || right != 0),
            Operator::And => u32::from(left != 0 && right != 0),
            Operator::Equal => u32::from(left == right),
            Operator::NotEqual => u32::from(left != right),
            Operator::AtMost => u32::from(left <= right),
            Operator::AtLeast => u32::from(left >= right),
            Operator::Less => u32::from(left < right),
            Operator::Greater => u32::from(left > right),
            Operator::Plus => left.wrapping_add(right),
            Operator::Minus => left.wrapping_sub(right),
            Operator::Times => left.wrapping_mul(right),
            Operator::Divided => left.checked_div(right)?,
            Operator::Modulo => left.checked_rem(right)?,
        })
    }
}

struct Parser<'t> {
    rest: &'t str,
    operations: Vec<Operation>,
    depth: usize,
}

impl Parser<'_> {
    /// Skips this text, if it is next.
    fn accept(&mut self, text: &str) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(text);
        rest.map(|rest| self.rest = rest).is_some()
    }

    fn choice(&mut self) -> Option<()> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        self.operation(1)?;
        if self.accept("?") {
            self.choice()?;
            if !self.accept(":") {
                return None;
            }
            self.choice()?;
            self.operations.push(Operation::Choose);
        }
        self.depth -= 1;
        Some(())
    }

    /// Parses operations whose operators have at least this rank, from left to right.
    fn operation(&mut self, least: u8) -> Option<()> {
        self.operand()?;
        while let Some((spelling, operator, rank)) = self.operator().filter(|(.., rank)| *rank >= least) {
            self.accept(spelling);
            self.operation(rank + 1)?;
            self.operations.push(Operation::Binary(operator));
        }
        Some(())
    }

    /// Returns the next operator without skipping it.
    fn operator(&mut self) -> Option<(&'static str, Operator, u8)> {
        self.rest = self.rest.trim_start();
        OPERATORS.into_iter().find(|(spelling, ..)| self.rest.starts_with(spelling))
    }

    fn operand(&mut self) -> Option<()> {
        let mut nots = 0;
        while self.accept("!") {
            nots += 1;
        }
        if self.accept("(") {
            self.choice()?;
            if !self.accept(")") {
                return None;
            }
        } else if self.accept("n") {
            self.operations.push(Operation::N);
        } else {
            let length = self.rest.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(self.rest.len());
            let (digits, rest) = self.rest.split_at(length);
            self.operations.push(Operation::Number(digits.parse().ok()?));
            self.rest = rest;
        }
        self.operations.extend(std::iter::repeat_n(Operation::Not, nots));
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_expressions() {
        let value = |text: &str, number| Expression::parse(text).unwrap().value(number);
        assert_eq!(value("n != 1", 1), Some(0));
        assert_eq!(value("!n", 0), Some(1));
        assert_eq!(value("!!(n-1)", 3), Some(1));
        assert_eq!(value("n%10==1 && n%100!=11 ? 0 : n != 0 ? 1 : 2", 21), Some(0));
        assert_eq!(value("n%10==1 && n%100!=11 ? 0 : n != 0 ? 1 : 2", 11), Some(1));
        assert_eq!(value("(n==1) ? 0 : (n>=2 && n<=4) ? 1 : 2", 5), Some(2));
        assert_eq!(value("10 - 2 - 3 * 2 + n / 2", 5), Some(4), "from left to right, by rank");
        assert_eq!(value("1 || 0 && 0", 0), Some(1));
        assert_eq!(value("n / 0", 1), None);
    }

    #[test]
    fn other_texts_are_refused() {
        let deep = "(".repeat(400) + "n" + &")".repeat(400);
        for text in ["", "n n", "n ?", "n ? 1", "(n", "n)", "m", "n = 1", "99999999999", "n ==", &deep, &"!".repeat(9)]
        {
            assert_eq!(Expression::parse(text), None, "{text}");
        }
        assert_eq!(Expression::parse(&format!("n{}", " ".repeat(LONGEST))), None);
    }
}
