// @ts-check
/* Makes elements. */

/**
 * An element with a text or children.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} kind
 * @param {(string | Node)[]} children
 * @param {Record<string, string>} [attributes]
 * @returns {HTMLElementTagNameMap[K]}
 */
export function made(kind, children, attributes = {}) {
  const element = document.createElement(kind);
  element.append(...children);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/**
 * @param {string} text
 * @param {() => void} onClick
 */
export function buttonOf(text, onClick) {
  const button = made("button", [text], { type: "button" });
  button.addEventListener("click", onClick);
  return button;
}

/**
 * A field to choose from.
 * @param {string} label
 * @param {[string, string][]} options - Their values and texts.
 * @param {(value: string) => void} onChange
 */
export function choiceOf(label, options, onChange) {
  const select = made("select", options.map(([value, text]) => made("option", [text], { value })));
  select.addEventListener("change", () => onChange(select.value));
  return { label: made("label", [`${label} `, select]), select };
}

/** @param {string[][]} entries - Terms and what they mean; they become the rows of a `dl`. */
export function termsOf(entries) {
  return entries.map(([term, meaning]) => made("div", [made("dt", [term]), made("dd", [meaning])]));
}
