// The colours of Pluto text, by the compiler's own words.

import { HighlightStyle, LanguageSupport, StreamLanguage } from "../codemirror/codemirror-language.js";
import { tags } from "../codemirror/lezer-highlight.js";

const WORDS = /^(?:pluto|use|as|app|category|can|action|evaluator|modifier|policy|emits|writes|when|otherwise)\b/;
const SETTINGS = /^(?:version|requires)\b(?=[ \t]*")/;
const FIELDS = /^(?:mission|trip)[ \t]+has\b(?=[ \t]+[A-Za-z])/;
const RESULT = /^(?:result)\b(?=[ \t]+[A-Za-z]\w*[ \t]+as\b)/;
const REACTING = /^(?:event|creator)\b(?=[ \t]+[A-Za-z])/;
const TAKES = /^(?:takes)\b(?=[ \t]+(?!when\b|otherwise\b)\w)/;
const CONSTANTS = /^(?:yes|no|safe|once|ask|along)\b/;
const STATUS = /^(?:UNEXECUTED|RUNNING|STANDBY|COMPLETED|FAILED)\b/;
const TYPES = /^(?:int|float|bool|text|mass|length|time|angle|percent|speed|temperature)\b/;
const PHOTO = /^(?:photo)\b(?=[ \t]*(?:$|#|safe|once|ask|along|takes))/;
const QUANTITY = /^-?\d+(?:\.\d+)?(?:[ \t]*(?:km\/h|m\/s|min|deg|rad|ms|mm|cm|km|mg|kg|s|h|m|g|%|C|K)(?!\w))?/;

function token(stream) {
  if (stream.eatSpace()) return null;
  if (stream.match(/^#.*/)) return "comment";
  if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return "string";
  if (stream.match(QUANTITY)) return "number";
  if (stream.match("->")) return "arrow";
  if (stream.match(/^[A-Za-z]\w*(?=[ \t]*:)/)) return "parameter";
  if (stream.match(/^[A-Za-z]\w*(?=[ \t]*=)/)) return "definition";
  if (stream.match(STATUS)) return "status";
  if (stream.match(WORDS) || stream.match(SETTINGS) || stream.match(FIELDS) || stream.match(RESULT) || stream.match(REACTING) || stream.match(TAKES)) return "keyword";
  if (stream.match(CONSTANTS)) return "constant";
  if (stream.match(TYPES) || stream.match(PHOTO)) return "type";
  if (stream.match(/^(?:start|end)\b/)) return "terminal";
  if (stream.match(/^[A-Z]\w*/)) return "kind";
  if (stream.match(/^\w+/)) return "name";
  stream.next();
  return null;
}

const pluto = StreamLanguage.define({
  name: "pluto",
  token,
  languageData: { commentTokens: { line: "#" }, closeBrackets: { brackets: ["(", "[", "{", '"'] } },
  tokenTable: {
    arrow: tags.operator, parameter: tags.propertyName, definition: tags.definition(tags.variableName),
    status: tags.atom, constant: tags.bool, type: tags.typeName, terminal: tags.atom,
    kind: tags.className, name: tags.variableName,
  },
});

export const plutoLanguage = () => new LanguageSupport(pluto);

const look = (tag, color, more = {}) => ({ tag, color: `var(--${color})`, ...more });

export const colours = HighlightStyle.define([
  look(tags.comment, "comment", { fontStyle: "italic" }),
  look([tags.string, tags.special(tags.string)], "string"),
  look([tags.number, tags.bool, tags.null], "number"),
  look([tags.keyword, tags.controlKeyword, tags.definitionKeyword, tags.moduleKeyword, tags.operatorKeyword], "keyword"),
  look([tags.className, tags.typeName], "type"),
  look(tags.atom, "standby"),
  look(tags.operator, "muted"),
  look(tags.propertyName, "muted"),
  look([tags.definition(tags.variableName), tags.function(tags.definition(tags.variableName))], "ink", { fontWeight: "bold" }),
]);
