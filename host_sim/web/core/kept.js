// @ts-check
/* Texts that the browser keeps from one visit to the next, if it is allowed to. */

/**
 * The text kept under a name; empty if there is none.
 * @param {string} name
 */
export function kept(name) {
  try {
    return localStorage.getItem(`octet-${name}`) ?? "";
  } catch {
    return ""; // a browser may forbid it to files
  }
}

/**
 * @param {string} name
 * @param {string} text
 */
export function keep(name, text) {
  try {
    localStorage.setItem(`octet-${name}`, text);
  } catch {
    // then for this visit only
  }
}
