//! Parses a query text: tokens, then a recursive descent into a condition tree.

use guideway_layout::{Layout, near_names};
use guideway_scene::Table;

use super::column::Column;
use super::condition::{Comparison, Condition, Operator};

/// The reason why a query is invalid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at character {at}: {what}")]
pub struct QueryError {
    /// Position of the error, in characters from 1.
    pub at: usize,
    /// The problem and a remedy.
    pub what: String,
}

/// Deepest nesting of parentheses and `not`: each level recurses once, and the stack is finite.
const MAX_DEPTH: usize = 100;

#[derive(Clone, Debug, PartialEq)]
enum Token {
    /// `and`, `or`, `not`, a column or a value.
    Word(String),
    /// A column or a value, and never a keyword.
    Quoted(String),
    Operator(Operator),
    Open,
    Close,
}

/// The condition tree of a query.
pub(super) fn parse(text: &str, layout: &Layout, of: Table) -> Result<Condition, QueryError> {
    let tokens = tokens(text)?;
    let mut parser = Parser {
        end: text.chars().count() + 1,
        tokens: &tokens,
        layout,
        of,
    };
    let condition = parser.condition(0)?;
    match parser.tokens.first() {
        None => Ok(condition),
        Some(_) => Err(parser.fail("join conditions with `and` or `or`")),
    }
}

/// Splits a text into tokens, each with its position in characters from 1.
fn tokens(text: &str) -> Result<Vec<(usize, Token)>, QueryError> {
    let mut tokens = Vec::new();
    let mut rest = text.chars().enumerate().peekable();
    while let Some((index, c)) = rest.next() {
        let at = index + 1;
        let mut and_equal =
            |with: Operator, without: Operator| match rest.next_if(|&(_, c)| c == '=') {
                Some(_) => Token::Operator(with),
                None => Token::Operator(without),
            };
        let token = match c {
            ' ' | '\t' | '\n' | '\r' => continue,
            '(' => Token::Open,
            ')' => Token::Close,
            '~' => Token::Operator(Operator::Contains),
            '=' => and_equal(Operator::Equal, Operator::Equal),
            '<' => and_equal(Operator::AtMost, Operator::Less),
            '>' => and_equal(Operator::AtLeast, Operator::Greater),
            '!' if rest.next_if(|&(_, c)| c == '=').is_some() => {
                Token::Operator(Operator::NotEqual)
            }
            '"' | '\'' => {
                let mut quoted = String::new();
                let is_closed = loop {
                    match rest.next() {
                        Some((_, end)) if end == c => break true,
                        Some((_, c)) => quoted.push(c),
                        None => break false,
                    }
                };
                if !is_closed {
                    let what = format!("the quote {c} is not closed");
                    return Err(QueryError { at, what });
                }
                Token::Quoted(quoted)
            }
            _ => {
                let mut word = String::from(c);
                let is_part = |c: char| !c.is_whitespace() && !"()~=<>!\"'".contains(c);
                while let Some((_, c)) = rest.next_if(|&(_, c)| is_part(c)) {
                    word.push(c);
                }
                Token::Word(word)
            }
        };
        tokens.push((at, token));
    }
    Ok(tokens)
}

/// The tokens that are left to parse.
struct Parser<'a> {
    tokens: &'a [(usize, Token)],
    /// Position after the last character.
    end: usize,
    layout: &'a Layout,
    of: Table,
}

impl Parser<'_> {
    fn condition(&mut self, depth: usize) -> Result<Condition, QueryError> {
        let mut terms = vec![self.term(depth)?];
        while self.take_keyword("or") {
            terms.push(self.term(depth)?);
        }
        Ok(Condition::Any(terms))
    }

    fn term(&mut self, depth: usize) -> Result<Condition, QueryError> {
        let mut factors = vec![self.factor(depth)?];
        while self.take_keyword("and") {
            factors.push(self.factor(depth)?);
        }
        Ok(Condition::All(factors))
    }

    fn factor(&mut self, depth: usize) -> Result<Condition, QueryError> {
        if depth > MAX_DEPTH {
            return Err(self.fail(format!("conditions nest deeper than {MAX_DEPTH} levels")));
        }
        if self.take_keyword("not") {
            return Ok(Condition::Not(Box::new(self.factor(depth + 1)?)));
        }
        if self.take(&Token::Open) {
            let inner = self.condition(depth + 1)?;
            if !self.take(&Token::Close) {
                return Err(self.fail("a parenthesis is not closed"));
            }
            return Ok(inner);
        }
        self.comparison().map(Condition::Compare)
    }

    fn comparison(&mut self) -> Result<Comparison, QueryError> {
        let expected_column = "expected a column, such as `id`";
        let Some((_, Token::Word(name) | Token::Quoted(name))) = self.tokens.first() else {
            return Err(self.fail(expected_column));
        };
        let Some(column) = Column::named(name, self.layout, self.of) else {
            let known = Column::names(self.layout, self.of);
            let near = near_names(name, known.iter().map(AsRef::as_ref));
            let near = match near[..] {
                [nearest, ..] => format!("did you mean `{nearest}`? "),
                [] => String::new(),
            };
            let known = known.join(", ");
            return Err(self.fail(format!(
                "unknown column `{name}`; {near}The layout has: {known}"
            )));
        };
        self.advance();
        let Some((_, Token::Operator(operator))) = self.tokens.first() else {
            return Err(self.fail("expected an operator: =, !=, <, <=, >, >= or ~"));
        };
        self.advance();
        let Some((_, Token::Word(text) | Token::Quoted(text))) = self.tokens.first() else {
            return Err(self.fail("expected a value, such as 1.5 or \"A 3\""));
        };
        self.advance();
        Ok(Comparison {
            column,
            operator: *operator,
            number: text.parse().ok(),
            text: text.clone(),
        })
    }

    fn take(&mut self, wanted: &Token) -> bool {
        let is_next = self
            .tokens
            .first()
            .is_some_and(|(_, token)| token == wanted);
        if is_next {
            self.advance();
        }
        is_next
    }

    fn take_keyword(&mut self, keyword: &str) -> bool {
        let is_keyword = |word: &str| word.eq_ignore_ascii_case(keyword);
        let is_next =
            matches!(self.tokens.first(), Some((_, Token::Word(word))) if is_keyword(word));
        if is_next {
            self.advance();
        }
        is_next
    }

    fn advance(&mut self) {
        self.tokens = &self.tokens[1..];
    }

    fn fail(&self, what: impl Into<String>) -> QueryError {
        QueryError {
            at: self.tokens.first().map_or(self.end, |&(at, _)| at),
            what: what.into(),
        }
    }
}
