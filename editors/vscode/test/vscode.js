// A stand-in for the module `vscode`, which only the editor has: as much of it as a language client needs to open files, show
// diagnostics and ask. What is not known here does nothing.

/** Something with these parts: what else is asked of it is a class or a namespace if it is written large, or a function. */
function standIn(known = {}) {
  const nothing = () => ({ dispose() {} });
  // Of a class or a namespace, only names are asked.
  const other = (name) => (/^[A-Z]/.test(name) ? standIn(class {}) : nothing);
  return new Proxy(known, { get: (target, name) => (name in target || typeof name === "symbol" ? target[name] : other(name)) });
}

class Position {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
}

class Range {
  constructor(start, end, ...rest) {
    const isNumbers = rest.length > 0;
    Object.assign(this, isNumbers ? { start: new Position(start, end), end: new Position(...rest) } : { start, end });
  }
}

class Uri {
  constructor(address) {
    Object.assign(this, { address, ...parts(address) });
  }
  static parse = (address) => new Uri(address);
  static file = (path) => new Uri(`file://${path}`);
  toString() {
    return this.address;
  }
}

function parts(address) {
  const { protocol, pathname } = new URL(address);
  return { scheme: protocol.slice(0, -1), path: pathname, fsPath: decodeURIComponent(pathname) };
}

class EventEmitter {
  #listeners = new Set();
  event = (listener, self) => {
    const bound = self ? listener.bind(self) : listener;
    this.#listeners.add(bound);
    return { dispose: () => this.#listeners.delete(bound) };
  };
  async fire(event) {
    // Of a copy, because a listener that waits for the next event is added during this one.
    for (const listener of [...this.#listeners]) await listener(event);
  }
  dispose() {
    this.#listeners.clear();
  }
}

/** A class whose values keep what they are made of, under these names. */
const record = (...names) =>
  class {
    constructor(...values) {
      names.forEach((name, index) => (this[name] = values[index]));
    }
  };

class CancellationTokenSource {
  token = { isCancellationRequested: false, onCancellationRequested: () => ({ dispose() {} }) };
  cancel() {
    this.token.isCancellationRequested = true;
  }
  dispose() {}
}

class CodeActionKind {
  static Empty = new CodeActionKind("");
  static QuickFix = CodeActionKind.Empty.append("quickfix");
  static Source = CodeActionKind.Empty.append("source");
  constructor(value) {
    this.value = value;
  }
  append(part) {
    return new CodeActionKind([this.value, part].filter(Boolean).join("."));
  }
}

/** An open document. */
class TextDocument {
  version = 1;
  languageId = "lipz";
  constructor(path, text) {
    Object.assign(this, { uri: Uri.file(path), fileName: path, text });
  }
  getText() {
    return this.text;
  }
}

/** The editor: `settings` are those of the extension. What it is told is in `shown`, `registered` and `diagnostics`. */
class Editor {
  registered = [];
  shown = [];
  /** What is wrong with documents, by their addresses. */
  diagnostics = new Map();
  /** What completes, formats and so on, by the kind of its provider. */
  providers = new Map();
  #opened = new EventEmitter();
  #changed = new EventEmitter();
  #told = new EventEmitter();

  constructor(settings) {
    const events = { onDidOpenTextDocument: this.#opened.event, onDidChangeTextDocument: this.#changed.event };
    this.vscode = standIn({
      version: "1.91.0",
      commands: standIn({ registerCommand: (name) => (this.registered.push(name), { dispose() {} }) }),
      languages: this.#languages(),
      window: standIn({
        showErrorMessage: async (message) => void this.shown.push(message),
        createOutputChannel: () => standIn(),
        visibleTextEditors: [],
        tabGroups: standIn({ all: [] }),
      }),
      workspace: standIn({
        getConfiguration: () => ({ get: (name, other) => (name in settings ? settings[name] : other) }),
        workspaceFolders: undefined,
        textDocuments: [],
        notebookDocuments: [],
        ...events,
      }),
      env: { language: "en", appName: "stand-in" },
      Position,
      Range,
      Uri,
      EventEmitter,
      CancellationTokenSource,
      CodeActionKind: standIn(CodeActionKind),
      Diagnostic: record("range", "message", "severity"),
      CompletionItem: record("label", "kind"),
      CompletionList: record("items", "isIncomplete"),
      Hover: record("contents", "range"),
      TextEdit: class extends record("range", "newText") {
        static replace = (range, text) => new this(range, text);
      },
      SnippetString: record("value"),
      MarkdownString: record("value"),
      DocumentSymbol: record("name", "detail", "kind", "range", "selectionRange"),
    });
  }

  #languages() {
    const takes = (selector, { languageId, uri }) =>
      selector.some(({ language, scheme }) => (language ?? languageId) === languageId && (scheme ?? uri.scheme) === uri.scheme);
    const collection = {
      set: (uri, found) => {
        this.diagnostics.set(uri.toString(), found);
        this.#told.fire();
      },
      delete: (uri) => this.diagnostics.delete(uri.toString()),
    };
    const languages = {
      match: (selector, document) => (takes([selector].flat(), document) ? 10 : 0),
      createDiagnosticCollection: () => standIn(collection),
    };
    // `registerHoverProvider(selector, provider)`, and so on.
    const register = (name) => (selector, provider) => {
      this.providers.set(/^register(.*)Provider$/.exec(name)?.[1], provider);
      return { dispose() {} };
    };
    const isProvider = (name) => typeof name === "string" && name.startsWith("register");
    return new Proxy(languages, { get: (known, name) => (isProvider(name) ? register(name) : (known[name] ?? standIn()[name])) });
  }

  /** Opens a document. */
  async open(path, text) {
    const document = new TextDocument(path, text);
    this.vscode.workspace.textDocuments.push(document);
    await this.#opened.fire(document);
    return document;
  }

  /** Types: replaces a stretch of one line. */
  async type(document, line, from, to, text) {
    const lines = document.text.split("\n");
    lines[line] = lines[line].slice(0, from) + text + lines[line].slice(to);
    Object.assign(document, { text: lines.join("\n"), version: document.version + 1 });
    const change = { range: new Range(line, from, line, to), rangeOffset: 0, rangeLength: to - from, text };
    await this.#changed.fire({ document, contentChanges: [change] });
  }

  /** Waits until what is wrong with a document is such. */
  async diagnosed(document, isMeant) {
    const found = () => this.diagnostics.get(document.uri.toString());
    while (!found() || !isMeant(found())) {
      let listener;
      await new Promise((resolve) => (listener = this.#told.event(resolve)));
      listener.dispose();
    }
    return found();
  }
}

module.exports = { CancellationTokenSource, Editor, Position };
