// One text in CodeMirror: its own colours, keys, completion, and what the server says of it.
// It lives in a shadow root, where styles need no exception from the page's policy.

import { acceptCompletion, autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "../codemirror/codemirror-autocomplete.js";
import { python } from "../codemirror/codemirror-lang-python.js";
import { defaultKeymap, toggleComment } from "../codemirror/codemirror-commands.js";
import { bracketMatching, foldGutter, foldKeymap, indentOnInput, indentUnit, syntaxHighlighting } from "../codemirror/codemirror-language.js";
import { lintKeymap, setDiagnostics } from "../codemirror/codemirror-lint.js";
import { highlightSelectionMatches, search, searchKeymap } from "../codemirror/codemirror-search.js";
import { EditorState, StateEffect, StateField } from "../codemirror/codemirror-state.js";
import { Decoration, EditorView, drawSelection, dropCursor, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, hoverTooltip, keymap, lineNumbers, rectangularSelection, tooltips } from "../codemirror/codemirror-view.js";
import { run } from "../commands.js";
import { h } from "../dom.js";
import { ask } from "../link.js";
import { markdown } from "./markdown.js";
import { colours, plutoLanguage } from "./pluto_mode.js";
import { Sync, fromServer } from "./sync.js";

const mark = StateEffect.define();
const marked = StateField.define({
  create: () => Decoration.none,
  update(value, transaction) {
    const found = transaction.effects.find((effect) => effect.is(mark));
    return found ? found.value : value.map(transaction.changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});
const chosenLine = Decoration.line({ class: "cm-chosen" });

const theme = EditorView.theme({
  "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--card)", fontSize: "13px" },
  "&.cm-focused": { outline: "none" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.55" },
  ".cm-content": { caretColor: "var(--accent)", padding: "8px 0 40px" },
  ".cm-cursor": { borderLeftColor: "var(--accent)", borderLeftWidth: "2px" },
  ".cm-gutters": { backgroundColor: "var(--card)", color: "var(--muted)", border: "0", paddingLeft: "4px" },
  ".cm-lineNumbers .cm-gutterElement": { minWidth: "28px" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--sunk) 60%, #0000)" },
  ".cm-chosen": { backgroundColor: "var(--accent-soft) !important", boxShadow: "inset 3px 0 var(--accent)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground":
    { background: "color-mix(in srgb, var(--focus) 30%, #0000) !important" },
  ".cm-selectionMatch": { backgroundColor: "color-mix(in srgb, var(--standby) 18%, #0000)" },
  "&.cm-focused .cm-matchingBracket": { backgroundColor: "color-mix(in srgb, var(--focus) 30%, #0000)" },
  ".cm-lintRange-error": { backgroundImage: "none", textDecoration: "underline wavy var(--bad) 1.3px", textUnderlineOffset: "3px" },
  ".cm-lintRange-warning": { backgroundImage: "none", textDecoration: "underline wavy var(--warn) 1.3px", textUnderlineOffset: "3px" },
  ".cm-tooltip": {
    backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--edge)", borderRadius: "8px",
    boxShadow: "var(--lifted)", fontFamily: "var(--font)", maxWidth: "440px",
  },
  ".explanation": { maxHeight: "320px", overflow: "auto" },
  ".cm-tooltip.cm-tooltip-autocomplete > ul": { fontFamily: "var(--mono)", fontSize: "12.5px", maxHeight: "15em" },
  ".cm-tooltip.cm-tooltip-autocomplete > ul > li": { padding: "2px 8px" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent) !important", color: "var(--on-accent) !important" },
  ".cm-completionDetail": { fontStyle: "normal", opacity: "0.85", marginLeft: "10px" },
  ".cm-completionIcon": { display: "none" },
  ".cm-completionInfo": { padding: "8px 10px", maxWidth: "340px", fontSize: "12.5px" },
  ".cm-diagnostic": { padding: "5px 10px", borderLeft: "3px solid var(--edge)", marginLeft: "0", whiteSpace: "pre-line" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--bad)" },
  ".cm-diagnostic-warning": { borderLeftColor: "var(--warn)" },
  ".cm-panels": { backgroundColor: "var(--sunk)", color: "var(--ink)" },
  ".cm-panels input, .cm-panels button": { font: "12.5px var(--font)" },
  ".cm-textfield": { backgroundColor: "var(--card)", border: "1px solid var(--edge)", color: "var(--ink)" },
  ".cm-button": { backgroundImage: "none", backgroundColor: "var(--card)", border: "1px solid var(--edge)", color: "var(--ink)" },
  ".cm-panel.cm-search [name=close]": { color: "var(--ink)" },
  ".cm-foldPlaceholder": { backgroundColor: "var(--sunk)", border: "0", color: "var(--muted)" },
  ".markdown": { padding: "8px 12px", fontSize: "12.5px", lineHeight: "1.45", display: "grid", gap: "5px" },
  ".markdown p, .markdown ul, .markdown h4": { margin: "0" },
  ".markdown ul": { paddingLeft: "16px" },
  ".markdown table": { borderCollapse: "collapse" },
  ".markdown :is(td, th)": { textAlign: "left", padding: "2px 8px 2px 0", borderBottom: "1px solid var(--line)", fontWeight: "400" },
  ".markdown pre": { margin: "0", padding: "6px 8px", borderRadius: "6px", background: "var(--sunk)", overflow: "auto", fontFamily: "var(--mono)" },
  ".markdown code": { fontFamily: "var(--mono)" },
});

const KINDS = { block: "variable", kind: "class", status: "constant", hook: "function" };

// What is legal here, as the server says, which must have the same text first.
function completion(file, sync) {
  // In Python a line ends with most of these, and Enter must begin the next one.
  const opening = file === "hooks" ? /\.$/ : /[.:=>,(\[]\s?$|\bwhen\s$/;
  return async (context) => {
    const before = context.matchBefore(/[\w.]*$/);
    const opens = context.matchBefore(opening);
    if (!context.explicit && !before?.text && !opens) return null;
    await sync().atRest();
    if (context.aborted) return null;
    const { items } = await ask("complete", { file, offset: context.pos }).catch(() => ({ items: [] }));
    if (!items.length || context.aborted) return null;
    return {
      from: Math.min(...items.map((one) => one.from)),
      options: items.map((one, i) => ({
        label: one.label, detail: one.detail, type: KINDS[one.kind] ?? "text", boost: -i / items.length,
        info: one.doc ? () => markdown(one.doc) : undefined,
        apply: (view) => view.dispatch({
          changes: { from: one.from, to: Math.max(one.to, view.state.selection.main.head), insert: one.insert },
          selection: { anchor: one.from + one.insert.length }, userEvent: "input.complete",
        }),
      })),
      validFor: /^\w*$/,
    };
  };
}

function hover(file) {
  return hoverTooltip(async (_view, pos) => {
    const found = await ask("hover", { file, offset: pos }).catch(() => null);
    if (!found?.markdown) return null;
    // What scrolls must be reached by a keyboard, too.
    const dom = h("div", { class: "explanation", tabIndex: 0 }, markdown(found.markdown));
    return { pos: found.from, end: found.to, above: true, create: () => ({ dom }) };
  }, { hoverTime: 350 });
}

// hosts: the elements that they fill. moved(offset): a person moved the cursor in the app's text.
export function makeEditors(hosts, moved) {
  return {
    app: makeEditor(hosts.app, {
      file: "app", label: "The app as Pluto text", language: plutoLanguage(), indent: "  ", moved,
    }),
    hooks: makeEditor(hosts.hooks, {
      file: "hooks", label: "hooks.py: your own code", language: python(), indent: "    ",
    }),
  };
}

function makeEditor(host, { file, label, language, indent, moved }) {
  const root = host.attachShadow({ mode: "open" });
  const inside = h("div", { class: "inside" });
  inside.style.height = "100%";
  root.append(inside);
  let sync = null;
  const view = new EditorView({
    root, parent: inside,
    state: EditorState.create({
      extensions: [
        lineNumbers(), foldGutter(), highlightActiveLineGutter(), highlightSpecialChars(), drawSelection(),
        dropCursor(), indentOnInput(), bracketMatching(), closeBrackets(), rectangularSelection(),
        highlightActiveLine(), highlightSelectionMatches(), search({ top: true }), marked,
        EditorView.lineWrapping, language, syntaxHighlighting(colours), theme, indentUnit.of(indent),
        autocompletion({ override: [completion(file, () => sync)], icons: false, activateOnTypingDelay: 60 }),
        hover(file), tooltips({ position: "fixed" }),
        EditorView.contentAttributes.of({ "aria-label": label, spellcheck: "false", tabindex: "0" }),
        keymap.of([
          { key: "Mod-z", run: () => run("undo") ?? true, preventDefault: true },
          { key: "Mod-y", run: () => run("redo") ?? true, preventDefault: true },
          { key: "Mod-Shift-z", run: () => run("redo") ?? true, preventDefault: true },
          { key: "Tab", run: acceptCompletion },
          { key: "Mod-/", run: toggleComment },
          ...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...foldKeymap, ...completionKeymap,
          ...lintKeymap,
        ]),
        EditorView.updateListener.of((update) => {
          const ours = !update.transactions.some((one) => one.annotation(fromServer));
          if (update.docChanged && ours) sync.typed(update.changes);
          if (update.selectionSet && !update.docChanged && ours && update.view.hasFocus) {
            moved?.(update.state.selection.main.head);
          }
        }),
      ],
    }),
  });
  sync = new Sync(file, view);
  return { view, sync, show, problems, mark: markRanges, type };

  function type(text) {
    view.dispatch(view.state.replaceSelection(text));
    view.focus();
  }

  function show(from, to = from, focus = true) {
    const end = view.state.doc.length;
    const at = Math.min(from, end);
    view.dispatch({
      selection: focus ? { anchor: at, head: Math.min(to, end) } : undefined,
      effects: EditorView.scrollIntoView(at, { y: "center" }),
    });
    if (focus) view.focus();
  }

  function problems(found) {
    const end = view.state.doc.length;
    view.dispatch(setDiagnostics(view.state, found.filter(({ to }) => to <= end).map((one) => ({
      from: one.from, to: one.to, severity: one.severity === "error" ? "error" : "warning",
      message: one.help ? `${one.message}\n${one.help}` : one.message, source: one.code,
    }))));
  }

  // The statements of what is selected in the graph.
  function markRanges(ranges) {
    const { doc } = view.state;
    const lines = new Set();
    for (const [from, to] of ranges) {
      if (to > doc.length) continue;
      for (let at = from; at <= to; at = doc.lineAt(at).to + 1) lines.add(doc.lineAt(at).from);
    }
    view.dispatch({
      effects: mark.of(Decoration.set([...lines].sort((a, b) => a - b).map((at) => chosenLine.range(at)))),
    });
    if (!lines.size || view.hasFocus) return;
    view.dispatch({ effects: EditorView.scrollIntoView(Math.min(...lines), { y: "nearest", yMargin: 60 }) });
  }
}
