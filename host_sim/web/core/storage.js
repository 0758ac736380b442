// @ts-check
/* What the browser keeps from one visit to the next: texts, if it is allowed to, and the token of a server. */

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

/** Takes the token out of the address bar and the history: the browser has it in a cookie. */
export function hideToken() {
  const address = new URL(location.href);
  address.searchParams.delete("token");
  history.replaceState(null, "", address);
}
