//! A bank and the layers over it, as tools use them: opened, checked, and made one.

use super::merge;
use crate::compile::verify;
use lipz_bank::{Bank, ErrorKind, Layers};
use lipz_diagnostics::{Code, Diagnostic, Report};

/// The most banks of a stack.
pub(super) const MAX_LAYERS: usize = 64;

/// A bank, or one with layers over it, and what they are together: the bank that would be packed from all of their
/// sources in one go, byte for byte.
///
/// ```
/// use lipz_compiler::{Compiler, Input, Over, Stack};
/// let aye = |text: &str| [Input::from_bytes("aye", format!(r#"{{ "text_en-us": "{text}" }}"#))];
/// let compiler = Compiler::default();
/// let base = compiler.compile(&aye("Aye.")).into_bank()?;
/// let over = Over::new(Stack::open([("base", &base)]).map_err(|report| report.to_string())?);
/// let patch = compiler.compile_over(&aye("Aye, aye."), &over).into_bank()?;
/// let stack = Stack::open([("base", &base), ("patch", &patch)]).map_err(|report| report.to_string())?;
/// assert_eq!(stack.into_bank(), compiler.compile(&aye("Aye, aye.")).into_bank()?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Stack {
    pub(super) whole: Vec<u8>,
    /// Checksums of the banks, the lowest first.
    pub(super) checksums: Vec<u64>,
}

impl Stack {
    /// Opens and verifies banks, the base first, each with the name that messages give it, and makes one bank of them.
    ///
    /// # Errors
    /// When one of them is damaged or does not fit those before it. A single bank must not be a layer.
    pub fn open<'f, B: AsRef<[u8]> + ?Sized + 'f>(
        files: impl IntoIterator<Item = (&'f str, &'f B)>,
    ) -> Result<Stack, Report> {
        let files: Vec<(&str, &[u8])> = files.into_iter().map(|(name, bytes)| (name, bytes.as_ref())).collect();
        let banks = files.iter().map(|(name, bytes)| verified(name, bytes)).collect::<Result<Vec<_>, _>>()?;
        let layers = Layers::<MAX_LAYERS>::from_slice(&banks).map_err(|error| {
            let (name, _) = files.get(error.layer()).or(files.last()).copied().unwrap_or_default();
            misfit(name, error.error().kind(), banks.get(error.layer()))
        })?;
        let whole = match files.as_slice() {
            [(_, bytes)] => bytes.to_vec(),
            _ => merge::merge(&layers)?,
        };
        verify(&whole)?;
        Ok(Stack { whole, checksums: banks.iter().map(Bank::checksum).collect() })
    }

    /// The bank that the stack is as a whole.
    pub fn bank(&self) -> &[u8] {
        &self.whole
    }

    /// The bank that the stack is as a whole.
    pub fn into_bank(self) -> Vec<u8> {
        self.whole
    }
}

/// The bank in a file, verified.
fn verified<'f>(name: &str, bytes: &'f [u8]) -> Result<Bank<'f>, Report> {
    let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
    let opened = Bank::open(bytes).map_err(|error| (Code::BankRefused, error));
    let verified = opened.and_then(|bank| bank.verify_with(utf8).map_err(|error| (Code::BankDamaged, error)));
    verified.map_err(|(code, error)| {
        let place =
            format!("bank error {}, at byte {} of {}", error.kind().number(), error.offset_bytes(), bytes.len());
        let diagnostic = Diagnostic::new(code, error.kind().message()).note(place);
        Report::about(name, diagnostic.help("name .lipzbank files, copied whole; pack those that are damaged again"))
    })
}

/// The report about a bank that does not fit those below it.
fn misfit(name: &str, kind: ErrorKind, bank: Option<&Bank<'_>>) -> Report {
    let help = match kind {
        ErrorKind::OtherBase => {
            "name the banks that it was packed over, in their order, before it; `lipz inspect` shows their checksums"
        }
        ErrorKind::NotALayer => "name one bank first, and behind it those that were packed with `--over`",
        ErrorKind::LayerCount => "name at least one bank, and at most 64",
        _ => "pack it again",
    };
    let mut diagnostic = Diagnostic::new(Code::LayerMisfit, kind.message()).help(help);
    if kind == ErrorKind::OtherBase {
        let over = bank.and_then(Bank::layer).into_iter().flat_map(|layer| layer.made_over());
        let over: Vec<String> = over.map(|checksum| format!("{checksum:016x}")).collect();
        diagnostic = diagnostic.note(format!("it was packed over {}", over.join(", ")));
    }
    Report::about(name, diagnostic)
}
