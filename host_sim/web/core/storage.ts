/* What the browser keeps from one visit to the next: texts, if it is allowed to, and the token of a server. */

/** The text kept under a name; empty if there is none. */
export function kept(name: string) {
  try {
    return localStorage.getItem(`octet-${name}`) ?? "";
  } catch {
    return ""; // a browser may forbid storage to a page opened from a file
  }
}

export function keep(name: string, text: string) {
  try {
    localStorage.setItem(`octet-${name}`, text);
  } catch {
    // it is then kept for this visit only
  }
}

/** Takes the token out of the address bar and the history: the browser has it in a cookie. */
export function hideToken() {
  const address = new URL(location.href);
  address.searchParams.delete("token");
  history.replaceState(null, "", address);
}
